"""Meshes of shapes of Open CASCADE: curved faces as triangles, edges as the model's edges.

In: a ``TopoDS_Shape`` of the package cadquery-ocp, which is imported here when one is converted.
Out: a `Mesh` in the shape's own coordinates. Each face has vertices of its own with the normals of
its surface; its ``edge_visible`` tells the edges of the model from those between triangles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material

#: How far a triangle may be from its surface, in diagonals of the shape, and radians.
LINEAR, ANGULAR = 1e-3, 0.25
#: Open CASCADE's own precision: it refuses to go below.
_FINEST = 1e-7


def shape_mesh(
    shape: Any,
    name: str = "",
    material_of: Callable[[Any], Material] | None = None,
    tolerance: float | None = None,
) -> Mesh:
    """Return the mesh of a shape: faces, and the edges and vertices that belong to none.

    Parameters
    ----------
    shape : TopoDS_Shape
        It keeps its triangles, which later calls with the same tolerance use.
    name : str
    material_of : callable, optional
        Returns the material of a ``TopoDS_Face``.
    tolerance : float, optional
        How far triangles and segments may be from the shape, in its units; by default a thousandth
        of its diagonal.
    """
    linear = max(LINEAR * diagonal_of(shape) if tolerance is None else tolerance, _FINEST)
    _tessellate(shape, linear)
    parts = _Parts()
    for face in explored(shape, "FACE"):
        parts.add_face(face, None if material_of is None else material_of(face))
    for edge in explored(shape, "EDGE", avoid="FACE"):
        parts.add_edge(edge, linear)
    for vertex in explored(shape, "VERTEX", avoid="EDGE"):
        parts.add_vertex(vertex)
    return parts.mesh(name)


def diagonal_of(shape: Any) -> float:
    """Return the length of the diagonal of a shape's box; 1 for empty shapes and points."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box, False)
    if box.IsVoid():
        return 1.0
    return float(box.SquareExtent()) ** 0.5 or 1.0


def _tessellate(shape: Any, linear: float) -> None:
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    if not BRepTools.Triangulation_s(shape, linear):
        # In one thread, and so always the same.
        BRepMesh_IncrementalMesh(shape, linear, False, ANGULAR, False)


def explored(shape: Any, kind: str, avoid: str | None = None) -> Iterator[Any]:
    """Yield the parts of a shape of a kind, such as ``"FACE"``, that belong to no other kind."""
    from OCP import TopAbs, TopExp, TopoDS

    wanted = getattr(TopAbs, f"TopAbs_{kind}")
    refused = TopAbs.TopAbs_SHAPE if avoid is None else getattr(TopAbs, f"TopAbs_{avoid}")
    explorer = TopExp.TopExp_Explorer(shape, wanted, refused)
    # Its name has depended on the version of the package.
    casts = TopoDS.TopoDS
    cast = getattr(casts, f"{kind.title()}_s", None) or getattr(casts, kind.title())
    while explorer.More():
        yield cast(explorer.Current())
        explorer.Next()


class _Parts:
    """Collects the arrays of a mesh."""

    def __init__(self) -> None:
        self._points: list[NDArray[np.float64]] = [np.zeros((0, 3))]
        self._normals: list[NDArray[np.float64]] = [np.zeros((0, 3))]
        self._faces: list[NDArray[np.int64]] = [np.zeros((0, 3), np.int64)]
        self._visible: list[NDArray[np.bool_]] = [np.zeros((0, 3), bool)]
        self._lines: list[NDArray[np.int64]] = [np.zeros((0, 2), np.int64)]
        self._dots: list[int] = []
        self._materials: list[Material] = []
        self._material_ids: list[NDArray[np.int64]] = [np.zeros(0, np.int64)]
        self._count = 0

    def add_face(self, face: Any, material: Material | None) -> None:
        """Add the triangles of a face, if it has some, in a material."""
        from OCP.BRep import BRep_Tool
        from OCP.BRepLib import BRepLib_ToolTriangulatedShape
        from OCP.TopAbs import TopAbs_REVERSED
        from OCP.TopLoc import TopLoc_Location

        place = TopLoc_Location()
        made = BRep_Tool.Triangulation_s(face, place)
        if made is None or not made.NbTriangles():
            return
        BRepLib_ToolTriangulatedShape.ComputeNormals_s(face, made)
        pose = _pose_of(place)
        numbers = range(1, made.NbNodes() + 1)
        points = linalg.transform_points(pose, _coordinates(made.Node(n) for n in numbers))
        normals = linalg.transform_directions(pose, _coordinates(made.Normal(n) for n in numbers))
        corners = [made.Triangle(n).Get() for n in range(1, made.NbTriangles() + 1)]
        faces = np.array(corners, np.int64).reshape(-1, 3) - 1
        if face.Orientation() == TopAbs_REVERSED:  # normals and corners are those of its surface
            faces, normals = faces[:, ::-1], -normals
        faces = faces[_have_area(points.astype(np.float32), faces)]
        self._visible.append(_visible_sides(face, made, place, faces))
        self._faces.append(faces + self._count)
        self._material_ids.append(np.full(len(faces), self._number_of(material), np.int64))
        self._add_points(points, normals)

    def add_edge(self, edge: Any, linear: float) -> None:
        """Add an edge that belongs to no face, as segments."""
        from OCP.BRep import BRep_Tool
        from OCP.BRepAdaptor import BRepAdaptor_Curve
        from OCP.GCPnts import GCPnts_TangentialDeflection

        if BRep_Tool.Degenerated_s(edge):
            return
        cut = GCPnts_TangentialDeflection(BRepAdaptor_Curve(edge), ANGULAR, linear)
        points = _coordinates(cut.Value(n) for n in range(1, cut.NbPoints() + 1))
        first = np.arange(len(points) - 1) + self._count
        self._lines.append(np.stack([first, first + 1], axis=1))
        self._add_points(points, np.zeros_like(points))

    def add_vertex(self, vertex: Any) -> None:
        """Add a vertex that belongs to no edge, as a point."""
        from OCP.BRep import BRep_Tool

        self._dots.append(self._count)
        self._add_points(_coordinates([BRep_Tool.Pnt_s(vertex)]), np.zeros((1, 3)))

    def _add_points(self, points: NDArray[np.float64], normals: NDArray[np.float64]) -> None:
        self._points.append(points)
        self._normals.append(normals)
        self._count += len(points)

    def _number_of(self, material: Material | None) -> int:
        if material is None:
            return 0
        known = [one is material for one in self._materials]
        if True not in known:
            self._materials.append(material)
            return len(known)
        return known.index(True)

    def mesh(self, name: str) -> Mesh:
        """Return the mesh of all that was added."""
        faces = np.concatenate(self._faces)
        return Mesh(
            np.concatenate(self._points),
            faces,
            normals=np.concatenate(self._normals) if len(faces) else None,
            edge_visible=np.concatenate(self._visible),
            lines=np.concatenate(self._lines),
            points=self._dots,
            materials=self._materials or None,
            material_ids=np.concatenate(self._material_ids),
            name=name,
        )


def _coordinates(points: Any) -> NDArray[np.float64]:
    return np.array([(p.X(), p.Y(), p.Z()) for p in points], np.float64).reshape(-1, 3)


def _pose_of(place: Any) -> NDArray[np.float64]:
    return pose_matrix(place.Transformation())


def pose_matrix(moved: Any) -> NDArray[np.float64]:
    """Return the matrix of a ``gp_Trsf``, (4, 4)."""
    pose = np.eye(4)
    for row in range(3):
        for column in range(4):
            pose[row, column] = moved.Value(row + 1, column + 1)
    return pose


def _have_area(points: NDArray[np.float32], faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which faces have three different corners; at poles of spheres, two are the same."""
    corners = points[faces]
    same = (corners == np.roll(corners, -1, axis=1)).all(axis=2)
    return ~np.asarray(same.any(axis=1))


def _visible_sides(face: Any, made: Any, place: Any, faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which sides of a face's triangles lie on edges of the model, (F, 3).

    The seam where a face meets itself, as that of a cylinder, is none.
    """
    from OCP.BRep import BRep_Tool

    keys = [np.zeros(0, np.int64)]
    count = made.NbNodes()
    for edge in explored(face, "EDGE"):
        if BRep_Tool.Degenerated_s(edge) or BRep_Tool.IsClosed_s(edge, face):
            continue
        line = BRep_Tool.PolygonOnTriangulation_s(edge, made, place)
        if line is not None:
            nodes = np.array([line.Node(n) - 1 for n in range(1, line.NbNodes() + 1)], np.int64)
            keys.append(_keys(nodes[:-1], nodes[1:], count))
    sides = _keys(faces.ravel(), np.roll(faces, -1, axis=1).ravel(), count)
    return np.isin(sides, np.concatenate(keys)).reshape(-1, 3)


def _keys(a: NDArray[np.int64], b: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    keys: NDArray[np.int64] = np.minimum(a, b) * count + np.maximum(a, b)
    return keys
