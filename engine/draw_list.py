"""From a scene to what the core draws: draws, materials and lights, renewed where they changed.

In: a `Scene` and what the picture needs of its meshes. Out: a `NativeDrawList` that is up to date.
Between frames it keeps the list and the versions it was made from, so that a frame in which nothing
or only poses changed costs a comparison a node.
"""

from __future__ import annotations

import math
import weakref

import numpy as np

from ._native.rasterizer import FALLOFFS, NativeDrawList
from .colors import linear_color
from .instances import InstancedMesh
from .lights import DirectionalLight, PointLight
from .linalg import normalize
from .materials import Material
from .mesh import Mesh
from .native_handles import MeshNeeds, native_mesh, native_texture
from .scene import Node, Scene

_SMALLEST_SHININESS = 1e-3  # the core wants an exponent above 0; this one shows as 0 would


class DrawList:
    """The draw list of one renderer, for the scene that it drew last.

    Parameters
    ----------
    color_space : {"srgb", "linear"}
        How 8-bit colours of materials and lights are read.
    """

    def __init__(self, color_space: str) -> None:
        self.native = NativeDrawList()
        self._color_space = color_space
        self._scene = lambda: None
        self._structure_version = self._pose_version = -1
        self._needs: MeshNeeds | None = None
        self._normals = ""
        self._draws: list[tuple[Node, np.ndarray]] = []
        self._lights: list[Node] = []
        self._watched: list[tuple[object, int]] = []
        self._material_lists: list[tuple[Mesh, list[Material]]] = []
        self.has_lights = False

    def update(self, scene: Scene, needs: MeshNeeds, normals: str, headlight) -> None:
        """Make the native list draw ``scene``.

        Parameters
        ----------
        scene : Scene
        needs : MeshNeeds
            Which derived arrays the picture reads; which of the two kinds of normals a mesh needs
            is decided for each mesh.
        normals : {"auto", "smooth", "flat"}
        headlight : tuple of two vectors, or None
            Colour and direction towards the light, for a scene that has no light.
        """
        if not self._is_current(scene, needs, normals):
            self._rebuild(scene, needs, normals)
        elif self._pose_version != scene._pose_version:
            self._move(scene)
        self._set_lights(headlight)

    def _is_current(self, scene: Scene, needs: MeshNeeds, normals: str) -> bool:
        return (
            self._scene() is scene
            and self._structure_version == scene._structure_version
            and self._needs == needs
            and self._normals == normals
            and all(thing.version == version for thing, version in self._watched)
            and all(mesh.materials == materials for mesh, materials in self._material_lists)
        )

    def _rebuild(self, scene: Scene, needs: MeshNeeds, normals: str) -> None:
        self._scene = lambda: None  # if anything below raises, the list is not current
        self.native.clear()
        self._draws, self._lights = [], []
        self._watched, self._material_lists = [], []
        self.has_lights = False
        bases: dict[Mesh, int] = {}
        for node in scene.nodes:
            obj = node.object
            if isinstance(obj, (DirectionalLight, PointLight)):
                self.has_lights = True
                if node.shown:
                    self._lights.append(node)
            elif isinstance(obj, (Mesh, InstancedMesh)) and node.shown:
                self._add_draw(node, bases, needs, normals)
        self._structure_version = scene._structure_version
        self._pose_version = scene._pose_version
        self._needs, self._normals = needs, normals
        self._scene = weakref.ref(scene)

    def _add_draw(self, node: Node, bases: dict[Mesh, int], needs, normals: str) -> None:
        obj = node.object
        mesh = obj.mesh if isinstance(obj, InstancedMesh) else obj
        if mesh not in bases:
            bases[mesh] = self.native.material_count
            self._watch_mesh(mesh)
        native = native_mesh(mesh, _needs_of(mesh, needs, normals))
        pose = node.world_pose
        index = self.native.add_draw(native, pose, node.id, bases[mesh])
        self._draws.append((node, pose))
        if obj is not mesh:
            self._watched.append((obj, obj.version))
            colors = obj.colors
            eight_bit = colors is not None and colors.dtype == np.uint8
            self.native.set_instances(
                index,
                obj.poses.reshape(len(obj.poses), math.prod(obj.poses.shape[1:])),
                colors if eight_bit else None,
                None if eight_bit else colors,
            )

    def _watch_mesh(self, mesh: Mesh) -> None:
        """Add the materials of a mesh, and remember what would make them out of date."""
        self._watched.append((mesh, mesh.version))
        self._material_lists.append((mesh, list(mesh.materials)))
        for number, material in enumerate(mesh.materials):
            self._watched.append((material, material.version))
            self._add_material(material, number)

    def _add_material(self, material: Material, number: int) -> None:
        texture = material.texture
        if texture is not None:
            self._watched.append((texture, texture.version))
            texture = native_texture(texture, self._color_space)
        self.native.add_material(
            linear_color(material.color, self._color_space),
            linear_color(material.specular, self._color_space),
            max(material.shininess, _SMALLEST_SHININESS),
            linear_color(material.emissive, self._color_space),
            texture,
            number,
            material.two_sided,
            material.flat_shading,
        )

    def _move(self, scene: Scene) -> None:
        """Renew the poses that changed: a node makes a new array for each pose."""
        for index, (node, drawn) in enumerate(self._draws):
            pose = node.world_pose
            if pose is not drawn:
                self.native.set_pose(index, pose)
                self._draws[index] = (node, pose)
        self._pose_version = scene._pose_version

    def _set_lights(self, headlight) -> None:
        self.native.clear_lights()
        if not self.has_lights:
            if headlight is not None:
                self.native.add_directional_light(*headlight)
            return
        for node in self._lights:
            self._add_light(node.object, node.world_pose)

    def _add_light(self, light, pose: np.ndarray) -> None:
        color = linear_color(light.color, self._color_space)
        color = [float(component) * light.intensity for component in color]
        if isinstance(light, DirectionalLight):
            x, y, z = light.direction
            towards = -(pose[:3, 0] * x + pose[:3, 1] * y + pose[:3, 2] * z)
            self.native.add_directional_light(color, normalize(towards))
        else:
            light.check()
            self.native.add_point_light(color, pose[:3, 3], light.range, FALLOFFS[light.falloff])


def _needs_of(mesh: Mesh, needs: MeshNeeds, normals: str) -> MeshNeeds:
    """Which arrays of this mesh are read, once its materials' flat shading is known."""
    smooth, flat = needs.vertex_normals, needs.face_normals
    if normals == "auto":
        flat = flat and any(material.flat_shading for material in mesh.materials)
        smooth = smooth and not all(material.flat_shading for material in mesh.materials)
    return MeshNeeds(smooth, flat, needs.edges)
