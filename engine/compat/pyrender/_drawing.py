"""Drawing of scenes: what to draw, in which order, with calls of the core.

In: a scene, flags and a size. Out: colours and depths. The engine's renderer determines the
visibility of opaque triangles; blended triangles, lines and points are drawn one by one, in
pyrender's order: nodes from far to near, opaque ones first.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence

import numpy as np

from ..._native import pyrender as _native
from ...rendering.renderer import Renderer as Engine
from ._lighting import Lighting, ShadowMaps
from ._shapes import is_triangles, shape_of, texture_of
from ._visibility import Placed, Visibility
from .camera import OrthographicCamera
from .constants import RenderFlags
from .material import Material, MetallicRoughnessMaterial
from .node import Node
from .primitive import Primitive
from .scene import Scene
from .settings import settings

_TINY = 2.0**-18  # near planes below it need a larger w (R143 in docs/exactness)
_FAR = 1e6  # a far plane this many times farther than the near plane counts as infinite
_PLAIN = ((1.0, 1.0, 1.0, 1.0), 1.0, 1.0, (0.0, 0.0, 0.0), (None,) * 5)
_BLACK = ((0.0, 0.0, 0.0, 1.0), 1.0, 1.0, (0.0, 0.0, 0.0), (None,) * 5)


class Drawing:
    """Draws pictures of scenes, and caches data for the next picture.

    Several may draw at once, in threads; each draws one picture after the other.
    """

    def __init__(self) -> None:
        self._engine: Engine | None = None
        self._picture = _native.NativePicture()
        self._visible: list[Visibility] = []
        self._shadows = ShadowMaps()
        self._lock = threading.Lock()

    def draw(
        self, scene: Scene, flags: int, seg_node_map, width: int, height: int, point_size: float
    ) -> tuple[np.ndarray | None, np.ndarray]:
        """Return colours, (H, W, 3 or 4) uint8, None for depths alone, and depths, (H, W) float32.

        Raises
        ------
        ValueError
            The scene has no camera.
        NotImplementedError
            Shadows of point lights.
        """
        with self._lock:
            try:
                return _Pass(self, scene, flags, seg_node_map).draw(width, height, point_size)
            finally:
                self._picture.clear()

    def _engine_of(self, width: int, height: int) -> Engine:
        if self._engine is None:
            self._engine = Engine((width, height))
        elif self._engine.size != (width, height):
            self._engine.resize((width, height))
        return self._engine


class _Pass:
    """One picture in progress."""

    def __init__(self, drawing: Drawing, scene: Scene, flags: int, seg_node_map) -> None:
        if scene.main_camera_node is None:
            raise ValueError("Cannot render scene without a camera")
        if flags & RenderFlags.SHADOWS_POINT and scene.point_light_nodes:
            raise NotImplementedError("Point light shadows not implemented")
        self._drawing, self._scene, self._flags = drawing, scene, flags
        self._picture = drawing._picture
        self._picture.clear()
        self._seg_node_map = (seg_node_map or {}) if flags & RenderFlags.SEG else None
        self._camera = scene.main_camera_node.camera
        self._pose = scene.get_pose(scene.main_camera_node)
        self._shading = _shading_of(flags)
        self._looks: dict[int, tuple] = {}
        self._draws = 0

    def draw(self, width: int, height: int, point_size: float):
        """Draw the picture; see `Drawing.draw`."""
        projection = np.asarray(
            self._camera.get_projection_matrix(width=width, height=height), np.float64
        )
        view = np.linalg.inv(self._pose)
        self._engine = self._drawing._engine_of(width, height)
        samples, depth_place = self._samples()
        places = range(_native.PLACES) if samples > 1 else (depth_place,)
        self._steps(_for_engine(projection), self._is_mirrored(self._pose), places)
        depth = np.empty((height, width), np.float32)
        color = None
        if self._shading != _native.DEPTH:
            channels = 4 if self._flags & RenderFlags.RGBA else 3
            color = np.empty((height, width, channels), np.uint8)
        near, far, straight = self._depth_range()
        self._picture.render(
            *(samples, self._shading, np.ascontiguousarray(projection @ view)),
            *(self._pose[:3, 3], self._scene.ambient_light, self._background()),
            *(point_size, near, far, straight, depth_place, 0, color, depth),
        )
        return color, depth

    def _samples(self) -> tuple[int, int]:
        """Return the samples of a pixel, and the position where its depth is sampled."""
        moves = settings.samples > 1 and settings.depth_place == "pyrender"
        if self._shading == _native.PLAIN:
            return 1, _native.CENTRE
        samples = 1 if self._shading == _native.DEPTH else settings.samples
        return samples, 0 if moves else _native.CENTRE

    def _background(self):
        return (0.0, 0.0, 0.0, 1.0) if self._seg_node_map is not None else self._scene.bg_color

    def _depth_range(self) -> tuple[float, float, bool]:
        far = self._camera.zfar
        is_straight = (
            isinstance(self._camera, OrthographicCamera) and settings.orthographic_depth == "metric"
        )
        return self._camera.znear, np.inf if far is None else far, is_straight

    @staticmethod
    def _is_mirrored(pose: np.ndarray) -> bool:
        return bool(np.linalg.det(pose[:3, :3]) < 0)

    # ---- steps ----

    def _nodes(self) -> list[tuple[Node, np.ndarray, bool]]:
        """Return the visible nodes in drawing order, with poses, and which are mirrored."""
        scene, listed = self._scene, self._seg_node_map
        nodes = [
            node
            for node in scene._in_order(scene.mesh_nodes)
            if node.mesh.is_visible and (listed is None or node in listed)
        ]
        if not nodes:
            return []
        poses = np.array([scene.get_pose(node) for node in nodes])
        away = poses[:, :3, 3] - self._pose[:3, 3]
        transparent = [node.mesh.is_transparent for node in nodes]
        order = np.lexsort((-(away * away).sum(axis=1), transparent)).tolist()
        mirrored = (np.linalg.det(poses[:, :3, :3]) < 0).tolist()
        return [(nodes[k], poses[k], mirrored[k]) for k in order]

    def _steps(self, projection: np.ndarray, mirrored: bool, places: Sequence[int]) -> None:
        """Add lights, draws and steps to the picture."""
        lights = None
        if self._shading == _native.LIT:
            shadows = self._drawing._shadows
            lights = Lighting(self._picture, self._scene, self._flags, shadows)
        groups: list[_Group] = [_Group()]
        for node, pose, turned in self._nodes():
            listed = (0, 0) if lights is None else lights.of(pose[:3, 3])
            for number, primitive in enumerate(node.mesh.primitives):
                self._list(groups, node, pose, number, primitive, mirrored != turned, listed)
        for number, group in enumerate(groups):
            if group.visible:
                self._see(number, group.visible, projection, places)
            for first, count in group.drawn:
                self._picture.add_drawn(first, count)

    def _see(self, number: int, visible: list[Placed], projection, places) -> None:
        kept = self._drawing._visible
        while len(kept) <= number:
            kept.append(Visibility())
        draw_of_object = kept[number].place(visible)
        shown = kept[number].find(self._engine, projection, self._pose, places)
        self._picture.add_visible(shown, draw_of_object)

    def _list(self, groups, node, pose, number, primitive, turned, lights) -> None:
        """Add a primitive: to the visibility pass, or to the draws done one by one."""
        if not len(primitive.positions):
            return
        material = primitive.material
        uses_material = self._shading in (_native.LIT, _native.FLAT)
        wire = uses_material and _shows_edges(material, self._flags)
        sides = uses_material and bool(
            material.doubleSided or self._flags & RenderFlags.SKIP_CULL_FACES
        )
        blends = uses_material and _may_blend(primitive)
        first, count = self._add(node, pose, primitive, not sides, wire, blends, lights)
        if not is_triangles(primitive) or wire or blends:
            groups[-1].drawn.append((first, count))
            groups[-1].blends |= blends
            return
        if groups[-1].blends:  # it must not be drawn below earlier blended ones
            groups.append(_Group())
        if primitive.poses is not None and len(primitive.poses):
            turned ^= self._is_mirrored(primitive.poses[0])
        key = (node, number)
        groups[-1].visible.append(Placed(key, primitive, pose, sides, turned, first))

    def _add(self, node, pose, primitive, culls, wire, blends, lights) -> tuple[int, int]:
        """Add the draws of a primitive's instances; return the first and their number."""
        shape, look = shape_of(primitive), self._look(node, primitive.material)
        poses = [pose] if primitive.poses is None else pose @ primitive.poses.astype(np.float64)
        first = self._draws
        for one in poses:
            self._picture.add_draw(
                shape, np.ascontiguousarray(one, np.float64), culls, wire, blends, *look, *lights
            )
        self._draws += len(poses)
        return first, len(poses)

    def _look(self, node: Node, material: Material) -> tuple:
        """Return colour, metallic, roughness, emission and textures."""
        if self._shading == _native.DEPTH:
            return _PLAIN
        if self._seg_node_map is not None:
            value = self._seg_node_map[node]
            color = value if isinstance(value, list | tuple | np.ndarray) else (value,) * 3
            return ((*(np.asarray(color, np.float64)[:3] / 255.0), 1.0), *_PLAIN[1:])
        key = id(material)
        if key not in self._looks:
            self._looks[key] = _look_of(material)
        return self._looks[key]


class _Group:
    """A group of drawing steps: visible triangles, then the draws over them."""

    def __init__(self) -> None:
        self.visible: list[Placed] = []
        self.drawn: list[tuple[int, int]] = []
        self.blends = False


def _shading_of(flags: int) -> int:
    if flags & RenderFlags.DEPTH_ONLY:
        return _native.DEPTH
    if flags & RenderFlags.SEG:
        return _native.PLAIN
    return _native.FLAT if flags & RenderFlags.FLAT else _native.LIT


def _shows_edges(material: Material, flags: int) -> bool:
    flipped = bool(flags & RenderFlags.FLIP_WIREFRAME)
    return bool(flags & RenderFlags.ALL_WIREFRAME) or material.wireframe != flipped


def _look_of(material: Material) -> tuple:
    if not isinstance(material, MetallicRoughnessMaterial):
        return _BLACK
    textures = (
        *(material.baseColorTexture, material.metallicRoughnessTexture, material.normalTexture),
        *(material.occlusionTexture, material.emissiveTexture),
    )
    return (
        material.baseColorFactor,
        material.metallicFactor,
        material.roughnessFactor,
        material.emissiveFactor,
        tuple(texture_of(texture) for texture in textures),
    )


def _may_blend(primitive: Primitive) -> bool:
    """Return whether any part of a primitive may be transparent."""
    material = primitive.material
    if material.alphaMode != "BLEND":
        return False
    if primitive._has_alpha or material._factor[3] < 1.0:
        return True
    texture = getattr(material, "baseColorTexture", None)
    source = None if texture is None else texture.source
    if source is None or primitive.texcoord_0 is None or source.ndim < 3 or source.shape[2] < 4:
        return False
    return texture._has_alpha()


def _for_engine(projection: np.ndarray) -> np.ndarray:
    """Return the projection with depths that float32 can distinguish, for a distant far plane."""
    matrix = projection.copy()
    is_perspective = np.array_equal(matrix[3], (0.0, 0.0, -1.0, 0.0)) and not matrix[2, :2].any()
    if not is_perspective:
        return matrix
    near = matrix[2, 3] / (matrix[2, 2] - 1.0)
    if near > 0 and abs(matrix[2, 2] + 1.0) < 1.0 / _FAR:  # R142: -1 at the near plane, 0 far away
        matrix[2] = 0.0, 0.0, 0.0, -near
    if 0 < near < _TINY:
        matrix *= 2.0 ** min(-np.frexp(near)[1], 100)
    return matrix
