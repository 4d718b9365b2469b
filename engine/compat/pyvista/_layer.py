"""What a renderer of VTK shows of its parts: colours and depths.

In: parts, lights and a view. Out: samples. Each sample of a pixel is a picture of its own, of a
camera that is moved by a part of a pixel: what the core does not know of VTK's look is added there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.materials.colors import linear_from_display
from ...model.materials.textures import Texture
from ...model.scene.cameras import Camera
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import MAX_LINE
from ...rendering.renderer import Renderer
from ._clear import mixture
from ._edges import edge_shares
from ._facets import facet_normals
from ._finish import Surface, shade
from ._lights import Lamp, add_lights
from ._parts import MANY, Paint, Part
from ._point_marks import spread_points
from ._properties import PLAIN, Property
from ._renderer_view import View, product
from ._samples import Samples
from ._surroundings import Surroundings

_OF_LIGHT = {"object_id", "albedo", "world_normal", "world_position"}
_OF_FACETS = {"object_id", "face_id", "albedo", "world_position"}
_OF_EDGES = {"object_id", "face_id"}
_MIDDLE = (0.5, 0.5)
_AT_ORIGIN = np.eye(4)
#: Those of `Maps`.
_MAPS = ("material", "emissive")


def draw_layer(
    samples: Samples,
    parts: list[Part],
    lamps: list[Lamp],
    view: View,
    peels: bool,
    surroundings: Surroundings | None = None,
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
        _Solid(solid, lamps, view, points, surroundings).draw(samples)
    if clear:

        def shaded(part: Part) -> Frame:
            alone = _Solid([part], lamps, view, PLAIN, surroundings, casters=solid)
            return alone.picture(_MIDDLE, {"depth", "face_id"})

        samples.blend(*mixture(solid, clear, lamps, view, peels, shaded))


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


class _Light(NamedTuple):
    """What is known of the light of a picture before its pixels are shaded.

    Attributes
    ----------
    maps : dict of str to (H, W, 3) float32
        What the maps of materials say.
    shadows : list of (H, W) bool or None
        For each lamp whether it arrives; None where nothing throws shadows in it.
    reflected : (H, W, 3) float32 or None
        What physical materials reflect of an environment.
    """

    maps: dict[str, NDArray[np.float32]]
    shadows: list[NDArray[np.bool_] | None]
    reflected: NDArray[np.float32] | None


class _Solid:
    """Parts that hide what is behind them.

    ``casters`` throw shadows on them; by default, they themselves do.
    """

    def __init__(
        self,
        parts: list[Part],
        lamps: list[Lamp],
        view: View,
        points: Property,
        surroundings: Surroundings | None,
        casters: list[Part] | None = None,
    ) -> None:
        self._lamps, self._view, self._points = lamps, view, points
        self._around = surroundings
        self._reflecting = None
        if surroundings is not None and any(part.look.is_physical for part in parts):
            self._reflecting = surroundings.scene(parts)
        self._scene = Scene(background=None, ambient=(0, 0, 0))
        self._unfinished: dict[int, _Unfinished] = {}
        self._maps = {name: scene for name in _MAPS if (scene := _map_scene(parts, name))}
        self._shadows = [
            _shadow_scene(parts, casters, lamp) if lamp.casts else None for lamp in lamps
        ]
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
        renderer = self._renderer()
        for number, place in enumerate(samples.pattern):
            samples.put(number, self._picture(renderer, place, self._outputs).color)

    def picture(self, place: tuple[float, float], outputs: set[str]) -> Frame:
        """Draw the parts at a place in each pixel, with other outputs than the colour."""
        return self._picture(self._renderer(), place, self._outputs | outputs)

    def _renderer(self) -> Renderer:
        return Renderer((self._view.width, self._view.height), color_space="linear")

    def _picture(self, renderer: Renderer, place: tuple[float, float], outputs: set[str]) -> Frame:
        camera = Camera(_moved(self._view, 0.5 - place[0], 0.5 - place[1]))
        frame = self._render(renderer, self._scene, camera, outputs)
        if self._unfinished:
            self._finish(frame, self._light(renderer, camera))
        return frame

    def _light(self, renderer: Renderer, camera: Camera) -> _Light:
        """Return what the core tells of the light of all pixels."""
        maps = {
            name: self._render(renderer, scene, camera, {"albedo"}).albedo
            for name, scene in self._maps.items()
        }
        shadows = [
            None
            if scene is None
            else self._render(renderer, scene, camera, {"radiance"}).radiance[..., 0] > 0.0
            for scene in self._shadows
        ]
        reflected = None
        if self._around is not None and self._reflecting is not None:
            pose = self._around.turn
            frame = self._render(renderer, self._reflecting, camera, {"radiance"}, pose)
            reflected = frame.radiance
        return _Light(maps, shadows, reflected)

    def _render(
        self,
        renderer: Renderer,
        scene: Scene,
        camera: Camera,
        outputs: set[str],
        pose: NDArray[np.float64] = _AT_ORIGIN,
    ) -> Frame:
        return renderer.render(
            scene,
            (camera, pose),
            outputs=tuple(sorted(outputs)),
            cull="none",
            **_point_options(self._points),
        )

    def _finish(self, frame: Frame, light: _Light) -> None:
        """Change the pixels of parts whose light or edges the core does not know."""
        color, ids = frame.color.reshape(-1, 4), frame.object_id.reshape(-1)
        for number, one in self._unfinished.items():
            rows = np.flatnonzero(ids == number)
            if not len(rows):
                continue
            if one.is_lit:
                found = color[rows, :3].astype(np.float64)
            else:
                found = 255.0 * self._shaded(frame, rows, one, light)
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
        self, frame: Frame, rows: NDArray[np.intp], one: _Unfinished, light: _Light
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
        if part.look.is_physical and part.paint.image is not None:
            factor = 1.0 if part.has_colors else np.maximum(part.look.color, 1e-6)
            albedo = factor * _decoded(albedo / factor, part.paint.image)
        told = {
            name: _decoded(_values(values, rows), picture)
            for name, values in light.maps.items()
            if (picture := getattr(part.maps, name, None)) is not None
        }
        shadows = [
            None if shown is None else shown.reshape(-1)[rows].astype(np.float64)
            for shown in light.shadows
        ]
        around = None if light.reflected is None else _values(light.reflected, rows)
        surface = Surface(albedo, ambient, normals, places, shadows, around, **told)
        return shade(part.look, surface, self._lamps)


def _map_scene(parts: list[Part], name: str) -> Scene | None:
    """Return a scene whose colours are those of a map of all parts; None where none has it."""
    pictures = [None if part.maps is None else getattr(part.maps, name) for part in parts]
    if not any(pictures):
        return None
    scene = Scene(background=None)
    for part, picture in zip(parts, pictures, strict=True):
        shown = part if picture is None else part.showing(picture)
        shown.added(scene, shown.material())
    return scene


def _shadow_scene(parts: list[Part], casters: list[Part] | None, lamp: Lamp) -> Scene:
    """Return a scene of white surfaces which is black where a lamp does not arrive.

    Casters throw shadows, and hide parts behind them; without them, the parts do.
    """
    scene = Scene(background=None, ambient=(0, 0, 0))
    add_lights(scene, [lamp._replace(color=np.ones(3))])
    for part in parts:
        _add_white(scene, part).cast_shadows = casters is None
    for part in casters or ():
        _add_white(scene, part)
    return scene


def _add_white(scene: Scene, part: Part) -> Node:
    white = replace(part, paint=Paint(), spot_colors=None, face_rgba=None)
    material = white.material()
    material.color, material.unlit = (1.0, 1.0, 1.0), False
    return white.added(scene, material)


def _values(array: NDArray[np.float32], rows: NDArray[np.intp]) -> NDArray[np.float64]:
    return array.reshape(-1, 3)[rows].astype(np.float64)


def _decoded(values: NDArray[np.float64], picture: Texture) -> NDArray[np.float64]:
    """Return the light that the colours of a picture stand for."""
    return linear_from_display(values) if picture.color_space == "srgb" else values


def _moved(view: View, right: float, down: float) -> NDArray[np.float64]:
    """Return the projection of a view whose picture is moved, in pixels."""
    shift = np.eye(4)
    shift[0, 3], shift[1, 3] = 2.0 * right / view.width, -2.0 * down / view.height
    return product(shift, view.projection)
