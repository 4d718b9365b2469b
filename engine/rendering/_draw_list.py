"""From a scene to what the core draws: draws, materials and lights, renewed where they changed.

In: a `Scene` and what the picture needs of its meshes. Out: a `NativeDrawList` that is up to date.
Between frames it keeps the part of the list that tells of objects, and what that was made from;
nodes are placed by C, from the arrays of the scene. Python looks at the objects that came, went or
changed, at all of them only where many did, and never at every node.
"""

from __future__ import annotations

import weakref

import numpy as np

from .._native.rasterizer import NativeDrawList
from .._support.dirty_tracking import Watch
from ..geometry.mesh import Mesh
from ..materials.material import Material, placed_textures_of
from ..materials.textures import Texture
from ..motion.posed_mesh import PosedMesh
from ..scene.instances import MANY, InstancedMesh
from ..scene.node_arrays import NodeArrays
from ..scene.scene import Scene
from ._enclosing import Holes, holes_of
from ._light_list import LightList
from ._native_handles import MeshNeeds, native_mesh
from ._native_materials import make_textures, set_material
from ._view import View

_SETTLED = 3  # frames in which they did not change


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
    renewals : int
        Grows when objects or materials changed, or meshes were bent anew.
    lights : LightList
    """

    def __init__(self, color_space: str, threads: int) -> None:
        self.native = NativeDrawList()
        self._color_space = color_space
        self._threads = threads
        self._scene = lambda: None
        self._objects_version = -1
        self._needs: MeshNeeds | None = None
        self._normals, self._by_mesh = "", False
        self._untextured: frozenset[Material] = frozenset()
        self._listed_for: tuple | None = None  # needs, normals and by_mesh
        # Numbers of the objects that enclose a volume.
        self._closed: set[int] = set()
        self._with_holes: set[int] = set()  # of these, those that have holes
        self._watch = Watch()
        self._changed: list = []  # of what is watched, since the list was made
        # Where they are, as whose, and whether both sides show anyway.
        self._materials: dict[Material, list[tuple[int, int, bool]]] = {}
        # Which normals they asked for, and whether nothing shows through them.
        self._traits: dict[Material, tuple[bool, bool]] = {}
        self._textured: dict[Material, set[Texture]] = {}
        self._users: dict[Texture, set[Material]] = {}
        # Where materials begin, by their ids, and whether both sides show anyway.
        self._bases: dict[tuple[tuple[int, ...], bool], int] = {}
        self._listed: list = []  # what the objects were made of, by number: things, materials' ids
        self._left = 0  # how often an object went, or took other materials, since all were listed
        self._marks = False
        self._many: dict[int, InstancedMesh] = {}  # by number
        self._trees, self._frames = False, 0
        self._placed: tuple | None = None
        self._frustum: np.ndarray | None = None
        self._how = 1.0, False, True
        self._selected: bytes | None = None
        self._posed: tuple | None = None  # what poses the scene's meshes, and its moment
        self.lights = LightList(self.native, color_space)
        self.changes = self.renewals = 0

    def update(
        self,
        scene: Scene,
        needs: MeshNeeds,
        normals: str,
        headlight,
        frustum: np.ndarray | None,
        marks: float,
        batching: bool,
        flat: bool = False,
        by_mesh: bool = False,
    ) -> None:
        """Make the native list draw ``scene``.

        Parameters
        ----------
        scene : Scene
        needs : MeshNeeds
            Which derived arrays the picture reads; which of the two kinds of normals a mesh needs
            is decided for each mesh.
        normals : {"auto", "smooth", "flat", "facet"}
        headlight : tuple of three vectors, or None
            Colour, lux and direction towards the light, for a scene that has no light.
        frustum : (4, 4) float64 or None
            clip_from_world of a camera: nodes outside of what it shows are left out.
        marks : float
            How far lines and points may reach beyond where they are, as a share of half the image.
        batching : bool
            Nodes of one mesh are drawn as one.
        flat : bool
            What is outside of the frustum is found box by box, without the trees of boxes.
        by_mesh : bool
            Materials of meshes that enclose no volume show both sides.
        """
        scene._update(self._threads)
        how = needs, normals, by_mesh
        if self._listed_for != how or not self._lists(scene):
            self._renew(scene, *how)
        self._follow_poses(scene)
        if self._many and not self._trees:
            self._settle()
        widen = 1.0 + marks if self._marks or needs.edges else 1.0
        self._place(scene._arrays, frustum, (widen, flat, batching))
        self.lights.update(scene, headlight)

    def _follow_poses(self, scene: Scene) -> None:
        """Draw meshes that were bent anew as they are now."""
        posing = scene._posing
        posed = None if posing is None else (posing, posing.moment)
        if posed != self._posed and posing is not None:
            self.native.set_meshes(posing.numbers, posing.poses)
            self._placed = None
            self.renewals += 1
        self._posed = posed

    def _settle(self) -> None:
        """Make trees of many instances, once these have stayed as they are for some frames."""
        self._frames += 1
        if self._frames == _SETTLED:
            for number, instances in self._many.items():
                self.native.set_instance_tree(number, instances._tree()[0])
            self._trees = True
            self._placed = None

    def _unsettle(self) -> None:
        for number in self._many:
            self.native.set_instance_tree(number, None)
        self._trees, self._frames = False, 0

    def open_windows(self, scene: Scene, view: View, size: tuple[int, int]) -> int | None:
        """Let backs show where the camera may look into holes of meshes that enclose a volume.

        Elsewhere they may be left out, of materials that do not show both sides anyway.

        Parameters
        ----------
        scene : Scene
        view : View
        size : (int, int)
            Width and height of the picture in pixels.

        Returns
        -------
        count : int or None
            How many windows there are; None if backs may show anywhere, because the near plane may
            cut such a mesh or no mesh encloses a volume.
        """
        if not self._closed:
            return None
        arrays = scene._arrays
        return self.native.open_windows(
            arrays.count, arrays.columns, view.clip_from_world, view.view_from_world, *size
        )

    @property
    def has_holes(self) -> bool:
        """Whether a mesh that encloses a volume has holes, which a light may look into."""
        return bool(self._with_holes)

    def shows(self, scene: Scene) -> bool:
        """Whether everything in the scene is still as and where it was at the last update."""
        return self._placed == (scene._arrays, scene._arrays.changes) and self._lists(scene)

    def _lists(self, scene: Scene) -> bool:
        """Whether the objects are those of the scene, as they are now."""
        self._changed += self._watch.changed()
        return (
            self._scene() is scene
            and self._objects_version == scene._objects.version
            and not self._changed
        )

    def _renew(self, scene: Scene, needs: MeshNeeds, normals: str, by_mesh: bool) -> None:
        """Make the list of objects anew, or only what changed of it."""
        self.renewals += 1
        self._changed += self._watch.changed()
        same = self._scene() is scene and self._listed_for == (needs, normals, by_mesh)
        numbers = self._numbers_that_changed(scene) if same else None
        self._scene = lambda: None  # if anything below raises, the list is not current
        self._untextured = scene._untextured
        if numbers is None:
            self._needs, self._normals, self._by_mesh = needs, normals, by_mesh
            self._listed_for = None
            self._rebuild(scene)
        else:
            self._replace(scene, sorted(numbers))
        self._objects_version = scene._objects.version
        self._listed_for = needs, normals, by_mesh
        self._scene = weakref.ref(scene)

    def _numbers_that_changed(self, scene: Scene) -> set[int] | None:
        """Numbers of objects that are others or changed; None where all are to be listed anew."""
        objects = scene._objects
        numbers = objects.renewed_since(self._objects_version)
        if numbers is None:
            return None
        for thing in self._changed:
            if isinstance(thing, (Mesh, InstancedMesh)):
                numbers |= objects.drawn_by(thing)
            elif isinstance(thing, Material) and self._traits[thing] != _traits_of(thing):
                numbers |= self._numbers_with(thing)
        # Materials that nothing shows any longer are let go of when the list is made anew.
        few = 4 * (self._left + len(numbers)) <= len(objects.objects)
        return numbers if few or not numbers else None

    def _numbers_with(self, material: Material) -> set[int]:
        """Numbers of the objects that a material was listed with."""
        key = id(material)
        return {number for number, (_, surfaces) in enumerate(self._listed) if key in surfaces}

    def _materials_that_changed(self) -> set[Material]:
        """Those that did, and those of textures that did."""
        materials = {thing for thing in self._changed if isinstance(thing, Material)}
        return materials.union(*(self._users.get(thing, ()) for thing in self._changed))

    def _replace(self, scene: Scene, numbers: list[int]) -> None:
        """Renew the materials that changed, and the objects of some numbers."""
        for material in self._materials_that_changed():
            for index, number, both in self._materials[material]:
                self._set_material(index, material, number, both)
        self._changed = []
        if not numbers:
            return
        self._placed = None
        many = set(self._many)
        for number in numbers:
            self._forget(scene, number)
            self._set_object(number, scene._objects.objects[number])
        if not many.union(self._many).isdisjoint(numbers):
            self._unsettle()

    def _rebuild(self, scene: Scene) -> None:
        self._placed = None
        self._closed, self._with_holes = set(), set()
        self.native.clear()
        self.lights.forget()
        self._watch, self._changed = Watch(), []
        self._materials, self._traits, self._textured, self._users = {}, {}, {}, {}
        self._bases, self._listed = {}, []
        self._left = 0
        self._marks = self._trees = False
        self._many, self._frames = {}, 0
        self._make_textures(scene)
        for number, obj in enumerate(scene._objects.objects):
            self._set_object(number, obj)

    def _make_textures(self, scene: Scene) -> None:
        meshes = (getattr(obj, "mesh", obj) for obj in scene._objects.objects if obj is not None)
        materials = {material for mesh in meshes for material in mesh.materials}
        make_textures(materials - self._untextured, self._color_space, self._threads)

    def _set_object(self, number: int, obj) -> None:
        """List a mesh, once or at many poses, or nothing, under a number or the next one."""
        self._many.pop(number, None)
        self._closed.discard(number)
        self._with_holes.discard(number)
        if obj is None:
            self.native.set_object(number, None, 0)
            self._note(number, (), ())
            return
        mesh = obj if isinstance(obj, Mesh) else obj.mesh
        things = (mesh, obj) if isinstance(obj, InstancedMesh) else (mesh,)
        for thing in things:
            self._watch.add(thing)  # before it is read
        surfaces = tuple(map(id, mesh.materials))
        holes = self._holes_of(obj)
        both = self._by_mesh and holes is None
        if holes is not None:
            self._closed.add(number)
            if len(holes.ends):
                self._with_holes.add(number)
        if (surfaces, both) not in self._bases:
            self._bases[surfaces, both] = self._add_materials(mesh.materials, both)
        needs = _needs_of(mesh, self._needs, self._normals)
        if isinstance(obj, PosedMesh):
            native = obj.handle(needs, self._threads)
        else:
            native = native_mesh(mesh, needs, self._threads)
        closed = () if holes is None else (True, holes.ends, holes.points)
        self.native.set_object(number, native, self._bases[surfaces, both], *closed)
        self._marks = self._marks or len(mesh.lines) > 0 or len(mesh.points) > 0
        self._note(number, things, surfaces)
        if isinstance(obj, InstancedMesh):
            self._set_instances(number, obj)

    def _holes_of(self, obj) -> Holes | None:
        """The holes of an object that encloses a volume but for them."""
        if not self._by_mesh or isinstance(obj, PosedMesh):
            return None
        holes = holes_of(obj if isinstance(obj, Mesh) else obj.mesh)
        if holes is not None and len(holes.ends) and not isinstance(obj, Mesh):
            return None  # each instance would have to be looked at
        return holes

    def _set_instances(self, number: int, obj: InstancedMesh) -> None:
        if len(obj) >= MANY:
            self._many[number] = obj
        colors = obj.colors
        eight_bit = colors is not None and colors.dtype == np.uint8
        self.native.set_instances(
            number,
            obj._flat_poses(),
            colors if eight_bit else None,
            None if eight_bit else colors,
            obj._ids,
        )

    def _note(self, number: int, things: tuple, surfaces: tuple) -> None:
        """Remember what would make a listed object out of date."""
        if number == len(self._listed):
            self._listed.append(((), ()))
        self._left += self._listed[number][1] not in ((), surfaces)
        self._listed[number] = things, surfaces

    def _forget(self, scene: Scene, number: int) -> None:
        """Look no longer at what a number's object was made of, where no other is."""
        if number < len(self._listed):
            for thing in self._listed[number][0]:
                if not scene._objects.drawn_by(thing):
                    self._watch.remove(thing)

    def _add_materials(self, materials: list[Material], both: bool) -> int:
        """Add materials to the native list; return the first one's number."""
        base = self.native.material_count
        for number, material in enumerate(materials):
            index = base + number
            self._materials.setdefault(material, []).append((index, number, both))
            self._set_material(index, material, number, both)
        return base

    def _place(
        self, arrays: NodeArrays, frustum: np.ndarray | None, how: tuple[float, bool, bool]
    ) -> None:
        """List the draws of what may show, where it is now; how: widen, flat and batching."""
        placed = arrays, arrays.updated  # what is assigned after the update shows in the next frame
        moved = self._placed != placed
        widen, flat, batching = how
        if not moved and self._frustum is frustum and self._how == how:
            return
        self._placed = None  # for if anything below raises
        selection, tested = None, 0
        if frustum is not None:
            selection = np.empty((arrays.count + 63) // 64, np.uint64)
            tested = arrays.select(frustum, widen, flat, selection)
        self.native.node_boxes_tested = tested
        selected = None if selection is None else selection.tobytes()
        same = selected is not None and selected == self._selected and batching == self._how[2]
        if moved or self._trees or not same:
            self.native.place(
                arrays.count,
                arrays.columns,
                selection,
                frustum,
                widen,
                flat,
                batching,
                moved,
            )
        self.changes += moved
        self._placed, self._selected = placed, selected
        self._frustum, self._how = frustum, how

    def _set_material(self, index: int, material: Material, number: int, both: bool) -> None:
        self._watch.add(material)
        self._traits[material] = _traits_of(material)
        placed = {} if material in self._untextured else placed_textures_of(material)
        self._note_textures(material, {use.texture for use in placed.values()})
        two_sided = both or material.two_sided
        set_material(self.native, index, number, material, placed, self._color_space, two_sided)

    def _note_textures(self, material: Material, textures: set[Texture]) -> None:
        """Look at the textures of a material, and no longer at those that no material has now."""
        for gone in self._textured.pop(material, set()) - textures:
            self._users[gone].discard(material)
            if not self._users[gone]:
                del self._users[gone]
                self._watch.remove(gone)
        for texture in textures:
            self._watch.add(texture)
            self._users.setdefault(texture, set()).add(material)
        if textures:
            self._textured[material] = textures


def _traits_of(material: Material) -> tuple[bool, bool]:
    """What of a material decides how meshes with it are listed."""
    return material.flat_shading, material.alpha_mode == "opaque"


def _needs_of(mesh: Mesh, needs: MeshNeeds, normals: str) -> MeshNeeds:
    """Which arrays of this mesh are read, once its materials' flat shading is known."""
    smooth, flat = needs.vertex_normals, needs.face_normals
    if normals == "auto":
        flat = flat and any(material.flat_shading for material in mesh.materials)
        smooth = smooth and not all(material.flat_shading for material in mesh.materials)
    return MeshNeeds(smooth, flat, needs.edges)
