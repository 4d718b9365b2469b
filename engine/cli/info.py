"""``engine3d info``: the lists that a model file holds, its bounds and its warnings."""

from __future__ import annotations

import argparse
import json
import sys
import warnings

from ..errors import Engine3DError, Engine3DWarning, printable
from ..geometry.mesh import Mesh
from ..linalg import transform_points
from ..loaders import load_document
from .inputs import model_files
from .loading_bar import LoadingBar


def info(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    sys.stdout.reconfigure(errors="backslashreplace")
    reports, failures = [], 0
    for file in model_files(args.models):
        try:
            report = describe(file)
        except Engine3DError as error:
            if len(args.models) == 1:
                raise
            print(f"engine3d: error: {printable(str(error))}", file=sys.stderr)
            failures += 1
            continue
        reports.append(report)
        if not args.json:
            # Names from the file must neither steer the terminal nor look like other lines.
            print("\n".join(map(printable, report_lines(report))))
    if args.json:
        print(json.dumps(reports if len(args.models) > 1 else reports[0], indent=2))
    return 1 if failures else 0


def describe(path) -> dict:
    """Return what a file holds, in types that JSON knows.

    Parameters
    ----------
    path : path-like or binary file object
        A file of any format that `engine3d.loaders` reads.

    Returns
    -------
    dict
        ``file``, ``format``, ``counts``, ``bounds`` (``min``, ``max``, ``size``, or None where
        there is no vertex), ``objects``, ``materials``, ``lights``, ``cameras``, ``warnings``.
    """
    with LoadingBar() as progress, warnings.catch_warnings():
        warnings.simplefilter("ignore", Engine3DWarning)  # they are part of the report
        document = load_document(path, progress=progress)
    meshes = [mesh for _, mesh, _ in document.objects]
    materials = {id(material): material for mesh in meshes for material in mesh.materials}
    return {
        "file": path.name if hasattr(path, "read") else str(path),
        "format": document.format,
        "counts": dict(document.counts),
        "bounds": _bounds(document.objects),
        "objects": [
            {
                "name": name,
                "vertices": len(mesh.positions),
                "faces": len(mesh.faces),
                "lines": len(mesh.lines),
                "points": len(mesh.points),
                "groups": list(mesh.groups),
            }
            for name, mesh, _ in document.objects
        ],
        "materials": [
            {"name": material.name, "texture": material.texture and material.texture.name}
            for material in materials.values()
        ],
        "lights": [light.kind for light in document.lights],
        "cameras": len(document.cameras),
        "warnings": [str(warning) for warning in document.warnings],
    }


def _bounds(objects) -> dict | None:
    """Return the box round the objects in file coordinates."""
    boxes = [_box(mesh, pose) for _, mesh, pose in objects if len(mesh.positions)]
    if not boxes:
        return None
    low = [min(box[0][axis] for box in boxes) for axis in range(3)]
    high = [max(box[1][axis] for box in boxes) for axis in range(3)]
    size = [b - a for a, b in zip(low, high, strict=True)]
    return {"min": low, "max": high, "size": size}


def _box(mesh, pose) -> list[list[float]]:
    if pose is not None:
        mesh = Mesh(transform_points(pose, mesh.positions))
    return mesh.bounds.tolist()


def report_lines(report: dict) -> list[str]:
    """Return the report as lines of text."""
    lines = [f"{report['file']}: {report['format']}"]
    for name, entries in report["counts"].items():
        count = entries if isinstance(entries, int) else len(entries)
        lines.append(f"  {name:<12}{count:>12,d}")
    if report["bounds"] is not None:
        lines.append("bounds")
        lines += [
            f"  {name:<12}" + "".join(f"{value:>12.6g}" for value in report["bounds"][name])
            for name in ("min", "max", "size")
        ]
    for item in report["objects"]:
        name = item["name"] or "unnamed"
        lines.append(f"object {name}: {item['vertices']:,d} vertices, {item['faces']:,d} faces")
    for material in report["materials"]:
        texture = f", texture {material['texture']}" if material["texture"] else ""
        lines.append(f"material {material['name'] or 'default'}{texture}")
    lines += [f"light {kind}" for kind in report["lights"]]
    if report["cameras"]:
        lines.append(f"cameras: {report['cameras']}")
    lines += [f"warning: {warning}" for warning in report["warnings"]]
    return lines
