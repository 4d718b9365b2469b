"""The tree of a robot whose joints stand at given values.

In: a `TreeRecord` with a robot, at rest. Out: the same with the poses of the moved links.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ...errors import InvalidArgumentError
from ...model.motion.joints import checked_values, joint_pose, rest_value
from ..reading.robot_options import RobotOptionError
from .document_trees import TreeRecord


def with_joints(tree: TreeRecord, values: Mapping[str, Any] | None) -> TreeRecord:
    """Return a robot's tree with joints at values; joints that follow others always move.

    Raises
    ------
    RobotOptionError
        As `checked_values`.
    """
    robot = tree.robot
    assert robot is not None  # only readers of robots call this
    forms = {joint.form.name: joint.form for joint in robot.joints}
    led = {
        name: rest_value(form)
        for name, form in forms.items()
        if form.mimic is None and form.kind != "fixed"
    }
    try:
        given = checked_values(forms, values or {})
    except InvalidArgumentError as error:
        raise RobotOptionError(str(error)) from None
    found = checked_values(forms, led, clamp=False) | given
    nodes = list(tree.nodes)
    for joint in robot.joints:
        if joint.form.name in found:
            pose = joint_pose(joint.form, found[joint.form.name])
            nodes[joint.child] = replace(nodes[joint.child], matrix=pose)
    return replace(tree, nodes=tuple(nodes), robot=replace(robot, values=found))
