"""Names of outputs with variables in them, such as ``{model}_{n}.png``.

In: what ``-o`` was given, and the model's name. Out: the name of a file. Places for the numbers of
frames, ``%04d`` and ``{:04}``, stay. Variables follow f3d.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Sequence

from ..version import __version__
from .usage import UsageError

_MODEL = ("model", "model.ext", "model_ext")
#: All variables; some take more behind a colon.
VARIABLES = ("app", "version", *_MODEL, "folder", "date", "n")
_FIELD = re.compile(r"\{\{|\}\}|\{(?P<name>[^{}:]+)(?::(?P<more>[^{}]*))?\}")
_MOST_NUMBERS = 1_000_000


def names_the_model(output: str | None) -> bool:
    """Return whether a name is another one for each model."""
    return output is not None and any(
        match["name"] in (*_MODEL, "folder", "n") for match in _FIELD.finditer(output)
    )


def fill(output: str | None, model: str, taken: Sequence = (), folder: str = "") -> str | None:
    """Return a name whose variables are filled in.

    Parameters
    ----------
    output : str or None
        What has none stays, and so does None.
    model : str
        Path of the model, or what is shown instead.
    taken : sequence of str
        Names that are not free though no file bears them yet.
    folder : str
        The model's folder, relative to the one that was given; empty in that folder itself.

    Raises
    ------
    UsageError
        There is no such variable, or a brace stands alone.
    """
    if output is None or not {"{", "}"} & set(output):
        return output
    _check_braces(output)
    if not folder:
        output = output.replace("{folder}/", "")  # without its slash, which begins the root
    stem, extension = os.path.splitext(os.path.basename(model))
    said = {
        "app": "engine3d",
        "version": __version__,
        "model": stem,
        "model.ext": stem + extension,
        "model_ext": extension.removeprefix("."),
        "folder": folder,
    }
    number = None

    def value(match: re.Match) -> str:
        name, more = match["name"], match["more"]
        if name is None:
            return match[0][0]
        if name in said and more is None:
            return said[name]
        if name == "date":
            return time.strftime(more or "%Y%m%d")
        if name == "n" and (more or "0").isdigit():
            return "{n}" if number is None else f"{number:0{int(more or 0)}d}"
        known = ", ".join(f"{{{known}}}" for known in VARIABLES)
        raise UsageError(f"-o: there is no variable {match[0]}; there are {known}")

    filled = _FIELD.sub(value, output)
    if "{n}" not in filled:
        return filled
    for number in range(1, _MOST_NUMBERS):  # noqa: B007 - `value` reads it
        filled = _FIELD.sub(value, output)
        if filled not in taken and not os.path.exists(filled):
            break
    return filled


def _check_braces(output: str) -> None:
    """Raise `UsageError` if a brace neither belongs to a variable nor is written twice."""
    from ..files.animation_files import FRAME_NUMBER

    rest = FRAME_NUMBER.sub("", _FIELD.sub("", output))
    for brace, other in ("{}", "}{"):
        if brace in rest:
            raise UsageError(
                f"-o: {brace!r} without {other!r} in {output!r}: a variable is {{model}}, and "
                f"{2 * brace} stands for {brace}"
            )
