"""The plan of a lens's picture: which pinhole pictures are drawn, and where its pixels look.

In: a lens camera, the picture's size. Out: a `LensPlan`, kept while the camera stays as it is. The
faces are as fine as the lens is where it is finest along the better of two directions, and cut to
what it sees (docs/exactness, R202, R203).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native.lens import PIXEL_BYTES, NativeLens
from ...base.image_size import MAX_SIZE
from ...base.system import machine_memory
from ...errors import InvalidArgumentError, warn
from ...model.scene.lenses.lens_camera import LensCamera, limit_of, pinhole_of
from .faces import CUBE, Places, is_narrow, places_of, places_on

Floats = NDArray[np.float64]

_ONE = 256  # of a face's pixel: the unit of places
_WIDEST = 32  # pixels of a face that half the filter may reach
_MOST_BORDER = 512  # pixels
_STEPS = 64  # focal lengths are rounded to this part of the lens's
_MOST = 3  # pixels of all faces over those of the picture
_FINEST = 1e6
_BYTES = 400  # a pixel, at most at once
_APART = 64  # pixels: each face begins at a multiple
_BAND = 1 << 14  # pixels whose rays are found at once: their numbers fit a processor's cache
_PIXEL = np.dtype([("x", "<i4"), ("y", "<i4"), ("face", "<i4"), ("across", "<u2"), ("down", "<u2")])
assert _PIXEL.itemsize == PIXEL_BYTES


class Face(NamedTuple):
    """A pinhole picture.

    Attributes
    ----------
    start : int
        Its first pixel in the arrays of all faces.
    size : (int, int)
    axes : (3, 3) float64
        Rows right, up and back, in camera space.
    intrinsics : (float, float, float, float)
        fx, fy, cx, cy of its pinhole camera.
    """

    start: int
    size: tuple[int, int]
    axes: Floats
    intrinsics: tuple[float, float, float, float]

    @property
    def pixels(self) -> slice:
        """Its pixels in the arrays of all faces."""
        return slice(self.start, self.start + self.size[0] * self.size[1])

    def pose(self, pose: Floats) -> Floats:
        """Return its pose, for that of the lens."""
        turned = pose.copy()
        for column, axis in enumerate(self.axes):
            number = int(np.flatnonzero(axis)[0])
            turned[:, column] = pose[:, number] * axis[number]
        return turned


class LensPlan(NamedTuple):
    """How a lens's picture is drawn.

    Attributes
    ----------
    faces : list of Face
    native : NativeLens
    rays : (H, W, 3) float64
        Unit, camera space; NaN for pixels that see nothing.
    seen : (H, W) bool
    scale : float
        Pixels of the faces over those of the lens at its middle.
    pixels : (H, W) structured
        Where they look: rows of e3d_lens_pixel.
    rows : int
        Pixels of the faces over the picture's height. One object: options are kept by identity.
    """

    faces: list[Face]
    native: NativeLens
    rays: Floats
    seen: NDArray[np.bool_]
    scale: float
    pixels: NDArray[Any]
    rows: int

    @property
    def total(self) -> int:
        """The number of pixels of all faces, with the gaps between them."""
        return int(self.native.total)

    def nearest(self) -> NDArray[np.int64]:
        """Return the pixel of the faces that each pixel's ray passes, (H, W); -1 for none."""
        starts = np.array([face.start for face in self.faces])
        widths = np.array([face.size[0] for face in self.faces])
        of = np.maximum(self.pixels["face"], 0)
        at = starts[of] + (self.pixels["y"] // _ONE) * widths[of] + self.pixels["x"] // _ONE
        return np.where(self.seen, at, -1)


def plan_lens(camera: LensCamera, size: tuple[int, int], border: float) -> LensPlan:
    """Plan a lens's picture.

    Parameters
    ----------
    camera : LensCamera
    size : (int, int)
        Width and height.
    border : float
        How much of a face's focal length is drawn around what the lens sees of it, for effects that
        depend on what is beside a pixel.
    """
    width, height = size
    _check_memory(width * height)
    rays = _rays(camera, size)
    seen = np.isfinite(rays[..., 0])
    _warn_of_limit(camera, size, seen)
    narrow = is_narrow(rays)
    places = places_of(rays, narrow)
    fx, fy, cx, cy = pinhole_of(camera, size)
    if not narrow:
        fx = fy = math.sqrt(fx * fy)
        cx = cy = 0.0
    across, down, finest = _footprints(places, rays, fx, fy)
    scale = _scale(places, finest, (fx, fy), width * height)
    focal = fx * scale, fy * scale
    reach = min(int(math.ceil(scale * max(float(across.max()), float(down.max()), 1.0))), _WIDEST)
    margin = reach + 2 + min(int(math.ceil(border * max(focal))), _MOST_BORDER)
    pixels = np.zeros((height, width), _PIXEL)
    pixels["face"] = -1
    for of, to in ((across, "across"), (down, "down")):
        pixels[to] = np.rint(np.clip(of * scale, 1.0, _WIDEST) * _ONE).astype(np.uint16)
    faces: list[Face] = []
    for number, axes in enumerate(CUBE):
        shown = places.face == number
        if not shown.any():
            continue
        x = places.x[shown] * focal[0] + cx * scale
        y = places.y[shown] * focal[1] + cy * scale
        (left, wide), (top, high) = _extent(x, margin), _extent(y, margin)
        start = 0 if not faces else -(-faces[-1].pixels.stop // _APART) * _APART
        intrinsics = *focal, cx * scale - left, cy * scale - top
        pixels["x"][shown] = np.rint((x - left) * _ONE).astype(np.int32)
        pixels["y"][shown] = np.rint((y - top) * _ONE).astype(np.int32)
        pixels["face"][shown] = len(faces)
        faces.append(Face(start, (wide, high), axes, intrinsics))
    if not faces:  # nothing is seen; statistics are still those of a picture
        faces.append(Face(0, (1, 1), CUBE[0], (1.0, 1.0, 0.5, 0.5)))
    rows = [(face.start, *face.size, face.axes.tolist()) for face in faces]
    raw = pixels.view(np.uint8).reshape(height, width, PIXEL_BYTES)
    native, tall = NativeLens(rows, raw, rays), max(round(height * scale), 1)
    return LensPlan(faces, native, rays, seen, scale, pixels, tall)


def _check_memory(pixels: int) -> None:
    """Raise an error if finding where pixels look would take more than the machine has."""
    room, needed = machine_memory(), _BYTES * pixels
    if room is not None and needed > room:
        raise InvalidArgumentError(
            f"finding where the {pixels} pixels of a lens look takes {needed / 2**30:.1f} GiB, but "
            f"this machine has {room / 2**30:.1f} GiB of memory: fewer pixels help"
        )


def _rays(camera: LensCamera, size: tuple[int, int]) -> Floats:
    width, height = size
    rays = np.empty((height, width, 3))
    step = max(_BAND // width, 1)
    for top in range(0, height, step):
        rows = np.arange(top, min(top + step, height)) + 0.5
        places = np.stack(np.meshgrid(np.arange(width) + 0.5, rows), axis=-1)
        found = camera.rays(places.reshape(-1, 2), size)
        rays[top : top + len(rows)] = found.reshape(len(rows), width, 3)
    return rays


def _warn_of_limit(camera: LensCamera, size: tuple[int, int], seen: NDArray[np.bool_]) -> None:
    """Tell if the model turns back within the picture."""
    limit = limit_of(camera, size)
    if limit and not seen.all():
        share = 100.0 * float((~seen).mean())
        told = f"{share:.0f}" if share >= 10.0 else f"{share:.2g}"  # never 1e+02
        warn(
            f"{type(camera).__name__}: {told}% of the pixels of {size[0]}x{size[1]} show "
            f"nothing, because the lens's distortion has no inverse there: {limit}"
        )


def _differences(places: Places, rays: Floats, axis: int) -> tuple[Floats, Floats]:
    """Return how places change from a pixel to its neighbour; 0 where none sees anything."""
    x, y = np.zeros(places.x.shape), np.zeros(places.x.shape)
    for step in (-1, 1):  # the next one if it sees something, else the one before
        other = np.roll(rays, step, axis)
        edge: list[slice | int] = [slice(None)] * 2
        edge[axis] = 0 if step == 1 else -1
        other[tuple(edge)] = np.nan
        for number in range(len(CUBE)):
            shown = places.face == number
            if not shown.any():
                continue
            at_x, at_y = places_on(number, other[shown])
            at_x, at_y = at_x - places.x[shown], at_y - places.y[shown]
            good = np.isfinite(at_x)
            if step == 1:
                good &= (x[shown] == 0.0) & (y[shown] == 0.0)
            x[shown] = np.where(good, at_x, x[shown])
            y[shown] = np.where(good, at_y, y[shown])
    return x, y


def _footprints(places: Places, rays: Floats, fx: float, fy: float) -> tuple[Floats, Floats, float]:
    """Return the widths of pixels on their faces, and the least extent of any.

    The extent of a pixel is that along the direction in which it is longer.
    """
    (xx, yx), (xy, yy) = (_differences(places, rays, axis) for axis in (1, 0))
    xx, xy, yx, yy = xx * fx, xy * fx, yx * fy, yy * fy
    across, down = np.sqrt(xx * xx + xy * xy), np.sqrt(yx * yx + yy * yy)
    total, area = across * across + down * down, xx * yy - xy * yx
    longest = np.sqrt(0.5 * (total + np.sqrt(np.maximum(total * total - 4.0 * area * area, 0.0))))
    known = longest[(places.face >= 0) & (longest > 0.0) & (longest < _FINEST)]
    return across, down, float(known.min()) if len(known) else 1.0


def _scale(places: Places, finest: float, focal: tuple[float, float], pixels: int) -> float:
    """Return by how much the faces are finer than the lens at its middle."""
    scale = math.ceil(min(_STEPS / finest, _FINEST) - 1e-6) / _STEPS
    area, most = 0.0, 1.0
    for number in range(len(CUBE)):
        shown = places.face == number
        if shown.any():
            wide = float(np.ptp(places.x[shown])) * focal[0]
            high = float(np.ptp(places.y[shown])) * focal[1]
            area, most = area + wide * high, max(most, wide, high)
    limit = min(math.sqrt(_MOST * pixels / max(area, 1.0)), 0.9 * MAX_SIZE / most)
    return min(scale, math.floor(limit * _STEPS) / _STEPS if limit * _STEPS >= 1.0 else limit)


def _extent(places: Floats, margin: int) -> tuple[int, int]:
    """Return where a face begins, in whole pixels from its axis, and how many it has."""
    low = math.floor(float(places.min())) - margin
    high = math.ceil(float(places.max())) + margin
    return low, high - low
