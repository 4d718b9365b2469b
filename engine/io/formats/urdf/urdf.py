"""Reader of URDF, the robots of ROS, Gazebo, PyBullet and others.

In: the bytes of a file, and the meshes and images that it names. Out: a `Document` whose tree has a
node for each link, below its parent link, and the joints between them. Coordinates are metres with
+Z up. What cannot be drawn is left out, with a warning that names the line. Source:
http://wiki.ros.org/urdf/XML.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ....base import linalg
from ....choices import ShapesOf
from ....errors import FileFormatError
from ...reading.documents import Document
from ...reading.posed_parts import MAX_REPEATED
from ...reading.reader_registry import Reader
from ...reading.sources import Source
from ...reading.warning_list import WarningList
from ...scenes.document_trees import JointRecord, MeshRecord, NodeRecord, RobotRecord, TreeRecord
from ...scenes.robot_posing import with_joints
from ...scenes.tree_objects import tree_counts, tree_objects
from .urdf_elements import UrdfText
from .urdf_files import RobotFiles
from .urdf_joints import UrdfJoint, read_joints, roots_of
from .urdf_model import Link, Shape, read_links
from .urdf_shapes import ShapeMeshes


def read_urdf(source: Source, split: bool = False) -> Document:
    """Read a URDF file, as `Reader.read`; each shape of a link is an object."""
    warnings = WarningList(source.path)
    text = UrdfText(source, warnings)
    links = read_links(text)
    joints = read_joints(text, links)
    meshes = ShapeMeshes(RobotFiles(source, warnings), warnings)
    tree = _Tree(links, joints, _wanted(source, text, links), meshes).record(
        text.root.attributes.get("name", ""), roots_of(text, links, joints)
    )
    _check_shown(source, tree, meshes.missing or text.left_out)
    tree = with_joints(tree, source.joints)
    objects = tree_objects(source, tree, MAX_REPEATED + source.size + meshes.size, split)
    counts: dict[str, Any] = {**tree_counts(tree, objects), "links": len(links)}
    counts["joints"] = len(joints)
    return Document(
        "urdf", objects, counts=counts, warnings=warnings.messages(), tree=tree, unit="m"
    )


def _check_shown(source: Source, tree: TreeRecord, left_out: str) -> None:
    """Raise if no shape is drawn, and say what was left out first."""
    if any(len(record.mesh.positions) for record in tree.meshes):
        return
    if left_out:
        raise FileFormatError(f"nothing of this robot can be drawn: {left_out}", source.path)
    raise FileFormatError("no link has a shape that can be drawn", source.path)


def _wanted(source: Source, text: UrdfText, links: dict[str, Link]) -> ShapesOf:
    """Return which shapes show: those of the other kind, with a warning, if there is no other."""
    kinds = {shape.is_collision for link in links.values() for shape in link.shapes}
    other: ShapesOf = "collision" if source.shapes == "visual" else "visual"
    if source.shapes == "both" or len(kinds) != 1 or (source.shapes == "collision") in kinds:
        return source.shapes
    text.warn(f"no link has a {source.shapes} shape: the {other} shapes are drawn", text.root)
    return other


class _Tree:
    """Makes the tree of a robot, links in the order of the file."""

    def __init__(
        self,
        links: dict[str, Link],
        joints: dict[str, UrdfJoint],
        wanted: ShapesOf,
        shapes: ShapeMeshes,
    ) -> None:
        self._links, self._joints = links, joints
        self._wanted, self._shapes = wanted, shapes
        self._nodes: list[NodeRecord] = []
        self._meshes: dict[int, tuple[int, MeshRecord]] = {}

    def record(self, name: str, roots: list[str]) -> TreeRecord:
        """Return the tree, with all joints at 0."""
        numbers = {link: self._put(NodeRecord(name=link)) for link in self._links}
        below: dict[str, list[int]] = {link: [] for link in self._links}
        above = {joint.child: joint for joint in self._joints.values()}
        for joint in self._joints.values():
            below[joint.parent].append(numbers[joint.child])
        for link in self._links.values():
            shown = [number for shape in link.shapes for number in self._shape(shape, link)]
            at = above[link.name].form.origin if link.name in above else None
            self._nodes[numbers[link.name]] = replace(
                self._nodes[numbers[link.name]], children=(*shown, *below[link.name]), matrix=at
            )
        records = tuple(record for _, record in self._meshes.values())
        joints = tuple(_joint(joint, numbers) for joint in self._joints.values())
        return TreeRecord(
            nodes=tuple(self._nodes),
            roots=tuple(numbers[root] for root in roots),
            meshes=records,
            materials=tuple({id(m): m for r in records for m in r.mesh.materials}.values()),
            robot=RobotRecord(name, tuple(numbers.values()), joints),
        )

    def _put(self, node: NodeRecord) -> int:
        self._nodes.append(node)
        return len(self._nodes) - 1

    def _shape(self, shape: Shape, link: Link) -> list[int]:
        """Add the nodes of a shape; return their numbers."""
        if self._wanted not in ("both", "collision" if shape.is_collision else "visual"):
            return []
        name = shape.name or f"{link.name}_{'collision' if shape.is_collision else 'visual'}"
        pose = shape.pose
        if shape.kind == "mesh" and shape.sizes != (1.0, 1.0, 1.0):
            pose = linalg.multiply(pose, np.diag([*shape.sizes, 1.0]))
        return [
            self._put(
                NodeRecord(
                    name=name,
                    mesh=self._mesh(part.mesh),
                    matrix=pose if part.pose is None else linalg.multiply(pose, part.pose),
                )
            )
            for part in self._shapes.parts(shape)
        ]

    def _mesh(self, mesh: Any) -> int:
        if id(mesh) not in self._meshes:
            self._meshes[id(mesh)] = len(self._meshes), MeshRecord(mesh.name, mesh)
        return self._meshes[id(mesh)][0]


def _joint(joint: UrdfJoint, numbers: dict[str, int]) -> JointRecord:
    return JointRecord(joint.form, numbers[joint.parent], numbers[joint.child])


def _resembles(head: bytes, size: int) -> bool:
    return b"<robot" in head


READERS = (
    Reader(
        "urdf",
        "Unified Robot Description Format",
        "mesh",
        (".urdf", ".xacro"),
        read_urdf,
        resembles=_resembles,
        up="+Z",
    ),
)
