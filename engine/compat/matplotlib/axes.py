"""The axes of the projection: mplot3d's, with a depth buffer."""

from __future__ import annotations

import numpy as np
from matplotlib import artist as martist
from matplotlib import cbook
from matplotlib import colors as mcolors
from mpl_toolkits.mplot3d import art3d, axes3d

from ...errors import warn
from ._blocks import Voxels, bar_polygons, colors_at, voxel_faces
from ._known import LINE, SCATTER, kind_of, reason_against, stands_in_space
from ._picture import Drawn, Picture, Words
from ._polygons import remember_grid

_OF_BARS = ("x", "y", "z", "dx", "dy", "dz", "color", "zsort", "shade", "lightsource")


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
        picture = Picture(self, drawn)
        with cbook._setattr_cm(self, _children=[picture, Words(picture), *others]):
            super().draw(renderer)

    def _sorted_out(self) -> tuple[list[Drawn], list[martist.Artist]]:
        """Return the artists that the picture shows, and those that mplot3d draws."""
        drawn, others = [], []
        for artist in self._children:
            kind = kind_of(artist)
            if not artist.get_visible() or artist.get_animated():
                others.append(artist)
            elif kind is None:
                if stands_in_space(artist):
                    _warn(artist, "its class is unknown")
                others.append(artist)
            elif reason := reason_against(artist, kind, self):
                _warn(artist, reason)
                others.append(artist)
            else:
                drawn.append(Drawn(artist, kind))
        return drawn, others

    def plot_surface(self, X, Y, Z, **kwargs):
        """Draw a surface; see `mpl_toolkits.mplot3d.axes3d.Axes3D.plot_surface`."""
        surface = super().plot_surface(X, Y, Z, **kwargs)
        remember_grid(surface, np.broadcast(X, Y, Z).shape)
        return surface

    def bar3d(self, *args, **kwargs):
        """Draw boxes; see `mpl_toolkits.mplot3d.axes3d.Axes3D.bar3d`."""
        given = dict(zip(_OF_BARS, args, strict=False)) | kwargs
        place = [given.pop(name, None) for name in _OF_BARS[:6]]
        color = given.pop("color", None)
        if (
            len(args) > len(_OF_BARS)
            or not set(kwargs).isdisjoint(_OF_BARS[: len(args)])
            or "data" in given
            or any(one is None or np.ndim(one) > 1 for one in place)
        ):
            return super().bar3d(*args, **kwargs)
        if color is None:
            color = self._get_patches_for_fill.get_next_color()
        had_data = self.has_data()
        place[0] = np.atleast_1d(place[0])
        arrays = np.broadcast_arrays(*place)
        low, size = np.stack(arrays[:3], -1).astype(float), np.stack(arrays[3:], -1).astype(float)
        rgba = mcolors.to_rgba_array(color)
        if len(rgba) not in (1, len(low)) or not len(low):
            return super().bar3d(*place, color, **given)
        given["facecolors"] = np.repeat(rgba, 6 * len(low) // len(rgba), 0)
        bars = art3d.Poly3DCollection(bar_polygons(low, size), **{"shade": True, **given})
        self.add_collection3d(bars, autolim=False)
        high = low + size
        self.auto_scale_xyz(*((low[:, k].min(), high[:, k].max()) for k in range(3)), had_data)
        return bars

    def voxels(
        self, *args, facecolors=None, edgecolors=None, shade=True, lightsource=None, **kwargs
    ):
        """Draw voxels; see `mpl_toolkits.mplot3d.axes3d.Axes3D.voxels`.

        They are one collection until one of the returned polygons is asked for.
        """
        xyz, filled = (
            (args[:3], args[3]) if len(args) == 4 else (None, args[0] if len(args) == 1 else None)
        )
        if np.ndim(filled) != 3:
            return super().voxels(
                *args,
                facecolors=facecolors,
                edgecolors=edgecolors,
                shade=shade,
                lightsource=lightsource,
                **kwargs,
            )
        filled = np.asarray(filled, bool)
        if facecolors is None:
            facecolors = self._get_patches_for_fill.get_next_color()
        shape = tuple(side + 1 for side in filled.shape)
        grid = np.indices(shape) if xyz is None else [np.broadcast_to(one, shape) for one in xyz]
        self.auto_scale_xyz(*grid)
        voxel, corners = voxel_faces(filled)
        at = tuple(np.moveaxis(corners, -1, 0))
        polygons = np.stack([one[at] for one in grid], -1).astype(float)
        faces = colors_at(facecolors, voxel, filled.shape)
        edges = None if edgecolors is None else colors_at(edgecolors, voxel, filled.shape)

        def spread(first: int, last: int) -> art3d.Poly3DCollection:
            part = slice(first, last)
            colors = {} if edges is None else {"edgecolors": edges[part]}
            return art3d.Poly3DCollection(
                polygons[part],
                facecolors=faces[part],
                shade=shade,
                lightsource=lightsource,
                **colors,
                **kwargs,
            )

        whole = None
        if len(voxel):
            whole = spread(0, len(voxel))
            self.add_collection3d(whole)
        return Voxels(self, whole, voxel, spread)

    def pick(self, mouseevent) -> None:
        """Let artists be picked; see `matplotlib.artist.Artist.pick`."""
        for artist in self._children:
            # Those are projected whenever they are drawn.
            if artist.pickable() and kind_of(artist) not in (None, LINE, SCATTER):
                if hasattr(artist, "do_3d_projection"):
                    artist.do_3d_projection()
        super().pick(mouseevent)


def _warn(artist: martist.Artist, reason: str) -> None:
    warn(f"{type(artist).__name__} is drawn on top by mplot3d, without a depth buffer: {reason}")
