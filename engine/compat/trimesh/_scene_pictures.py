"""The picture of a trimesh scene.

In: a ``trimesh.Scene``, which trimesh's graph walks node by node, and `Settings`. Out: pixels.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from ...base.linalg import inverse, perspective
from ...errors import InvalidArgumentError, warn
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...rendering.options import MAX_LINE
from ...rendering.renderer import Renderer
from ._settings import Settings
from ._vertex_light import Lamp, lamps_of, lit
from ._viewer_shapes import Shape, shape_of

_SAMPLES = 4
_LEAST = 1.0  # pixels: OpenGL draws no thinner lines


def draw(scene: Any, settings: Settings) -> NDArray[np.uint8]:
    """Return the picture, (H, W, 4) uint8."""
    eye_from_world = _eye_from_world(scene)
    lamps = lamps_of(scene)
    drawn = Scene(background=None, ambient=(0, 0, 0))
    for shape, pose in _shapes(scene, settings, eye_from_world):
        _add(drawn, shape, np.asarray(eye_from_world) @ pose, lamps, settings)
    width, height = settings.size
    camera = scene.camera
    projection = perspective(
        math.radians(float(camera.fov[1])),
        width / height,
        float(camera.z_near),
        float(camera.z_far),
    )
    renderer = Renderer(settings.size, color_space="linear", samples=_SAMPLES, antialiasing="msaa")
    frame = renderer.render(
        drawn,
        (Camera(projection), np.eye(4)),
        cull="back" if settings.flags["cull"] else "none",
        line_width=min(max(settings.line_width, _LEAST), MAX_LINE),
        point_size=min(max(settings.point_size, _LEAST), MAX_LINE),
        line_shape="round",
    )
    return _over(frame.color, background_of(settings.background))


def _eye_from_world(scene: Any) -> NDArray[np.float64]:
    place = np.asarray(scene.camera_transform, np.float64)
    if np.isfinite(place).all():
        return np.asarray(inverse(place))
    if all(
        shape.is_empty for shape in scene.geometry.values()
    ):  # trimesh finds no place for the camera
        return np.eye(4)
    broken = [name for name, shape in scene.geometry.items() if not _is_finite(shape)]
    cause = f": geometry {broken[0]!r} has points that are not finite" if broken else ""
    raise InvalidArgumentError(f"the scene's camera_transform is not finite{cause}")


def _is_finite(shape: Any) -> bool:
    return bool(np.isfinite(np.asarray(getattr(shape, "vertices", 0.0), np.float64)).all())


def _shapes(
    scene: Any, settings: Settings, eye_from_world: Any
) -> Iterator[tuple[Shape, NDArray[np.float64]]]:
    """Yield shapes with their poses in the world."""
    known: dict[str, Shape | None] = {}
    axis = settings.flags["axis"]
    marker = _axis(scene) if axis else None
    if marker is not None and axis != "without_world":
        yield marker, np.eye(4)
    if settings.flags["grid"] and (grid := _grid(scene)) is not None:
        yield grid, np.eye(4)
    for node in scene.graph.nodes_geometry:
        if node in settings.hidden:
            continue
        pose, name = scene.graph.get(node)
        geometry = scene.geometry.get(name)
        if geometry is None or geometry.is_empty:
            continue
        if name not in known:
            known[name] = shape_of(geometry, settings.is_smooth)
        pose = np.asarray(pose, np.float64)
        if name in settings.fixed:
            moved = np.asarray(settings.first_transform) @ np.asarray(eye_from_world)
            pose = pose @ np.asarray(inverse(moved))
        shape = known[name]
        if shape is not None:
            yield shape, pose
        is_moved = not np.allclose(pose, np.eye(4), atol=1e-5)
        if marker is not None and (axis == "all" or (axis == "without_world" and is_moved)):
            yield marker, pose


def _add(
    scene: Scene,
    shape: Shape,
    eye_from_shape: NDArray[np.float64],
    lamps: list[Lamp],
    settings: Settings,
) -> None:
    turn = eye_from_shape[:3, :3]
    # As OpenGL: by the inverse's transpose. Lines and points have the normal that nobody set.
    normals = shape.normals
    if normals is None:
        normals = np.broadcast_to((0.0, 0.0, 1.0), shape.positions.shape)
    try:
        towards = np.linalg.inv(turn)
    except np.linalg.LinAlgError:
        towards = turn.T
    colors = lit(shape.colors, normals @ towards, lamps)
    places = shape.positions @ turn.T + eye_from_shape[:3, 3]
    lines, faces = shape.lines, shape.faces
    if lines is not None:
        places = places + (0.0, 0.0, settings.lift)
    if faces is not None and settings.flags["wireframe"]:
        lines, faces = _edges(places, faces, settings.flags["cull"]), None
    is_clear = bool((colors[:, 3] != 255).any())
    if shape.texture is not None:
        is_clear = is_clear or bool((shape.texture.pixels[..., 3] != 255).any())
    mesh = Mesh(
        places,
        faces,
        lines=lines,
        points=shape.points,
        colors=colors,
        uvs=shape.uvs,
        materials=[
            Material(
                unlit=True, texture=shape.texture, alpha_mode="blend" if is_clear else "opaque"
            )
        ],
    )
    scene.add(mesh)


def _edges(places: NDArray[np.float64], faces: NDArray[np.int32], culls: bool) -> NDArray[np.int32]:
    """Return the edges of faces, of those that face the camera if others are culled."""
    if culls:
        a, b, c = (places[faces[:, k]] for k in range(3))
        faces = faces[(np.cross(b - a, c - a) * a).sum(1) < 0.0]
    pairs = np.stack([faces, np.roll(faces, -1, axis=1)], -1).reshape(-1, 2)
    return np.unique(np.sort(pairs, axis=1), axis=0).astype(np.int32)


def _axis(scene: Any) -> Shape | None:
    return shape_of(trimesh.creation.axis(origin_size=scene.scale / 100), is_smooth=False)


def _grid(scene: Any) -> Shape | None:
    """Return a grid below a scene, as trimesh makes it; None where a package for it is missing."""
    bounds = scene.bounds
    if bounds is None:
        return None
    center = bounds.mean(axis=0)
    center[2] = bounds[0][2] - np.ptp(bounds[:, 2]) / 100
    side = np.ptp(bounds, axis=0)[:2].max()
    try:
        from trimesh.path.creation import grid

        place = trimesh.transformations.translation_matrix(center)
        return shape_of(grid(side=side, count=4, transform=place), is_smooth=False)
    except ImportError as error:
        warn(f"the grid is not drawn: trimesh needs a package for it ({error})")
        return None


def background_of(given: Any) -> NDArray[np.uint8]:
    """Return the RGBA bytes of a background, (4,); white for None."""
    if given is None:
        return np.full(4, 255, np.uint8)
    try:
        return np.asarray(trimesh.visual.to_rgba(given), np.uint8).reshape(4)
    except (ValueError, TypeError):
        raise InvalidArgumentError(f"background must be a colour, not {given!r}") from None


def _over(rgba: NDArray[np.uint8], background: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return pixels over a background, which may be clear itself."""
    cover = rgba[..., 3:] / 255.0
    below = background[3] / 255.0 * (1.0 - cover)
    alpha = cover + below
    color = rgba[..., :3] * cover + background[:3] * below
    out = np.empty_like(rgba)
    out[..., :3] = np.clip(color / np.maximum(alpha, 1e-9) + 0.5, 0, 255).astype(np.uint8)
    out[..., 3] = np.clip(255.0 * alpha[..., 0] + 0.5, 0, 255).astype(np.uint8)
    return out
