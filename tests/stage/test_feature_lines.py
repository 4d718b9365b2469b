"""The lines that a look draws along the edges of faceted models."""

from pathlib import Path

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (240, 180)
BARE = e3d.Look.studio(feature_edges=False)


def lines_on(thing, look="studio", **options):
    """Return which pixels lines darken."""
    pictures = [e3d.render(thing, size=SIZE, look=one, **options).color for one in (look, BARE)]
    with_lines, without = (picture.astype(int).sum(-1) for picture in pictures)
    assert (with_lines <= without + 3).all()
    return with_lines < without - 60


def test_a_box_has_lines_along_the_edges_that_show():
    lines = lines_on(e3d.box())
    assert 400 < lines.sum() < 2500


def test_hidden_edges_do_not_show():
    scene = e3d.Scene()
    scene.add(e3d.box())
    camera = e3d.OrthographicCamera(0.8), e3d.look_at((0, 0, 3), (0, 0, 0))
    lines = lines_on(scene, camera=camera)
    rows, columns = np.nonzero(lines)
    middle = lines[60:120, 90:150]
    assert lines.any() and not middle.any()  # four edges of the front, none behind it
    turned = e3d.OrthographicCamera(0.9), e3d.look_at((2, 1.5, 3), (0, 0, 0))
    frame = e3d.render(scene, turned, size=SIZE, look=BARE, outputs=("object_id",))
    inside = frame.object_id == 0
    drawn = lines_on(scene, camera=turned)
    nearest = np.array([(0.5, 0.5, 0.5)])
    (x, y), _ = (part[0] for part in frame.project(nearest))
    farthest, _ = frame.project(-nearest)
    u, v = np.rint(farthest[0]).astype(int)
    assert drawn[int(y) - 3 : int(y) + 3, int(x) - 3 : int(x) + 3].any()
    assert inside[v, u] and not drawn[v - 3 : v + 4, u - 3 : u + 4].any()


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e5])
@pytest.mark.parametrize("place", [0.0, 30.0])
def test_lines_are_whole_at_every_scale_and_place(scale, place):
    scene = e3d.Scene()
    scene.add(e3d.box(), scale=scale, translation=(place * scale, 0, 0))
    usual = e3d.Scene()
    usual.add(e3d.box())
    count, expected = lines_on(scene).sum(), lines_on(usual).sum()
    assert abs(count - expected) <= 0.03 * expected


@pytest.mark.parametrize(
    "make",
    [
        lambda mesh: setattr(mesh, "materials", [e3d.Material(color="red")]),
        lambda mesh: setattr(mesh, "colors", np.full((len(mesh.positions), 3), 99, np.uint8)),
    ],
)
def test_what_states_its_look_has_no_lines_unless_all_get_them(make):
    mesh = e3d.box()
    make(mesh)
    assert not lines_on(mesh).any()
    assert lines_on(mesh, e3d.Look.studio(feature_edges=True)).any()


def test_material_and_numbers_leave_the_lines_out():
    red = e3d.Material(color="red")
    assert not lines_on(e3d.box(), material=red).any()
    assert not lines_on(e3d.box(), color_by="y").any()


def test_outputs_show_the_faces_below_the_lines():
    names = ("color", "depth", "object_id", "face_id", "normal")
    drawn, bare = (
        e3d.render(e3d.box(), size=SIZE, look=look, outputs=names) for look in ("studio", BARE)
    )
    assert (drawn.color != bare.color).any()
    for name in names[1:]:
        assert np.array_equal(getattr(drawn, name), getattr(bare, name), equal_nan=True), name


def test_modes_that_show_something_else_have_none():
    for options in ({"mode": "normal"}, {"wireframe": "overlay"}, {"mode": "face_id"}):
        pictures = [
            e3d.render(e3d.box(), size=SIZE, look=look, **options).color
            for look in ("studio", BARE)
        ]
        assert np.array_equal(*pictures)


def test_lines_follow_what_moves_comes_and_changes():
    scene = e3d.Scene()
    node = scene.add(e3d.box())
    with e3d.Renderer(SIZE) as kept:
        for change in (
            lambda: None,
            lambda: setattr(node, "translation", (0.4, 0, 0)),
            lambda: scene.add(e3d.cylinder(), translation=(2, 0, 0)),
            lambda: setattr(node.object, "positions", node.object.positions * (1, 2, 1)),
            lambda: setattr(node.object.materials[0], "color", "red"),
            lambda: setattr(node, "visible", False),
        ):
            change()
            picture = kept.render(scene).color.copy()
            assert np.array_equal(picture, e3d.render(scene, size=SIZE).color)


def test_lines_that_are_kept_are_those_found_anew():
    generator = np.random.default_rng(7)
    meshes = [e3d.box(), e3d.cylinder(0.4, 1.0, segments=6)]
    scene, nodes = e3d.Scene(), []
    camera = e3d.PerspectiveCamera(0.9), e3d.look_at((6, 5, 7), (0, 0, 0))
    with e3d.Renderer(SIZE, look="studio") as kept:
        for step in range(24):
            kind = generator.integers(5)
            if kind < 2 or not nodes:
                parent = nodes[0] if nodes and generator.random() < 0.3 else None
                nodes.append(scene.add(meshes[generator.integers(2)], parent=parent))
            node = nodes[generator.integers(len(nodes))]
            if kind == 4 and node is not nodes[0]:
                scene.remove(node)
                nodes.remove(node)
            elif kind == 3:
                node.visible = not node.visible
            else:
                node.translation = generator.uniform(-2, 2, 3)
            if step % 4:
                continue
            with e3d.Renderer(SIZE, look="studio") as anew:
                expected = anew.render(scene, camera).color
            assert (kept.render(scene, camera).color == expected).all(), step


def test_a_frame_of_a_motion_is_that_of_its_moment():
    scene = e3d.Scene()
    node = scene.add(e3d.box())

    def update(time):
        node.translation = (time, 0.0, 0.0)

    def staged():
        viewed = ViewedScene(scene, "box", themed=True, update=update)
        return ViewRenderer(viewed, Settings({}, look="studio"), SIZE)

    with staged() as kept:
        view = kept.view()
        for time in (0.0, 0.5, 0.2, 0.0):
            picture = kept.draw(view, time).color.copy()
            with staged() as fresh:
                fresh.draw(view, 0.0)  # so that both chose their ground at the same moment
                assert np.array_equal(fresh.draw(view, time).color, picture)


def test_instances_have_lines_and_very_many_have_none():
    poses = np.array([(0, 0, 0, 1), (2, 0, 0, 0.5), (0, 2, 0, 0.5)], np.float32)
    two = lines_on(e3d.InstancedMesh(e3d.box(), poses)).sum()
    one = lines_on(e3d.InstancedMesh(e3d.box(), poses[:1])).sum()
    assert two > 100 and one > 100
    grid = np.zeros((6000, 4), np.float32)
    grid[:, :3] = np.stack(np.unravel_index(np.arange(6000), (20, 15, 20)), 1)
    grid[:, 3] = 0.6
    assert not lines_on(e3d.InstancedMesh(e3d.box(), grid)).any()


def test_hidden_objects_have_no_lines():
    scene = e3d.Scene()
    scene.add(e3d.box())
    with ViewRenderer(
        ViewedScene(scene, "box", themed=True), Settings({}, look="studio"), SIZE
    ) as renderer:
        view = renderer.view()
        renderer.draw(view)
        renderer.visibility.toggle_object(0)
        picture = renderer.draw(view).color.astype(int)
    assert np.abs(np.diff(picture[..., 1], axis=1)).max() <= 2  # nothing but the background


def test_where_backs_are_left_out_open_meshes_have_no_lines():
    scene = e3d.Scene()
    scene.add(e3d.plane((2.0, 2.0)))
    below = e3d.OrthographicCamera(1.5), e3d.look_at((0, -3, 1), (0, 0, 0))
    assert lines_on(scene, camera=below, cull="none").any()
    assert not lines_on(scene, camera=below, cull="back").any()
    closed = e3d.Scene()
    closed.add(e3d.box())
    assert np.array_equal(
        lines_on(closed, camera=below, cull="back"), lines_on(closed, camera=below, cull="none")
    )


def test_wild_vertices_have_no_lines():
    box = e3d.box()
    positions = box.positions.copy()
    positions[0] = np.inf
    with pytest.warns(e3d.Engine3DWarning, match="not finite"):
        wild = e3d.Mesh(positions, box.faces)
    assert lines_on(wild).any()


def test_a_large_machine_part_has_lines():
    """Its sharp edges lie between patches of faces that are stored far from each other."""
    path = Path(__file__).parents[3] / "shared" / "models" / "fandisk.obj"
    if not path.exists():
        pytest.skip("needs the shared models")
    assert 400 < lines_on(path).sum() < 2500
