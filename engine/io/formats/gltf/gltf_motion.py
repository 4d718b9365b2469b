"""Skins and animations of a glTF file.

In: a `GltfFile` and its accessors. Out: a `SkinRecord` and a `ClipRecord` each. Invalid parts are
left out with a warning.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple, TypeAlias, get_args

import numpy as np

from ....choices import Interpolation, MotionPath
from ...reading.text import shown
from ...scenes.document_trees import (
    ChannelRecord,
    ClipRecord,
    MeshRecord,
    NodeRecord,
    PropertyRecord,
    SkinRecord,
)
from .gltf_accessors import GltfAccessors
from .gltf_file import DamagedError, Entry, GltfFile, once
from .gltf_lists import SoundList, sound_list
from .gltf_pointers import POINTER, target_of

# Interpolations by their names in files.
_INTERPOLATIONS: dict[str, Interpolation] = {name.upper(): name for name in get_args(Interpolation)}
_PATHS: dict[str, MotionPath] = {name: name for name in get_args(MotionPath)}
_WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}
_MOST_TOLD = 200
# A pointer to a mesh animates all nodes that show it; each channel takes the memory of this many
# numbers.
_NUMBERS_PER_CHANNEL = 64
# The numbers of a spline's key: in-tangent, value, out-tangent.
_SPLINE = 3
# Times and values.
_Keys: TypeAlias = tuple[np.ndarray, np.ndarray]


def read_skins(file: GltfFile, accessors: GltfAccessors) -> SoundList:
    """Return the skins with joints and a matching number of matrices."""
    return sound_list(file, "skins", file.entries("skins"), partial(_skin, file, accessors))


def _skin(file: GltfFile, accessors: GltfAccessors, entry: Entry, where: str) -> SkinRecord:
    given = entry.get("joints")
    if not isinstance(given, list) or not given:
        raise file.damaged(f"{where} has no joints")
    joints = tuple(file.number_in("nodes", joint, f"{where}.joints") for joint in given)
    skeleton = entry.get("skeleton")
    if skeleton is not None:
        place = f"{where}.skeleton"
        skeleton = file.sound(place, file.number_in, "nodes", skeleton, place)
    if "inverseBindMatrices" in entry:
        columns = accessors.floats(entry["inverseBindMatrices"], where, 16)[: len(joints)]
        if len(columns) < len(joints):
            raise file.damaged(f"{where} has {len(columns)} matrices, {len(joints)} joints")
        matrices = columns.reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)
        matrices[:, 3] = (0.0, 0.0, 0.0, 1.0)  # files may hold rounded values
        if not np.isfinite(matrices).all():
            raise file.damaged(f"{where} has matrices that are not finite")
    else:
        matrices = np.broadcast_to(np.eye(4), (len(joints), 4, 4))
    return SkinRecord(file.name(entry, where), joints, matrices, skeleton, entry.get("extras"))


def read_clips(
    file: GltfFile,
    accessors: GltfAccessors,
    nodes: tuple[NodeRecord, ...],
    meshes: tuple[MeshRecord, ...],
    lists: dict[str, SoundList],
) -> tuple[ClipRecord, ...]:
    """Return the animations, without their invalid channels.

    Parameters
    ----------
    file : GltfFile
    accessors : GltfAccessors
    nodes : tuple of NodeRecord
    meshes : tuple of MeshRecord
    lists : dict of str to SoundList
        Cameras and lights.
    """
    reading = _Clips(file, accessors, nodes, meshes, lists)
    return sound_list(file, "animations", file.entries("animations"), reading.clip).records


def _named(pointer: str) -> str:
    """Return a pointer for a message, shortened if it is very long."""
    return repr(pointer if len(pointer) <= _MOST_TOLD else f"{pointer[:_MOST_TOLD]}...")


def _later(
    channel: ChannelRecord | PropertyRecord, seconds: float, made: dict[tuple[int, int], _Keys]
) -> ChannelRecord | PropertyRecord:
    """Return a channel with its keys shifted later; of coinciding keys, the last is kept.

    ``made`` caches arrays, for channels that share them.
    """
    key = id(channel.times), id(channel.values)
    if key not in made:
        times = channel.times + np.float32(seconds)
        is_later = np.append(np.diff(times) > 0, True)
        made[key] = times[is_later], channel.values[is_later]
    return replace(channel, times=made[key][0], values=made[key][1])


class _Sampled(NamedTuple):
    """The data of a sampler; ``is_later`` marks times that differ from the next, None marks all."""

    times: np.ndarray
    values: np.ndarray
    is_later: np.ndarray | None
    interpolation: Interpolation


class _Clips:
    """Reads animations; values shared by several channels are read once."""

    def __init__(
        self,
        file: GltfFile,
        accessors: GltfAccessors,
        nodes: tuple[NodeRecord, ...],
        meshes: tuple[MeshRecord, ...],
        lists: dict[str, SoundList],
    ) -> None:
        self._file, self._accessors = file, accessors
        self._nodes, self._meshes, self._lists = nodes, meshes, lists
        self._times: dict[int, tuple[np.ndarray, np.ndarray | None] | DamagedError] = {}
        self._values: dict[int, np.ndarray | DamagedError] = {}
        self._keys: dict[tuple[int, int, str, int], _Keys] = {}  # by IDs of cached objects
        self._flags: list[np.ndarray] = []  # kept alive because their IDs are in use
        self._turns: dict[int, tuple[np.ndarray, np.ndarray]] = {}
        self._shown_by: dict[int, list[int]] = {}  # the nodes of each mesh
        for index, node in enumerate(nodes):
            if node.mesh is not None and node.weights is None:
                self._shown_by.setdefault(node.mesh, []).append(index)

    def clip(self, entry: Entry, where: str) -> ClipRecord | None:
        """Return a clip; None if no channel is usable; each fault is reported."""
        file = self._file
        for name in ("channels", "samplers"):
            if name not in entry:
                raise file.damaged(f"{where} has no {name}")
        samplers = file.entries("samplers", entry, f"{where}.")
        entries = file.entries("channels", entry, f"{where}.")
        made: list[ChannelRecord | PropertyRecord] = []
        first, last, is_sound = 0.0, 0.0, not entries
        moved_by = [repr(channel.get("target")) for channel in entries]
        last_of = {moved: number for number, moved in enumerate(moved_by)}
        for number, channel in enumerate(entries):
            place = f"{where}.channels[{number}]"
            other = last_of[moved_by[number]]
            if other != number:
                file.warnings.add(f"{place} moves what channels[{other}] moves: left out")
                continue
            read = file.sound(place, self._channel, channel, samplers, where, place)
            if read is not None:
                times, moved = read
                is_sound = True
                first, last = min(first, float(times[0])), max(last, float(times[-1]))
                made += moved
        if not is_sound:
            return None
        if first < 0:
            file.warnings.add(f"{where} begins at {first:g} s: it is moved to begin at 0")
            shifted: dict[tuple[int, int], _Keys] = {}
            made = [_later(one, -first, shifted) for one in made]
        return ClipRecord(
            file.name(entry, where),
            last - first,
            tuple(one for one in made if isinstance(one, ChannelRecord)),
            entry.get("extras"),
            tuple(one for one in made if isinstance(one, PropertyRecord)),
        )

    def _channel(
        self, channel: Entry, samplers: list[Entry], clip: str, where: str
    ) -> tuple[np.ndarray, list[ChannelRecord | PropertyRecord]]:
        """Return the times of a channel, and the records of what it animates."""
        file = self._file
        number = file.index(channel.get("sampler"), len(samplers), "samplers", where)
        sampled = self._sampled(samplers[number], f"{clip}.samplers[{number}]")
        target = file.part(channel, "target", where)
        path = target.get("path")
        if not isinstance(path, str):
            raise file.damaged(f"{where} has no path")
        if path == "pointer":
            pointer = file.part(file.part(target, "extensions", where), POINTER, where)
            return sampled.times, self._pointed(pointer.get("pointer"), sampled, where)
        moved = _PATHS.get(path)
        if moved is None or "node" not in target:
            file.warnings.add(f"{where} moves {shown(path)} of no node: left out")
            return sampled.times, []
        node = file.number_in("nodes", target["node"], where)
        return sampled.times, [self._of_node(node, moved, sampled, where)]

    def _of_node(self, node: int, path: MotionPath, sampled: _Sampled, where: str) -> ChannelRecord:
        times, values = self._shaped(sampled, self._width(path, node, where), where)
        if path == "rotation":
            if id(values) not in self._turns:
                self._turns[id(values)] = values, self._turning(values, where)
            values = self._turns[id(values)][1]
        return ChannelRecord(node, path, sampled.interpolation, times, values)

    def _pointed(
        self, pointer: Any, sampled: _Sampled, where: str
    ) -> list[ChannelRecord | PropertyRecord]:
        """Return the channels for the target of a pointer."""
        file, target = self._file, target_of(self._file, pointer, where)
        if target is None:
            file.warnings.add(f"{where} moves {_named(pointer)}, which is not played: left out")
            return []
        kind, number, path, width = target
        nodes = self._shown_by.get(number, []) if kind == "mesh" else [number]
        if path in _PATHS:
            self._accessors.count(_NUMBERS_PER_CHANNEL * len(nodes))
            return [self._of_node(node, _PATHS[path], sampled, where) for node in nodes]
        if kind in ("camera", "light"):
            records = self._lists[f"{kind}s"].number_of
            if number not in records:
                return []  # left out, and already reported
            nodes = [records[number]]
        if path == "visible":
            # An animated visibility is either on or off.
            sampled = sampled._replace(values=(sampled.values != 0).astype(np.float32))
            self._flags.append(sampled.values)
            if sampled.interpolation != "step":
                file.warnings.add(f"{where} moves {_named(pointer)} otherwise than by steps: STEP")
                if sampled.interpolation == "cubicspline":
                    raise file.damaged(f"{where} has splines of what is only true or false")
                sampled = sampled._replace(interpolation="step")
        times, values = self._shaped(sampled, width, where)
        kind = "node" if kind == "mesh" else kind
        self._accessors.count(_NUMBERS_PER_CHANNEL * len(nodes))
        return [
            PropertyRecord(kind, node, path, sampled.interpolation, times, values) for node in nodes
        ]

    def _shaped(self, sampled: _Sampled, width: int, where: str) -> _Keys:
        """Return times and values with a fixed number of columns; cached for all users."""
        key = id(sampled.times), id(sampled.values), sampled.interpolation, width
        found = self._keys.get(key)
        if found is None:
            found = self._keys[key] = self._rows(sampled, width, where)
        return found

    def _rows(self, sampled: _Sampled, width: int, where: str) -> _Keys:
        times, values, is_later, interpolation = sampled
        shape = (_SPLINE, width) if interpolation == "cubicspline" else (width,)
        if values.size != len(times) * math.prod(shape):
            raise self._file.damaged(
                f"{where} has {values.size} numbers for {len(times)} times of {width}"
            )
        values = values.reshape(len(times), *shape)
        return (times, values) if is_later is None else (times[is_later], values[is_later])

    def _turning(self, values: np.ndarray, where: str) -> np.ndarray:
        """Return rotations without null quaternions."""
        keys = values if values.ndim == 2 else values[:, 1]
        is_none = ~keys.any(axis=1)
        if not is_none.any():
            return values
        self._file.warnings.add(f"{where} has rotations without a direction: none instead")
        values = values.copy()
        keys = values if values.ndim == 2 else values[:, 1]
        keys[is_none, 3] = 1.0
        return values

    def _width(self, path: str, node: int, where: str) -> int:
        """Return how many numbers each time has."""
        if path != "weights":
            return _WIDTHS[path]
        mesh = self._nodes[node].mesh
        count = 0 if mesh is None else len(self._meshes[mesh].mesh.morph_targets)
        if not count:
            raise self._file.damaged(f"{where} moves weights of no morph targets")
        return count

    def _sampled(self, sampler: Entry, where: str) -> _Sampled:
        file = self._file
        interpolation = sampler.get("interpolation", "LINEAR")
        if not isinstance(interpolation, str) or interpolation not in _INTERPOLATIONS:
            file.warnings.add_once(f"{where}: no interpolation {shown(str(interpolation))}: LINEAR")
            interpolation = "LINEAR"
        key = file.number_in("accessors", sampler.get("input"), f"{where}.input")
        output = file.number_in("accessors", sampler.get("output"), f"{where}.output")
        times, is_later = once(self._times, key, lambda: self._checked_times(key, where))
        values = once(self._values, output, lambda: self._checked_values(output, where))
        return _Sampled(times, values, is_later, _INTERPOLATIONS[interpolation])

    def _checked_values(self, index: int, where: str) -> np.ndarray:
        values = self._accessors.floats(index, where, 1, 2, 3, 4)
        if not np.isfinite(values).all():
            raise self._file.damaged(f"{where} has values that are not finite")
        return values

    def _checked_times(self, index: int, where: str) -> tuple[np.ndarray, np.ndarray | None]:
        raw = self._accessors.raw(index, where, 1)
        if raw.dtype.kind != "f":
            raise self._file.damaged(f"{where} has times that are no floats")
        times = self._accessors.as_floats(raw, index)[:, 0]
        least = float(np.diff(times).min(initial=np.inf))  # NaN if any time is NaN
        ends = [float(time) for time in (*times[:1], *times[-1:])]
        if not ends or not (least >= 0 and all(map(math.isfinite, ends))):
            raise self._file.damaged(f"{where} has times that go back, or are none")
        if least > 0:
            return times, None
        self._file.warnings.add(f"{where} has equal times: the last one of each counts")
        return times, np.append(np.diff(times) > 0, True)
