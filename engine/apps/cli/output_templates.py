"""Names of outputs with variables in them, such as ``{model}_{n}.png``.

In: the value of ``-o``, and the model's name. Out: the name of a file. Places for frame numbers,
``%04d`` and ``{:04}``, are kept; ``{{``, ``}}`` and ``%%04d`` mean ``{``, ``}`` and ``%04d``.
Values of variables are always literal. The variables are those of f3d.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Container

from ...base.files.portable_names import key_here
from ...io.output.frame_names import FRAME_NUMBER, FrameName, joined_name
from ...version import __version__
from .usage import UsageError

_MODEL = ("model", "model.ext", "model_ext")
#: All variables; some accept a format after a colon.
VARIABLES = ("app", "version", *_MODEL, "folder", "date", "n")
_BRACES = re.compile(r"\{\{|\}\}")
_FIELD = re.compile(r"\{(?P<name>[^{}:]+)(?::(?P<more>[^{}]*))?\}")
_DIGITS = re.compile(r"[0-9]{0,2}")
_WIDE = re.compile(r"%[^a-zA-Z%]*[0-9]{3}")  # date fields with very large padding
_MOST_NUMBERS = 1_000_000


def names_the_model(output: str | None) -> bool:
    """Return whether a name differs for each model."""
    fields = () if output is None else (p for p in _pieces(output) if not isinstance(p, str))
    return any(_name_of(match) in (*_MODEL, "folder", "n") for match in fields)


def fill(
    output: str | None, model: str, taken: Container[str] = (), folder: str = ""
) -> FrameName | None:
    """Return a name with its variables filled in.

    Parameters
    ----------
    output : str or None
        None stays.
    model : str
        Path of the model, or what is shown instead.
    taken : container of str
        Names that are not free though no file bears them yet, each as `key_here` returns it.
    folder : str
        The model's folder, relative to the one that was given; empty in that folder itself.

    Raises
    ------
    UsageError
        There is no such variable, or a brace stands alone; or no number is left.
    """
    if output is None:
        return None
    if not folder:
        # without its slash, which would make the path absolute
        output = output.replace("{folder}/", "")
    pieces = _pieces(output)
    stem, extension = os.path.splitext(os.path.basename(model))
    said = {
        "app": "engine3d",
        "version": __version__,
        "model": stem,
        "model.ext": stem + extension,
        "model_ext": extension.removeprefix("."),
        "folder": folder,
    }
    if not any(_name_of(piece) == "n" for piece in pieces):
        return _filled(pieces, said, 0)
    for number in range(1, _MOST_NUMBERS):
        filled = _filled(pieces, said, number)
        if key_here(filled) not in taken and not os.path.exists(filled):
            return filled
    raise UsageError(f"-o {output}: there are files of all numbers up to {_MOST_NUMBERS - 1:,}")


def _pieces(output: str) -> list[str | re.Match]:
    """Return a name as texts, variables and places for a frame number, in order."""
    pieces: list[str | re.Match] = []
    place = 0
    while place < len(output):
        braces, frame, field = (
            pattern.match(output, place) for pattern in (_BRACES, FRAME_NUMBER, _FIELD)
        )
        if braces is not None:
            pieces.append(braces[0][0])
            place = braces.end()
        elif frame is not None and frame["escaped"] is not None:
            pieces.append(frame[0][1:])
            place = frame.end()
        elif (match := frame or field) is not None:
            pieces.append(match)
            place = match.end()
        else:
            _check_brace(output, place)
            pieces.append(output[place])
            place += 1
    return pieces


def _check_brace(output: str, place: int) -> None:
    """Raise `UsageError` if a brace neither belongs to a variable nor is doubled."""
    brace = output[place]
    if brace in "{}":
        other = "}" if brace == "{" else "{"
        raise UsageError(
            f"-o: {brace!r} without {other!r} in {output!r}: a variable is {{model}}, and "
            f"{2 * brace} stands for {brace}"
        )


def _name_of(piece: str | re.Match) -> str | None:
    """Return the name of a variable; None for other texts."""
    return piece.groupdict().get("name") if isinstance(piece, re.Match) else None


def _filled(pieces: list[str | re.Match], said: dict[str, str], number: int) -> FrameName:
    return joined_name(
        [piece if _name_of(piece) is None else _value(piece, said, number) for piece in pieces]
    )


def _value(match: re.Match, said: dict[str, str], number: int) -> str:
    """Return the value of a variable."""
    name, more = match["name"], match["more"]
    if name in said and more is None:
        return said[name]
    if name == "date":
        return _date(more or "%Y%m%d", match)
    if name == "n" and _DIGITS.fullmatch(more or ""):
        return f"{number:0{int(more or 0)}d}"
    known = ", ".join(f"{{{known}}}" for known in VARIABLES)
    digits = "; behind {n: stand up to two digits" if name == "n" else ""
    raise UsageError(f"-o: there is no variable {match[0]}; there are {known}{digits}")


def _date(form: str, match: re.Match) -> str:
    try:
        if _WIDE.search(form):
            raise ValueError("its fields have up to two digits")
        return time.strftime(form)
    except ValueError as error:  # includes errors of texts that cannot be encoded
        raise UsageError(f"-o: {match[0]} is no date: {error}") from None
