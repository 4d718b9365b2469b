"""The history: commands in order, for undo and redo.

In: commands. Out: the same commands, backwards and forwards. A new command discards undone ones.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable

from ...model.scene.nodes import Node


class Command(ABC):
    """One change of a scene.

    Attributes
    ----------
    label : str
        What it does, for menus and the console: "Delete 3 nodes".
    nodes : tuple of Node
        What it is about: worth selecting once it was done or undone.
    makes_nodes : bool
        Whether these are new, and so to be selected when it is done the first time.
    """

    label: str
    nodes: tuple[Node, ...] = ()
    makes_nodes = False

    @abstractmethod
    def do(self) -> None:
        """Apply the change, the first time or again after `undo`.

        On failure, raise and leave everything unchanged.
        """

    @abstractmethod
    def undo(self) -> None:
        """Revert the change, to the bit."""

    def absorb(self, later: Command) -> bool:
        """Merge a command done right after this one, if possible; return whether it was merged."""
        return False


class History:
    """Undoable steps.

    Attributes
    ----------
    steps : list of Command
        The oldest first, those that were undone included.
    position : int
        How many of the steps are done.
    version : int
        Grows with all that is done, undone or forgotten.
    """

    def __init__(self) -> None:
        self.steps: list[Command] = []
        self.position = 0
        self.version = 0
        self._drag: Hashable = None
        self._saved: Command | None = None
        self._saved_is_reachable = True

    def do(self, command: Command, drag: Hashable = None) -> None:
        """Run a command and add it to the history.

        Parameters
        ----------
        command : Command
        drag : hashable, optional
            What a movement of the mouse has in common from button down to button up: commands with
            the same one, nothing else between them, become one step where they can.
        """
        command.do()
        self.note(command, drag)

    def note(self, command: Command, drag: Hashable = None) -> None:
        """Add a command that was already run; as `do`."""
        if self._saved_is_undone():
            self._saved_is_reachable = False
        del self.steps[self.position :]
        last = self.steps[-1] if self.steps else None
        continues = drag is not None and drag == self._drag and last is not self._saved
        if not (continues and last is not None and last.absorb(command)):
            self.steps.append(command)
        self.position = len(self.steps)
        self.version += 1
        self._drag = drag

    def undo(self) -> Command | None:
        """Undo the last step; return it, or None if there is none."""
        self._drag = None
        if self.position == 0:
            return None
        command = self.steps[self.position - 1]
        command.undo()
        self.position -= 1
        self.version += 1
        return command

    def redo(self) -> Command | None:
        """Redo the last undone step; return it, or None if there is none."""
        self._drag = None
        if self.position == len(self.steps):
            return None
        command = self.steps[self.position]
        command.do()
        self.position += 1
        self.version += 1
        return command

    def clear(self) -> None:
        """Forget all steps."""
        if self.last is not self._saved:
            self._saved_is_reachable = False
        self.version += 1
        self.steps.clear()
        self.position, self._drag, self._saved = 0, None, None

    @property
    def last(self) -> Command | None:
        """The step that `undo` would undo."""
        return self.steps[self.position - 1] if self.position else None

    @property
    def next(self) -> Command | None:
        """The step that `redo` would do."""
        return self.steps[self.position] if self.position < len(self.steps) else None

    def mark_saved(self) -> None:
        """Mark the current state as saved."""
        self._saved, self._saved_is_reachable, self._drag = self.last, True, None

    def mark_unsaved(self) -> None:
        """Mark the current state as never saved, regardless of undo."""
        self._saved_is_reachable, self._drag = False, None
        self.version += 1

    @property
    def is_saved(self) -> bool:
        """Return whether the current state is the saved one."""
        return self._saved_is_reachable and self.last is self._saved

    def _saved_is_undone(self) -> bool:
        """Return whether the steps that lead to the saved state are about to be discarded."""
        return self._saved is not None and self._saved in self.steps[self.position :]
