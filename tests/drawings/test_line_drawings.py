"""Line drawings of scenes: lengths that are known, and views that must agree."""

import math
import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d.drawings import line_drawing

UP = e3d.OrthographicCamera(ymag=5.0, znear=0.1, zfar=100.0)
ABOVE = e3d.look_at((0, 0, 20), (0, 0, 0), (0, 1, 0))
ASLANT = e3d.look_at((9, 7, 12), (0, 0, 0), (0, 1, 0))
#: Ten units are a thousand pixels.
SIZE = (1000, 1000)
UNIT = 100 * 25.4 / 96


def draw(scene, pose=ABOVE, camera=UP, **options):
    return line_drawing(scene, (camera, pose), size=SIZE, **options)


def lengths(drawing):
    """Return the lengths of visible and hidden lines, in world units."""
    return tuple(drawing.pieces.of(hidden=hidden).length / UNIT for hidden in (False, True))


def test_a_box_from_above_is_a_rectangle():
    drawing = draw(e3d.box((2.0, 3.0, 1.0)))
    assert lengths(drawing) == pytest.approx((10.0, 0.0))
    (one,) = drawing.strokes("outline")
    (line,) = one.polylines
    assert len(line) == 5 and line[0] == line[-1]


def test_a_box_aslant_shows_nine_edges_and_hides_three():
    drawing = draw(e3d.box((2.0, 3.0, 1.0)), ASLANT)
    assert drawing.pieces.of(hidden=True).length > 0
    hidden = [line for one in drawing.strokes("crease", True) for line in one.polylines]
    assert sum(len(line) - 1 for line in hidden) == 3


def test_a_sphere_has_one_round_outline():
    drawing = draw(e3d.icosphere(2.0, subdivisions=5))
    shown, hidden = lengths(drawing)
    assert shown == pytest.approx(4 * math.pi, rel=3e-3)
    assert hidden < 0.01 * shown
    (one,) = drawing.strokes("outline")
    assert max(map(len, one.polylines)) > 50


def test_a_plate_hides_what_is_below_it_exactly():
    scene = e3d.Scene()
    scene.add(e3d.box((2.0, 2.0, 0.1)), name="plate", translation=(0.3, 0, 1))
    scene.add(e3d.box((6.0, 0.5, 0.5)), name="bar")
    drawing = draw(scene)
    # The bar's long sides are hidden along the plate's width.
    assert lengths(drawing) == pytest.approx((8.0 + 13.0 - 4.0, 4.0), rel=1e-6)
    assert drawing.parts == ("plate", "bar")


def test_faces_that_touch_do_not_hide_each_others_lines():
    scene = e3d.Scene()
    scene.add(e3d.box((4.0, 4.0, 1.0)))
    scene.add(e3d.box((1.0, 1.0, 1.0)))  # its top lies in that of the other
    assert lengths(draw(scene)) == pytest.approx((20.0, 0.0), rel=1e-6)


def test_parts_that_cross_have_lines_there():
    scene = e3d.Scene()
    scene.add(e3d.box((4.0, 4.0, 1.0)))
    scene.add(e3d.cylinder(1.0, 4.0, segments=64), rotation=(math.sqrt(0.5), 0, 0, math.sqrt(0.5)))
    with_lines = draw(scene, ASLANT)
    without = draw(scene, ASLANT, intersections=False)
    assert with_lines.pieces.of("intersection", False).length > 2 * UNIT
    assert without.pieces.of("intersection").length == 0
    for kind in ("outline", "crease"):
        one, other = (d.pieces.of(kind, False).length for d in (with_lines, without))
        assert one == pytest.approx(other, rel=1e-3)


def test_instances_are_as_nodes():
    rng = np.random.default_rng(3)
    places = rng.uniform(-3, 3, (12, 3))
    poses = np.tile(np.eye(4), (12, 1, 1))
    poses[:, :3, 3] = places
    together, apart = e3d.Scene(), e3d.Scene()
    together.add(e3d.InstancedMesh(e3d.box(0.9), poses), name="boxes")
    for place in places.astype(np.float32):
        apart.add(e3d.box(0.9), translation=place)
    one, other = draw(together, ASLANT), draw(apart, ASLANT)
    assert lengths(one) == pytest.approx(lengths(other), rel=1e-6)
    assert one.parts[3] == "boxes 3"


@pytest.mark.parametrize("scale", [1e-4, 1e4])
@pytest.mark.parametrize("kind", ["parallel", "perspective"])
def test_units_do_not_matter(scale, kind):
    def scene_at(scale):
        scene = e3d.Scene()
        scene.add(e3d.torus(1.0, 0.4), scale=scale, translation=np.array((0.5, 0, 0)) * scale)
        scene.add(e3d.box((3.0, 1.0, 1.0)), scale=scale)
        pose = ASLANT.copy()
        pose[:3, 3] *= scale
        if kind == "parallel":
            return (
                scene,
                e3d.OrthographicCamera(5 * scale, znear=0.1 * scale, zfar=99 * scale),
                pose,
            )
        return scene, e3d.PerspectiveCamera(0.5, znear=0.1 * scale, zfar=99 * scale), pose

    found = []
    for size in (1.0, scale):
        scene, camera, pose = scene_at(size)
        found.append(lengths(draw(scene, pose, camera)))
    assert found[0] == pytest.approx(found[1], rel=1e-4)


def test_winding_does_not_matter():
    mesh = e3d.torus(2.0, 0.7)
    faces = mesh.faces.copy()
    flips = np.random.default_rng(1).random(len(faces)) < 0.5
    faces[flips] = faces[flips, ::-1]
    one = draw(e3d.Mesh(mesh.positions, mesh.faces), ASLANT)
    other = draw(e3d.Mesh(mesh.positions, faces), ASLANT)
    assert lengths(one) == pytest.approx(lengths(other), rel=1e-9)


def test_a_parallel_view_from_afar_is_as_a_perspective_one():
    scene = e3d.Scene()
    scene.add(e3d.torus(2.0, 0.7))
    scene.add(e3d.box((1.0, 5.0, 1.0)))
    away = ASLANT.copy()
    away[:3, 3] *= 1e4
    distance = float(np.linalg.norm(away[:3, 3]))
    far = e3d.PerspectiveCamera(
        2 * math.atan(5.0 / distance), znear=distance / 2, zfar=2 * distance
    )
    near = draw(scene, ASLANT)
    assert lengths(draw(scene, away, far)) == pytest.approx(lengths(near), rel=2e-3)


def test_what_is_behind_the_camera_is_not_drawn():
    scene = e3d.Scene()
    scene.add(e3d.box((2.0, 2.0, 30.0)))  # the camera stands in it
    camera = e3d.PerspectiveCamera(1.0, znear=0.01)
    inside = e3d.look_at((0.2, 0.1, 5), (0, 0, -20), (0, 1, 0))
    drawing = draw(scene, inside, camera)
    ends = drawing.pieces.ends
    assert len(ends) and np.isfinite(ends).all()
    assert ends.min() >= -1e-6 and ends.max() <= drawing.size[0] + 1e-6
    # The end of the tunnel, and the four edges that lead there.
    assert drawing.pieces.of(hidden=True).length == 0


def test_lines_are_hidden_and_points_are_warned_of():
    scene = e3d.Scene()
    mesh = e3d.Mesh([[-3, 0, 0], [3, 0, 0], [0, 3, 0]], lines=[[0, 1]], points=[2])
    scene.add(mesh, name="wire")
    scene.add(e3d.box((2.0, 2.0, 2.0)))
    with pytest.warns(e3d.errors.Engine3DWarning, match="wire: a line drawing has no points"):
        drawing = draw(scene)
    assert drawing.pieces.of("line", False).length / UNIT == pytest.approx(4.0)
    assert drawing.pieces.of("line", True).length / UNIT == pytest.approx(2.0)


def test_nothing_is_a_warning():
    with pytest.warns(e3d.errors.Engine3DWarning, match="no lines"):
        assert len(draw(e3d.Scene()).pieces.ends) == 0
    scene = e3d.Scene()
    scene.add(e3d.box()).visible = False
    with pytest.warns(e3d.errors.Engine3DWarning, match="no lines"):
        draw(scene)


def test_instances_without_a_place_leave_the_others():
    poses = np.stack([np.eye(4), np.eye(4)])
    poses[1, 0, 3] = np.nan
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.box(), poses), name="crowd")
    with pytest.warns(e3d.errors.Engine3DWarning, match="crowd: 1 of its poses"):
        drawing = draw(scene, ASLANT)
    alone = draw(e3d.box(), ASLANT)
    assert drawing.pieces.of(hidden=False).length == pytest.approx(
        alone.pieces.of(hidden=False).length
    )


def test_threads_and_repetition_change_nothing():
    scene = e3d.Scene()
    scene.add(e3d.torus(2.0, 0.7))
    scene.add(e3d.box((1.0, 5.0, 1.0)))
    texts = {draw(scene, ASLANT, threads=threads).svg(hidden=True) for threads in (1, 2, 3, 0)}
    assert len(texts) == 1


@pytest.mark.filterwarnings("ignore:.*positions are not finite")
@pytest.mark.parametrize("seed", range(30))
def test_soups_of_any_kind_are_drawn(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 60))
    positions = rng.normal(0, rng.choice([1e-8, 1.0, 1e6]), (count, 3))
    if seed % 3 == 0:
        positions = np.round(positions)
    if seed % 4 == 0:
        positions[rng.integers(0, count)] = rng.choice([np.nan, np.inf, 1e38])
    faces = rng.integers(0, count, (int(rng.integers(1, 100)), 3))
    mesh = e3d.Mesh(positions, faces, edge_visible=rng.random(faces.shape) < 0.7)
    extent = max(float(np.nanmax(np.abs(positions[np.isfinite(positions)]), initial=1e-9)), 1e-9)
    extent = min(extent, 1e30)
    pose = e3d.look_at((0, 0, 3 * extent), (0, 0, 0), (0, 1, 0))
    camera = e3d.OrthographicCamera(extent, znear=0.0, zfar=9 * extent)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.errors.Engine3DWarning)
        drawing = draw(mesh, pose, camera)
    assert np.isfinite(drawing.pieces.ends).all()


def test_bad_arguments_are_refused():
    box = e3d.box()
    wrong = e3d.InvalidArgumentError
    for options, message in (
        ({"size": (0, 5)}, "width"),
        ({"crease_angle": 9.0}, "crease_angle"),
        ({"unit": "yard"}, "unit"),
        ({"scale": -1.0}, "scale"),
        ({"threads": "many"}, "threads"),
    ):
        with pytest.raises(wrong, match=message):
            line_drawing(box, (UP, ABOVE), **options)
    with pytest.raises(wrong, match="only a parallel projection"):
        line_drawing(box, scale=0.5)
    with pytest.raises(wrong, match="scene must be"):
        line_drawing(3)
    with pytest.raises(wrong, match="kind must be one of .*did you mean outline"):
        line_drawing(box, (UP, ABOVE)).pieces.of("outlin")


def test_a_scale_gives_the_size_on_paper():
    drawing = line_drawing(
        e3d.box((2.0, 3.0, 1.0)), (UP, ABOVE), size=(200, 100), scale=0.5, unit="cm"
    )
    assert drawing.size == pytest.approx((100.0, 50.0))
    assert drawing.pieces.of(hidden=False).length == pytest.approx(50.0)
