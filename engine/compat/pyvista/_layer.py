"""What a renderer of VTK shows of its parts: colours and depths.

In: parts, lights and a view. Out: samples. Each sample of a pixel is a picture of its own, of a
camera that is moved by a part of a pixel: what the core does not know of VTK's look is added there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import MAX_LINE
from ...rendering.renderer import Renderer
from ._clear import mixture
from ._edges import edge_shares
from ._facets import facet_normals
from ._finish import shade
from ._lights import Lamp, add_lights
from ._parts import MANY, Part
from ._point_marks import spread_points
from ._properties import PLAIN, Property
from ._renderer_view import View, product
from ._samples import Samples

_OF_LIGHT = {"object_id", "albedo", "world_normal", "world_position"}
_OF_FACETS = {"object_id", "face_id", "albedo", "world_position"}
_OF_EDGES = {"object_id", "face_id"}


def draw_layer(
    samples: Samples, parts: list[Part], lamps: list[Lamp], view: View, peels: bool
) -> None:
    """Draw parts over samples.

    Parameters
    ----------
    samples : Samples
        Of the view's rectangle.
    peels : bool
        Whether clear faces lie over each other from far to near, instead of being mixed. As in VTK,
        they have one sample a pixel.
    """
    shown = [part for part in parts if not part.is_empty]
    solid, points = _with_one_size([part for part in shown if not part.is_clear], view)
    clear = [_spread(part, view) for part in shown if part.is_clear]
    if solid:
        _Solid(solid, lamps, view, points).draw(samples)
    if clear:
        samples.blend(*mixture(solid, clear, lamps, view, peels))


def _spread(part: Part, view: View) -> Part:
    return spread_points(part, view) if part.is_points else part


def _with_one_size(parts: list[Part], view: View) -> tuple[list[Part], Property]:
    """Return parts whose points all look alike, and the look; others become triangles."""
    looks = [part.look for part in parts if part.is_points]
    if not looks:
        return parts, PLAIN
    most = max((part for part in parts if part.is_points), key=lambda part: len(part.places))
    wanted = most.look.point_size, most.look.round_points
    if wanted[0] > MAX_LINE:
        return [_spread(part, view) for part in parts], PLAIN

    def fits(part: Part) -> bool:
        return (part.look.point_size, part.look.round_points) == wanted

    return [part if fits(part) else _spread(part, view) for part in parts], most.look


def depth_of(parts: list[Part], view: View, place: tuple[float, float]) -> NDArray[np.float32]:
    """Return distances along the view axis, (H, W); 0 where nothing is.

    ``place`` is where in a pixel they are found. VTK takes the first sample's, of what is not
    clear.
    """
    scene = Scene(background=None)
    solid = [part for part in parts if not part.is_empty and not part.is_clear]
    alike, points = _with_one_size(solid, view)
    for part in alike:
        part.added(scene, part.material())
    renderer = Renderer((view.width, view.height), color_space="linear")
    camera = Camera(_moved(view, 0.5 - place[0], 0.5 - place[1])), np.eye(4)
    return renderer.render(
        scene,
        camera,
        mode="unlit",
        outputs=("depth",),
        cull="none",
        **_point_options(points),
    ).depth


def _point_options(look: Property) -> dict[str, Any]:
    shape = "round" if look.round_points else "square"
    return {"point_size": min(max(look.point_size, 1e-3), MAX_LINE), "point_shape": shape}


@dataclass
class _Unfinished:
    """A part whose samples are changed.

    Attributes
    ----------
    part : Part
    is_lit : bool
        Whether the core knows all of its light.
    is_faceted : bool
        Whether its normals are those of the faces that show: of many, most don't.
    """

    part: Part
    is_lit: bool
    is_faceted: bool


class _Solid:
    """Parts that hide what is behind them."""

    def __init__(self, parts: list[Part], lamps: list[Lamp], view: View, points: Property) -> None:
        self._lamps, self._view, self._points = lamps, view, points
        self._scene = Scene(background=None, ambient=(0, 0, 0))
        self._unfinished: dict[int, _Unfinished] = {}
        self._outputs = {"color"}
        add_lights(self._scene, lamps)
        is_plain = all(lamp.is_plain for lamp in lamps)
        for part in parts:
            self._add(part, is_plain)

    def _add(self, part: Part, is_plain: bool) -> None:
        look = part.look
        is_faceted = part.normals is None and len(part.faces) > MANY and not look.is_unlit
        is_known = look.is_unlit or (look.is_matt and is_plain and not is_faceted)
        is_lit = is_known and part.face_rgba is None
        factor = look.ambient + look.diffuse if look.is_unlit else look.diffuse
        material = part.material(factor if is_lit else 1.0)
        material.unlit = not is_lit or look.is_unlit
        material.flat_shading = material.flat_shading and not (is_faceted or look.is_unlit)
        node = part.added(self._scene, material)
        if not is_lit:
            self._outputs |= _OF_FACETS if is_faceted else _OF_LIGHT
        if look.edge_width or part.face_rgba is not None:
            self._outputs |= _OF_EDGES
        if not is_lit or look.edge_width:
            self._unfinished[node.id] = _Unfinished(part, is_lit, is_faceted)

    def draw(self, samples: Samples) -> None:
        """Draw the parts over samples."""
        renderer = Renderer((self._view.width, self._view.height), color_space="linear")
        for number, (x, y) in enumerate(samples.pattern):
            frame = self._render(renderer, _moved(self._view, 0.5 - x, 0.5 - y))
            if self._unfinished:
                self._finish(frame)
            samples.put(number, frame.color)

    def _render(self, renderer: Renderer, projection: NDArray[np.float64]) -> Frame:
        return renderer.render(
            self._scene,
            (Camera(projection), np.eye(4)),
            outputs=tuple(sorted(self._outputs)),
            cull="none",
            **_point_options(self._points),
        )

    def _finish(self, frame: Frame) -> None:
        """Change the pixels of parts whose light or edges the core does not know."""
        color, ids = frame.color.reshape(-1, 4), frame.object_id.reshape(-1)
        for number, one in self._unfinished.items():
            rows = np.flatnonzero(ids == number)
            if not len(rows):
                continue
            if one.is_lit:
                found = color[rows, :3].astype(np.float64)
            else:
                found = 255.0 * self._shaded(frame, rows, one)
            if one.part.look.edge_width:
                found = self._edged(frame, rows, one.part, found)
            color[rows, :3] = np.clip(found + 0.5, 0.0, 255.0).astype(np.uint8)

    def _edged(
        self, frame: Frame, rows: NDArray[np.intp], part: Part, colors: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        y, x = np.divmod(rows, self._view.width)
        middles = np.stack([x, y], -1) + 0.5
        share = edge_shares(part, self._view, frame.face_id.reshape(-1)[rows], middles)[:, None]
        share *= part.look.edge_opacity
        return colors * (1.0 - share) + 255.0 * part.look.edge_color * share

    def _shaded(
        self, frame: Frame, rows: NDArray[np.intp], one: _Unfinished
    ) -> NDArray[np.float64]:
        part, places = one.part, _values(frame.world_position, rows)
        if part.face_rgba is None:
            albedo = _values(frame.albedo, rows)
        else:
            albedo = part.face_rgba[frame.face_id.reshape(-1)[rows], :3] / 255.0
        if one.is_faceted:
            faces = frame.face_id.reshape(-1)[rows]
            normals = facet_normals(part, faces, places, self._view)
        else:
            normals = _values(frame.world_normal, rows)
        is_own = part.has_colors or not part.paint.is_plain
        ambient = albedo if is_own else np.broadcast_to(part.look.ambient_color, albedo.shape)
        return shade(part.look, albedo, ambient, normals, places, self._lamps)


def _values(array: NDArray[np.float32], rows: NDArray[np.intp]) -> NDArray[np.float64]:
    return array.reshape(-1, 3)[rows].astype(np.float64)


def _moved(view: View, right: float, down: float) -> NDArray[np.float64]:
    """Return the projection of a view whose picture is moved, in pixels."""
    shift = np.eye(4)
    shift[0, 3], shift[1, 3] = 2.0 * right / view.width, -2.0 * down / view.height
    return product(shift, view.projection)
