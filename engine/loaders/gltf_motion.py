"""Skins and animations of a glTF file.

In: a `GltfFile` and its accessors. Out: a `SkinRecord` and a `ClipRecord` each. An animation of
something else than nodes is left out with a warning.
"""

from __future__ import annotations

import math

import numpy as np

from .documents import ChannelRecord, ClipRecord, MeshRecord, NodeRecord, SkinRecord
from .gltf_accessors import GltfAccessors
from .gltf_file import GltfFile
from .text import shown
from .warning_list import WarningList

_INTERPOLATIONS = ("LINEAR", "STEP", "CUBICSPLINE")
_WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}
_POINTER = "KHR_animation_pointer"
# Parts of a key of a spline: the tangent towards it, its value, the tangent away from it.
_SPLINE = 3


def read_skins(file: GltfFile, accessors: GltfAccessors) -> tuple[SkinRecord, ...]:
    """Return the skins.

    Raises
    ------
    FileFormatError
        One has no joints, or fewer matrices than joints.
    """
    return tuple(
        _skin(file, accessors, entry, f"skins[{index}]")
        for index, entry in enumerate(file.entries("skins"))
    )


def _skin(file: GltfFile, accessors: GltfAccessors, entry: dict, where: str) -> SkinRecord:
    joints = entry.get("joints")
    if not isinstance(joints, list) or not joints:
        raise file.error(f"damaged: {where} has no joints")
    nodes = len(file.entries("nodes"))
    for joint in joints:
        file.index(joint, nodes, "nodes", f"{where}.joints")
    skeleton = entry.get("skeleton")
    if skeleton is not None:
        file.index(skeleton, nodes, "nodes", f"{where}.skeleton")
    if "inverseBindMatrices" in entry:
        columns = accessors.floats(entry["inverseBindMatrices"], where, 16)[: len(joints)]
        if len(columns) < len(joints):
            raise file.error(f"damaged: {where} has {len(columns)} matrices, {len(joints)} joints")
        matrices = columns.reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)
        matrices[:, 3] = (0.0, 0.0, 0.0, 1.0)  # which files may only have rounded
        if not np.isfinite(matrices).all():
            raise file.error(f"damaged: {where} has matrices that are not finite")
    else:
        matrices = np.broadcast_to(np.eye(4), (len(joints), 4, 4))
    name = file.text(entry, "name", where)
    return SkinRecord(name, tuple(joints), matrices, skeleton, entry.get("extras"))


def read_clips(
    file: GltfFile,
    accessors: GltfAccessors,
    nodes: tuple[NodeRecord, ...],
    meshes: tuple[MeshRecord, ...],
    warnings: WarningList,
) -> tuple[ClipRecord, ...]:
    """Return the animations.

    Raises
    ------
    FileFormatError
        The times of one go back, or it has too few values for its times.
    """
    reading = _Clips(file, accessors, nodes, meshes, warnings)
    return tuple(
        reading.clip(entry, f"animations[{index}]")
        for index, entry in enumerate(file.entries("animations"))
    )


class _Clips:
    """Reads animations; the values that several channels name are read once."""

    def __init__(self, file, accessors, nodes, meshes, warnings) -> None:
        self._file, self._accessors = file, accessors
        self._nodes, self._meshes, self._warnings = nodes, meshes, warnings
        self._times: dict[int, tuple[np.ndarray, np.ndarray | None]] = {}
        self._values: dict[int, np.ndarray] = {}

    def clip(self, entry: dict, where: str) -> ClipRecord:
        file = self._file
        for name in ("channels", "samplers"):
            if name not in entry:
                raise file.error(f"damaged: {where} has no {name}")
        samplers = file.entries("samplers", entry, f"{where}.")
        channels, last = [], 0.0
        for number, channel in enumerate(file.entries("channels", entry, f"{where}.")):
            place = f"{where}.channels[{number}]"
            index = file.index(channel.get("sampler"), len(samplers), "samplers", place)
            sampled = self._sampled(samplers[index], f"{where}.samplers[{index}]")
            last = max(last, float(sampled[0][-1]))
            read = self._channel(channel, sampled, place)
            channels += [] if read is None else [read]
        name = file.text(entry, "name", where)
        return ClipRecord(name, last, tuple(channels), entry.get("extras"))

    def _channel(self, channel: dict, sampled: tuple, where: str) -> ChannelRecord | None:
        file = self._file
        target = file.part(channel, "target", where)
        path = target.get("path")
        if not isinstance(path, str):
            raise file.error(f"damaged: {where} has no path")
        times, values, is_later, interpolation = sampled
        if "node" in target:
            file.entry("nodes", target["node"], where)
        if path not in (*_WIDTHS, "weights") or "node" not in target:
            pointer = file.part(file.part(target, "extensions", where), _POINTER, where)
            what = pointer.get("pointer", path) if path == "pointer" else path
            self._warnings.add(f"{where} moves {shown(str(what))} of no node: left out")
            return None
        width = self._width(path, target["node"], where)
        shape = (_SPLINE, width) if interpolation == "cubicspline" else (width,)
        if values.size != len(times) * math.prod(shape):
            raise file.error(
                f"damaged: {where} has {values.size} numbers for {len(times)} times of {width}"
            )
        values = values.reshape(len(times), *shape)
        if path == "rotation":
            values = self._turning(values, where)
        if is_later is not None:
            times, values = times[is_later], values[is_later]
        return ChannelRecord(target["node"], path, interpolation, times, values)

    def _turning(self, values: np.ndarray, where: str) -> np.ndarray:
        """Rotations of which none is the null quaternion."""
        keys = values if values.ndim == 2 else values[:, 1]
        is_none = ~keys.any(axis=1)
        if not is_none.any():
            return values
        self._warnings.add(f"{where} has rotations without a direction: none instead")
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
            raise self._file.error(f"damaged: {where} moves weights of no morph targets")
        return count

    def _sampled(self, sampler: dict, where: str) -> tuple:
        """Times, values, which times differ from the next one (None for all), interpolation."""
        file = self._file
        interpolation = sampler.get("interpolation", "LINEAR")
        if interpolation not in _INTERPOLATIONS:
            self._warnings.add(f"{where}: no interpolation {shown(str(interpolation))}: LINEAR")
            interpolation = "LINEAR"
        for name in ("input", "output"):
            file.entry("accessors", sampler.get(name), f"{where}.{name}")
        key, output = sampler["input"], sampler["output"]
        if key not in self._times:
            self._times[key] = self._checked_times(key, where)
        if output not in self._values:
            values = self._accessors.floats(output, where, 1, 2, 3, 4)
            if not np.isfinite(values).all():
                raise file.error(f"damaged: {where} has values that are not finite")
            self._values[output] = values
        times, is_later = self._times[key]
        return times, self._values[output], is_later, interpolation.lower()

    def _checked_times(self, index: int, where: str) -> tuple[np.ndarray, np.ndarray | None]:
        raw = self._accessors.raw(index, where, 1)
        if raw.dtype.kind != "f":
            raise self._file.error(f"damaged: {where} has times that are no floats")
        times = self._accessors.floats(index, where, 1)[:, 0]
        steps = np.diff(times)
        is_sound = len(times) and np.isfinite(times).all() and times[0] >= 0
        if not is_sound or (steps < 0).any():
            raise self._file.error(f"damaged: {where} has times that go back, or are none")
        if (steps > 0).all():
            return times, None
        self._warnings.add(f"{where} has equal times: the last one of each counts")
        return times, np.append(steps > 0, True)
