"""From a scene to what the core draws: draws, materials and lights, renewed where they changed.

In: a `Scene` and what the picture needs of its meshes. Out: a `NativeDrawList` that is up to date.
Between frames it keeps the objects' part of the list and the versions it was made from; nodes are
placed by C, from the scene's arrays. Python looks at the objects that changed, never at every node.
"""

from __future__ import annotations

import weakref

import numpy as np

from ._native.rasterizer import NativeDrawList
from .changes import Watch
from .display_colors import shading_color
from .instances import InstancedMesh
from .light_list import LightList
from .materials import Material
from .mesh import Mesh
from .native_handles import MeshNeeds, native_mesh, native_texture
from .scene import Scene
from .scene_arrays import NodeArrays

_MANY = 1024  # instances that are worth a tree of their boxes
_SETTLED = 3  # frames in which they did not change
_SMALLEST_SHININESS = 1e-3  # the core wants an exponent above 0; this one shows as 0 would


class DrawList:
    """The draw list of one renderer, for the scene that it drew last.

    Parameters
    ----------
    color_space : {"srgb", "linear"}
        How 8-bit colours of materials and lights are read.
    threads : int
        That cut meshes into clusters, and move nodes; 0: all.

    Attributes
    ----------
    native : NativeDrawList
    changes : int
        Grows whenever `update` finds that something else is to be drawn, or elsewhere.
    """

    def __init__(self, color_space: str, threads: int) -> None:
        self.native = NativeDrawList()
        self._color_space = color_space
        self._threads = threads
        self._scene = lambda: None
        self._objects_version = -1
        self._needs: MeshNeeds | None = None
        self._normals = ""
        self._watch = Watch()
        self._changed: list = []  # of what is watched, since the list was made
        self._materials: dict[Material, tuple[bool, list[tuple[int, int]]]] = {}
        self._material_lists: list[list[Material]] = []  # the meshes' own, and as they were:
        self._lists_then: list[list[Material]] = []
        self._marks = False
        self._many: list[tuple[int, InstancedMesh]] = []  # with their index in the native list
        self._trees, self._frames = False, 0
        self._placed: tuple | None = None
        self._frustum: np.ndarray | None = None
        self._how = 1.0, True
        self._selected: bytes | None = None
        self._lights = LightList(self.native, color_space)
        self.changes = 0

    def update(
        self,
        scene: Scene,
        needs: MeshNeeds,
        normals: str,
        headlight,
        frustum: np.ndarray | None,
        marks: float,
        batching: bool,
    ) -> None:
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
        frustum : (4, 4) float64 or None
            clip_from_world of a camera: nodes outside of what it shows are left out.
        marks : float
            How far lines and points may reach beyond where they are, as a share of half the image.
        batching : bool
            Nodes of one mesh are drawn as one.
        """
        scene._update(self._threads)
        if self._needs != needs or self._normals != normals or not self._lists(scene):
            self._renew(scene, needs, normals)
        if self._many and not self._trees:
            self._settle()
        widen = 1.0 + marks if self._marks or needs.edges else 1.0
        self._place(scene._arrays, frustum, widen, batching)
        self._lights.update(scene, headlight)

    def _settle(self) -> None:
        """Make trees of many instances, once these have stayed as they are for some frames."""
        self._frames += 1
        if self._frames == _SETTLED:
            for index, instances in self._many:
                self.native.set_instance_tree(index, instances._tree())
            self._trees = True
            self._placed = None

    def shows(self, scene: Scene) -> bool:
        """Whether everything in the scene is still as and where it was at the last update."""
        return self._placed == (scene._arrays, scene._arrays.changes) and self._lists(scene)

    def _lists(self, scene: Scene) -> bool:
        """Whether the objects are those of the scene, as they are now."""
        return self._has_objects_of(scene) and not self._changed

    def _has_objects_of(self, scene: Scene) -> bool:
        """Whether the objects are the scene's, and have the materials that they had."""
        self._changed += self._watch.changed()
        return (
            self._scene() is scene
            and self._objects_version == scene._objects.version
            and self._material_lists == self._lists_then
        )

    def _renew(self, scene: Scene, needs: MeshNeeds, normals: str) -> None:
        """Make the list of objects anew, or only those materials that changed."""
        same = self._needs == needs and self._normals == normals and self._has_objects_of(scene)
        if not same or not all(map(self._is_material, self._changed)):
            self._rebuild(scene, needs, normals)
            return
        for material in self._changed:
            for index, number in self._materials[material][1]:
                self._set_material(index, material, number)
        self._changed = []

    def _is_material(self, thing) -> bool:
        """Whether it is a material that asks for the same normals as before."""
        return isinstance(thing, Material) and self._materials[thing][0] == thing.flat_shading

    def _rebuild(self, scene: Scene, needs: MeshNeeds, normals: str) -> None:
        self._scene = lambda: None  # if anything below raises, the list is not current
        self._placed = None
        self.native.clear()
        self._lights.forget()
        self._watch, self._changed, self._materials = Watch(), [], {}
        self._material_lists, self._lists_then = [], []
        self._marks = self._trees = False
        self._many, self._frames = [], 0
        bases: dict[tuple[int, ...], int] = {}
        for obj in scene._objects.objects:
            if obj is None:
                self.native.add_object(None, 0)
            else:
                self._add_object(obj, bases, needs, normals)
        self._objects_version = scene._objects.version
        self._needs, self._normals = needs, normals
        self._scene = weakref.ref(scene)

    def _add_object(self, obj, bases: dict[tuple[int, ...], int], needs, normals: str) -> None:
        """Add a mesh, once or at many poses. `bases` knows where materials begin, by their ids."""
        mesh = obj.mesh if isinstance(obj, InstancedMesh) else obj
        self._watch_mesh(mesh)
        surfaces = tuple(map(id, mesh.materials))
        if surfaces not in bases:
            bases[surfaces] = self.native.material_count
            for number, material in enumerate(mesh.materials):
                self._materials.setdefault(material, (material.flat_shading, []))
                self._materials[material][1].append((self.native.material_count, number))
                self._set_material(self.native.material_count, material, number)
        native = native_mesh(mesh, _needs_of(mesh, needs, normals), self._threads)
        index = self.native.add_object(native, bases[surfaces])
        if obj is not mesh:
            self._watch.add(obj)
            if len(obj) >= _MANY:
                self._many.append((index, obj))
            colors = obj.colors
            eight_bit = colors is not None and colors.dtype == np.uint8
            self.native.set_instances(
                index,
                obj._flat_poses(),
                colors if eight_bit else None,
                None if eight_bit else colors,
                obj._ids,
            )

    def _place(
        self, arrays: NodeArrays, frustum: np.ndarray | None, widen: float, batching: bool
    ) -> None:
        """List the draws of what may show, where it is now."""
        placed = arrays, arrays.changes
        moved = self._placed != placed
        how = widen, batching
        if not moved and self._frustum is frustum and self._how == how:
            return
        self._placed = None  # for if anything below raises
        selection = None
        if frustum is not None:
            selection = np.empty((arrays.count + 63) // 64, np.uint64)
            arrays.select(frustum, widen, selection)
        selected = None if selection is None else selection.tobytes()
        same = selected is not None and selected == self._selected and batching == self._how[1]
        if moved or self._trees or not same:
            columns = arrays.columns
            self.native.place(
                arrays.count,
                columns["flags"],
                columns["object"],
                columns["object_id"],
                columns["world"],
                selection,
                frustum,
                widen,
                batching,
                moved,
            )
        self.changes += moved
        self._placed, self._selected = placed, selected
        self._frustum, self._how = frustum, how

    def _watch_mesh(self, mesh: Mesh) -> None:
        """Remember what would make a mesh, or its list of materials, out of date."""
        self._marks = self._marks or len(mesh.lines) > 0 or len(mesh.points) > 0
        self._watch.add(mesh)
        self._material_lists.append(mesh.materials)
        self._lists_then.append(list(mesh.materials))

    def _set_material(self, index: int, material: Material, number: int) -> None:
        self._watch.add(material)
        texture = material.texture
        if texture is not None:
            self._watch.add(texture)
            texture = native_texture(texture, self._color_space)
        self.native.set_material(
            index,
            shading_color(material.color, self._color_space),
            shading_color(material.specular, self._color_space),
            max(material.shininess, _SMALLEST_SHININESS),
            shading_color(material.emissive, self._color_space),
            texture,
            number,
            material.two_sided,
            material.flat_shading,
        )


def _needs_of(mesh: Mesh, needs: MeshNeeds, normals: str) -> MeshNeeds:
    """Which arrays of this mesh are read, once its materials' flat shading is known."""
    smooth, flat = needs.vertex_normals, needs.face_normals
    if normals == "auto":
        flat = flat and any(material.flat_shading for material in mesh.materials)
        smooth = smooth and not all(material.flat_shading for material in mesh.materials)
    return MeshNeeds(smooth, flat, needs.edges)
