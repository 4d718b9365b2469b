"""Keeps the core's draw list of a scene up to date: draws, materials and lights.

In: a `Scene` and the mesh data that the picture needs. Out: an up-to-date `NativeDrawList`. Between
frames it keeps the listed objects and what they were made from; C places the nodes, from the arrays
of the scene. Python looks at the objects that came, went or changed (at all of them only if many
did), and never at every node.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from ..._native.rasterizer import NativeDrawList
from ...base.dirty_tracking import Watch
from ...choices import ColorSpace, Normals
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Finish, Material
from ...model.materials.textures import Reading
from ...model.motion.posed_mesh import PosedMesh
from ...model.scene.instances import InstancedMesh, flat_poses, shown_ids
from ...model.scene.staged_data import AnyData
from .._told import Told
from .._view import View
from .closed_meshes import Holes, holes_of
from .instance_trees import InstanceTrees
from .light_list import Headlight, LightList
from .material_list import MaterialList
from .native_handles import MeshNeeds, native_mesh
from .placement import Placement, Placing

if TYPE_CHECKING:
    from ...model.scene._posing import Posing
    from ...model.scene.shown import Drawn

#: The sources of a listed object: a mesh, and the instances that draw it.
Things: TypeAlias = tuple[()] | tuple[Mesh] | tuple[Mesh, InstancedMesh]


class Listing(NamedTuple):
    """How to list a picture's objects."""

    needs: MeshNeeds  # each mesh decides between its two kinds of normals
    normals: Normals
    by_mesh: bool  # materials of open meshes show both sides


class DrawList:
    """The draw list of one renderer, for the scene it drew last.

    Parameters
    ----------
    color_space : {"srgb", "linear"}
        How 8-bit colours of materials and lights are decoded.
    threads : int
        Threads that cut meshes into clusters and move nodes; 0: all.
    told : Told

    Attributes
    ----------
    native : NativeDrawList
    renewals : int
        Grows when objects, materials or deformed meshes change.
    lights : LightList
    """

    def __init__(self, color_space: ColorSpace, threads: int, told: Told) -> None:
        self.native = NativeDrawList()
        self._color_space, self._threads = color_space, threads
        self._data: Callable[[], AnyData | None] = lambda: None
        self._objects_version: Any = -1  # version of the objects, from either kind of scene
        self._listing = Listing(MeshNeeds(), "auto", by_mesh=False)
        # Of the scene: materials without textures, and how textures are read and materials drawn.
        self._dress: tuple[frozenset[Material], Reading | None, Finish | None]
        self._dress = frozenset(), None, None
        # The numbers of closed objects.
        self._closed: set[int] = set()
        self._with_holes: set[int] = set()  # the closed objects that have holes
        self._watch = Watch()
        self._changed: list[Any] = []  # watched things that changed since the list was made
        self._materials = MaterialList(self.native, color_space, self._watch, told)
        # The sources of each object, by number: things, and IDs of materials.
        self._listed: list[tuple[Things, tuple[int, ...]]] = []
        self._left = 0  # objects removed or given other materials since all were listed
        self._marks = False
        self._trees = InstanceTrees(self.native)
        self._placement = Placement(self.native)
        # The poses of the scene's meshes, and their moment.
        self._posed: tuple[Posing, int] | None = None
        self.lights = LightList(self.native, color_space)
        self.renewals = 0

    @property
    def changes(self) -> int:
        """Grows whenever `update` finds that a draw has changed or moved."""
        return self._placement.changes

    def update(
        self, data: AnyData, listing: Listing, headlight: Headlight | None, placing: Placing
    ) -> None:
        """Make the native list draw a scene in its current state.

        Parameters
        ----------
        data : AnyData
        listing : Listing
        headlight : tuple of two vectors, or None
            Colour times intensity, and direction towards the light, for scenes without lights.
        placing : Placing
        """
        data.update(self._threads)
        if self._listing != listing or not self._lists(data):
            self._renew(data, listing)
        self._follow_poses(data)
        if self._trees.settle():
            self._placement.forget()
        has_marks = self._marks or listing.needs.edges
        self._placement.place(data.arrays, placing, has_marks, self._trees.made)
        self.lights.update(data, headlight)

    def _follow_poses(self, data: AnyData) -> None:
        """Update meshes whose deformation changed."""
        posing = data.posing
        posed = None if posing is None else (posing, posing.moment)
        if posed != self._posed and posing is not None:
            self.native.set_meshes(posing.numbers, posing.poses)
            self._placement.forget()
            self.renewals += 1
        self._posed = posed

    def open_apertures(self, data: AnyData, view: View, size: tuple[int, int]) -> int | None:
        """Let backs show where the camera may look into holes of closed meshes.

        Elsewhere the backs of closed meshes may be culled, unless a material is double-sided.

        Parameters
        ----------
        data : AnyData
        view : View
        size : (int, int)
            Width and height of the picture in pixels.

        Returns
        -------
        count : int or None
            The number of apertures; None if backs may show anywhere, because the near plane may cut
            a closed mesh or no mesh is closed.
        """
        if not self._closed:
            return None
        arrays = data.arrays
        return self.native.open_apertures(
            arrays.rows, arrays.count, view.clip_from_world, view.view_from_world, *size
        )

    @property
    def has_holes(self) -> bool:
        """Whether a closed mesh has holes, which a light may look into."""
        return bool(self._with_holes)

    @property
    def has_mirrors(self) -> bool:
        """Whether a listed material mirrors."""
        return bool(self._materials.mirrors)

    def is_closed(self, number: int) -> bool:
        """Return whether the backs of an object may be culled."""
        return number in self._closed

    def shows(self, data: AnyData) -> bool:
        """Return whether nothing in the scene has changed or moved since the last update."""
        return self._placement.shows(data.arrays) and self._lists(data)

    def _lists(self, data: AnyData) -> bool:
        """Return whether the list has the scene's current objects."""
        self._changed += self._watch.changed()
        return (
            self._data() is data
            and self._objects_version == data.objects.version
            and not self._changed
        )

    def _renew(self, data: AnyData, listing: Listing) -> None:
        """Rebuild the list of objects, or only its changed parts."""
        self.renewals += 1
        self._changed += self._watch.changed()
        same = self._data() is data and self._listing == listing
        numbers = self._numbers_that_changed(data) if same else None
        self._data = lambda: None  # if anything below raises, the list is not current
        self._listing = listing
        self._dress = data.untextured, data.reading, data.finish
        self._dress_materials()
        if numbers is None:
            self._rebuild(data)
        else:
            self._replace(data, sorted(numbers))
        self._objects_version = data.objects.version
        self._data = weakref.ref(data)

    def _numbers_that_changed(self, data: AnyData) -> set[int] | None:
        """Return the numbers of changed objects; None if all must be listed anew."""
        objects = data.objects
        numbers = objects.renewed_since(self._objects_version)
        if numbers is None:
            return None
        for thing in self._changed:
            if isinstance(thing, (Mesh, InstancedMesh)):
                numbers |= objects.drawn_by(thing)
            elif isinstance(thing, Material) and self._materials.is_listed_otherwise(thing):
                numbers |= self._numbers_with(thing)
        # Materials that are no longer used are dropped when the list is rebuilt.
        few = 4 * (self._left + len(numbers)) <= len(objects.objects)
        return numbers if few or not numbers else None

    def _numbers_with(self, material: Material) -> set[int]:
        """Return the numbers of the objects that were listed with a material."""
        key = id(material)
        return {number for number, (_, surfaces) in enumerate(self._listed) if key in surfaces}

    def _replace(self, data: AnyData, numbers: list[int]) -> None:
        """Renew the changed materials, and the objects with given numbers."""
        self._materials.renew(self._changed)
        self._changed = []
        if numbers:
            self._placement.forget()
        for number in numbers:
            self._forget(data, number)
            self._set_object(number, data.objects.objects[number])

    def _rebuild(self, data: AnyData) -> None:
        self._placement.forget()
        self._closed, self._with_holes = set(), set()
        self.native.clear()
        self.lights.forget()
        self._watch, self._changed = Watch(), []
        self._materials = MaterialList(
            self.native, self._color_space, self._watch, self._materials.told
        )
        self._dress_materials()
        self._trees = InstanceTrees(self.native)
        self._listed, self._left, self._marks = [], 0, False
        self._make_textures(data)
        for number, obj in enumerate(data.objects.objects):
            self._set_object(number, obj)

    def _dress_materials(self) -> None:
        materials = self._materials
        materials.untextured, materials.reading, materials.finish = self._dress

    def _make_textures(self, data: AnyData) -> None:
        meshes = (_mesh_of(obj) for obj in data.objects.objects if obj is not None)
        materials = {material for mesh in meshes for material in mesh.materials}
        self._materials.make_textures(materials, self._threads)

    def _set_object(self, number: int, obj: Drawn | None) -> None:
        """List a mesh, once or at many poses, or nothing, under a number or the next one."""
        self._trees.note(number, obj)
        self._closed.discard(number)
        self._with_holes.discard(number)
        if obj is None:
            self.native.set_object(number, None, 0)
            self._note(number, (), ())
            return
        mesh = _mesh_of(obj)
        things: Things = (mesh, obj) if isinstance(obj, InstancedMesh) else (mesh,)
        for thing in things:
            self._watch.add(thing)  # before it is read
        holes = self._holes_of(obj)
        both = self._listing.by_mesh and holes is None
        if holes is not None:
            self._closed.add(number)
            if len(holes.ends):
                self._with_holes.add(number)
        tinted = mesh.colors is not None or getattr(obj, "colors", None) is not None
        tinted = tinted or not len(mesh.faces)
        base = self._materials.base_of(mesh.materials, both, tinted)
        needs = _needs_of(mesh, self._listing.needs, self._listing.normals)
        if isinstance(obj, PosedMesh):
            native = obj.handle(needs.face_normals, needs.edges, self._threads)
        else:
            native = native_mesh(mesh, needs, self._threads)
        closed = () if holes is None else (True, holes.ends, holes.points)
        self.native.set_object(number, native, base, *closed)
        self._marks = self._marks or len(mesh.lines) > 0 or len(mesh.points) > 0
        self._note(number, things, tuple(map(id, mesh.materials)))
        if isinstance(obj, InstancedMesh):
            self._set_instances(number, obj)

    def _holes_of(self, obj: Drawn) -> Holes | None:
        """Return the holes of an object that is closed except for them."""
        if not self._listing.by_mesh or isinstance(obj, PosedMesh):
            return None
        holes = holes_of(_mesh_of(obj))
        if holes is not None and len(holes.ends) and not isinstance(obj, Mesh):
            return None  # each instance would need a look
        return holes

    def _set_instances(self, number: int, obj: InstancedMesh) -> None:
        colors: Any = obj.colors  # of either type, as tested below
        eight_bit = colors is not None and colors.dtype == np.uint8
        self.native.set_instances(
            number,
            flat_poses(obj),
            colors if eight_bit else None,
            None if eight_bit else colors,
            shown_ids(obj),
        )

    def _note(self, number: int, things: Things, surfaces: tuple[int, ...]) -> None:
        """Watch everything that would make a listed object out of date."""
        if number == len(self._listed):
            self._listed.append(((), ()))
        self._left += self._listed[number][1] not in ((), surfaces)
        self._listed[number] = things, surfaces

    def _forget(self, data: AnyData, number: int) -> None:
        """Stop watching the sources of a number's object, unless another object uses them."""
        if number < len(self._listed):
            for thing in self._listed[number][0]:
                if not data.objects.drawn_by(thing):
                    self._watch.remove(thing)


def _mesh_of(obj: Drawn) -> Mesh:
    return obj if isinstance(obj, Mesh) else obj.mesh


def _needs_of(mesh: Mesh, needs: MeshNeeds, normals: Normals) -> MeshNeeds:
    """Return which arrays of a mesh are needed, given its materials' flat shading."""
    smooth, flat = needs.vertex_normals, needs.face_normals
    if normals == "auto":
        flat = flat and any(material.flat_shading for material in mesh.materials)
        smooth = smooth and not all(material.flat_shading for material in mesh.materials)
    return MeshNeeds(smooth, flat, needs.edges)
