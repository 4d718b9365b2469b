"""Skins and animations of a glTF file.

In: a `GltfFile` and its accessors. Out: a `SkinRecord` and a `ClipRecord` each. What makes no sense
is left out with a warning.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from .documents import ChannelRecord, ClipRecord, MeshRecord, NodeRecord, SkinRecord
from .gltf_accessors import GltfAccessors
from .gltf_file import DamagedError, GltfFile, once
from .gltf_lists import SoundList, sound_list
from .text import shown

_INTERPOLATIONS = ("LINEAR", "STEP", "CUBICSPLINE")
_WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}
_POINTER = "KHR_animation_pointer"
# Parts of a key of a spline: the tangent towards it, its value, the tangent away from it.
_SPLINE = 3


def read_skins(file: GltfFile, accessors: GltfAccessors) -> SoundList:
    """Return the skins that have joints, and as many matrices."""
    return sound_list(file, "skins", file.entries("skins"), partial(_skin, file, accessors))


def _skin(file: GltfFile, accessors: GltfAccessors, entry: dict, where: str) -> SkinRecord:
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
        matrices[:, 3] = (0.0, 0.0, 0.0, 1.0)  # which files may only have rounded
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
) -> tuple[ClipRecord, ...]:
    """Return the animations, without the channels that make no sense."""
    reading = _Clips(file, accessors, nodes, meshes)
    return sound_list(file, "animations", file.entries("animations"), reading.clip).records


class _Clips:
    """Reads animations; the values that several channels name are read once."""

    def __init__(self, file, accessors, nodes, meshes) -> None:
        self._file, self._accessors = file, accessors
        self._nodes, self._meshes = nodes, meshes
        self._times: dict[int, tuple[np.ndarray, np.ndarray | None] | DamagedError] = {}
        self._values: dict[int, np.ndarray | DamagedError] = {}

    def clip(self, entry: dict, where: str) -> ClipRecord | None:
        """Return a clip; None if none of its channels makes sense, each of which was told."""
        file = self._file
        for name in ("channels", "samplers"):
            if name not in entry:
                raise file.damaged(f"{where} has no {name}")
        samplers = file.entries("samplers", entry, f"{where}.")
        entries = file.entries("channels", entry, f"{where}.")
        channels, first, last, is_sound = [], 0.0, 0.0, not entries
        for number, channel in enumerate(entries):
            place = f"{where}.channels[{number}]"
            read = file.sound(place, self._channel, channel, samplers, where, place)
            if read is not None:
                times, made = read
                is_sound = True
                first, last = min(first, float(times[0])), max(last, float(times[-1]))
                channels += [] if made is None else [made]
        if not is_sound:
            return None
        if first < 0:
            file.warnings.add(f"{where} begins at {first:g} s: it is moved to begin at 0")
            channels = [replace(made, times=made.times - np.float32(first)) for made in channels]
        name = file.name(entry, where)
        return ClipRecord(name, last - first, tuple(channels), entry.get("extras"))

    def _channel(
        self, channel: dict, samplers: list[dict], clip: str, where: str
    ) -> tuple[np.ndarray, ChannelRecord | None]:
        """The times of a channel, and the channel; None for one that moves no node."""
        file = self._file
        number = file.index(channel.get("sampler"), len(samplers), "samplers", where)
        times, values, is_later, interpolation = self._sampled(
            samplers[number], f"{clip}.samplers[{number}]"
        )
        target = file.part(channel, "target", where)
        path = target.get("path")
        if not isinstance(path, str):
            raise file.damaged(f"{where} has no path")
        if path not in (*_WIDTHS, "weights") or "node" not in target:
            pointer = file.part(file.part(target, "extensions", where), _POINTER, where)
            what = pointer.get("pointer", path) if path == "pointer" else path
            file.warnings.add(f"{where} moves {shown(str(what))} of no node: left out")
            return times, None
        node = file.number_in("nodes", target["node"], where)
        width = self._width(path, node, where)
        shape = (_SPLINE, width) if interpolation == "cubicspline" else (width,)
        if values.size != len(times) * math.prod(shape):
            raise file.damaged(
                f"{where} has {values.size} numbers for {len(times)} times of {width}"
            )
        values = values.reshape(len(times), *shape)
        if path == "rotation":
            values = self._turning(values, where)
        if is_later is not None:
            times, values = times[is_later], values[is_later]
        return times, ChannelRecord(node, path, interpolation, times, values)

    def _turning(self, values: np.ndarray, where: str) -> np.ndarray:
        """Rotations of which none is the null quaternion."""
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
        """How many numbers there are for each time."""
        if path != "weights":
            return _WIDTHS[path]
        mesh = self._nodes[node].mesh
        count = 0 if mesh is None else len(self._meshes[mesh].mesh.morph_targets)
        if not count:
            raise self._file.damaged(f"{where} moves weights of no morph targets")
        return count

    def _sampled(self, sampler: dict, where: str) -> tuple:
        """Times, values, which times differ from the next one (None for all), interpolation."""
        file = self._file
        interpolation = sampler.get("interpolation", "LINEAR")
        if interpolation not in _INTERPOLATIONS:
            file.warnings.add_once(f"{where}: no interpolation {shown(str(interpolation))}: LINEAR")
            interpolation = "LINEAR"
        key, output = (
            file.number_in("accessors", sampler.get(name), f"{where}.{name}")
            for name in ("input", "output")
        )
        times, is_later = once(self._times, key, partial(self._checked_times, key, where))
        values = once(self._values, output, partial(self._checked_values, output, where))
        return times, values, is_later, interpolation.lower()

    def _checked_values(self, index: int, where: str) -> np.ndarray:
        values = self._accessors.floats(index, where, 1, 2, 3, 4)
        if not np.isfinite(values).all():
            raise self._file.damaged(f"{where} has values that are not finite")
        return values

    def _checked_times(self, index: int, where: str) -> tuple[np.ndarray, np.ndarray | None]:
        raw = self._accessors.raw(index, where, 1)
        if raw.dtype.kind != "f":
            raise self._file.damaged(f"{where} has times that are no floats")
        times = self._accessors.floats(index, where, 1)[:, 0]
        steps = np.diff(times)
        if not len(times) or not np.isfinite(times).all() or (steps < 0).any():
            raise self._file.damaged(f"{where} has times that go back, or are none")
        if (steps > 0).all():
            return times, None
        self._file.warnings.add(f"{where} has equal times: the last one of each counts")
        return times, np.append(steps > 0, True)
