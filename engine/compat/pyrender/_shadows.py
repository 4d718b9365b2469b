"""Shadow maps."""

from __future__ import annotations

import numpy as np

from ...rendering.renderer import Renderer as Engine
from ._shapes import is_triangles
from ._visibility import Placed, Visibility
from .constants import SHADOW_TEX_SZ
from .light import DirectionalLight
from .node import Node
from .scene import Scene


class ShadowMaps:
    """Draws the shadow maps of lights."""

    def __init__(self) -> None:
        self._engine: Engine | None = None
        self._casters = Visibility()

    def map_of(self, scene: Scene, light_node: Node) -> tuple[np.ndarray, np.ndarray]:
        """Return the shadow map of a light.

        Parameters
        ----------
        scene : Scene
        light_node : Node
            With a directional light or a spotlight.

        Returns
        -------
        depths : (N, N) float32
            z_ndc, infinite where nothing is.
        clip_from_world : (4, 4) float64
        """
        if self._engine is None:
            self._engine = Engine(SHADOW_TEX_SZ, SHADOW_TEX_SZ)
        pose, scale = scene.get_pose(light_node), scene.scale
        projection = light_node.light._get_shadow_camera(scale).get_projection_matrix()
        if isinstance(light_node.light, DirectionalLight):
            pose[:3, 3] = scene.centroid + pose[:3, 2] * scale
        self._casters.place(_casters(scene, pose))
        depths = self._casters.depths(self._engine, projection, pose)
        return depths, np.ascontiguousarray(projection @ np.linalg.inv(pose))


def _casters(scene: Scene, light_pose: np.ndarray) -> list[Placed]:
    """Return the front-facing triangles of all visible meshes."""
    mirrored = np.linalg.det(light_pose[:3, :3]) < 0
    casters = []
    for node in scene._in_order(scene.mesh_nodes):
        if not node.mesh.is_visible:
            continue
        pose = scene.get_pose(node)
        turned = bool(mirrored != (np.linalg.det(pose[:3, :3]) < 0))
        for number, primitive in enumerate(node.mesh.primitives):
            if is_triangles(primitive) and len(primitive.positions):
                casters.append(Placed((node, number), primitive, pose, False, turned, 0))
    return casters
