"""A Python prompt on the edited scene.

In: lines. Out: console entries. Changes to the scene and to its nodes' objects are one undoable
step; other effects (files, variables, unused meshes) are not undone.
"""

from __future__ import annotations

import code
import contextlib
import io
import rlcompleter
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from ...base.language import translated
from ...model.scene.scene import Scene
from .console import Console
from .history import Command, History
from .scene_state import SceneState


class PythonStep(Command):
    """The changes that Python code made to a scene."""

    def __init__(self, label: str, old: SceneState, new: SceneState) -> None:
        self.label, self._old, self._new = label, old, new
        there = set(old.nodes)
        self.nodes = tuple(node for node in new.nodes if node not in there)

    def do(self) -> None:
        self._new.put()

    def undo(self) -> None:
        self._old.put()


class Prompt:
    """Runs lines of Python.

    Parameters
    ----------
    scene : Scene
    history : History
    console : Console
    names : callable
        Returns what the lines find under names of their own, anew before each run.

    Attributes
    ----------
    lines : list of str
        What was entered, the latest last.
    guard : callable
        Returns a context in which lines run: one that stops them with `KeyboardInterrupt`, say.
    """

    def __init__(
        self,
        scene: Scene,
        history: History,
        console: Console,
        names: Callable[[], dict[str, Any]],
    ) -> None:
        self._scene, self._history, self._console, self._names = scene, history, console, names
        self._interpreter = _Interpreter(console)
        self._block: list[str] = []
        self.lines: list[str] = []
        self.guard: Callable[[], AbstractContextManager[Any]] = contextlib.nullcontext

    @property
    def is_open(self) -> bool:
        """Whether the last lines are an incomplete statement."""
        return bool(self._block)

    def push(self, line: str) -> bool:
        """Run a line, or continue a statement; return whether more lines must follow."""
        if line.strip():
            self.lines.append(line)
        self._console.write("input", ("... " if self._block else ">>> ") + line)
        self._block.append(line)
        source = "\n".join(self._block)
        self._interpreter.locals.update(self._names())
        old = SceneState(self._scene)
        is_open = self._interpreter.run(source, self.guard)
        if not is_open:
            self._block.clear()
            new = SceneState(self._scene)
            if new != old:
                self._history.note(PythonStep(f"Python: {source.strip()[:60]}", old, new))
        return is_open

    def reset(self) -> None:
        """Discard an incomplete statement."""
        self._block.clear()

    def completions(self, text: str) -> tuple[str, ...]:
        """Return completions of the last name in a line, such as ``scene.nodes``."""
        self._interpreter.locals.update(self._names())
        completer = rlcompleter.Completer(self._interpreter.locals)
        found: dict[str, None] = {}
        with contextlib.suppress(Exception):  # arbitrary properties may raise any exception
            while (match := completer.complete(text, len(found))) is not None:
                if match in found:
                    break
                found[match] = None
        return tuple(found)


class _Interpreter(code.InteractiveInterpreter):
    """Runs source; output and exceptions go to the console."""

    def __init__(self, console: Console) -> None:
        super().__init__({"__name__": "__console__", "__doc__": None})
        self._console = console

    def run(self, source: str, guard: Callable[[], AbstractContextManager[Any]]) -> bool:
        """Run source; return whether it is incomplete."""
        output, is_open = io.StringIO(), False
        with (
            contextlib.redirect_stdout(output),
            contextlib.redirect_stderr(output),
            self._console.warnings_noted(),
            contextlib.suppress(KeyboardInterrupt),  # from an interrupt after the end of the code
            guard(),
        ):
            is_open = self.runsource(source, "<console>")
        if text := output.getvalue():
            self._console.write("output", text.rstrip("\n"))
        return is_open

    def runcode(self, code) -> None:
        try:
            super().runcode(code)
        except SystemExit:
            self._console.write(
                "warning", translated("the editor goes on: close its window to end it")
            )

    def write(self, data: str) -> None:
        self._console.write("error", data.rstrip("\n"))
