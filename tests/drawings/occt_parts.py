"""Parts modelled with Open CASCADE, their tessellation, and its own drawings of them."""

import math
import time

import numpy as np
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeWire,
)
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.BRepLib import BRepLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipe
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt, gp_Vec
from OCP.HLRAlgo import HLRAlgo_Projector
from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape, HLRBRep_PolyAlgo, HLRBRep_PolyHLRToShape
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_REVERSED
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound

import engine3d as e3d

Z = (0, 0, 1)
#: Of a frame that holds every part, in millimetres.
WIDTH = 200.0


def box(x, y, z, at=(0, 0, 0)):
    return BRepPrimAPI_MakeBox(gp_Pnt(*at), x, y, z).Shape()


def cylinder(radius, height, at=(0, 0, 0), along=Z):
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*at), gp_Dir(*along)), radius, height).Shape()


def sphere(radius, at=(0, 0, 0)):
    return BRepPrimAPI_MakeSphere(gp_Pnt(*at), radius).Shape()


def cut(shape, *tools):
    for tool in tools:
        shape = BRepAlgoAPI_Cut(shape, tool).Shape()
    return shape


def fuse(shape, *others):
    for other in others:
        shape = BRepAlgoAPI_Fuse(shape, other).Shape()
    unified = ShapeUpgrade_UnifySameDomain(shape)
    unified.Build()
    return unified.Shape()


def compound(*shapes):
    made, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(made)
    for shape in shapes:
        builder.Add(made, shape)
    return made


def prism(points, height):
    polygon = BRepBuilderAPI_MakePolygon()
    for x, y in points:
        polygon.Add(gp_Pnt(x, y, 0))
    polygon.Close()
    face = BRepBuilderAPI_MakeFace(polygon.Wire()).Face()
    return BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, height)).Shape()


def around(count, radius):
    turns = (2 * math.pi * k / count for k in range(count))
    return [(radius * math.cos(turn), radius * math.sin(turn)) for turn in turns]


def block():
    return cut(
        box(60, 40, 20),
        *(cylinder(5, 30, (x, y, -5)) for x in (12, 48) for y in (10, 30)),
        cylinder(7, 80, (-10, 20, 10), (1, 0, 0)),
    )


def flange():
    body = fuse(cylinder(40, 8), cylinder(18, 30))
    holes = [cylinder(4, 20, (x, y, -5)) for x, y in around(6, 29)]
    return cut(body, cylinder(12, 50, (0, 0, -5)), *holes)


def bracket():
    body = fuse(box(50, 40, 8), box(8, 40, 45), prism([(8, 8), (30, 8), (8, 30)], 6))
    return cut(body, cylinder(6, 30, (35, 20, -5)), cylinder(8, 30, (-5, 20, 30), (1, 0, 0)))


def gear(teeth=18):
    points = []
    for k in range(teeth):
        for turn, radius in ((0, 20), (0.2, 25), (0.5, 25), (0.7, 20)):
            angle = 2 * math.pi * (k + turn) / teeth
            points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return cut(prism(points, 10), cylinder(6, 30, (0, 0, -5)), box(3, 4, 30, (5, -2, -5)))


def shaft():
    body = fuse(cylinder(10, 30), cylinder(14, 20, (0, 0, 30)), cylinder(8, 25, (0, 0, 50)))
    body = cut(body, box(4, 6, 15, (-2, 7, 5)))
    fillet = BRepFilletAPI_MakeFillet(body)
    explorer = TopExp_Explorer(body, TopAbs_EDGE)
    while explorer.More():
        edge = TopoDS.Edge(explorer.Current())
        curve = BRepAdaptor_Curve(edge)
        middle = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)
        if abs(middle.Z() - 30) < 1e-6 and math.hypot(middle.X(), middle.Y()) > 9.9:
            fillet.Add(1.5, edge)
        explorer.Next()
    return fillet.Shape()


def pipe():
    ring = BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 20, 5).Shape()
    path = gp_Circ(gp_Ax2(gp_Pnt(0, 0, 12), gp_Dir(1, 0, 0)), 25)
    spine = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(path, 0.3, 2.6).Edge()).Wire()
    start = gp_Pnt(0, 25 * math.cos(0.3), 12 + 25 * math.sin(0.3))
    way = gp_Dir(0, -math.sin(0.3), math.cos(0.3))
    circle = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(start, way), 4)).Edge()
    profile = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(circle).Wire()).Face()
    return compound(ring, BRepOffsetAPI_MakePipe(spine, profile).Shape())


def ball():
    return cut(
        fuse(sphere(20), cylinder(9, 60, (-30, 0, 0), (1, 0, 0))), cylinder(6, 80, (0, 0, -40))
    )


def plate():
    holes = [cylinder(2.2, 10, (8 + 9 * i, 8 + 9 * k, -5)) for i in range(8) for k in range(5)]
    return cut(box(80, 52, 2), *holes)


def thread():
    return fuse(cylinder(6, 40), *(cylinder(8, 1.5, (0, 0, 3 * k + 2)) for k in range(12)))


def assembly():
    return compound(
        block(),
        *(cylinder(4.8, 35, (x, y, -4)) for x in (12, 48) for y in (10, 30)),
        box(60, 40, 5, (0, 0, 24)),
        sphere(8, (30, 20, 38)),
    )


PARTS = (block, flange, bracket, gear, shaft, pipe, ball, plate, thread, assembly)
VIEWS = {
    "front": ((0, -1, 0), (1, 0, 0)),
    "top": ((0, 0, 1), (1, 0, 0)),
    "iso": ((1, -1, 1), (1, 1, 0)),
    "slant": ((0.4, -0.83, 0.31), (0.9, 0.35, -0.2)),
}


def tessellate(shape, deflection=0.1):
    """Return positions (V, 3) and faces (F, 3) of each solid or loose face of a shape."""
    BRepMesh_IncrementalMesh(shape, deflection, False, 0.3, False)
    positions, faces, count = [], [], 0
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        face, location = TopoDS.Face(explorer.Current()), TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, location)
        place = location.Transformation()
        nodes = [mesh.Node(k + 1).Transformed(place) for k in range(mesh.NbNodes())]
        positions += [(node.X(), node.Y(), node.Z()) for node in nodes]
        corners = np.array([mesh.Triangle(k + 1).Get() for k in range(mesh.NbTriangles())]) - 1
        if face.Orientation() == TopAbs_REVERSED:
            corners = corners[:, ::-1]
        faces.append(corners + count)
        count += len(nodes)
        explorer.Next()
    return np.array(positions), np.concatenate(faces)


def projector(view):
    toward, across = VIEWS[view]
    return HLRAlgo_Projector(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*toward), gp_Dir(*across)))


def camera(view):
    """Return a camera and its pose that see what `projector` does; a millimetre is one on paper."""
    toward, across = (np.array(way, float) for way in VIEWS[view])
    toward /= np.linalg.norm(toward)
    across -= toward * (across @ toward)
    across /= np.linalg.norm(across)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([across, np.cross(toward, across), toward], axis=1)
    pose[:3, 3] = toward * 500.0
    return e3d.OrthographicCamera(WIDTH / 2, xmag=WIDTH / 2, znear=1.0, zfar=1000.0), pose


def poly_lines(shape, view):
    """Return segments (N, 2, 2), visible and hidden, of the tessellation; and the seconds."""
    start = time.process_time()
    algo = HLRBRep_PolyAlgo()
    algo.Load(shape)
    algo.Projector(projector(view))
    algo.Update()
    to_shape = HLRBRep_PolyHLRToShape()
    to_shape.Update(algo)
    shown = [to_shape.VCompound(), to_shape.OutLineVCompound()]
    hidden = [to_shape.HCompound(), to_shape.OutLineHCompound()]
    seconds = time.process_time() - start
    return _segments(shown), _segments(hidden), seconds


def exact_lines(shape, view):
    """Return segments of the exact algorithm's sharp edges and outlines, as `poly_lines` does."""
    start = time.process_time()
    algo = HLRBRep_Algo()
    algo.Add(shape)
    algo.Projector(projector(view))
    algo.Update()
    algo.Hide()
    to_shape = HLRBRep_HLRToShape(algo)
    shown = [to_shape.VCompound(), to_shape.OutLineVCompound()]
    hidden = [to_shape.HCompound(), to_shape.OutLineHCompound()]
    seconds = time.process_time() - start
    for shape in (*shown, *hidden):
        if shape is not None:
            BRepLib.BuildCurves3d_s(shape)
    return _segments(shown, 200), _segments(hidden, 200), seconds


def _segments(shapes, count=1):
    found = []
    for shape in shapes:
        if shape is None or shape.IsNull():
            continue
        explorer = TopExp_Explorer(shape, TopAbs_EDGE)
        while explorer.More():
            curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
            steps = np.linspace(curve.FirstParameter(), curve.LastParameter(), count + 1)
            points = [(point.X(), point.Y()) for point in map(curve.Value, steps.tolist())]
            found += zip(points, points[1:], strict=False)
            explorer.Next()
    return np.array(found).reshape(-1, 2, 2)
