"""A model whose parts move away from its middle, and that a plane cuts.

In: a `ViewedScene`, how far its parts are spread, a plane. Out: another `ViewedScene` with a copy
of the scene as it stands, in which what is shown is moved and cut, and the cuts are closed. It is
drawn, picked, lit and measured like any other; the model itself does not change.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.box_corners import box_corners
from ...base.language import translated
from ...model.geometry.mesh import Mesh
from ...model.measuring.cutting import MOST_INSTANCES, Plane, area_of, cut_nodes
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.lights import LIGHTS
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.shown import placing_pose, shown_object
from ...model.scene.surroundings import SCENE_VALUES
from ..viewed_scene import ViewedScene
from .clipped_meshes import clipped, with_only
from .cut_faces import cut_face
from .loose_parts import loose_parts

Thing: TypeAlias = Mesh | InstancedMesh
#: World units between lines of the hatching, in radii of the model.
_PITCH = 1 / 9
#: How far each cut face lies before the next larger one, in radii, and for how many of them.
_LIFT, _MOST_LIFTS = 2e-5, 50


class _Part(NamedTuple):
    """A part of the model.

    Attributes
    ----------
    node : Node
        Of the copy.
    thing : Mesh or InstancedMesh
        What it shows when nothing is cut.
    pose : (4, 4) float64
        World from part when nothing is moved.
    middle : (3,) float64
        Of its box, in world space.
    """

    node: Node
    thing: Thing
    pose: NDArray[np.float64]
    middle: NDArray[np.float64]


class TakenApart:
    """A copy of a model that can be spread and cut.

    Parameters
    ----------
    whole : ViewedScene
        The model; what moves stands still in the copy.

    Attributes
    ----------
    whole : ViewedScene
    viewed : ViewedScene
        The copy.
    open_cuts : list of str
        The names of parts whose cut is not closed, because they are open all round or too
        intricate.
    uncut : list of str
        The names of parts that stay whole: a plane crosses too many instances.
    """

    def __init__(self, whole: ViewedScene) -> None:
        self.whole = whole
        self.open_cuts: list[str] = []
        self.uncut: list[str] = []
        self._scene = Scene()
        for name in SCENE_VALUES:
            setattr(self._scene, name, getattr(whole.scene, name))
        whole.scene.data.update()
        self._parts: list[_Part] = []
        for node in whole.scene.nodes:
            self._take(node)
        self._scene.data.update()
        self._center = np.array(whole.scene.bounds, np.float64).mean(axis=0)
        self._pieces: list[Node] = []  # cut faces, and cut instances
        self._is_split = False
        self.viewed = replace(
            whole,
            scene=self._scene,
            may_turn=False,  # cut faces are to be seen
            update=None,
            plays=False,
            player=None,
            swept=None,
            follow=None,
            detail=None,
            coloring=None,
        )

    def _take(self, node: Node) -> None:
        """Add what a node of the model shows, or shines, to the copy."""
        thing = shown_object(node)
        if isinstance(thing, Mesh | InstancedMesh) and node.shown and node.bounds is not None:
            if self.whole.coloring is not None:
                thing = self.whole.coloring.colored_thing(thing)
            self._add_part(thing, node.name, placing_pose(node), node)
        elif isinstance(thing, (Camera, *LIGHTS)) and node.shown:
            self._scene.add(thing, name=node.name, pose=node.world_pose)

    def _add_part(self, thing: Thing, name: str, pose: NDArray[np.float64], of: Node) -> None:
        if isinstance(thing, Mesh):
            thing = thing.with_creases()
        node = self._scene.add(
            thing,
            name=name,
            pose=pose,
            cast_shadows=of.cast_shadows,
            receive_shadows=of.receive_shadows,
        )
        box = node.bounds
        middle = np.zeros(3) if box is None else np.array(box, np.float64).mean(axis=0)
        self._parts.append(_Part(node, thing, pose, middle))

    @property
    def count(self) -> int:
        """How many parts there are; instances count one by one."""
        things = (part.thing for part in self._parts)
        return sum(len(one) if isinstance(one, InstancedMesh) else 1 for one in things)

    def spread(self, amount: float) -> None:
        """Move all parts, uncut, away from the middle: 1 doubles their distances."""
        if amount > 0.0 and not self._is_split:
            self._split()
        self.viewed.focus = None if amount else self.whole.focus
        for node in self._pieces:
            self._scene.remove(node)
        self._pieces, self.open_cuts, self.uncut = [], [], []
        for part in self._parts:
            thing = self._moved(part, amount)
            if part.node.object is not thing:
                part.node.object = thing
            part.node.pose = self._place(part, amount)
        self._scene.data.update()

    def _split(self) -> None:
        """Take a model that is one mesh apart."""
        self._is_split = True
        if len(self._parts) != 1:
            return
        only = self._parts[0]
        mesh = only.thing
        if not isinstance(mesh, Mesh) or len(mesh.lines) or len(mesh.points):
            return
        found = loose_parts(mesh)
        if len(found) < 2:
            return
        self._parts = []
        for name, faces in found:
            self._add_part(with_only(mesh, faces), name, only.pose, only.node)
        self._scene.remove(only.node)

    def _place(self, part: _Part, amount: float) -> NDArray[np.float64]:
        pose = part.pose.copy()
        if not isinstance(part.thing, InstancedMesh):
            pose[:3, 3] += (part.middle - self._center) * amount
        return pose

    def _moved(self, part: _Part, amount: float) -> Thing:
        """Return what a part shows; instances are parts of their own."""
        thing = part.thing
        if not isinstance(thing, InstancedMesh) or not amount or not len(thing):
            return thing
        own = instance_matrices(thing.poses).astype(np.float64)
        middle = np.array(thing.mesh.bounds, np.float64).mean(axis=0)
        center = linalg.transform_points(linalg.inverse(part.pose), self._center)
        middles = linalg.dot(own[:, :3, :3], middle) + own[:, :3, 3]
        own[:, :3, 3] += (middles - center) * amount
        return InstancedMesh(thing.mesh, own, colors=thing.colors)

    # Cutting

    def cut(self, plane: Plane, hidden: Collection[Node] = ()) -> None:
        """Cut off, from where `spread` left the parts, what is at the side that sees a plane.

        Parameters
        ----------
        plane : Plane
            In the scene's space.
        hidden : collection of Node
            Nodes of the copy that do not show: they get no cut faces.
        """
        parts = [part for part in self._parts if part.node not in hidden]
        outlines = cut_nodes((part.node for part in parts), plane)
        radius = 0.5 * float(linalg.length(np.subtract(*self.whole.scene.bounds)))
        names = {part.node.id: part.node.name or f"object {part.node.id}" for part in self._parts}
        for part in parts:
            self._cut_part(part, plane)
        # What is cut inside something else shows before it.
        outlines.sort(key=lambda outline: -area_of(outline.segments, plane))
        for rank, outline in enumerate(outlines):
            lift = radius * _LIFT * min(rank, _MOST_LIFTS)
            face = cut_face(outline, plane, radius * _PITCH, lift)
            if face is None:
                self.open_cuts.append(names[outline.node])
            else:
                name = translated("cut of {name}", name=names[outline.node])
                self._pieces.append(self._scene.add(face, name=name))

    def _cut_part(self, part: _Part, plane: Plane) -> None:
        node, thing = part.node, part.node.object
        if isinstance(thing, Mesh):
            height = _heights(node.pose, plane)
            side = _sides(thing, height)
            node.object = clipped(thing, height) if side == 0 else thing
            if side < 0:
                node.object = None
        elif isinstance(thing, InstancedMesh):
            self._cut_instances(node, thing, plane)

    def _cut_instances(self, node: Node, thing: InstancedMesh, plane: Plane) -> None:
        own = instance_matrices(thing.poses).astype(np.float64)
        heights = _heights(linalg.multiply(node.pose, own), plane)
        sides = _sides(thing.mesh, heights)
        crossing = np.flatnonzero(sides == 0)
        if len(thing) > MOST_INSTANCES and len(crossing):
            self.uncut.append(node.name or f"object {node.id}")
            return
        mesh = thing.mesh.with_creases()
        for number in crossing.tolist():
            piece = clipped(mesh, heights[number])
            if piece is not None:
                made = self._scene.add(
                    _rows(thing, [number], piece),
                    name=node.name,
                    pose=node.pose,
                    cast_shadows=node.cast_shadows,
                    receive_shadows=node.receive_shadows,
                )
                self._pieces.append(made)
        node.object = _rows(thing, np.flatnonzero(sides > 0), thing.mesh)


def _rows(thing: InstancedMesh, rows: Any, mesh: Mesh) -> InstancedMesh:
    """Return some of the instances, showing another mesh."""
    colors = None if thing.colors is None else thing.colors[rows]
    return InstancedMesh(mesh, thing.poses[rows], colors=colors)


def _heights(poses: NDArray[np.float64], plane: Plane) -> NDArray[np.float64]:
    """Return a plane's equation in the space of each pose, positive on the side that stays."""
    rows = np.array(poses[..., plane.axis, :], np.float64)
    rows[..., 3] -= plane.coordinate
    return -rows if plane.from_above else rows


def _sides(mesh: Mesh, heights: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return 1 where a mesh stays, -1 where it is cut off, 0 where it is cut."""
    corners = box_corners(np.asarray(mesh.bounds, np.float64))
    above = linalg.dot(heights[..., np.newaxis, :3], corners) + heights[..., 3:]
    return (above >= 0.0).all(axis=-1).astype(np.int64) - (above < 0.0).all(axis=-1)
