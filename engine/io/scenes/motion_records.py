"""Spins and keyframes of nodes in scene files.

In: an `Animator`, or the nodes of a file. Out: entries for the file, or an `Animator` that moves
the same nodes identically, to the bit. Numbers are kept as given.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from ..._native.loaders import frozen
from ...errors import InvalidArgumentError
from ...model.scene.animation import Animator, Spin, Track, motions_of, set_motions
from ...model.scene.nodes import Node, check_rotation
from ...model.scene.scene import Scene
from ..reading.json_values import JsonValue

MOTION_KEYS = {"spins", "tracks"}
_SPIN_KEYS = {"axis", "period", "phase", "rotation"}
#: The arrays of keyframes, and the numbers in each row.
_PARTS = {"translations": 3, "rotations": 4, "scales": 3}
# Entries of spins and tracks by node; None: for deleted nodes.
Motions: TypeAlias = dict[Node | None, dict[str, list[dict[str, Any]]]]


def motion_entries(animator: Animator | None) -> Motions:
    """Return the file entries of each moving node."""
    entries: Motions = {}
    spins, tracks = ((), ()) if animator is None else motions_of(animator)
    for spin in spins:
        entries.setdefault(spin.node, {}).setdefault("spins", []).append(_spin_entry(spin))
    for track in tracks:
        entries.setdefault(track.node, {}).setdefault("tracks", []).append(_track_entry(track))
    return entries


def _spin_entry(spin: Spin) -> dict[str, Any]:
    entry = {"axis": spin.axis.tolist(), "period": spin.period}
    if spin.phase:
        entry["phase"] = spin.phase
    return {**entry, "rotation": spin.rotation.tolist()}


def _track_entry(track: Track) -> dict[str, Any]:
    held = {part: getattr(track, part) for part in ("times", *_PARTS)}
    entry = {part: rows.tolist() for part, rows in held.items() if rows is not None}
    return entry if track.repeat else {**entry, "repeat": False}


def fill_animator(scene: Scene, nodes: list[Node], entries: list[JsonValue], rate: float) -> None:
    """Give a scene the animator described by its nodes' entries, if any."""
    spins, tracks = [], []
    for node, entry in zip(nodes, entries, strict=True):
        spins += [_spin(node, each) for each in entry.entries("spins")]
        tracks += [_track(node, each) for each in entry.entries("tracks")]
    animator = Animator(scene, full_rate_distance=rate)
    if spins or tracks:
        set_motions(animator, (tuple(spins), tuple(tracks)))
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


def _check_keys(entry: JsonValue, known: set[str]) -> None:
    for key in entry.value:
        if key not in known:
            raise entry.need(key).error("is no property of a motion")
