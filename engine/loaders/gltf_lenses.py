"""Cameras and lights of a glTF file, as its nodes place them.

In: a `GltfFile`. Out: a `LensRecord` for each camera, a `LampRecord` for each light of
KHR_lights_punctual.
"""

from __future__ import annotations

import math

from .documents import LampRecord, LensRecord
from .gltf_file import LIGHTS, GltfFile
from .warning_list import WarningList


def read_cameras(file: GltfFile) -> tuple[LensRecord, ...]:
    """Return the cameras.

    Raises
    ------
    FileFormatError
        One sees nothing: its angle, size or distances make no sense.
    """
    return tuple(
        _camera(file, entry, f"cameras[{index}]")
        for index, entry in enumerate(file.entries("cameras"))
    )


def _camera(file: GltfFile, entry: dict, where: str) -> LensRecord:
    kind = entry.get("type")
    if kind not in ("perspective", "orthographic"):
        raise file.error(f"damaged: {where} is of no type that is known")
    where, part = f"{where}.{kind}", file.part(entry, kind, where)
    common = {
        "kind": kind,
        "name": file.text(entry, "name", where),
        "znear": _needed(file, part, "znear", where),
        "zfar": file.number(part, "zfar", where, 0.0) if "zfar" in part else math.inf,
        "extras": entry.get("extras"),
    }
    if not common["znear"] < common["zfar"]:
        raise file.error(f"damaged: {where} ends before it begins")
    if kind == "orthographic":
        size = {name: _needed(file, part, name, where) for name in ("xmag", "ymag")}
        if 0.0 in size.values() or common["znear"] < 0 or math.isinf(common["zfar"]):
            raise file.error(f"damaged: {where} sees nothing")
        return LensRecord(**common, **size)
    yfov = _needed(file, part, "yfov", where)
    aspect = file.number(part, "aspectRatio", where, 0.0) if "aspectRatio" in part else None
    if not (yfov > 0 and common["znear"] > 0 and (aspect is None or aspect > 0)):
        raise file.error(f"damaged: {where} sees nothing")
    return LensRecord(**common, yfov=yfov, aspect=aspect)


def _needed(file: GltfFile, part: dict, name: str, where: str) -> float:
    if name not in part:
        raise file.error(f"damaged: {where} has no {name}")
    return file.number(part, name, where, 0.0)


def read_lights(file: GltfFile, warnings: WarningList) -> tuple[LampRecord, ...]:
    """Return the lights.

    Raises
    ------
    FileFormatError
        One has no kind, or is darker than dark.
    """
    return tuple(
        _light(file, entry, warnings, f"{LIGHTS}.lights[{index}]")
        for index, entry in enumerate(file.lights())
    )


def _light(file: GltfFile, entry: dict, warnings: WarningList, where: str) -> LampRecord:
    kind = entry.get("type")
    if not isinstance(kind, str):
        raise file.error(f"damaged: {where} is of no type")
    color = file.numbers(entry, "color", where, (1.0, 1.0, 1.0))
    intensity = file.number(entry, "intensity", where, 1.0)
    reach = file.number(entry, "range", where, 0.0) if "range" in entry else math.inf
    if min(*color, intensity) < 0 or reach <= 0:
        raise file.error(f"damaged: {where} is darker than no light, or reaches nowhere")
    inner, outer = 0.0, math.pi / 4
    if kind == "spot":
        spot = file.part(entry, "spot", where)
        inner = file.number(spot, "innerConeAngle", where, inner)
        outer = file.number(spot, "outerConeAngle", where, outer)
        # Exporters write pi / 2 with a digit too many.
        outer = math.pi / 2 if 0 < outer - math.pi / 2 < 1e-6 else outer
        if not (inner >= 0 and 0 < outer <= math.pi / 2):
            raise file.error(f"damaged: {where} has a cone from {inner:g} to {outer:g}")
        if inner >= outer:
            warnings.add(f"{where} has a cone from {inner:g} to {outer:g}: its rim is sharp")
            inner = math.nextafter(outer, 0.0)
    name = file.text(entry, "name", where)
    return LampRecord(kind, name, color, intensity, reach, inner, outer, entry.get("extras"))
