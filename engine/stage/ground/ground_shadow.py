"""The soft shadow of a model on an invisible ground.

In: a scene, its ground, and the side it is viewed from. Out: the darkness of the ground on a square
around the model.

Along the rays of a light, depth pictures from below and from above give the model's lower and upper
surface over each point of the ground. The model is cut into slices by height. A slice blocks light
where its rays meet the ground, blurred by about its height; at each point the strongest slice
counts. So the shadow is dark and sharp where the model stands and soft below overhangs; slices
overlap, so that no ring shows between them. The sky's rays come straight down, the key light's at a
slant. Sums are integers that 32-bit floats hold exactly: they are the same on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from ...base import linalg
from ...base.dirty_tracking import Watch
from ...choices import FrameCull
from ...model.geometry.mesh import Mesh
from ...model.materials.material import textures_of
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh
from ...model.scene.orbiting import cosine, sine
from ...model.scene.staged_scene import StagedScene
from ...rendering.casters import placed_casters
from ...rendering.renderer import Renderer
from ..views.viewpoint import Sphere

#: The square's half side in model radii, and its texels per side.
REACH, SIDE = 2.0, 512
#: Darkness where none of the sky's light arrives, and none of the key light.
_SKY, _KEY = 0.46, 0.3
#: Blur of both, per height.
_SKY_SPREAD, _KEY_SPREAD = 0.45, 0.18
#: How far the key light's shadow reaches per height: usually, and at most.
_LEFT, _BACK = 0.42, 0.5
_LONGEST = 0.9
#: Heights of the slices in radii: the first is at the ground, each next one higher by a fixed
#: factor.
_HEIGHTS = (0.0, *(0.02 * 1.5**k for k in range(12)))
#: Range of heights covered, in radii.
_LOW, _HIGH = -0.01, 3.0
#: Blur in texels: no slice is blurred less than the first; beyond the second, coarser texels are
#: used. Slices are cut into blocks that are whole texels at all sizes.
_LEAST, _MOST, _BLOCK = 2, 4, 64
#: The values of a point fully inside a slice, and of one blurred horizontally.
_WHOLE, _WIDE = 256.0, 4096.0
#: Rows and columns.
Block: TypeAlias = tuple[slice, slice]
#: The distance in radii at which the shadow starts to fade, to vanish before the square's edge.
_FADES = 1.6


class GroundShadow:
    """The shadow of a scene on its ground; parts are cached while they are valid.

    Parameters
    ----------
    staged : StagedScene
    ground : Mesh
        The mesh that shows the shadow; it casts none itself.
    axes : (3, 3) ndarray of float64
        The axes of `home_axes`: rows right, up and back.
    """

    def __init__(self, staged: StagedScene, ground: Mesh, axes: np.ndarray) -> None:
        self._scene = staged
        self._ground = ground
        self._axes = axes
        self._renderers: dict[bool, Renderer] = {}
        self._kept: dict[float, tuple[tuple[object, ...], np.ndarray]] = {}
        self._shapes = _Shapes(ground)

    def alphas(
        self, lowest: float, sphere: Sphere, slant: tuple[float, float], cull: FrameCull
    ) -> np.ndarray:
        """Return the darkness of the ground; rows go from back to front.

        Parameters
        ----------
        lowest : float
            Height of the ground along the up direction.
        sphere : Sphere
            The scene's bounding sphere; determines the size of the square.
        slant : (float, float)
            How far the key light's shadow reaches to the right and back, per height.
        cull : str
            As in `Renderer.render`: culled faces cast no shadow.

        Returns
        -------
        (SIDE, SIDE) ndarray of uint8
            0 at the edges.
        """
        stands = lowest, sphere, cull, self._state()
        sky = self._darkness((0.0, 0.0), _SKY_SPREAD, stands)
        key = self._darkness(slant, _KEY_SPREAD, stands)
        dark = (sky * np.float32(255 * _SKY) + key * np.float32(255 * _KEY)) * _fading()
        return np.rint(dark).astype(np.uint8)

    def _darkness(
        self,
        slant: tuple[float, float],
        spread: float,
        stands: tuple[float, Sphere, FrameCull, Any],
    ) -> np.ndarray:
        """Return the fraction of a light that is blocked, (SIDE, SIDE) float32 from 0 to 1."""
        kept = self._kept.get(spread)
        if kept is None or kept[0] != (slant, stands):
            heights = self._heights(slant, *stands[:3])
            kept = self._kept[spread] = (slant, stands), _darkness(*heights, spread)
        return kept[1]

    def _state(self) -> tuple[object, ...]:
        """Return numbers that stay equal as long as no caster changes or moves."""
        data = self._scene.data
        data.update()
        posing = None if data.posing is None else data.posing.moment
        shapes = self._shapes.changes(data.objects)
        return shapes, data.shows_textures, posing, placed_casters(data.arrays)

    def _heights(
        self, slant: tuple[float, float], lowest: float, sphere: Sphere, cull: FrameCull
    ) -> tuple[Block, np.ndarray, np.ndarray]:
        """Return the model's lower and upper surface along rays, in radii, and where they are.

        Where nothing is, the lower surface is at infinity and the upper at minus infinity.
        """
        right, up, back = self._axes
        center = np.array(sphere.center)
        middle = center + up * (lowest - float(linalg.dot(center, up)))
        across, down = slant
        from_below = _camera((-across, -down), 2 * _LOW, sphere.radius)
        from_above = _camera((across, -down), -2 * _HIGH, sphere.radius)
        below = self._depths(from_below, middle, (right, back, -up))[::-1]
        above = self._depths(from_above, middle, (right, -back, up), cull)
        block = _block(np.isfinite(above))
        below, above = _share_of_depth(below[block]), _share_of_depth(above[block])
        last = np.float32(_HIGH) - above * np.float32(_HIGH - _LOW)
        first = np.minimum(np.float32(_LOW) + below * np.float32(_HIGH - _LOW), last)
        return block, np.where(np.isfinite(above), first, np.float32(np.inf)), last

    def _depths(
        self,
        camera: Camera,
        middle: np.ndarray,
        axes: Sequence[np.ndarray],
        cull: FrameCull = "none",
    ) -> np.ndarray:
        """Return ndc depths seen by a camera on the ground; infinite where nothing is."""
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = np.stack(axes, axis=1), middle
        by_mesh = cull == "auto"  # each renderer keeps the mode it began with
        if by_mesh not in self._renderers:
            self._renderers[by_mesh] = Renderer((SIDE, SIDE))
        frame = self._renderers[by_mesh].render(
            self._scene, (camera, pose), outputs=("ndc_depth",), cull=cull
        )
        return frame.ndc_depth


def _share_of_depth(depths: np.ndarray) -> np.ndarray:
    """Return ndc depths as numbers from 0 to 1."""
    return (depths + np.float32(1.0)) * np.float32(0.5)


def usual_slant(azimuth: float) -> tuple[float, float]:
    """Return the slant of light from behind the right shoulder of a viewer at an azimuth."""
    turned, tipped = cosine(azimuth), sine(azimuth)
    return -_LEFT * turned - _BACK * tipped, _LEFT * tipped - _BACK * turned


def slant_along(direction: np.ndarray, axes: np.ndarray) -> tuple[float, float]:
    """Return the slant of light that travels in a direction, (3,); of flat light the longest.

    Parameters
    ----------
    direction : (3,) ndarray of float64
    axes : (3, 3) ndarray of float64
        As for `GroundShadow`.
    """
    right, rise, back = (float(linalg.dot(direction, axis)) for axis in axes)
    aside = math.sqrt(right * right + back * back)
    reach = max(-rise, aside / _LONGEST) or 1.0
    return right / reach, back / reach


class _Shapes:
    """The shapes of a scene's objects, which are visited only if one may have changed.

    Parameters
    ----------
    ground : Mesh
        It does not count.
    """

    def __init__(self, ground: Mesh) -> None:
        self._ground = ground
        self._version: object = None
        self._versions: dict[Any, int] = {}
        self._watch = Watch()
        self._changes = 0

    def changes(self, objects: Any) -> int:
        """Return a number that grows whenever what may cast shadows changes; places do not count.

        Parameters
        ----------
        objects
            Those of a `StagedScene`.
        """
        if objects.version != self._version or self._watch.found():
            self._version = objects.version
            things = self._things(objects.objects)
            self._watch = Watch(things)
            versions = {thing: thing.version for thing in things}
            self._changes += versions != self._versions
            self._versions = versions
        return self._changes

    def _things(self, shapes: Sequence[Any]) -> dict[Any, None]:
        """Return the meshes, instances and materials, and the textures that have holes."""
        things: dict[Any, None] = {}
        for shape in shapes:
            if shape is None or shape is self._ground:
                continue
            if isinstance(shape, InstancedMesh):
                things[shape] = None
            mesh = getattr(shape, "mesh", shape)
            things[mesh] = None
            for material in mesh.materials:
                things[material] = None
                if material.alpha_mode != "opaque":
                    things.update(dict.fromkeys(textures_of(material).values()))
        return things


def _camera(lean: tuple[float, float], reached: float, radius: float) -> Camera:
    """Return an orthographic camera whose picture shows where slanted rays meet the ground.

    Parameters
    ----------
    lean : (float, float)
        How far a point moves right and up in the picture for each step towards the viewer.
    reached : float
        Twice the distance of the near plane in front of the camera, in radii.
    radius : float
    """
    side, deep = REACH * radius, _HIGH - _LOW
    return Camera(
        [
            [1 / side, 0.0, lean[0] / side, 0.0],
            [0.0, 1 / side, lean[1] / side, 0.0],
            [0.0, 0.0, -2 / (deep * radius), -reached / deep - 1.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


# ---- slices ----


def _darkness(block: Block, first: np.ndarray, last: np.ndarray, spread: float) -> np.ndarray:
    """Return the light blocked by all slices, (SIDE, SIDE) float32 from 0 to 1."""
    level = _texels(len(_HEIGHTS) - 1, spread)[0]
    taken = np.zeros((SIDE >> level, SIDE >> level), np.float32)
    for number in reversed(range(len(_HEIGHTS))):
        finer, reach = _texels(number, spread)
        while level > finer:
            taken, level = _doubled(taken), level - 1
        part = _slice(first, last, number)
        inner = _block(part > 0)
        if part[inner].size:
            corner = [a.start + b.start >> level for a, b in zip(block, inner, strict=True)]
            _lay(_spread(_coarse(part[inner], level), reach), taken, corner, 3 * reach)
    while level > 0:
        taken, level = _doubled(taken), level - 1
    return taken


def _texels(number: int, spread: float) -> tuple[int, int]:
    """Return how often to double texels for a slice, and its blur in the resulting texels."""
    reach, level = spread * _HEIGHTS[number] * SIDE / (2 * REACH), 0
    while reach > _MOST:
        reach, level = reach / 2, level + 1
    return level, max(_LEAST, round(reach))


def _slice(first: np.ndarray, last: np.ndarray, number: int) -> np.ndarray:
    """Return the model's coverage of a slice, from 0 to `_WHOLE`; nearby heights count in part."""
    above = _HEIGHTS[number + 1] if number + 1 < len(_HEIGHTS) else _HIGH
    here, whole = _HEIGHTS[number], np.float32(_WHOLE)
    part = _share(np.float32(above) - first, above - here)
    if number:
        part *= _share(last - np.float32(_HEIGHTS[number - 1]), here - _HEIGHTS[number - 1])
    return np.rint(part * whole)


def _share(height: np.ndarray, step: float) -> np.ndarray:
    return np.clip(height * np.float32(1 / step), np.float32(0), np.float32(1))


def _block(shows: np.ndarray) -> Block:
    """Return the non-empty rows and columns, rounded to whole blocks."""
    found = []
    for axis in (1, 0):
        places = np.flatnonzero(shows.any(axis=axis))
        low, high = (places[0], places[-1] + 1) if len(places) else (0, 0)
        found.append(slice(low // _BLOCK * _BLOCK, -(-high // _BLOCK) * _BLOCK))
    return found[0], found[1]


def _coarse(part: np.ndarray, level: int) -> np.ndarray:
    for _ in range(level):
        part = part[::2] + part[1::2]
        part = part[:, ::2] + part[:, 1::2]
    return np.rint(part * np.float32(0.25**level))


def _doubled(taken: np.ndarray) -> np.ndarray:
    """Return a picture with twice the rows and columns, interpolated."""
    for _ in range(2):
        beside = np.concatenate([taken[:1], taken, taken[-1:]]) * np.float32(0.25)
        finer = np.empty((2 * len(taken), taken.shape[1]), np.float32)
        inner = taken * np.float32(0.75)
        finer[::2], finer[1::2] = inner + beside[:-2], inner + beside[2:]
        taken = finer.T
    return np.ascontiguousarray(taken)


def _spread(part: np.ndarray, reach: int) -> np.ndarray:
    """Return a part blurred approximately by a Gaussian, with a margin of 3 reaches.

    It applies three box filters along each axis; the result is 1 where the whole neighbourhood is
    fully inside the slice.
    """
    taps = float((2 * reach + 1) ** 3)
    wide = _sums(np.pad(part, 6 * reach), reach)
    wide = np.rint(wide * np.float32(_WIDE / (_WHOLE * taps)))
    return _sums(wide.T, reach).T * np.float32(1 / (_WIDE * taps))


def _sums(rows: np.ndarray, reach: int) -> np.ndarray:
    """Return three successive box sums; rows become shorter by 3 reaches at each end."""
    for _ in range(3):
        length = len(rows) - 2 * reach
        total = rows[:length] + rows[1 : 1 + length]
        for k in range(2, 2 * reach + 1):
            total += rows[k : k + length]
        rows = total
    return rows


def _lay(part: np.ndarray, taken: np.ndarray, corner: Sequence[int], margin: int) -> None:
    """Apply a part's blocked light where it exceeds the blocked light so far."""
    to, source = [], []
    for start, size in zip(corner, part.shape, strict=True):
        low, high = max(start - margin, 0), min(start - margin + size, len(taken))
        to.append(slice(low, high))
        source.append(slice(low - start + margin, high - start + margin))
    np.maximum(taken[tuple(to)], part[tuple(source)], out=taken[tuple(to)])


def _fading() -> np.ndarray:
    """Return weights from 1 in the middle to 0 at the edges, (SIDE, SIDE) float32."""
    beside = np.abs(np.arange(SIDE) + 0.5 - SIDE / 2) * (2 * REACH / SIDE)
    share = np.clip((REACH - 2 * REACH / SIDE - beside) / (REACH - _FADES), 0.0, 1.0)
    share = (share * share * (3.0 - 2.0 * share)).astype(np.float32)
    return share[:, np.newaxis] * share
