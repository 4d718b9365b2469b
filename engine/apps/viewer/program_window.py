"""The window of a program: as large as its screen wants it, with texts to match.

In: a size on a usual screen, and the scale that the user asks for. Out: a `Window` that fits its
screen, and whose `scale` is that of all texts and panels in it.
"""

from __future__ import annotations

from .screen_scale import has_own_units, screen_scale
from .window import Window


class ProgramWindow(Window):
    """A window of one of engine3d's own programs.

    Parameters
    ----------
    size : (int, int) or None
        What the user asks for, in pixels; None for the usual size.
    usual : (int, int)
        The usual size, in pixels of a usual screen. On a finer one the window has more pixels, if
        there is room.
    title : str
    ui_scale : float, optional
        The scale that the user asks for; by default the screen's.
    **options
        Other options of `Window`.

    Raises
    ------
    DisplayError
        There is no screen.
    """

    def __init__(
        self,
        size: tuple[int, int] | None,
        usual: tuple[int, int],
        title: str,
        *,
        ui_scale: float | None = None,
        **options: bool,
    ) -> None:
        self._asked, self._ui_scale = size, ui_scale
        super().__init__(size or usual, title, **options)

    def _open(self, size: tuple[int, int], vsync: bool) -> None:
        if self._asked is not None:
            super()._open(size, vsync)
            return
        if not has_own_units(self._sdl):
            scale = max(self._ui_scale or screen_scale(self._sdl, 0), 1.0)
            size = round(size[0] * scale), round(size[1] * scale)
        super()._open(size, vsync)
        self.fit_to_screen()

    @property
    def scale(self) -> float:
        """The scale of texts and panels."""
        return self._ui_scale or super().scale
