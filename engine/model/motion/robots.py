"""Robots: the links of a scene that joints move.

In: nodes of links, and the forms of the joints between them. Out: poses of the nodes, changed by
assigning values to joints. A link's node is below that of its parent link, so that the scene's tree
does forward kinematics.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any, NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.calls import checks_types
from ...base.named_things import NamedThings
from ...base.numbers import shown
from ...base.validation import FixedNames
from ...choices import JointKind
from ..scene.nodes import Node
from .joints import JointForm, JointValue, checked_values, joint_pose, rest_value


class Joint(FixedNames):
    """A joint of a `Robot`: it places its child link against its parent link."""

    def __init__(self, robot: Robot, form: JointForm, parent: Node, child: Node) -> None:
        self._robot, self._form = robot, form
        self._parent, self._child = parent, child
        self._value = rest_value(form)

    @property
    def name(self) -> str:
        return self._form.name

    @property
    def kind(self) -> JointKind:
        """What the file calls its type, such as ``"revolute"``."""
        return self._form.kind

    @property
    def parent(self) -> Node:
        """The node of the link that holds the joint."""
        return self._parent

    @property
    def child(self) -> Node:
        """The node of the link that the joint moves."""
        return self._child

    @property
    def axis(self) -> tuple[float, ...]:
        """The axis as a unit vector, in the child link's coordinates."""
        return self._form.axis

    @property
    def limits(self) -> tuple[float, float] | None:
        """The least and the greatest value; None for any."""
        return self._form.limits

    @property
    def mimic(self) -> tuple[str, float, float] | None:
        """The joint that this one follows, a factor and an offset; None for its own value."""
        return self._form.mimic

    @property
    def value(self) -> Any:
        """Where the joint stands; assign as with `Robot.set_joint`.

        Radians of revolute and continuous joints, metres of prismatic ones, ``(3,)`` x, y, angle of
        planar and roll, pitch, yaw of spherical ones, a ``(4, 4)`` pose of floating ones, 0 of
        fixed ones.
        """
        return self._value

    @value.setter
    def value(self, value: Any) -> None:
        self._robot.set_joints({self.name: value})

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Joint belongs to its Robot: scene.copy() copies both")

    def __repr__(self) -> str:
        return f"Joint({self.name!r}, {self.kind}, value={shown(self._value)})"


class Robot(FixedNames):
    """The links and joints of a robot in a scene; see `Scene.robots`.

    Loading a URDF file makes one. Angles are radians and lengths metres; `numpy.radians` converts
    degrees.
    """

    def __init__(
        self,
        name: str,
        links: Iterable[Node],
        joints: Iterable[tuple[JointForm, Node, Node]],
        values: Mapping[str, JointValue],
    ) -> None:
        self._name = name
        self._links: NamedThings[Node] = NamedThings("link")
        self._links.update((node.name, node) for node in links)
        self._joints: NamedThings[Joint] = NamedThings("joint")
        self._joints.update((form.name, Joint(self, form, *ends)) for form, *ends in joints)
        self._forms = {joint.name: joint._form for joint in self._joints.values()}
        self._above = {joint._child: joint for joint in self._joints.values()}
        for key, value in values.items():
            self._joints[key]._value = value

    @property
    def name(self) -> str:
        return self._name

    @property
    def links(self) -> Mapping[str, Node]:
        """The nodes of the links by name, read-only; shapes are below them."""
        return MappingProxyType(self._links)

    @property
    def joints(self) -> Mapping[str, Joint]:
        """The joints by name, in file order, read-only."""
        return MappingProxyType(self._joints)

    @property
    def values(self) -> dict[str, Any]:
        """The values of all joints that can be set: neither fixed ones nor those that follow."""
        movable = (j for j in self._joints.values() if j.kind != "fixed" and j.mimic is None)
        return {joint.name: joint.value for joint in movable}

    @checks_types
    def set_joint(self, name: str, position: float | ArrayLike, *, clamp: bool = True) -> None:
        """Move a joint, and those that follow it.

        Parameters
        ----------
        name : str
        position : float or array_like
            Radians of revolute and continuous joints, metres of prismatic ones; ``(3,)`` x, y and
            angle of planar ones, or roll, pitch and yaw of spherical ones; ``(6,)`` x, y, z, roll,
            pitch, yaw or a ``(4, 4)`` pose of floating ones.
        clamp : bool
            Hold the value within the joint's limits, with an `Engine3DWarning`; with False, limits
            do not count.

        Raises
        ------
        InvalidArgumentError
            There is no such joint, it is fixed or follows another, or the value has a wrong form.
        """
        self.set_joints({name: position}, clamp=clamp)

    @checks_types
    def set_joints(self, values: Mapping[str, Any], *, clamp: bool = True) -> None:
        """Move several joints by name: all, or none if one of them cannot be moved.

        Parameters and errors are those of `set_joint`.
        """
        found = checked_values(self._forms, values, clamp=clamp)
        for name, value in found.items():
            joint = self._joints[name]
            joint._child.pose = joint_pose(joint._form, value)
            joint._value = value

    @checks_types
    def link_pose(self, name: str) -> NDArray[np.float64]:
        """Return root-from-link, (4, 4) float64: forward kinematics.

        Raises
        ------
        InvalidArgumentError
            There is no such link.
        """
        return self._placed(self._links[name], {})

    def link_poses(self) -> dict[str, NDArray[np.float64]]:
        """Return root-from-link of all links by name, each (4, 4) float64."""
        known: dict[Node, NDArray[np.float64]] = {}
        return {name: self._placed(node, known).copy() for name, node in self._links.items()}

    def _placed(self, node: Node, known: dict[Node, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Return root-from-link of a node; ``known`` keeps those on the way."""
        path = []
        while node not in known and (joint := self._above.get(node)) is not None:
            path.append(joint)
            node = joint._parent
        pose = known.get(node, np.eye(4))
        for joint in reversed(path):
            pose = linalg.multiply(pose, joint_pose(joint._form, joint._value))
            known[joint._child] = pose
        return pose

    def _copied_to(self, copy_of: Callable[[Node], Node]) -> Robot:
        """Return the robot of a copied scene."""
        joints = [(j._form, copy_of(j._parent), copy_of(j._child)) for j in self._joints.values()]
        values = {joint.name: joint._value for joint in self._joints.values()}
        return Robot(self._name, map(copy_of, self._links.values()), joints, values)

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Robot belongs to its Scene: scene.copy() copies both")

    def __repr__(self) -> str:
        return f"Robot({self._name!r}, {len(self._links)} links, {len(self._joints)} joints)"
