"""Cameras and lights of a glTF file, which its nodes place.

In: a `GltfFile`. Out: a `LensRecord` for each camera, a `LampRecord` for each light of
KHR_lights_punctual; a warning for invalid ones.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from ...scenes.document_trees import LampRecord, LensRecord
from .gltf_file import LIGHTS, Entry, GltfFile
from .gltf_lists import SoundList, sound_list


def read_cameras(file: GltfFile) -> SoundList:
    """Return the cameras whose angle, size and distances are valid."""
    return sound_list(file, "cameras", file.entries("cameras"), partial(_camera, file))


def _camera(file: GltfFile, entry: Entry, where: str) -> LensRecord:
    kind = entry.get("type")
    if kind not in ("perspective", "orthographic"):
        raise file.damaged(f"{where} is of no type that is known")
    name = file.name(entry, where)
    where, part = f"{where}.{kind}", file.part(entry, kind, where)
    common: dict[str, Any] = {
        "kind": kind,
        "name": name,
        "znear": _needed(file, part, "znear", where),
        "zfar": file.number(part, "zfar", where, 0.0) if "zfar" in part else math.inf,
        "extras": entry.get("extras"),
    }
    if not common["znear"] < common["zfar"]:
        raise file.damaged(f"{where} ends before it begins")
    if kind == "orthographic":
        xmag, ymag = (_needed(file, part, name, where) for name in ("xmag", "ymag"))
        if 0.0 in (xmag, ymag) or common["znear"] < 0 or math.isinf(common["zfar"]):
            raise file.damaged(f"{where} sees nothing")
        return LensRecord(**common, xmag=xmag, ymag=ymag)
    yfov = _needed(file, part, "yfov", where)
    aspect = file.number(part, "aspectRatio", where, 0.0) if "aspectRatio" in part else None
    if not (yfov > 0 and common["znear"] > 0 and (aspect is None or aspect > 0)):
        raise file.damaged(f"{where} sees nothing")
    return LensRecord(**common, yfov=yfov, aspect=aspect)


def _needed(file: GltfFile, part: Entry, name: str, where: str) -> float:
    if name not in part:
        raise file.damaged(f"{where} has no {name}")
    return file.number(part, name, where, 0.0)


def read_lights(file: GltfFile) -> SoundList:
    """Return the lights that have a kind and valid values."""
    return sound_list(file, f"{LIGHTS}.lights", file.lights(), partial(_light, file))


def _light(file: GltfFile, entry: Entry, where: str) -> LampRecord:
    kind = entry.get("type")
    if not isinstance(kind, str):
        raise file.damaged(f"{where} is of no type")
    red, green, blue = file.numbers(entry, "color", where, (1.0, 1.0, 1.0))
    intensity = file.number(entry, "intensity", where, 1.0)
    reach = file.number(entry, "range", where, 0.0) if "range" in entry else math.inf
    if min(red, green, blue, intensity) < 0 or reach <= 0:
        raise file.damaged(f"{where} is darker than no light, or reaches nowhere")
    inner, outer = 0.0, math.pi / 4
    if kind == "spot":
        spot = file.part(entry, "spot", where)
        inner = file.number(spot, "innerConeAngle", where, inner)
        outer = file.number(spot, "outerConeAngle", where, outer)
        # Exporters round pi / 2 up in its last digits.
        outer = math.pi / 2 if 0 < outer - math.pi / 2 < 1e-6 else outer
        if not (inner >= 0 and 0 < outer <= math.pi / 2):
            raise file.damaged(f"{where} has a cone from {inner:g} to {outer:g}")
        if inner >= outer:
            file.warnings.add(f"{where} has a cone from {inner:g} to {outer:g}: its rim is sharp")
            inner = math.nextafter(outer, 0.0)
    name = file.name(entry, where)
    color = red, green, blue
    return LampRecord(kind, name, color, intensity, reach, inner, outer, entry.get("extras"))
