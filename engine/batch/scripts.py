"""The scripts of tasks: files of Python with a function that builds a scene.

In: a script's path, a scene, a generator. Out: what the function says of the picture. What it
raises becomes an error that names the file and the line.
"""

from __future__ import annotations

import importlib.util
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from types import ModuleType
from typing import Any, NamedTuple

from .._support.numbers import shown
from ..datasets.generator import Generator
from ..errors import Engine3DError, InvalidArgumentError, located
from ..files.stamps import file_stamp
from ..scene.nodes import Node
from ..scene.scene import Scene
from .bytes_of import bytes_of

_SAID = ("camera", "labels", "files")


class ScriptError(Engine3DError, RuntimeError):
    """A script raised something, or is none."""


class Said(NamedTuple):
    """What a script says of its picture.

    Attributes
    ----------
    camera : Node, (Camera, pose) or None
    labels : dict of Node to str, or None
    files : dict of str to bytes
        By the end of their names, such as ``"points.npy"``.
    """

    camera: Any = None
    labels: Mapping[Node, str] | None = None
    files: Mapping[str, bytes] = {}


class Scripts:
    """The scripts that a process has run, each once for as long as its file stays as it is."""

    def __init__(self) -> None:
        self._modules: dict[str, tuple[Any, ModuleType, list[str]]] = {}

    def call(
        self,
        path: str,
        function: str,
        arguments: Mapping[str, Any],
        scene: Scene,
        generator: Generator,
        note: Callable[[str], None],
    ) -> Said:
        """Call a script's function; ``note`` gets the script and what of its folder it imports.

        Raises
        ------
        ScriptError
        """
        path = os.path.realpath(path)
        note(path)
        stamp = file_stamp(path)
        known = self._modules.get(path)
        if known is None or known[0] != stamp:
            module, imported = _guarded(path, lambda: _loaded(path))
            known = self._modules[path] = stamp, module, imported
        for other in known[2]:
            note(other)
        build = getattr(known[1], function, None)
        if not callable(build):
            raise ScriptError(located(f"there is no function {function}", path))
        result = _guarded(path, lambda: build(scene, generator, **arguments))
        try:
            return _said(result)
        except InvalidArgumentError as error:
            raise ScriptError(located(f"what {function} returned: {error}", path)) from None


def _loaded(path: str) -> tuple[ModuleType, list[str]]:
    """Run a script as a module; return it, and the files of its folder that it imported."""
    folder, before = os.path.dirname(path), set(sys.modules)
    spec = importlib.util.spec_from_file_location(f"engine3d_script_{abs(hash(path))}", path)
    if spec is None or spec.loader is None:
        raise ScriptError(located("not a file of Python: its name does not end in .py", path))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    new = (getattr(sys.modules[name], "__file__", None) for name in set(sys.modules) - before)
    return module, sorted(file for file in new if file and file.startswith(folder + os.sep))


def _guarded(path: str, do: Callable[[], Any]) -> Any:
    """Let a script import what is beside it, and whatever it raises name the file and the line."""
    folder = os.path.dirname(path)
    sys.path.insert(0, folder)
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
        sys.path.remove(folder)


def _said(result: Any) -> Said:
    """Check what a script's function returned."""
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
    return Said(result.get("camera"), labels, dict(bytes_of(key, files[key]) for key in files))
