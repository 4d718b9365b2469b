"""Scripts of tasks: Python files with a function that builds a scene.

In: a script's path, a scene, a generator. Out: the function's data about the picture. Exceptions
become an error that names the file and the line.
"""

from __future__ import annotations

import importlib.util
import os
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any, NamedTuple

from ...base.numbers import shown
from ...base.system import after_fork
from ...errors import Engine3DError, InvalidArgumentError, located
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ..datasets.generator import Generator
from .bytes_of import bytes_of
from .file_digests import digest_of
from .imports_beside import imports_beside


class ScriptError(Engine3DError, RuntimeError):
    """A script raised an exception, or is invalid."""


class Said(NamedTuple):
    """A script's data about its picture.

    Attributes
    ----------
    camera : Node, (Camera, pose) or None
    labels : dict of Node to str, or None
    files : dict of str to bytes
        By the end of their names, such as ``"points.npy"``.
    next, previous : callable or None
        Moves the scene to the next or previous picture's moment, for optical flow; returns that
        picture's camera, or None for the same.
    """

    camera: Any = None
    labels: Mapping[Node, str] | None = None
    files: Mapping[str, bytes] = {}
    next: Callable[[], Any] | None = None
    previous: Callable[[], Any] | None = None


_SAID = tuple(Said.__annotations__)


class Loaded(NamedTuple):
    """A script that has been run.

    Attributes
    ----------
    module : ModuleType
    digests : dict of str to str
        Hashes of its file and of those that it imports from its folder, by path.
    """

    module: ModuleType
    digests: dict[str, str | None]


class _Turn:
    """Scripts run one after the other: what they import, and from where, belongs to the process."""

    def __init__(self) -> None:
        self.renew()

    def renew(self) -> None:
        """Make a lock that nobody holds, such as in a process forked from within a script."""
        self.lock = threading.RLock()


_turn = _Turn()
after_fork(_turn.renew)


# The names of the modules that scripts imported from their folders, by folder.
_imported: dict[str, set[str]] = {}


class Scripts:
    """The scripts that a thread has run, each once until its files change."""

    def __init__(self) -> None:
        self._loaded: dict[str, Loaded] = {}

    def call(
        self,
        path: str,
        function: str,
        arguments: Mapping[str, Any],
        scene: Scene,
        generator: Generator,
        note: Callable[[str], None],
    ) -> Said:
        """Call a script's function; ``note`` receives the script and the modules it imports.

        Raises
        ------
        ScriptError
        """
        path = os.path.realpath(path)
        with _turn.lock:
            loaded = self._fresh(path)
            for file in loaded.digests:
                note(file)
            build = getattr(loaded.module, function, None)
            if not callable(build):
                raise ScriptError(located(f"there is no function {function}", path))
            result = _guarded(path, lambda: build(scene, generator, **arguments))
        try:
            return _said(result)
        except InvalidArgumentError as error:
            raise ScriptError(located(f"what {function} returned: {error}", path)) from None

    def _fresh(self, path: str) -> Loaded:
        """Return the script for the current state of its files."""
        known = self._loaded.get(path)
        if known is not None:
            if all(digest_of(file) == digest for file, digest in known.digests.items()):
                return known
        # It imports its modules anew: they, or what they import, may have changed.
        for name in _imported.pop(_folder_of(path), ()):
            sys.modules.pop(name, None)
        loaded = self._loaded[path] = _guarded(path, lambda: _run(path))
        return loaded


def _run(path: str) -> Loaded:
    """Run a script as a module."""
    own, before = digest_of(path), set(sys.modules)
    spec = importlib.util.spec_from_file_location(f"engine3d_script_{abs(hash(path))}", path)
    if spec is None or spec.loader is None:
        raise ScriptError(located("its name does not end in .py", path))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    # The source names also what the program imported before, but not what `importlib` is told.
    beside = {file for file in _imported_since(before, _folder_of(path)).values() if file}
    beside.update(imports_beside(path).values())
    return Loaded(module, {path: own, **{file: digest_of(file) for file in sorted(beside)}})


def _folder_of(path: str) -> str:
    """Return the folder of a file, as the paths of what is in it begin."""
    return os.path.dirname(path) + os.sep


def _imported_since(before: set[str], folder: str) -> dict[str, str | None]:
    """Return the modules of a folder that are new, by name: files, None of packages without one."""
    new = {}
    for name in set(sys.modules) - before:
        file = getattr(sys.modules[name], "__file__", None)
        places = [file] if file else getattr(sys.modules[name], "__path__", None) or ()
        if any(str(place).startswith(folder) for place in places):
            new[name] = file
    return new


def _guarded(path: str, do: Callable[[], Any]) -> Any:
    """Let a script import from its folder, and name file and line in its errors."""
    folder, before = os.path.dirname(path), set(sys.modules)
    sys.path.insert(0, folder)
    # Python reuses compiled code for files of equal size and second: a change could be missed.
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    importlib.invalidate_caches()
    try:
        return do()
    except ScriptError:
        raise
    except (Exception, SystemExit) as error:
        lines = [
            entry.lineno
            for entry in traceback.extract_tb(error.__traceback__)
            if os.path.realpath(entry.filename) == path
        ]
        line = error.lineno if isinstance(error, SyntaxError) else (lines[-1] if lines else None)
        text = error.msg if isinstance(error, SyntaxError) else str(error)
        said = f"{type(error).__name__}: {' '.join(text.split())}"
        raise ScriptError(located(said, path, line)) from error
    finally:
        sys.dont_write_bytecode = writes
        sys.path.remove(folder)
        new = _imported_since(before, _folder_of(path))
        _imported.setdefault(_folder_of(path), set()).update(new)


def _said(result: Any) -> Said:
    """Return a script's result, checked."""
    if result is None:
        return Said()
    if not isinstance(result, Mapping):
        raise InvalidArgumentError(f"must be None or a dict, not {shown(result)}")
    for key in result:
        if key not in _SAID:
            raise InvalidArgumentError(f"{shown(key)} is none of {', '.join(_SAID)}")
    labels, files = result.get("labels"), result.get("files", {})
    for name, value in (("labels", labels), ("files", files)):
        if value is not None and not isinstance(value, Mapping):
            raise InvalidArgumentError(f"{name} must be a dict, not {shown(value)}")
    moves = result.get("next"), result.get("previous")
    for name, move in zip(("next", "previous"), moves, strict=True):
        if move is not None and not callable(move):
            raise InvalidArgumentError(f"{name} must be a function, not {shown(move)}")
    by_end = dict(bytes_of(key, files[key]) for key in files)
    return Said(result.get("camera"), labels, by_end, *moves)
