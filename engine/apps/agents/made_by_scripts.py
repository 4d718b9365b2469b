"""Runs a script that makes objects: only if whoever started the server allows it.

In: Python code and the name of its function. Out: what the function returned, as an object. The
code runs in this process and may do whatever the user may; the server's limits are no cage for it.
"""

from __future__ import annotations

import contextlib
import io
import traceback
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from ...errors import Engine3DError, InvalidArgumentError, printable
from ...io.reading.sources import read_source
from ...stage.viewed_thing import viewed_of
from .indirect_light import joined
from .server_limits import Limits
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
    named = session.checked_name(name) if name else unused("script", session.things)
    source: str | bytes = _read(session.limits, path) if path else code
    printed, file = io.StringIO(), path or _FILE
    with contextlib.redirect_stdout(printed):
        with _errors_of(file):
            made = _called(source, file, function)
        with _errors_of(file, alone=False):  # generators run on, and properties are computed
            thing = _thing(made, named)
    return session.add(thing) | {"printed": printed.getvalue()[-_MOST_TEXT:]}


def _read(limits: Limits, path: str) -> bytes:
    """Return a script's bytes: Python itself knows which encoding they state."""
    with limits.reading(), read_source(limits.path_to_read(path)) as source:
        return source.data


def _called(code: str | bytes, file: str, function: str) -> Any:
    names: dict[str, Any] = {"__name__": "script", "__file__": file}
    exec(compile(code, file, "exec", dont_inherit=True), names)
    call = names.get(function)
    if not callable(call):
        raise InvalidArgumentError(f"script: it defines no function {function!r}")
    return call()


@contextlib.contextmanager
def _errors_of(file: str, *, alone: bool = True) -> Iterator[None]:
    """Name the script and its line in errors within the block.

    Where the script is not alone, errors in which it has no part are faults of others, and pass.
    """
    try:
        yield
    except Engine3DError:
        raise
    except SystemExit as error:
        raise ScriptError(f"the script ended itself: SystemExit({error.code!r})") from error
    except Exception as error:
        line = _line_of(error, file)
        if line is None and not alone:
            raise
        where = "" if line is None else f"{file}:{line}: "
        said = printable(str(error)) or "no message"
        raise ScriptError(f"{where}{type(error).__name__}: {said}") from error


def _line_of(error: Exception, file: str) -> int | None:
    """Return the line of a script that raised an error; None if it has no part in that."""
    if isinstance(error, SyntaxError) and error.filename in (file, None):
        return error.lineno or 1  # of encodings that Python does not know, there is none
    frames = traceback.extract_tb(error.__traceback__)
    return next((one.lineno for one in reversed(frames) if one.filename == file), None)


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
        indirect=joined([thing.indirect for _, thing in things]),
    )
