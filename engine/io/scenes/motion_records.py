"""Spins, keyframes, paths and orbits of nodes in scene files.

In: an `Animator`, or the nodes of a file. Out: entries for the file, or an `Animator` that moves
the same nodes identically, to the bit. Numbers are kept as given.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from ..._native.loaders import frozen
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ...model.motion.orbits import ORBIT_VALUES, Orbit, circling
from ...model.motion.paths import PATH_VALUES, Path
from ...model.scene.animation import (
    MOTION_KINDS,
    Animator,
    Motions,
    Spin,
    Track,
    motions_of,
    set_motions,
)
from ...model.scene.nodes import Node, check_rotation
from ...model.scene.scene import Scene
from ..reading.json_values import JsonValue

MOTION_KEYS = set(MOTION_KINDS)
_SPIN_KEYS = {"axis", "period", "phase", "rotation"}
#: The values of a path that may be left out.
_PATH_USUAL: dict[str, Any] = {"phase": 0.0, "end": "close", "smooth": True, "forward": None}
#: The arrays of keyframes, and the numbers in each row.
_PARTS = {"translations": 3, "rotations": 4, "scales": 3}
# Entries of motions by kind and node; None: for deleted nodes.
Entries: TypeAlias = dict[Node | None, dict[str, list[dict[str, Any]]]]


def motion_entries(
    animator: Animator | None, numbers: Mapping[Node, int]
) -> tuple[Entries, list[str]]:
    """Return the file entries of each moving node, and a line for each motion that is lost.

    Parameters
    ----------
    animator : Animator or None
    numbers : dict of Node to int
        The nodes of the file.
    """
    entries: Entries = {}
    told: list[str] = []

    def put(kind: str, node: Node | None, entry: dict[str, Any]) -> None:
        entries.setdefault(node, {}).setdefault(kind, []).append(entry)

    spins, tracks, paths, orbits = Motions() if animator is None else motions_of(animator)
    for spin in spins:
        put("spins", spin.node, _spin_entry(spin))
    for track in tracks:
        put("tracks", track.node, _track_entry(track))
    for path in paths:
        put("paths", path.node, _path_entry(path))
    for orbit in orbits:
        node, about = orbit.node, orbit.about
        if not orbit.is_about_node or about in numbers:
            put("orbits", node, _orbit_entry(orbit, None if about is None else numbers[about]))
        elif node is not None and node in numbers:
            told.append(f"node {shown(node.name)}: what it circles is gone, and with it the orbit")
    return entries, told


def _spin_entry(spin: Spin) -> dict[str, Any]:
    entry = {"axis": spin.axis.tolist(), "period": spin.period}
    if spin.phase:
        entry["phase"] = spin.phase
    return {**entry, "rotation": spin.rotation.tolist()}


def _track_entry(track: Track) -> dict[str, Any]:
    held = {part: getattr(track, part) for part in ("times", *_PARTS)}
    entry = {part: rows.tolist() for part, rows in held.items() if rows is not None}
    return entry if track.repeat else {**entry, "repeat": False}


def _path_entry(path: Path) -> dict[str, Any]:
    entry: dict[str, Any] = {"points": path.points.tolist(), "period": path.period}
    held = {name: getattr(path, name) for name in _PATH_USUAL}
    return entry | {name: value for name, value in held.items() if value != _PATH_USUAL[name]}


def _orbit_entry(orbit: Orbit, about: int | None) -> dict[str, Any]:
    entry: dict[str, Any] = {} if about is None else {"about": about}
    entry |= {"radius": orbit.radius, "axis": orbit.axis.tolist(), "period": orbit.period}
    return entry | ({"phase": orbit.phase} if orbit.phase else {})


def fill_animator(scene: Scene, nodes: list[Node], entries: list[JsonValue], rate: float) -> None:
    """Give a scene the animator described by its nodes' entries, if any."""
    places: dict[Orbit, JsonValue] = {}
    found: dict[str, list[Any]] = {kind: [] for kind in MOTION_KINDS}
    for node, entry in zip(nodes, entries, strict=True):
        found["spins"] += [_spin(node, each) for each in entry.entries("spins")]
        found["tracks"] += [_track(node, each) for each in entry.entries("tracks")]
        found["paths"] += [_path(node, each) for each in entry.entries("paths")]
        for each in entry.entries("orbits"):
            found["orbits"].append(_orbit(node, each, nodes))
            places[found["orbits"][-1]] = each
    if (wrong := circling(found["orbits"])) is not None:
        raise places[wrong].error("a node cannot circle what moves with it")
    animator = Animator(scene, full_rate_distance=rate)
    if any(found.values()):
        set_motions(animator, Motions(**{kind: tuple(held) for kind, held in found.items()}))
        scene.animator = animator


def _spin(node: Node, entry: JsonValue) -> Spin:
    _check_keys(entry, _SPIN_KEYS)
    rotation = entry.get("rotation")
    first = node.rotation if rotation is None else np.array(rotation.numbers(4))
    phase = entry.get("phase")
    try:
        return Spin(
            node,
            frozen(check_rotation(first)),
            entry.need("axis").numbers(3),
            entry.need("period").value,
            0.0 if phase is None else phase.value,
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


def _track(node: Node, entry: JsonValue) -> Track:
    _check_keys(entry, {"times", "repeat", *_PARTS})
    repeat = entry.get("repeat")
    parts = {
        part: None if (rows := entry.get(part)) is None else [row.numbers(count) for row in rows]
        for part, count in _PARTS.items()
    }
    times = entry.need("times")
    try:
        return Track(
            node,
            times.numbers(len(list(times))),
            **parts,
            repeat=True if repeat is None else repeat.flag(),
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


def _path(node: Node, entry: JsonValue) -> Path:
    _check_keys(entry, set(PATH_VALUES))
    held = {name: entry.get(name) for name in _PATH_USUAL}
    points = [row.numbers(3) for row in entry.need("points")]
    try:
        return Path(
            node,
            points,
            entry.need("period").value,
            **{name: value.value for name, value in held.items() if value is not None},
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


def _orbit(node: Node, entry: JsonValue, nodes: list[Node]) -> Orbit:
    _check_keys(entry, set(ORBIT_VALUES))
    number, phase = entry.get("about"), entry.get("phase")
    about = None if number is None else nodes[number.index(len(nodes), "nodes")]
    try:
        return Orbit(
            node,
            about,
            entry.need("radius").value,
            entry.need("axis").numbers(3),
            entry.need("period").value,
            0.0 if phase is None else phase.value,
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


def _check_keys(entry: JsonValue, known: set[str]) -> None:
    for key in entry.value:
        if key not in known:
            raise entry.need(key).error("is no property of a motion")
