"""From a scene to what the core draws: draws, materials and lights, renewed where they changed.

In: a `Scene` and what the picture needs of its meshes. Out: a `NativeDrawList` that is up to date.
Between frames it keeps the list and the versions it was made from, so that a frame in which nothing
or only poses changed costs a comparison a node.
"""

from __future__ import annotations

import itertools
import math
import operator
import weakref

import numpy as np

from ._native.rasterizer import FALLOFFS, NativeDrawList
from .colors import linear_color
from .display_colors import shading_color
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

    Attributes
    ----------
    native : NativeDrawList
    changes : int
        Grows whenever `update` finds that something else is to be drawn, or elsewhere.
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
        self._lights_listed: list | None = None
        self.changes = 0

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
        if self._needs != needs or self._normals != normals or not self._lists(scene):
            self._rebuild(scene, needs, normals)
        elif self._pose_version != scene._pose_version:
            self._move(scene)
        self._list_lights(headlight)

    def shows(self, scene: Scene) -> bool:
        """Whether everything in the scene is still as and where it was at the last update."""
        return self._pose_version == scene._pose_version and self._lists(scene)

    def _lists(self, scene: Scene) -> bool:
        """Whether the list is that of the scene but for poses."""
        return (
            self._scene() is scene
            and self._structure_version == scene._structure_version
            and all(thing.version == version for thing, version in self._watched)
            and all(mesh.materials == materials for mesh, materials in self._material_lists)
        )

    def _rebuild(self, scene: Scene, needs: MeshNeeds, normals: str) -> None:
        self._scene = lambda: None  # if anything below raises, the list is not current
        self.changes += 1
        self.native.clear()
        self._draws, self._lights = [], []
        self._watched, self._material_lists = [], []
        self.has_lights, self._lights_listed = False, None
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
        self.changes += 1
        for index, (node, drawn) in enumerate(self._draws):
            if node._world_pose is not drawn:  # spares a thousand nodes a call each
                pose = node.world_pose
                self.native.set_pose(index, pose)
                self._draws[index] = (node, pose)
        self._pose_version = scene._pose_version

    def _list_lights(self, headlight) -> None:
        """List the lights anew unless all are the objects they were, at the poses they were."""
        if self.has_lights:
            marks = [(node.object, node.object.version, node.world_pose) for node in self._lights]
            marks = list(itertools.chain(*marks))
        else:
            marks = list(headlight or ())
        listed, self._lights_listed = self._lights_listed, None  # for if anything below raises
        if listed is None or len(listed) != len(marks) or not all(map(operator.is_, listed, marks)):
            self.native.clear_lights()
            for node in self._lights:
                self._add_light(node.object, node.world_pose)
            if headlight is not None and not self.has_lights:
                self.native.add_directional_light(*headlight)
        self._lights_listed = marks

    def _add_light(self, light, pose: np.ndarray) -> None:
        color = shading_color(light.color, self._color_space)
        color = [component * light.intensity for component in color]
        if isinstance(light, DirectionalLight):
            x, y, z = light.direction.tolist()
            towards = [-(a * x + b * y + c * z) for a, b, c, _ in pose[:3].tolist()]
            self.native.add_directional_light(color, normalize(towards).tolist())
        else:
            light.check()
            position = pose[:3, 3].tolist()
            self.native.add_point_light(color, position, light.range, FALLOFFS[light.falloff])


def _needs_of(mesh: Mesh, needs: MeshNeeds, normals: str) -> MeshNeeds:
    """Which arrays of this mesh are read, once its materials' flat shading is known."""
    smooth, flat = needs.vertex_normals, needs.face_normals
    if normals == "auto":
        flat = flat and any(material.flat_shading for material in mesh.materials)
        smooth = smooth and not all(material.flat_shading for material in mesh.materials)
    return MeshNeeds(smooth, flat, needs.edges)
