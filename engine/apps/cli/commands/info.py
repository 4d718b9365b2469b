"""``engine3d info``: prints the contents of a model file, its bounds and warnings.

``--system`` describes the machine and the installation instead.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings

from ....base.linalg import transform_points
from ....errors import Engine3DError, Engine3DWarning, printable
from ....io.loaders import load_document
from ....io.reading.documents import Document
from ....io.scenes.document_trees import JointRecord, TreeRecord
from ....io.scenes.tree_totals import rest_bounds, triangle_count
from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material, textures_of
from ..loading_bar import LoadingBar
from ..options.input_options import model_files, of_robot
from ..usage import UsageError


def info(args: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    if args.system == bool(args.models):
        raise UsageError("say which MODEL, or --system alone")
    if args.system:
        return _info_of_system(args.json)
    reports, failures = [], 0
    for file in model_files(args.models):
        try:
            report = describe(file, args.root, **of_robot(args))
        except Engine3DError as error:
            if len(args.models) == 1:
                raise
            print(f"engine3d: error: {printable(str(error))}", file=sys.stderr)
            failures += 1
            continue
        reports.append(report)
        if not args.json:
            # Names from the file must neither control the terminal nor look like other lines.
            print("\n".join(map(printable, report_lines(report))))
    if args.json:
        print(json.dumps(reports if len(args.models) > 1 else reports[0], indent=2))
    return 1 if failures else 0


def _info_of_system(as_json: bool) -> int:
    from ..system_report import describe_system, system_lines

    report = describe_system()
    print(json.dumps(report, indent=2) if as_json else "\n".join(system_lines(report)))
    return 0


def describe(path, root: str | None = None, **of_robot) -> dict:
    """Return the contents of a file as JSON types.

    Parameters
    ----------
    path : path-like or binary file object
        A file of any format that `engine3d.loaders` reads.
    root, **of_robot
        As in `load_mesh`: ``joints`` and ``shapes``.

    Returns
    -------
    dict
        ``file``, ``format``, ``unit`` (of lengths; None where the format has none), ``counts``,
        ``triangles`` (as drawn, each instance's counted),
        ``bounds`` (lowest and highest coordinates, at rest; None where there is no vertex),
        ``objects``, ``nodes`` and ``meshes`` (how many the file has), ``materials``, ``variants``,
        ``lights``, ``cameras``, ``skins``, ``animations``, ``joints`` (of robots), ``arrays`` (what
        ``--coloring-array`` can name, of vertices and of faces), ``warnings``.
    """
    with LoadingBar() as progress, warnings.catch_warnings():
        warnings.simplefilter("ignore", Engine3DWarning)  # they are part of the report
        document = load_document(path, progress=progress, values=False, root=root, **of_robot)
    return {
        "file": path.name if hasattr(path, "read") else str(path),
        "format": document.format,
        "unit": document.unit or None,
        "counts": dict(document.counts),
        **(_of_objects(document) if document.tree is None else _of_tree(document.tree)),
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
        "arrays": {kind: names for kind, names in document.arrays.items() if names},
        "warnings": [str(warning) for warning in document.warnings],
    }


def _of_tree(tree: TreeRecord) -> dict:
    """Return a file's contents from its tree."""
    return {
        "triangles": triangle_count(tree),
        "bounds": rest_bounds(tree),
        "nodes": len(tree.nodes),
        "meshes": len(tree.meshes),
        "materials": [_of_material(material) for material in tree.materials],
        "variants": list(tree.variants),
        "lights": [light.kind for light in tree.lights],
        "cameras": len(tree.cameras),
        "skins": [{"joints": len(skin.joints)} for skin in tree.skins],
        "joints": [] if tree.robot is None else [_of_joint(j, tree) for j in tree.robot.joints],
        "animations": [
            {"name": clip.name or None, "duration": clip.duration} for clip in tree.clips
        ],
    }


def _of_objects(document: Document) -> dict:
    """Return a file's contents from its objects."""
    meshes = {id(mesh): mesh for _, mesh, _ in document.objects}
    materials = {id(m): m for mesh in meshes.values() for m in mesh.materials}
    return {
        "triangles": sum(len(mesh.faces) for _, mesh, _ in document.objects),
        "bounds": _bounds(document.objects),
        "nodes": document.counts.get("nodes", len(document.objects)),
        "meshes": len(meshes),
        "materials": [_of_material(material) for material in materials.values()],
        "variants": [],
        "lights": [light.kind for light in document.lights],
        "cameras": len(document.cameras),
        "skins": [],
        "joints": [],
        "animations": [],
    }


def _of_joint(joint: JointRecord, tree: TreeRecord) -> dict:
    form = joint.form
    return {
        "name": form.name,
        "type": form.kind,
        "parent": tree.nodes[joint.parent].name,
        "child": tree.nodes[joint.child].name,
        "limits": form.limits and list(form.limits),
        "mimic": form.mimic and form.mimic[0],
    }


def _of_material(material: Material) -> dict:
    textures = textures_of(material)
    base = textures.get("texture")
    return {
        "name": material.name,
        "texture": base and base.name,
        "textures": list(textures),
        "physical": material.is_physical,
        "alpha_mode": material.alpha_mode,
    }


def _bounds(objects) -> list[list[float]] | None:
    """Return the box around the objects in file coordinates."""
    boxes = [_box(mesh, pose) for _, mesh, pose in objects if len(mesh.positions)]
    if not boxes:
        return None
    return [
        [pick(box[side][axis] for box in boxes) for axis in range(3)]
        for side, pick in enumerate((min, max))
    ]


def _box(mesh, pose) -> list[list[float]]:
    if pose is not None:
        mesh = Mesh(transform_points(pose, mesh.positions))
    return mesh.bounds.tolist()


def report_lines(report: dict) -> list[str]:
    """Return the report as lines of text."""
    unit = f", in {report['unit']}" if report["unit"] else ""
    lines = [f"{report['file']}: {report['format']}{unit}"]
    for name, entries in report["counts"].items():
        count = entries if isinstance(entries, int) else len(entries)
        lines.append(f"  {name:<12}{count:>12,d}")
    if report["bounds"] is not None:
        low, high = report["bounds"]
        size = [b - a for a, b in zip(low, high, strict=True)]
        lines.append("bounds")
        lines += [
            f"  {name:<12}" + "".join(f"{value:>12.6g}" for value in values)
            for name, values in (("min", low), ("max", high), ("size", size))
        ]
    for item in report["objects"]:
        name = item["name"] or "unnamed"
        kinds = ["vertices", "faces", *(kind for kind in ("lines", "points") if item[kind])]
        counts = ", ".join(f"{item[kind]:,d} {kind}" for kind in kinds)
        lines.append(f"object {name}: {counts}")
    for material in report["materials"]:
        texture = f", texture {material['texture']}" if material["texture"] else ""
        lines.append(f"material {material['name'] or 'default'}{texture}")
    lines += [f"variant {name}" for name in report["variants"]]
    lines += [f"light {kind}" for kind in report["lights"]]
    if report["cameras"]:
        lines.append(f"cameras: {report['cameras']}")
    lines += [f"skin: {skin['joints']:,d} joints" for skin in report["skins"]]
    lines += map(_joint_line, report["joints"])
    for number, clip in enumerate(report["animations"]):
        lines.append(f"animation {clip['name'] or number}: {clip['duration']:g} s")
    lines += [f"arrays of {kind}: {', '.join(names)}" for kind, names in report["arrays"].items()]
    lines += [f"warning: {warning}" for warning in report["warnings"]]
    return lines


def _joint_line(joint: dict) -> str:
    unit = "m" if joint["type"] == "prismatic" else "rad"
    limits = "" if joint["limits"] is None else "{:g} to {:g} ".format(*joint["limits"]) + unit
    follows = "" if joint["mimic"] is None else f"follows {joint['mimic']}"
    words = [f"joint {joint['name']}: {joint['type']}", limits, follows]
    ends = f"{joint['parent']} -> {joint['child']}"
    return ", ".join(filter(None, [*words, ends]))
