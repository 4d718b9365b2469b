"""Skeletons: the nodes between a skin's joints and their common ancestor.

In: joints of a scene. Out: the nodes on the paths to the joints, parents first, and the anchor: the
lowest node above all joints, whose own pose moves all joints alike.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .skins import Skin

WORLD = -2  # the joints have no common ancestor node


class Skeleton(NamedTuple):
    """The data from which C computes the matrices of a skin's joints.

    Attributes
    ----------
    anchor : int
        Slot of the joints' common ancestor; `WORLD` if there is none.
    slots, above : (L,) int32
        Slots of the nodes on the paths to the joints, and each one's parent row; -1: the anchor.
    ends : (J,) int32
        The row of each joint.
    inverse_binds : (J, 12) float64
    """

    anchor: int
    slots: np.ndarray
    above: np.ndarray
    ends: np.ndarray
    inverse_binds: np.ndarray


def skeleton_of(skin: Skin, joints: list[int], parents: np.ndarray) -> Skeleton:
    """Return the skeleton of a skin, given the slots of its joints and of all nodes' parents."""
    anchor = _anchor(joints, parents)
    rows: dict[int, int] = {}
    above: list[int] = []
    for joint in joints:
        way, slot = [], joint
        while slot != anchor and slot not in rows:
            way.append(slot)
            slot = _above(parents, slot)
        for step in reversed(way):
            parent = _above(parents, step)
            above.append(rows.get(parent, -1))
            rows[step] = len(rows)
    return Skeleton(
        anchor,
        np.array(list(rows), np.int32),
        np.array(above, np.int32),
        np.array([rows[joint] for joint in joints], np.int32),
        np.ascontiguousarray(skin.inverse_binds[:, :3].reshape(-1, 12)),
    )


def _above(parents: np.ndarray, slot: int) -> int:
    parent = int(parents[slot])
    return WORLD if parent < 0 else parent


def _anchor(joints: list[int], parents: np.ndarray) -> int:
    """Return the lowest node above all joints, itself not a joint."""
    common = _ways_up(_above(parents, joints[0]), parents)
    shared = set(common)
    for joint in joints[1:]:
        slot = _above(parents, joint)
        while slot not in shared:  # all joints are below the world
            slot = _above(parents, slot)
        if slot != common[0]:
            common = common[common.index(slot) :]
            shared = set(common)
    return common[0]


def _ways_up(slot: int, parents: np.ndarray) -> list[int]:
    way = [slot]
    while slot != WORLD:
        slot = _above(parents, slot)
        way.append(slot)
    return way
