"""The pressed keys and buttons, and the mouse position, tracked from events."""

from __future__ import annotations

from .. import events


class HeldInput:
    """Tracks events.

    Attributes
    ----------
    keys, positions, buttons : frozenset of str
        What is down: keys by what they type, keys by where they are, mouse buttons.
    mouse : (int, int) or None
        Where the mouse is, in pixels of the picture; None outside the window.
    """

    def __init__(self) -> None:
        self._down: set[tuple[str, str]] = set()
        self.buttons: frozenset[str] = frozenset()
        self.mouse: tuple[int, int] | None = None

    @property
    def keys(self) -> frozenset[str]:
        return frozenset(key for key, _ in self._down)

    @property
    def positions(self) -> frozenset[str]:
        return frozenset(position for _, position in self._down)

    def follow(self, event) -> None:
        """Handle one event."""
        if isinstance(event, events.KeyDown):
            self._down.add((event.key, event.position))
        elif isinstance(event, events.KeyUp):
            self._down.discard((event.key, event.position))
        elif isinstance(event, events.MouseButton):
            changed = {event.button}
            self.buttons = self.buttons | changed if event.down else self.buttons - changed
            self.mouse = event.x, event.y
        elif isinstance(event, events.MouseMotion | events.Wheel):
            self.mouse = event.x, event.y
        elif isinstance(event, events.MouseLeft):
            self.mouse = None
        elif isinstance(event, events.FocusLost):
            self._down.clear()
            self.buttons = frozenset()
