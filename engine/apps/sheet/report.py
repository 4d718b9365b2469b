"""The report of a sheet for programs, in JSON types.

In: models and their panels. Out: a dict; docs/sheet.md names all keys. Nothing in it depends on the
machine or on the time.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from ...errors import printable
from ...model.materials.colors import linear_color, split_alpha
from ...model.scene.cameras import Camera, OrthographicCamera, PerspectiveCamera
from ...model.scene.instances import InstancedMesh
from ...stage.viewed_scene import ViewedScene
from .panel_renderer import PanelRenderer
from .panels import Panel
from .placing import is_parallel_projection
from .visible import Shown, count_by_key, count_parts, joined, mesh_of_node

#: Grows when a key changes its meaning.
VERSION = 1
_MATERIAL_BITS = 20


def report_text(report: dict[str, Any]) -> str:
    """Return a report as JSON, with a line for each innermost value."""
    return _text(report, "\n") + "\n"


def _text(value: Any, margin: str) -> str:
    """Return a value as JSON, with further lines indented."""
    inner = margin + "  "
    if isinstance(value, dict) and value:
        rows = [f"{json.dumps(key)}: {_text(item, inner)}" for key, item in value.items()]
        return "{" + inner + ("," + inner).join(rows) + margin + "}"
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return "[" + inner + ("," + inner).join(_text(v, inner) for v in value) + margin + "]"
    return json.dumps(value, allow_nan=False)


class ModelReport:
    """Builds the report on one model.

    Parameters
    ----------
    model : ViewedScene
    studio : PanelRenderer
    unit : str or None
    """

    def __init__(self, model: ViewedScene, studio: PanelRenderer, unit: str | None) -> None:
        self._model, self._scene = model, model.scene
        self._nodes = [node for node in self._scene.nodes if mesh_of_node(node) is not None]
        self._names = {node.id: printable(node.name) for node in self._nodes}
        self._materials = _materials_of(self._nodes)
        self._studio, self._unit = studio, unit

    def as_dict(self, up: str, panels: list[Panel]) -> dict[str, Any]:
        """Return the report of the model and its panels."""
        views = [self._view(panel) for panel in panels]
        seen = {node["id"] for view in views for node in view["nodes"]}
        meshes = [mesh_of_node(node) for node in self._nodes]
        times = [_times(node) for node in self._nodes]
        return {
            "file": self._model.path,
            "title": self._model.title,
            "format": self._model.format,
            "unit": self._unit,
            "up": up,
            "bounds": self.bounds(),
            "triangles": sum(len(m.faces) * n for m, n in zip(meshes, times, strict=True)),
            "lines": sum(len(m.lines) * n for m, n in zip(meshes, times, strict=True)),
            "points": sum(len(m.points) * n for m, n in zip(meshes, times, strict=True)),
            "blank": all(view["blank"] for view in views),
            "why": views[0]["why"] if all(view["blank"] for view in views) else None,
            "materials": [_material(number, m) for number, m in enumerate(self._materials)],
            "nodes": [self._node(node) for node in self._nodes],
            "never_visible": [node.id for node in self._nodes if node.id not in seen],
            "warnings": [printable(str(line)) for line in self._model.warnings],
            "views": views,
        }

    def bounds(self) -> dict[str, list[float]] | None:
        """Return the box of the model in the file's coordinates, or None without vertices."""
        if not any(len(mesh_of_node(node).positions) for node in self._nodes):
            return None
        low, high = (_moved(corner, self._model.origin) for corner in self._studio.bounds)
        size = (self._studio.bounds[1] - self._studio.bounds[0]).tolist()
        center = [(a + b) * 0.5 for a, b in zip(low, high, strict=True)]
        return {"low": low, "high": high, "size": size, "center": center}

    def _node(self, node) -> dict[str, Any]:
        box = node.bounds
        mesh = mesh_of_node(node)
        return {
            "id": node.id,
            "name": self._names[node.id],
            "triangles": len(mesh.faces) * _times(node),
            "bounds": None if box is None else [_moved(b, self._model.origin) for b in box],
        }

    def _view(self, panel: Panel) -> dict[str, Any]:
        table, box, reason = _count(panel), panel.box, panel.reason
        pixels = int(np.count_nonzero(panel.shown))
        report = {
            "name": printable(panel.spec.name),
            "kind": panel.spec.kind,
            "rectangle": list(panel.rectangle),
            "to_scale": panel.spec.to_scale,
            "camera": _camera(panel, self._model.origin),
            "blank": reason is not None,
            "why": None if reason is None else reason.word,
            "sentence": None if reason is None else reason.sentence,
            "contrast": panel.contrast,
            "pixels": pixels,
            "coverage": pixels / panel.shown.size,
            "box": None if box is None else _on_sheet(box, panel),
            "extent": list(panel.extent.size[:2]) if panel.scale is not None else None,
            "nodes": self._nodes_of(table, panel),
            "materials": self._materials_of(table, panel),
            "parts": self._parts_of(panel),
        }
        if panel.caps is not None:
            report["cut"] = self._cut_of(panel)
        return report

    def _parts_of(self, panel: Panel) -> list[dict[str, Any]]:
        return [
            {
                "node": part.node,
                "name": printable(part.name),
                "pixels": part.pixels,
                "box": _on_sheet(part.box, panel),
            }
            for part in count_parts(panel.frame, panel.shown, self._scene)
        ]

    def _cut_of(self, panel: Panel) -> list[dict[str, Any]]:
        return [
            {
                "id": cut.node,
                "name": self._names.get(cut.node, ""),
                "pixels": cut.pixels,
                "area": cut.area,
            }
            for cut in panel.caps.nodes
        ]

    def _nodes_of(self, table: list[Shown], panel: Panel) -> list[dict[str, Any]]:
        found, by_node = [], {}
        for shown in table:
            by_node.setdefault(shown.key >> _MATERIAL_BITS, []).append(shown)
        for number, of_node in by_node.items():
            node = joined(of_node, number)
            alone = panel.alone.get(number, node.pixels)
            hidden = None if alone is None else max(0.0, 1.0 - node.pixels / alone)
            found.append(
                {
                    "id": number,
                    "name": self._names.get(number, ""),
                    "pixels": node.pixels,
                    "box": _on_sheet(node.box, panel),
                    "alone": alone,
                    "hidden": hidden,
                }
            )
        return found

    def _materials_of(self, table: list[Shown], panel: Panel) -> list[dict[str, Any]]:
        places = {id(material): number for number, material in enumerate(self._materials)}
        by_material: dict[int, list[Shown]] = {}
        meshes = {node.id: mesh_of_node(node) for node in self._nodes}
        for shown in table:
            mesh, number = meshes[shown.key >> _MATERIAL_BITS], shown.key & _MOST_MATERIALS
            if number < len(mesh.materials):
                place = places[id(mesh.materials[number])]
                by_material.setdefault(place, []).append(shown)
        found = []
        for place in sorted(by_material):
            material = joined(by_material[place], place)
            found.append(
                {
                    "index": place,
                    "name": printable(self._materials[place].name),
                    "pixels": material.pixels,
                    "box": _on_sheet(material.box, panel),
                }
            )
        return found


_MOST_MATERIALS = (1 << _MATERIAL_BITS) - 1


def _count(panel: Panel) -> list[Shown]:
    """Return the pixels of each material of each node; keys have the node's ID in the high bits."""
    keys = panel.frame.object_id.astype(np.int64) << _MATERIAL_BITS
    keys += np.clip(panel.frame.material_id, 0, _MOST_MATERIALS)
    return count_by_key(keys, panel.shown)


def _times(node) -> int:
    return len(node.object.poses) if isinstance(node.object, InstancedMesh) else 1


def _materials_of(nodes) -> list:
    """Return the materials of nodes, each once, in order."""
    materials = (m for node in nodes for m in mesh_of_node(node).materials)
    return list({id(material): material for material in materials}.values())


def _material(number: int, material) -> dict[str, Any]:
    color, alpha = split_alpha(material.color)
    return {
        "index": number,
        "name": printable(material.name),
        "color": [float(c) for c in linear_color(color)],
        "alpha": float(alpha),
        "alpha_mode": material.alpha_mode,
        "two_sided": material.two_sided,
        "physical": material.is_physical,
    }


def _camera(panel: Panel, origin) -> dict[str, Any]:
    camera, pose = panel.camera, panel.pose
    _, up, back = (pose[:3, k] for k in range(3))
    target = panel.extent.middle
    away = sum((p - t) * b for p, t, b in zip(pose[:3, 3], target, back, strict=True))
    sight = (-back).tolist()
    aim = [p + s * float(away) for p, s in zip(pose[:3, 3].tolist(), sight, strict=True)]
    report: dict[str, Any] = {
        "projection": _projection_name(camera, panel),
        "position": _moved(pose[:3, 3], origin),
        "target": _moved(aim, origin),
        "direction": [s + 0.0 for s in sight],
        "up": [u + 0.0 for u in up.tolist()],
        "znear": _finite(camera.znear),
        "zfar": _finite(camera.zfar),
    }
    if panel.scale is not None:
        report["scale"] = panel.scale
    if isinstance(camera, OrthographicCamera):
        report["ymag"] = camera.ymag
    if isinstance(camera, PerspectiveCamera):
        report["yfov"] = camera.yfov
    report |= {
        name: [[value + 0.0 for value in row] for row in matrix.tolist()]
        for name, matrix in panel.matrices._asdict().items()
    }
    return report


def _projection_name(camera: Camera, panel: Panel) -> str:
    projection = np.array(camera.projection((panel.rectangle.width, panel.rectangle.height)))
    return "orthographic" if is_parallel_projection(projection) else "perspective"


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None


def _moved(position, origin) -> list[float]:
    return [float(p) + o for p, o in zip(position, origin, strict=True)]


def _on_sheet(box: tuple[int, int, int, int], panel: Panel) -> list[int]:
    x, y, width, height = box
    return [x + panel.rectangle.x, y + panel.rectangle.y, width, height]
