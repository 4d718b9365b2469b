"""The axes of the projection: mplot3d's, with a depth buffer."""

from __future__ import annotations

from matplotlib import artist as martist
from matplotlib import cbook
from mpl_toolkits.mplot3d import axes3d

from ...errors import warn
from ._known import kind_of, looks_solid, reason_against
from ._picture import Drawn, Picture


class Axes3D(axes3d.Axes3D):
    """mplot3d's axes, whose artists hide each other by depth, pixel by pixel.

    ``projection="engine3d"`` makes them. All methods are mplot3d's, with the same arguments and
    meaning; docs/matplotlib.md tells what is drawn.
    """

    name = "engine3d"

    def __init__(self, *args, **kwargs) -> None:
        # Ticks and widgets of matplotlib ask for this name.
        self.name = "3d"
        super().__init__(*args, **kwargs)

    @martist.allow_rasterization
    def draw(self, renderer) -> None:
        """Draw the axes; see `mpl_toolkits.mplot3d.axes3d.Axes3D.draw`."""
        drawn, others = self._sorted_out()
        with cbook._setattr_cm(self, _children=[*others, Picture(self, drawn)]):
            super().draw(renderer)

    def _sorted_out(self) -> tuple[list[Drawn], list[martist.Artist]]:
        """Return the artists that the picture shows, and those that mplot3d draws."""
        drawn, others = [], []
        for artist in self._children:
            kind = kind_of(artist)
            if not artist.get_visible() or artist.get_animated():
                others.append(artist)
            elif kind is None:
                if looks_solid(artist):
                    _warn(artist, "its class is unknown")
                others.append(artist)
            elif reason := reason_against(artist, kind, self):
                _warn(artist, reason)
                others.append(artist)
            else:
                drawn.append(Drawn(artist, kind))
        return drawn, others

    def pick(self, mouseevent) -> None:
        """Let artists be picked; see `matplotlib.artist.Artist.pick`."""
        for artist in self._children:
            if kind_of(artist) in ("polygons", "segments", "contours", "patch") and artist.pickable():
                artist.do_3d_projection()
        super().pick(mouseevent)


def _warn(artist: martist.Artist, reason: str) -> None:
    warn(f"{type(artist).__name__} is drawn on top by mplot3d, without a depth buffer: {reason}")
