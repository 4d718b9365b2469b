"""What a renderer of VTK shows of its parts: colours and depths.

In: parts, lights and a view. Out: samples. Each sample of a pixel is a picture of its own, of a
camera that is moved by a part of a pixel: what the core does not know of VTK's look is added there.
"""

from __future__ import annotations

from dataclasses import dataclass
import numpy as np
from numpy.typing import NDArray

from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.renderer import Renderer
from ._clear import mixture
from ._edges import edge_shares
from ._finish import shade
from ._lights import Lamp, add_lights
from ._parts import Part
from ._samples import Samples
from ._view import View, product

_OF_LIGHT = {"object_id", "albedo", "world_normal", "world_position"}
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
    shown = [part for part in parts if len(part.faces)]
    solid = [part for part in shown if not part.is_clear]
    clear = [part for part in shown if part.is_clear]
    if solid:
        _Solid(solid, lamps, view).draw(samples)
    if clear:
        samples.blend(*mixture(solid, clear, lamps, view, peels))


def depth_of(parts: list[Part], view: View) -> NDArray[np.float32]:
    """Return distances along the view axis in the middles of pixels, (H, W); 0 where nothing is."""
    scene = Scene(background=None)
    for part in parts:
        if len(part.faces):
            part.added(scene, part.material(opacity=1.0))
    renderer = Renderer((view.width, view.height), color_space="linear")
    camera = Camera(view.projection), np.eye(4)
    return renderer.render(
        scene,
        camera,
        mode="unlit",
        outputs=("depth",),
        cull="none",
        transparent_outputs=True,
    ).depth


@dataclass
class _Unfinished:
    """A part whose samples are changed; ``is_lit`` if the core knows all of its light."""

    part: Part
    is_lit: bool


class _Solid:
    """Parts that hide what is behind them."""

    def __init__(self, parts: list[Part], lamps: list[Lamp], view: View) -> None:
        self._lamps, self._view = lamps, view
        self._scene = Scene(background=None, ambient=(0, 0, 0))
        self._unfinished: dict[int, _Unfinished] = {}
        self._outputs = {"color"}
        add_lights(self._scene, lamps)
        is_plain = all(lamp.is_plain for lamp in lamps)
        for part in parts:
            self._add(part, is_plain)

    def _add(self, part: Part, is_plain: bool) -> None:
        look = part.look
        is_lit = look.is_unlit or (look.is_matt and is_plain)
        factor = look.ambient + look.diffuse if look.is_unlit else look.diffuse
        node = part.added(self._scene, part.material(factor if is_lit else 1.0))
        if not is_lit:
            self._outputs |= _OF_LIGHT
        if look.edge_width:
            self._outputs |= _OF_EDGES
        if not is_lit or look.edge_width:
            self._unfinished[node.id] = _Unfinished(part, is_lit)

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
                found = 255.0 * self._shaded(frame, rows, one.part)
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

    def _shaded(self, frame: Frame, rows: NDArray[np.intp], part: Part) -> NDArray[np.float64]:
        albedo, normals, places = (
            array.reshape(-1, 3)[rows].astype(np.float64)
            for array in (frame.albedo, frame.world_normal, frame.world_position)
        )
        is_own = part.has_colors or not part.paint.is_plain
        ambient = albedo if is_own else np.broadcast_to(part.look.ambient_color, albedo.shape)
        return shade(part.look, albedo, ambient, normals, places, self._lamps)


def _moved(view: View, right: float, down: float) -> NDArray[np.float64]:
    """Return the projection of a view whose picture is moved, in pixels."""
    shift = np.eye(4)
    shift[0, 3], shift[1, 3] = 2.0 * right / view.width, -2.0 * down / view.height
    return product(shift, view.projection)
