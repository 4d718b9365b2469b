"""The triangles of a picture, collected artist by artist, and the drawing of them.

In: places on the screen with colours, artist by artist in the order of painting. Out: a picture.
Surfaces come first, so that what lies on them can be lifted before it is added.
"""

from __future__ import annotations

import numpy as np

from ..._native import rasterizer as _native
from ...rendering.backend_selection import resolve_backend, resolve_threads
from ._resting import Surfaces
from ._view import View

SAMPLES = 16  # a pixel
_LIFT = 0.002  # of the scene's depth: how much nearer lines and markers are than surfaces
_CHUNK = 1 << 18  # vertices that are turned to float32 at a time
_OPAQUE, _BLENDED, _TEXTURED = 0, 1, 2


class Pile:
    """Triangles of one picture.

    Parameters
    ----------
    view : View
    vertices : int
        How many the surfaces will have: a pile grows, but large ones are best made at once.
    """

    def __init__(self, view: View, vertices: int) -> None:
        self._view = view
        self._clip = np.empty((vertices, 4), np.float32)
        self._colors = np.empty((vertices, 4), np.uint8)
        self._used = 0
        # By the number of the artist: faces, and what they look like.
        self._faces: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {}
        self._textures: list[np.ndarray] = []
        self._textured: list[tuple[int, np.ndarray]] = []
        self._artist = 0
        self._surfaces: Surfaces | None = None

    def begin(self, artist: int) -> None:
        """Let what is added belong to the artist of a number; of equal depth, greater ones show."""
        self._artist = artist

    def end_surfaces(self) -> None:
        """Remember what was added as the surfaces that others may lie on."""
        lists = self._faces.values()
        if self._used and lists:
            faces = np.concatenate([faces for parts in lists for faces, _ in parts])
            self._surfaces = Surfaces(self._view.region, self._clip[: self._used], faces)

    def lifted(self, places: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return places of markers, nearer: those on surfaces by as much as surfaces rise round them."""
        out = places.copy()
        out[:, 2] -= _LIFT * self._view.span
        if self._surfaces is not None and len(places):
            rise, lies = self._surfaces.under(places, self._view.span)
            out[:, 2] -= np.where(lies, self._surfaces.limited(rise * (1.0 + radii), self._view.span), 0.0)
        return out

    def lifted_lines(self, places: np.ndarray, runs: np.ndarray, half_widths: np.ndarray) -> np.ndarray:
        """The same of lines: a point lies on a surface where its neighbours do."""
        out = places.copy()
        out[:, 2] -= _LIFT * self._view.span
        if self._surfaces is not None and len(places):
            rise, lies = self._surfaces.under(places, self._view.span)
            joined = np.append(runs[1:] == runs[:-1], False)
            before, after = np.roll(joined, 1), joined
            lies &= (np.roll(lies, 1) | ~before) & (np.roll(lies, -1) | ~after) & (before | after)
            out[:, 2] -= np.where(lies, self._surfaces.limited(rise * (1.0 + half_widths), self._view.span), 0.0)
        return out

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
        first = self._take(places, colors)
        alpha = np.broadcast_to(colors[..., 3], len(places))[faces[:, 0]]
        looks = np.where(alpha == 255, _OPAQUE, _BLENDED).astype(np.int32)
        if not alpha.all():
            faces, looks = faces[alpha > 0], looks[alpha > 0]
        self._put(faces + np.int32(first), looks)

    def add_picture(self, corners: np.ndarray, pixels: np.ndarray) -> None:
        """Add a rectangle of pixels, (H, W, 4) uint8, between four corners, (4, 3), left top, right top, left bottom, right bottom."""
        first = self._take(corners, np.full(4, 255, np.uint8))
        uvs = np.array([[0, 1], [1, 1], [0, 0], [1, 0]], np.float32)
        self._textured.append((first, uvs))
        faces = np.array([[0, 1, 2], [1, 3, 2]], np.int32) + np.int32(first)
        self._put(faces, np.full(2, _TEXTURED + len(self._textures), np.int32))
        self._textures.append(pixels)

    def _take(self, places: np.ndarray, colors: np.ndarray) -> int:
        first, self._used = self._used, self._used + len(places)
        if self._used > len(self._clip):
            room = max(self._used, 2 * len(self._clip))
            self._clip = np.append(self._clip[:first], np.empty((room - first, 4), np.float32), 0)
            self._colors = np.append(self._colors[:first], np.empty((room - first, 4), np.uint8), 0)
        for k in range(0, len(places), _CHUNK):
            chunk = places[k : k + _CHUNK]
            self._view.clip(chunk, self._clip[first + k : first + k + len(chunk)])
        self._colors[first : self._used] = colors
        return first

    def _put(self, faces: np.ndarray, looks: np.ndarray) -> None:
        self._faces.setdefault(self._artist, []).append((faces, looks))

    def draw(self) -> np.ndarray | None:
        """Return the picture, (H, W, 4) uint8, straight alpha, top row first; None if it is empty."""
        parts = [part for artist in sorted(self._faces, reverse=True) for part in self._faces[artist]]
        if not parts:
            return None
        faces, looks = (np.concatenate(one) for one in zip(*parts, strict=True))
        uvs = None
        if self._textured:
            uvs = np.zeros((self._used, 2), np.float32)
            for first, rows in self._textured:
                uvs[first : first + len(rows)] = rows
        region = self._view.region
        out = np.empty((region.height, region.width, 4), np.uint8)
        _native.draw_clip(
            *(self._clip[: self._used], self._colors[: self._used], faces, looks, uvs),
            *([_texture(pixels) for pixels in self._textures], SAMPLES),
            *(resolve_backend(), resolve_threads(), out),
        )
        return out


def _texture(pixels: np.ndarray):
    nearest, clamp = _native.FILTERS["nearest"], _native.WRAPS["clamp"]
    return _native.NativeTexture(np.ascontiguousarray(pixels), False, nearest, clamp, clamp, 1, 0.0, False)
