"""Thumbnails of resources that panels show: pictures of the painter, by their numbers.

In: a resource. Out: the number of its picture, made when there is time.
"""

from __future__ import annotations

from ....model.materials.material import Material
from ...imgui_painter.imgui_painter import ImguiPainter
from ..resource_list import Thing
from ..thumbnails import Thumbnails

#: So many more pictures than resources may be kept.
_SPARE = 48


class ShownThumbnails:
    """Gives thumbnails to the painter.

    Parameters
    ----------
    painter : ImguiPainter
    size : int
        Width and height in pixels.
    """

    def __init__(self, painter: ImguiPainter, size: int) -> None:
        self._painter = painter
        self._thumbnails = Thumbnails(size)
        self._numbers: dict[int, tuple[object, int]] = {}

    def number(self, thing: Thing | Material, deadline: float) -> tuple[int, bool]:
        """Return the number of a thumbnail, 0 if there is none yet, and whether it is late.

        Parameters
        ----------
        thing : Mesh, Material or Texture
        deadline : float
            As of `Thumbnails.get_if_time`.
        """
        pixels = self._thumbnails.get_if_time(thing, deadline)
        held, number = self._numbers.get(id(thing), (None, 0))
        if pixels is None:
            return number, True
        if pixels is not held:
            number = number or self._painter.add(pixels, opaque=True)
            self._painter.replace(number, pixels, opaque=True)
            self._numbers[id(thing)] = pixels, number
        return number, False

    def forget_unused(self, count: int) -> None:
        """Free the pictures, to be made anew, if there are many more than ``count``."""
        if len(self._numbers) > 2 * count + _SPARE:
            for _, number in self._numbers.values():
                self._painter.remove(number)
            self._numbers.clear()
