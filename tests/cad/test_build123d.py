"""Objects of build123d and of OCP, drawn and measured, against what the library itself says."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.io.cad.shape_meshes import shape_mesh
from engine3d.io.scenes.other_libraries import library_of, scene_of_library
from engine3d.measuring import check, measure

b = pytest.importorskip("build123d", exc_type=ImportError)


def plate():
    made = b.Box(40, 60, 20) - b.Cylinder(10, 40)
    return b.fillet(made.edges().filter_by(b.Axis.Z), 5)


def assembly():
    body, pin, ball = plate(), b.Cylinder(9.5, 50), b.Sphere(12).moved(b.Location((0, 45, 10)))
    body.label, body.color = "plate", b.Color("orange")
    pin.label, pin.color = "pin", b.Color(0.2, 0.4, 0.9, 0.5)
    ball.label = "ball"
    return b.Compound(label="assembly", children=[body, pin, ball])


@pytest.mark.parametrize(
    "make",
    [
        plate,
        lambda: b.Box(1, 2, 3),
        lambda: b.Sphere(5),
        lambda: b.Torus(10, 3),
        lambda: b.Cone(4, 1, 6),
        lambda: b.extrude(b.Text("e3", 10), 2),
        lambda: b.mirror(plate(), b.Plane.YZ),
        lambda: b.Box(1, 1, 1).moved(b.Location((1e4, 0, 0))),
    ],
)
def test_bodies_are_watertight_and_of_their_volume(make):
    body = make()
    scene = scene_of_library(body)
    found = measure(scene)
    assert found.watertight and not check(scene).any
    assert found.volume == pytest.approx(body.volume, rel=0.02)
    box = body.bounding_box()
    np.testing.assert_allclose(found.bounds[1] - found.bounds[0], tuple(box.size), rtol=0.02)


@pytest.mark.parametrize("make", [plate, lambda: b.Sphere(5), lambda: b.mirror(b.Sphere(2))])
def test_normals_look_outward(make):
    (node,) = scene_of_library(make()).nodes
    mesh = node.object
    a, b, c = mesh.positions[mesh.faces].astype(float).transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    assert ((mesh.normals[mesh.faces] * across[:, np.newaxis]).sum(axis=2) > 0.85).all()


def test_visible_edges_are_those_of_the_model():
    (node,) = scene_of_library(b.Box(2, 2, 2)).nodes
    lengths = np.linalg.norm(np.diff(node.object.positions[node.object.edges()], axis=1), axis=2)
    np.testing.assert_allclose(lengths, 2)  # and no diagonals
    (node,) = scene_of_library(b.Cylinder(1, 2)).nodes
    heights = node.object.positions[node.object.edges()][..., 2]
    assert (heights[:, 0] == heights[:, 1]).all()  # two circles, and no seam


def test_assemblies_keep_names_colours_and_places():
    made = assembly().moved(b.Location((100, 0, 0), (0, 0, 30)))
    scene = scene_of_library(made)
    assert [node.name for node in scene.nodes] == ["plate", "pin", "ball"]
    for node, child in zip(scene.nodes, made.children, strict=True):
        center = tuple(child.global_location.position)
        np.testing.assert_allclose(node.pose[:3, 3], center, atol=1e-6)
    found, expected = measure(scene).bounds, made.bounding_box()
    np.testing.assert_allclose(found[0], tuple(expected.min), atol=0.5)
    np.testing.assert_allclose(found[1], tuple(expected.max), atol=0.5)
    orange, blue, plain = (node.object.materials[0] for node in scene.nodes)
    assert tuple(orange.color)[:3] == pytest.approx((1, 0.376, 0), abs=0.01)  # linear light
    assert blue.alpha_mode == "blend" and blue.color[3] == pytest.approx(0.5)
    assert not plain.name


def test_repeated_shapes_are_one_mesh():
    pin = b.Cylinder(1, 5)
    pins = [pin.moved(b.Location((3 * k, 0, 0))) for k in range(4)]
    scene = scene_of_library(pins)
    assert len({id(node.object) for node in scene.nodes}) == 1
    assert [node.pose[0, 3] for node in scene.nodes] == [0, 3, 6, 9]


def test_sketches_lines_and_builders_are_drawn():
    sketch = scene_of_library(b.Rectangle(4, 2))
    assert measure(sketch).area == pytest.approx(8)
    (node,) = scene_of_library(b.Edge.make_circle(3)).nodes
    ends = node.object.positions[node.object.lines]
    assert len(ends) > 12 and not len(node.object.faces)
    np.testing.assert_allclose(np.linalg.norm(ends, axis=2), 3, rtol=1e-6)
    with b.BuildPart() as part:
        b.Box(1, 1, 1)
    assert measure(scene_of_library(part)).volume == pytest.approx(1)
    with b.BuildSketch() as drawn:
        b.Circle(1)
    assert measure(scene_of_library(drawn)).area == pytest.approx(np.pi, rel=0.02)


def test_pictures_have_thin_lines_and_stand_upright():
    tall = b.Box(10, 10, 60)
    frame = e3d.render(tall, size=(120, 160), outputs=("color", "object_id"))
    rows = np.flatnonzero((frame.object_id == 0).any(axis=1))
    columns = np.flatnonzero((frame.object_id == 0).any(axis=0))
    assert np.ptp(rows) > 2 * np.ptp(columns)
    bare = e3d.Look.studio(feature_edges=False)
    without = e3d.render(tall, size=(120, 160), look=bare)
    assert (frame.color != without.color).any()


def test_tolerance_goes_with_size():
    counts = [len(shape_mesh(b.Sphere(size).wrapped).faces) for size in (0.01, 1, 100)]
    assert max(counts) < 1.3 * min(counts)
    fine = shape_mesh(b.Sphere(1.1).wrapped, tolerance=1e-4)
    assert len(fine.faces) > 2 * counts[1]


def test_shapes_of_ocp_itself_and_lists_are_known():
    assert library_of(b.Box(1, 1, 1).wrapped) == "OCP"
    assert library_of([b.Box(1, 1, 1), b.Sphere(1)]) == "build123d"
    assert library_of([b.Box(1, 1, 1), 3]) is None and library_of([]) is None
    assert len(scene_of_library([b.Box(1, 1, 1), b.Sphere(1)]).nodes) == 2
    with pytest.raises(e3d.InvalidArgumentError, match="can be drawn"):
        e3d.render(b.Location((1, 2, 3)))


@pytest.mark.parametrize("make", [b.Compound, b.Part, b.Sketch, lambda: [b.Part(), b.Sketch()]])
def test_empty_shapes_are_no_shapes(make):
    assert scene_of_library(make()) is None
    with pytest.raises(
        e3d.InvalidArgumentError, match="of build123d holds nothing that can be drawn"
    ):
        e3d.render(make())


def test_empty_shapes_leave_the_others():
    (node,) = scene_of_library([b.Part(), b.Box(1, 1, 1), b.Compound()]).nodes
    assert len(node.object.faces) == 12


@pytest.mark.parametrize("size", [1e-5, 1e-4, 1e-3, 1e6])
def test_tiny_and_huge_shapes_have_their_size(size):
    bounds = measure(scene_of_library(b.Box(size, size, size))).bounds
    np.testing.assert_allclose(bounds[1] - bounds[0], size, rtol=1e-3)
