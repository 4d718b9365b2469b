"""The triangles of a picture, collected artist by artist, and the drawing of them.

In: places on the screen with colours, artist by artist in the order of painting. Out: a picture.
Surfaces come first, so that what lies on them can be lifted before it is added.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..._native import rasterizer as _native
from ...base.thread_count import resolve_threads
from ...rendering.backend_selection import resolve_backend
from ._resting import Surfaces
from ._view import View

SAMPLES = 16  # a pixel
# Of so many triangles, which are mostly smaller than pixels; of so many clear ones, which are slow.
_MANY, _MANY_CLEAR, _FEWER_SAMPLES = 1 << 20, 1 << 16, 4
# Of the scene's depth: how much nearer an artist is at most than the one before, or the first.
_RANK, _RANKS = 0.0001, 0.002
_LIFT = 0.002  # of the scene's depth: how much nearer lines and markers are than surfaces
_CHUNK = 1 << 14  # vertices that are projected at a time, so that they stay in the cache
_TEXTURED = 2  # how faces look: 0 opaque, 1 blended, 2 and more by a texture


class Pile:
    """Triangles of one picture.

    Parameters
    ----------
    view : View
    artists : int
        How many will be added.
    vertices : int
        How many the surfaces will have: a pile grows, but large ones are best made at once.
    """

    def __init__(self, view: View, artists: int, vertices: int) -> None:
        self._view = view
        self._clip = np.empty((vertices, 4), np.float32)
        self._colors = np.empty((vertices, 4), np.uint8)
        self._used = 0
        # By the number of the artist: faces, and what they look like.
        self._faces: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {}
        self._textures: list[np.ndarray] = []
        self._textured: list[tuple[int, np.ndarray]] = []
        self._artists = max(artists, 1)
        self.artist, self.rank = 0, 0.0
        self._artist, self._rank = 0, 0.0
        #: Lines by their pens, which are drawn together at last: see _lines.py.
        self.waiting: dict[Any, list[tuple[int, tuple[np.ndarray, ...]]]] = {}
        self._surfaces: Surfaces | None = None

    def begin(self, artist: int, is_on_faces: bool = False, is_ranked: bool = False) -> None:
        """Let what is added belong to the artist of a number, from 0 on.

        Of equal depth, greater numbers show. They are a little nearer, too: where two lie in one
        plane, rounding must not decide. ``is_ranked``: what is added was brought nearer already.
        """
        self.artist = artist
        self._artist = 2 * artist + is_on_faces
        self.rank = artist * min(_RANK, _RANKS / self._artists) * self._view.span
        self._rank = 0.0 if is_ranked else self.rank

    def end_surfaces(self) -> None:
        """Remember what was added as the surfaces that others may lie on."""
        if self._faces:
            self._surfaces = self._seen()

    def _seen(self) -> Surfaces:
        faces = np.concatenate([faces for parts in self._faces.values() for faces, _ in parts])
        return Surfaces(self._view.region, self._clip[: self._used], faces)

    def depths(self) -> np.ndarray:
        """Return the depth of what shows so far, (H, W) float32, infinite where nothing does."""
        region = self._view.region
        return (
            self._seen().depth
            if self._faces
            else np.full((region.height, region.width), np.inf, np.float32)
        )

    def bounds(self) -> tuple[float, float, float, float]:
        """Return left, top, right and bottom of all that was added, pixels of the region."""
        region, clip = self._view.region, self._clip[: self._used]
        x, y = (clip[:, k][np.isfinite(clip[:, k])] for k in (0, 1))
        if not x.size:
            return 0.0, 0.0, 0.0, 0.0
        left, right = (0.5 * (1.0 + float(one)) * region.width for one in (x.min(), x.max()))
        top, bottom = (0.5 * (1.0 - float(one)) * region.height for one in (y.max(), y.min()))
        return left, top, right, bottom

    def lifted(self, places: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return places of markers, nearer: on surfaces by as much as these rise round them."""
        return self._lifted(places, radii, lambda lies: lies, True)

    def lifted_lines(
        self, places: np.ndarray, runs: np.ndarray, half_widths: np.ndarray
    ) -> np.ndarray:
        """The same of lines: a point lies on a surface where its neighbours do, too."""
        after = np.append(runs[1:] == runs[:-1], False)
        before = np.roll(after, 1)

        def along(lies: np.ndarray) -> np.ndarray:
            return (
                lies
                & (np.roll(lies, 1) | ~before)
                & (np.roll(lies, -1) | ~after)
                & (before | after)
            )

        return self._lifted(places, half_widths, along, False)

    def lifted_edges(
        self, places: np.ndarray, runs: np.ndarray, half_widths: np.ndarray
    ) -> np.ndarray:
        """The same of edges of faces: a point lies on its face where a neighbour does."""
        after = np.append(runs[1:] == runs[:-1], False)
        before = np.roll(after, 1)

        def near(lies: np.ndarray) -> np.ndarray:
            return lies | (np.roll(lies, 1) & before) | (np.roll(lies, -1) & after)

        return self._lifted(places, half_widths, near, True)

    def _lifted(
        self,
        places: np.ndarray,
        radii: np.ndarray,
        decide: Callable[[np.ndarray], np.ndarray],
        looks_round: bool,
    ) -> np.ndarray:
        out = places.copy()
        out[:, 2] -= _LIFT * self._view.span
        if self._surfaces is not None and len(places):
            rise, lies = self._surfaces.under(places, self._view.span, looks_round)
            out[:, 2] -= np.where(
                decide(lies), self._surfaces.limited(rise * (1.0 + radii), self._view.span), 0.0
            )
        return out

    @property
    def is_empty(self) -> bool:
        return not self._faces

    @property
    def has_surfaces(self) -> bool:
        return self._surfaces is not None

    def add(self, places: np.ndarray, colors: np.ndarray, faces: np.ndarray) -> None:
        """Add triangles.

        Parameters
        ----------
        places : (V, 3) float64
            On the screen.
        colors : (V, 4) or (4,) uint8
            Straight RGBA; a face has one colour.
        faces : (F, 3) int32
            Of equal depth, earlier ones show.
        """
        first = self._take(len(places), colors)
        self._view.clip(places, self._clip[first : self._used], self._rank)
        self._put(faces, first, colors)

    def add_polygons(
        self,
        points: np.ndarray,
        faces: np.ndarray,
        colors: np.ndarray,
        sizes: np.ndarray | None = None,
    ) -> None:
        """The same with points in data coordinates.

        Of polygons of given sizes, those with a corner that is not finite are left out.
        """
        first = self._take(len(points), colors)
        clip = self._clip[first : self._used]
        for k in range(0, len(points), _CHUNK):
            self._view.clip(
                self._view.screen(points[k : k + _CHUNK]), clip[k : k + _CHUNK], self._rank
            )
        if sizes is not None:
            drop_broken(clip, sizes)
        self._put(faces, first, colors)

    def add_picture(self, corners: np.ndarray, pixels: np.ndarray) -> None:
        """Add a rectangle of pixels, (H, W, 4) uint8.

        corners : (4, 3) places: left top, right top, left bottom, right bottom.
        """
        white = np.full(4, 255, np.uint8)
        first = self._take(4, white)
        self._view.clip(corners, self._clip[first : self._used], self._rank)
        uvs = np.array([[0, 1], [1, 1], [0, 0], [1, 0]], np.float32)
        self._textured.append((first, uvs))
        faces = np.array([[0, 1, 2], [1, 3, 2]], np.int32)
        self._put(faces, first, white, _TEXTURED + len(self._textures))
        self._textures.append(pixels)

    def _take(self, count: int, colors: np.ndarray) -> int:
        """Make room for vertices of given colours; return the number of the first."""
        first, self._used = self._used, self._used + count
        if self._used > len(self._clip):
            room = max(self._used, 2 * len(self._clip))
            self._clip = np.append(self._clip[:first], np.empty((room - first, 4), np.float32), 0)
            self._colors = np.append(self._colors[:first], np.empty((room - first, 4), np.uint8), 0)
        self._colors[first : self._used] = colors
        return first

    def _put(self, faces: np.ndarray, first: int, colors: np.ndarray, look: int = 0) -> None:
        """Add faces, whose corners are counted from the first."""
        if look:
            looks = np.full(len(faces), look, np.int32)
        else:
            alpha = (
                colors[faces[:, 0], 3]
                if colors.ndim == 2
                else np.broadcast_to(colors[3], len(faces))
            )
            looks = (alpha != 255).astype(np.int32)
            if not alpha.all():
                faces, looks = faces[alpha > 0], looks[alpha > 0]
        self._faces.setdefault(self._artist, []).append((faces + np.int32(first), looks))

    def _take_faces(self) -> tuple[np.ndarray, np.ndarray]:
        """Return all faces and looks, those that show at one depth first; let go of the parts."""
        total = sum(len(faces) for parts in self._faces.values() for faces, _ in parts)
        faces, looks, used = np.empty((total, 3), np.int32), np.empty(total, np.int32), 0
        for artist in sorted(self._faces, reverse=True):
            for part, look in self._faces.pop(artist):
                faces[used : used + len(part)], looks[used : used + len(part)] = part, look
                used += len(part)
        return faces, looks

    def draw(self) -> np.ndarray | None:
        """Return the picture, (H, W, 4) uint8, straight alpha, or None if it is empty; once."""
        if not self._faces:
            return None
        self._surfaces = None
        faces, looks = self._take_faces()
        uvs = None
        if self._textured:
            uvs = np.zeros((self._used, 2), np.float32)
            for first, rows in self._textured:
                uvs[first : first + len(rows)] = rows
        region = self._view.region
        out = np.empty((region.height, region.width, 4), np.uint8)
        _native.draw_clip(
            *(self._clip[: self._used], self._colors[: self._used], faces, looks, uvs),
            *(
                [_texture(pixels) for pixels in self._textures],
                _samples_for(looks),
            ),
            *(resolve_backend(), resolve_threads(), out),
        )
        return out


def _texture(pixels: np.ndarray):
    nearest, clamp = _native.FILTERS["nearest"], _native.WRAPS["clamp"]
    return _native.NativeTexture(
        np.ascontiguousarray(pixels), False, nearest, clamp, clamp, 1, 0.0, False
    )


def _samples_for(looks: np.ndarray) -> int:
    """Return the samples of a pixel."""
    is_crowded = len(looks) > _MANY or np.count_nonzero(looks) > _MANY_CLEAR
    return _FEWER_SAMPLES if is_crowded else SAMPLES


def drop_broken(places: np.ndarray, sizes: np.ndarray) -> None:
    """Make all corners of polygons not a number where one of them is."""
    bad = ~np.isfinite(places[:, 2])
    if bad.any():
        owner = np.repeat(np.arange(len(sizes)), sizes)
        broken = np.zeros(len(sizes), bool)
        broken[owner[bad]] = True
        places[broken[owner]] = np.nan
