"""Names of golden pictures: converts test or given names to relative paths.

In:  the name of a test, or any text. Out: a relative path without a suffix that is the same on all
     systems, stays inside of its folder, and is another one for each name.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata

from ...base.files.portable_names import is_device
from ...errors import InvalidArgumentError

SUFFIX = ".png"
MAX_LENGTH = 120  # bytes per part, which leaves room for suffixes
_TEST = re.compile(r"(?P<function>\w+)(?:\[(?P<case>.*)\])?", re.S)
# Matches characters that not every system allows. A name may neither begin nor end with a dot or
# space.
_ODD = re.compile(r"[^\w.+=,@ -]")


def test_name(classes: list[str], test: str, number: int) -> str:
    """Return the name of a test's unnamed picture.

    Parameters
    ----------
    classes : list of str
        The classes around the test, the outermost first.
    test : str
        What pytest calls it: ``test_torus[4-red]`` becomes ``test_torus-4-red``.
    number : int
        Counts the pictures of the test without a name, from 1.
    """
    match = _TEST.fullmatch(test)
    function, case = (match["function"], match["case"]) if match else (test, None)
    joined = ".".join([*classes, function])
    whole = joined if case is None else f"{joined}-{case}"
    return portable_part(whole if number == 1 else f"{whole}-{number}")


def given_name(name: str) -> str:
    """Return the path for a given name; ``/`` separates folders.

    Raises
    ------
    InvalidArgumentError
        It is no text, is empty, or leads out of the folder.
    """
    if not isinstance(name, str):
        raise InvalidArgumentError(f"a golden picture's name is a str, not {type(name).__name__}")
    parts = name.removesuffix(SUFFIX).split("/")
    if any(part.strip() in ("", ".", "..") for part in parts):
        raise InvalidArgumentError(
            f"{name!r} is no name of a golden picture: it stays below its folder, without . and .."
        )
    return "/".join(map(portable_part, parts))


def portable_part(text: str) -> str:
    """Return one part of a path: the text, or a similar one with a hash."""
    text = unicodedata.normalize("NFC", text)
    plain = _ODD.sub("_", text)
    if plain.strip(". ") != plain or is_device(plain):
        plain = "_" + plain.strip(". ")
    encoded = plain.encode("utf-8", "replace")
    if plain == text and len(encoded) <= MAX_LENGTH:
        return plain
    digest = hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return f"{encoded[:MAX_LENGTH].decode('utf-8', 'ignore').rstrip('. ')}~{digest}"
