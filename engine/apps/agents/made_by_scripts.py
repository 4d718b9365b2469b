"""Runs a script that makes objects: only if whoever started the server allows it.

In: Python code and the name of its function. Out: what the function returned, as an object. The
code runs in this process and may do whatever the user may; the server's limits are no cage for it.
"""

from __future__ import annotations

import contextlib
import io
import traceback
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from ...errors import Engine3DError, InvalidArgumentError, printable
from ...stage.viewed_thing import viewed_of
from .session import Session
from .things import Thing, thing_of, unused

_FILE = "<script>"
_MOST_TEXT = 2000
_DEEPEST = 8


class ScriptError(Engine3DError):
    """A script raised an exception."""


def run_script(session: Session, code: str, path: str, function: str, name: str) -> dict[str, Any]:
    """Run a script, and add what its function returns.

    Raises
    ------
    ScriptError, InvalidArgumentError, FileAccessError
    """
    if bool(code) == bool(path):
        raise InvalidArgumentError("script: give code or path")
    if path:
        with open(session.limits.path_to_read(path), encoding="utf-8") as file:
            code = file.read()
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        made = _called(code, path or _FILE, function)
        thing = _thing(
            made, session.checked_name(name) if name else unused("script", session.things)
        )
    return session.add(thing) | {"printed": printed.getvalue()[-_MOST_TEXT:]}


def _called(code: str, file: str, function: str) -> Any:
    names: dict[str, Any] = {"__name__": "script", "__file__": file}
    try:
        exec(compile(code, file, "exec", dont_inherit=True), names)
        call = names.get(function)
        if not callable(call):
            raise InvalidArgumentError(f"script: it defines no function {function!r}")
        return call()
    except Engine3DError:
        raise
    except SystemExit as error:
        raise ScriptError(f"the script ended itself: SystemExit({error.code!r})") from error
    except Exception as error:
        raise ScriptError(_place_of(error, file)) from error


def _place_of(error: Exception, file: str) -> str:
    """Return an exception of a script on one line, with the line of the script."""
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == file
    ]
    line = getattr(error, "lineno", None) if isinstance(error, SyntaxError) else None
    place = line or (lines[-1] if lines else None)
    said = printable(str(error)) or "no message"
    where = f"{file}:{place}: " if place else ""
    return f"{where}{type(error).__name__}: {said}"


def _thing(made: Any, name: str, depth: int = 0) -> Thing:
    """Return an object of what a function returned."""
    viewed = None if isinstance(made, (str, bytes)) else viewed_of(made)
    if viewed is not None:
        return thing_of(viewed, name)
    if isinstance(made, (Mapping, Iterable)) and not isinstance(made, (str, bytes)):
        if depth == _DEEPEST:
            raise InvalidArgumentError("script: its function returned lists in lists, too deep")
        entries = made.items() if isinstance(made, Mapping) else enumerate(made, 1)
        return _as_one([(f"{key}", _thing(one, f"{key}", depth + 1)) for key, one in entries], name)
    raise InvalidArgumentError(
        f"script: its function returned {type(made).__name__}; a scene, a mesh, or what trimesh, "
        "CadQuery or build123d hold can be drawn, and dicts and lists of these"
    )


def _as_one(things: list[tuple[str, Thing]], name: str) -> Thing:
    """Return one object with the parts of several, under their names."""
    parts, taken = [], set[str]()
    for key, thing in things:
        for part in thing.parts:
            own = key if len(thing.parts) == 1 else f"{key}.{part.name}"
            parts.append(replace(part, name=unused(printable(own).replace("/", "_"), taken)))
            taken.add(parts[-1].name)
    first = things[0][1] if things else Thing(name, ())
    lights = tuple(light for _, thing in things for light in thing.lights)
    return Thing(
        name,
        tuple(parts),
        lights,
        unit=first.unit,
        up=first.up,
        model_edges=bool(things) and all(thing.model_edges for _, thing in things),
    )
