"""Reader of COLLADA (.dae).

In: the bytes of a file, and the images that it names. Out: a `Document` whose tree has the nodes of
the file's scene, with meshes. Coordinates are the file's; its up direction and unit are told. Skins
show as they were bound; lights, cameras and animations are left out, with a warning.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ....base import linalg
from ....errors import FileFormatError
from ....model.geometry.twins import twin_of
from ....model.materials.material import Material
from ...reading.documents import Document
from ...reading.posed_parts import MAX_REPEATED
from ...reading.reader_registry import Reader
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_elements import Element
from ...scenes.document_trees import MeshRecord, NodeRecord, TreeRecord
from ...scenes.tree_objects import tree_counts, tree_objects
from ..threemf.threemf_model import METRES
from .dae_file import DaeFile
from .dae_geometry import DaeMesh, GeometryReader
from .dae_looks import Looks

_UP = {"X_UP": "+X", "Y_UP": "+Y", "Z_UP": "+Z"}
# What is not drawn -> how it is called.
_LEFT_OUT = {
    "instance_camera": "cameras",
    "instance_light": "lights",
    "instance_physics_scene": "physics",
}
# Nodes may be repeated, and may repeat nodes.
_MOST_NODES, _MOST_DEPTH = 1 << 16, 64


def read_dae(source: Source, split: bool = False) -> Document:
    """Read a COLLADA file, as `Reader.read`; each mesh of a node is an object."""
    if not source.head(64).lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n\0").startswith(b"<"):
        raise FileFormatError("not a dae file", source.path)
    warnings = WarningList(source.path)
    file = DaeFile(source, warnings)
    tree = _Nodes(file).tree()
    if not any(len(record.mesh.positions) for record in tree.meshes):
        raise FileFormatError("no vertices in this file", source.path)
    if file.root.first("library_animations", "animation") is not None:
        warnings.add("animations of COLLADA are left out")
    unit = _unit(file)
    objects = tree_objects(source, tree, MAX_REPEATED + source.size, split)
    return Document(
        "dae",
        objects,
        counts=tree_counts(tree, objects),
        warnings=warnings.messages(),
        tree=tree,
        unit=unit,
        up=_up(file),
    )


def _up(file: DaeFile) -> str:
    axis = file.root.first("asset", "up_axis")
    return _UP.get("Y_UP" if axis is None else axis.text.strip(), "+Y")


def _unit(file: DaeFile) -> str:
    """Return the symbol of the file's unit; empty, with a warning, for one that has none."""
    unit = file.root.first("asset", "unit")
    text = "1" if unit is None else unit.attributes.get("meter", "1")
    try:
        metres = float(text)
    except ValueError:
        metres = 1.0
    symbol = next((s for s, m in METRES.items() if abs(metres - m) <= 1e-6 * m), "")
    if not symbol and unit is not None:
        file.warn(f"a unit of {shown(text)} metres is not known: lengths stay", unit)
    return symbol


class _Nodes:
    """Reads the nodes of a file's scene."""

    def __init__(self, file: DaeFile) -> None:
        self._file = file
        self._geometries, self._looks = GeometryReader(file), Looks(file)
        self._nodes: list[NodeRecord] = []
        self._meshes: list[MeshRecord] = []
        self._shown: dict[tuple[int, ...], int] = {}
        self._told: set[str] = set()

    def tree(self) -> TreeRecord:
        """Return the tree of the scene; without one, of all geometries."""
        shown_scene = self._file.root.first("scene", "instance_visual_scene")
        if shown_scene is None:
            library = self._file.root.first("library_geometries")
            geometries = [] if library is None else library.all("geometry")
            for geometry in geometries:
                self._put(NodeRecord(name=geometry.attributes.get("name", "")), geometry, {})
            roots = tuple(range(len(self._nodes)))
        else:
            url = shown_scene.attributes.get("url", "")
            scene = self._file.named(url, shown_scene, "visual_scene")
            roots = tuple(self._node(node, 0) for node in scene.all("node"))
        return TreeRecord(
            nodes=tuple(self._nodes),
            roots=roots,
            meshes=tuple(self._meshes),
            materials=self._looks.materials,
        )

    def _node(self, node: Element, depth: int) -> int:
        """Add a node with those below it; return its number."""
        file = self._file
        if depth > _MOST_DEPTH or len(self._nodes) > _MOST_NODES:
            raise file.fault(
                f"nodes are nested more than {_MOST_DEPTH} deep, or more than {_MOST_NODES}", node
            )
        name = node.attributes.get("name") or node.attributes.get("id", "")
        number = len(self._nodes)
        self._nodes.append(NodeRecord(name=name, matrix=self._pose(node)))
        below: list[int] = []
        for child in node.children:
            if child.name == "node":
                below.append(self._node(child, depth + 1))
            elif child.name == "instance_node":
                url = child.attributes.get("url", "")
                below.append(self._node(file.named(url, child, "node"), depth + 1))
            elif child.name in ("instance_geometry", "instance_controller"):
                geometry = self._geometry(child)
                if geometry is not None:
                    below.append(self._put(NodeRecord(name=name), geometry, _bound(child)))
            elif child.name in _LEFT_OUT and child.name not in self._told:
                self._told.add(child.name)
                file.warn(f"{_LEFT_OUT[child.name]} of COLLADA are left out", child)
        self._nodes[number] = replace(
            self._nodes[number], children=tuple(one for one in below if one >= 0)
        )
        return number

    def _put(self, node: NodeRecord, geometry: Element, bound: dict[str, str]) -> int:
        """Add a node that shows a geometry; return its number, -1 if there is nothing to show."""
        made = self._geometries.mesh(geometry)
        if made is None:
            return -1
        self._nodes.append(replace(node, mesh=self._mesh(made, bound)))
        return len(self._nodes) - 1

    def _mesh(self, made: DaeMesh, bound: dict[str, str]) -> int:
        """Return the number of a mesh with the materials that a node gives to its symbols."""
        materials = [
            self._looks.material(bound.get(symbol, symbol)) or Material() for symbol in made.symbols
        ]
        key = id(made.mesh), *(id(one) if one.name else 0 for one in materials)
        if key not in self._shown:
            self._shown[key] = len(self._meshes)
            mesh = twin_of(made.mesh, materials, made.mesh.name)
            self._meshes.append(MeshRecord(mesh.name, mesh))
        return self._shown[key]

    def _geometry(self, used: Element) -> Element | None:
        """Return the geometry that a node shows; of a skin, the mesh as it was bound."""
        url = used.attributes.get("url", "")
        if used.name == "instance_geometry":
            return self._file.named(url, used, "geometry")
        controller = self._file.named(url, used, "controller")
        skin = controller.first("skin")
        self._file.warn("a skin of COLLADA shows as it was bound", used)
        return (
            None if skin is None else self._file.find(skin.attributes.get("source", ""), "geometry")
        )

    def _pose(self, node: Element) -> np.ndarray | None:
        """Return the product of a node's transforms, in order; None without any."""
        pose = None
        for child in node.children:
            step = self._step(child)
            if step is not None:
                pose = step if pose is None else linalg.multiply(pose, step)
        return pose

    def _step(self, child: Element) -> np.ndarray | None:
        numbers = self._file.numbers
        if child.name == "matrix":
            return numbers(child, 16).reshape(4, 4)
        if child.name == "translate":
            return linalg.translation(numbers(child, 3))
        if child.name == "scale":
            return np.diag([*numbers(child, 3), 1.0])
        if child.name == "rotate":
            *axis, angle = numbers(child, 4).tolist()
            return linalg.rotation_axis(axis, np.radians(angle)) if any(axis) else None
        if child.name in ("lookat", "skew"):
            self._file.warn(f"<{child.name}> of a node is left out", child)
        return None


def _bound(used: Element) -> dict[str, str]:
    """Return the URL of the material that a node gives to each symbol."""
    common = used.first("bind_material", "technique_common")
    given = [] if common is None else common.all("instance_material")
    return {one.attributes.get("symbol", ""): one.attributes.get("target", "") for one in given}


def _resembles(head: bytes, size: int) -> bool:
    return b"<COLLADA" in head


READERS = (Reader("dae", "COLLADA", "mesh", (".dae",), read_dae, resembles=_resembles, up=""),)
