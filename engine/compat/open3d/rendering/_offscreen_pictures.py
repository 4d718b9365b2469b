"""Pictures of an offscreen scene: the engine's light, Filament's exposure and tone mapping.

In: an `Open3DScene`, a size. Out: bytes of sRGB, or depths as Filament's buffer has them: 1 at the
near plane, 0 far away. Open3D's camera has Filament's exposure: f/16, 1/125 s, ISO 100.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....model.materials.colors import linear_color, srgb_bytes, srgb_to_linear_table
from ....model.materials.linear_colors import linear
from ....model.scene.cameras import Camera
from ....model.scene.lights import DirectionalLight, PointLight, SpotLight
from ....model.scene.scene import Scene
from ....rendering.frame import Frame
from ....rendering.options import MAX_LINE
from ....rendering.renderer import Renderer
from ._ktx import environment_of_ktx
from ._special_shaders import special_colors
from ._things import Thing, normal_colors
from ._tone import tone_mapped

if TYPE_CHECKING:
    from .low_level_scene import Lamp
    from .open3d_scene import Open3DScene
    from .view_camera import Camera as ViewCamera

_EXPOSURE = 1.0 / (1.2 * 16.0**2 * 125.0)
#: Filament's diffuse light does not lose what a surface reflects, mostly 4 %; the engine's does.
_DIFFUSE = 1.0 / 0.96
_OCCLUSION_RADIUS = 0.3  # world units
_OUTPUTS = ("color", "radiance", "depth", "object_id")


class Drawer:
    """Draws pictures, and keeps the renderers."""

    def __init__(self) -> None:
        self._renderers: dict[tuple[tuple[int, int], int], Renderer] = {}

    def _renderer(self, size: tuple[int, int], samples: int) -> Renderer:
        if (size, samples) not in self._renderers:
            self._renderers = {
                (size, samples): Renderer(size, samples=samples, antialiasing="ssaa"),
                **{key: kept for key, kept in self._renderers.items() if key[0] == size},
            }
        return self._renderers[size, samples]

    def depth(self, scene: Open3DScene, size: tuple[int, int]) -> NDArray[np.float32]:
        """Return depths, (H, W) float32: 1 at the near plane, 0 far away and where nothing is."""
        frames = [
            frame.ndc_depth
            for frame, _ in self._frames(scene, size, 1, ("ndc_depth",), is_lit=False)
        ]
        nearest = np.minimum.reduce(frames)
        shows = np.isfinite(nearest)
        if scene.camera.is_parallel:
            return np.where(shows, 0.5 - 0.5 * np.where(shows, nearest, 1.0), 0.0).astype(
                np.float32
            )
        return np.where(shows, -np.where(shows, nearest, 0.0), 0.0).astype(np.float32)

    def color(self, scene: Open3DScene, size: tuple[int, int]) -> NDArray[np.uint8]:
        """Return the picture, (H, W, 3) uint8."""
        view = scene.view
        is_smooth = view.is_antialiased and view.samples > 1 and view.has_post_processing
        light: NDArray[np.float64] | None = None
        cover = nearest = None
        for frame, things in self._frames(scene, size, 4 if is_smooth else 1, _OUTPUTS):
            own = frame.radiance.astype(np.float64)
            share = frame.color[..., 3:].astype(np.float64) / 255.0
            special_colors(own, frame, things, scene.camera.get_near())
            depth = np.where(frame.depth > 0, frame.depth, np.inf)
            if light is None:
                light, cover, nearest = own, share, depth
                continue
            is_nearer = (depth < nearest)[..., np.newaxis]
            over = own + light * (1.0 - share)
            light = np.where(is_nearer, over, light)
            cover = np.where(is_nearer, share + cover * (1.0 - share), cover)
            nearest = np.minimum(depth, nearest)
        if not scene.scene.shows_skybox:
            light = light + _background(scene, size) * (1.0 - cover)
        return _shown(light, is_mapped=view.has_post_processing)

    def _frames(
        self,
        source: Open3DScene,
        size: tuple[int, int],
        samples: int,
        outputs: tuple[str, ...],
        *,
        is_lit: bool = True,
    ) -> list[tuple[Frame, dict[int, Thing]]]:
        """Draw the scene, once for each size of points and lines: most scenes have one.

        Return the frames, with the things of the objects that each shows.
        """
        visible = [thing for thing in source.scene.things.values() if thing.is_visible]
        marks = [thing for thing in visible if thing.arrays.kind != "faces"]
        sizes = list(dict.fromkeys(_mark_size(thing) for thing in marks)) or [(1.0, 0.0)]
        drawn = []
        for number, (points, width) in enumerate(sizes):
            shown = [
                thing
                for thing in visible
                if (
                    number == 0
                    if thing.arrays.kind == "faces"
                    else _mark_size(thing) == sizes[number]
                )
            ]
            scene, things = _scene(source, shown, is_lit=is_lit)
            camera = source.camera
            matrix = camera.up_to(_end(camera, shown)) if is_lit else camera.reversed_depth
            frame = self._renderer(size, samples).render(
                scene,
                (Camera(matrix), camera.pose),
                outputs=outputs,
                cull="back",
                point_size=min(max(points, 1.0), MAX_LINE),
                line_width=_line_width(width, matrix),
                ambient_occlusion=is_lit
                and source.view.has_occlusion
                and source.view.has_post_processing,
                ambient_occlusion_radius=_OCCLUSION_RADIUS,
                transparent_outputs=True,
            )
            drawn.append((frame, things))
        return drawn


def _end(camera: ViewCamera, things: list[Thing]) -> float:
    """Return how far away the farthest thing ends, a little more."""
    view, farthest = linalg.inverse(camera.pose), 0.0
    for thing in things:
        corners = linalg.transform_points(thing.pose, np.asarray(thing.box.get_box_points()))
        farthest = max(farthest, -float(linalg.transform_points(view, corners)[:, 2].min()))
    return 1.01 * farthest


def _mark_size(thing: Thing) -> tuple[float, float]:
    """Return the size of points and the width of lines, of which a thing has one."""
    points, width = thing.size
    return (points, 0.0) if thing.arrays.kind == "points" else (1.0, width)


def _line_width(width: float, projection: NDArray[np.float64]) -> float:
    """Return pixels: Open3D's shader makes wide lines wider in narrower views."""
    return min(max(width * 0.5 * float(projection[1, 1]), 1.0), MAX_LINE)


def _scene(
    source: Open3DScene, shown: list[Thing], *, is_lit: bool
) -> tuple[Scene, dict[int, Thing]]:
    """Return the engine's scene, and the things by their numbers."""
    low = source.scene
    scene = Scene(background=None, ambient=(0, 0, 0))
    things: dict[int, Thing] = {}
    for thing in shown:
        if thing.record.shader == "normals":
            thing.mesh.colors = normal_colors(thing)
        node = scene.add(
            thing.mesh,
            pose=thing.pose,
            cast_shadows=thing.casts_shadows,
            receive_shadows=thing.receives_shadows,
        )
        things[node.id] = thing
    if is_lit:
        _light(scene, source)
        if low.shows_skybox and low.skybox_path is not None:
            scene.background = environment_of_ktx(low.skybox_path)
    return scene, things


def _light(scene: Scene, source: Open3DScene) -> None:
    low = source.scene
    has_shadows = source.view.has_shadows
    if low.has_indirect_light and low.environment_path is not None:
        scene.environment = environment_of_ktx(low.environment_path)
        scene.environment_intensity = low.indirect_intensity * _EXPOSURE
    if low.has_sun:
        _add_lamp(scene, low.sun, casts_shadows=has_shadows)
    for lamp in low.lamps.values():
        _add_lamp(scene, lamp, casts_shadows=has_shadows and lamp.casts_shadows)
    if not scene.data.placed_lights():  # or the engine would add a headlight
        scene.add(DirectionalLight(intensity=0.0))


def _add_lamp(scene: Scene, lamp: Lamp, *, casts_shadows: bool) -> None:
    """Add a light: Filament's lumens are candelas times 4 pi, those of spots times pi."""
    strength = max(lamp.intensity, 0.0) * _EXPOSURE * _DIFFUSE
    color = linear(*(max(part, 0.0) for part in lamp.color))
    shadow: dict[str, Any] = {"shadow": "map" if casts_shadows else "none"}
    if lamp.kind in ("sun", "directional"):
        if any(lamp.direction):
            scene.add(DirectionalLight(lamp.direction, color, strength, **shadow))
        return
    reach = {"range": lamp.falloff, "falloff": "gltf"} if lamp.falloff > 0 else {}
    if lamp.kind == "point":
        candela = strength / (4.0 * math.pi)
        scene.add(PointLight(color, candela, **reach, **shadow), translation=lamp.position)
        return
    inner, outer = (min(max(angle, 0.0), 1.57) for angle in lamp.cone)
    reach.pop("falloff", None)  # spots have but one
    light = SpotLight(
        color,
        strength / math.pi,
        inner_cone_angle=min(inner, outer),
        outer_cone_angle=max(outer, 1e-3),
        **reach,
        **shadow,
    )
    scene.add(light, pose=_aimed(lamp))


def _aimed(lamp: Lamp) -> NDArray[np.float64]:
    place = np.array(lamp.position)
    towards = np.array(lamp.direction) if any(lamp.direction) else np.array([0.0, 0.0, -1.0])
    up = (0.0, 1.0, 0.0) if abs(towards[1]) < 0.9 * np.sqrt((towards**2).sum()) else (1.0, 0.0, 0.0)
    return linalg.look_at(place, place + towards, up)


def _background(scene: Open3DScene, size: tuple[int, int]) -> NDArray[np.float64]:
    """Return the light of the background, (H, W, 3): its colour, and its image in the middle."""
    color = np.clip(scene.background_color[:3].astype(np.float64), 0.0, 1.0)
    light = np.broadcast_to(linear_color(tuple(color.tolist())), (size[1], size[0], 3)).copy()
    image = scene.background_image
    if image is None:
        return light
    aspect, own = size[0] / size[1], image.shape[1] / image.shape[0]
    x = (np.arange(size[0]) + 0.5) / size[0] - 0.5
    y = (np.arange(size[1]) + 0.5) / size[1] - 0.5
    x, y = (x * aspect / own, y) if own < aspect else (x, y * own / aspect)
    rows, columns = (np.flatnonzero(abs(line) <= 0.5) for line in (y, x))
    picture = image[..., :3] if image.shape[2] >= 3 else np.repeat(image[..., :1], 3, axis=2)
    light[np.ix_(rows, columns)] = _stretched(
        srgb_to_linear_table()[picture].astype(np.float64), y[rows] + 0.5, x[columns] + 0.5
    )
    return light


def _stretched(image: NDArray[np.float64], v, u) -> NDArray[np.float64]:
    """Return an image at the places (v, u), from 0 to 1, bilinearly."""
    for axis, places in enumerate((v, u)):
        at = np.clip(places * image.shape[axis] - 0.5, 0.0, image.shape[axis] - 1.0)
        low = at.astype(np.intp)
        high = np.minimum(low + 1, image.shape[axis] - 1)
        share = (at - low).reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
        image = image.take(low, axis) * (1.0 - share) + image.take(high, axis) * share
    return image


def _shown(light: NDArray[np.float64], *, is_mapped: bool) -> NDArray[np.uint8]:
    """Return light as bytes: each colour that occurs is mapped once."""
    if not is_mapped:
        return (np.clip(light, 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)
    flat = light.reshape(-1, 3)
    first = flat[:1]
    differs = np.flatnonzero((flat != first).any(axis=1))
    shown = np.empty((len(flat), 3), np.uint8)
    shown[:] = srgb_bytes(tone_mapped(first))
    shown[differs] = srgb_bytes(tone_mapped(flat[differs]))
    return shown.reshape(light.shape)
