"""User input in a window, as small values: keys, mouse, dropped files, window changes.

`engine3d.Window` hands them out; SDL's own structures stay behind it. Keys carry both what they
type and where they are. Events compare and match by their values::

    match event:
        case events.KeyDown("Space"): ...
        case events.MouseButton("left", True, x=x, y=y): ...
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

__all__ = [
    "CloseRequested",
    "Event",
    "Exposed",
    "FilesDropped",
    "FocusLost",
    "KeyDown",
    "KeyUp",
    "Minimised",
    "MouseButton",
    "MouseLeft",
    "MouseMotion",
    "Resized",
    "Restored",
    "TextEntered",
    "Tick",
    "Wheel",
]


@dataclass(frozen=True)
class KeyDown:
    """A key went down, or repeats.

    Parameters
    ----------
    key : str
        What it types: ``"W"``, ``"7"``, ``"Left"``, ``"Space"``, ``"Return"``, ``"Escape"``,
        ``"F12"``, ``"Keypad 7"`` …
    position : str
        Where it is: what the key there types on a US keyboard. WASD by position are ZQSD on AZERTY.
    shift, control : bool
        Whether these are held; on macOS, Cmd counts as Ctrl.
    repeat : bool
        Whether the key was down already.
    """

    key: str
    position: str
    shift: bool = False
    control: bool = False
    repeat: bool = False


@dataclass(frozen=True)
class KeyUp:
    """A key came up; named as for `KeyDown`."""

    key: str
    position: str


@dataclass(frozen=True)
class TextEntered:
    """Keys or an input method entered text."""

    text: str


@dataclass(frozen=True)
class MouseButton:
    """A mouse button went down or came up.

    Parameters
    ----------
    button : {"left", "middle", "right"}
    down : bool
    shift, control : bool
        Whether these keys are held; on macOS, Cmd counts as Ctrl.
    x, y : int
        Where, in pixels of the picture that the window shows, from its top left corner.
    clicks : int
        1 for a click, 2 for a double click, …
    """

    button: str
    down: bool
    shift: bool = False
    control: bool = False
    x: int = 0
    y: int = 0
    clicks: int = 1


@dataclass(frozen=True)
class MouseMotion:
    """The mouse moved by (dx, dy) pixels, y downward, to (x, y) of the picture."""

    dx: int
    dy: int
    x: int = 0
    y: int = 0


@dataclass(frozen=True)
class MouseLeft:
    """The mouse left the window."""


@dataclass(frozen=True)
class Wheel:
    """The wheel turned by ``steps``, positive away from the user, over (x, y) of the picture."""

    steps: float
    x: int = 0
    y: int = 0


@dataclass(frozen=True)
class Resized:
    """The window's drawable area has a new size, in pixels."""

    width: int
    height: int


@dataclass(frozen=True)
class FilesDropped:
    """Files were dropped on the window, all at once."""

    paths: tuple[str, ...]


@dataclass(frozen=True)
class Exposed:
    """The window's content must be shown again."""


@dataclass(frozen=True)
class Minimised:
    """The window is hidden: nothing needs drawing."""


@dataclass(frozen=True)
class Restored:
    """The window shows again."""


@dataclass(frozen=True)
class FocusLost:
    """The keyboard went to another window: no key is down any more as far as we know."""


@dataclass(frozen=True)
class CloseRequested:
    """The user, or the system, asked the window to close."""


@dataclass(frozen=True)
class Tick:
    """Time for the next picture.

    Parameters
    ----------
    dt : float
        Seconds since the last tick; 0 for the first.
    time : float
        Seconds since the first tick.
    """

    dt: float
    time: float


#: What `Window.events` returns, and iterating over a window yields.
Event: TypeAlias = (
    KeyDown
    | KeyUp
    | TextEntered
    | MouseButton
    | MouseMotion
    | MouseLeft
    | Wheel
    | Resized
    | FilesDropped
    | Exposed
    | Minimised
    | Restored
    | FocusLost
    | CloseRequested
    | Tick
)
