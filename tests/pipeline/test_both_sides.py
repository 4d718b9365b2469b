"""``cull="auto"``: both sides show, and backs are left out only where that changes nothing."""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d.model.primitives import box, cylinder, icosphere, torus, uv_sphere
from engine3d.rendering.draw_list.closed_meshes import holes_of


def encloses(mesh):
    holes = holes_of(mesh)
    return holes is not None and len(holes.ends) == 0


def scene_of(*meshes):
    scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
    for number, mesh in enumerate(meshes):
        scene.add(mesh, translation=(2.5 * number, 0, 0))
    scene.add(e3d.DirectionalLight((-0.3, -0.5, -1)))
    return scene


def inside_out(mesh, some=slice(None)):
    faces = mesh.faces.copy()
    faces[some] = faces[some][:, ::-1]
    return e3d.Mesh(mesh.positions, faces, normals=None, position_ids=mesh.position_ids)


def picture(renderer, scene, cull, camera=None):
    frame = renderer.render(scene, camera, cull=cull, outputs=("color", "face_id"))
    return frame.color.copy(), frame.face_id.copy(), dict(frame.stats)


@pytest.fixture
def renderer():
    with Renderer((160, 120)) as renderer:
        yield renderer


SHAPES = {
    "box": lambda: box((1, 1, 1)),
    "ball": lambda: icosphere(1.0, 3),
    "cylinder": lambda: cylinder(0.7, 1.5),
    "torus": lambda: torus(1.0, 0.4),
}


@pytest.mark.parametrize("name", SHAPES)
def test_what_is_closed_is_culled_and_looks_the_same(renderer, name):
    mesh = SHAPES[name]()
    assert encloses(mesh)
    scene = scene_of(mesh)
    auto, none, back = (picture(renderer, scene, cull) for cull in ("auto", "none", "back"))
    assert (auto[0] == none[0]).all()
    assert (auto[1] == back[1]).all()
    assert auto[2]["triangles_setup"] == back[2]["triangles_setup"] < none[2]["triangles_setup"]


@pytest.mark.parametrize("name", SHAPES)
def test_what_is_inside_out_looks_as_if_it_were_not(renderer, name):
    mesh = inside_out(SHAPES[name]())
    assert not encloses(mesh)
    turned = inside_out(mesh)
    wrong, right = (picture(renderer, scene_of(one), "auto")[0] for one in (mesh, turned))
    # Silhouettes may fall to the face behind by a rounding.
    assert (wrong != right).any(axis=2).sum() <= 4
    assert (picture(renderer, scene_of(mesh), "back")[0] != right).any(axis=2).sum() > 500


def test_some_faces_turned_over_leave_no_holes(renderer):
    ball = icosphere(1.0, 3)
    mixed = inside_out(ball, slice(None, None, 3))
    assert not encloses(mixed)
    mixed.crease_angle = 0.6
    right = picture(renderer, scene_of(inside_out(ball, slice(0))), "auto")[0]
    wrong = picture(renderer, scene_of(mixed), "auto")[0]
    assert np.abs(wrong.astype(int) - right).max(axis=2).mean() < 1.0


def test_closed_and_open_meshes_in_one_picture(renderer):
    plane = e3d.primitives.plane((1, 1))
    scene = scene_of(icosphere(1.0, 2), inside_out(plane))
    auto, none, back = (picture(renderer, scene, cull) for cull in ("auto", "none", "back"))
    assert (auto[0] == none[0]).all()
    assert back[2]["triangles_setup"] < auto[2]["triangles_setup"] < none[2]["triangles_setup"]


def test_from_inside_both_sides_show(renderer):
    room = box((4, 4, 4))
    assert encloses(room)
    camera = e3d.PerspectiveCamera(1.2, znear=0.05, zfar=20.0)
    scene = scene_of(room)
    for pose in (np.eye(4), _at(0, 0, 2.02)):  # inside, and where the near plane cuts a wall
        auto, none = (picture(renderer, scene, cull, (camera, pose)) for cull in ("auto", "none"))
        assert (auto[0] == none[0]).all()
        assert (auto[1] >= 0).any()
    outside = picture(renderer, scene, "auto", (camera, _at(0, 0, 2.1)))
    assert (outside[1] == picture(renderer, scene, "back", (camera, _at(0, 0, 2.1)))[1]).all()


def _at(*place):
    pose = np.eye(4)
    pose[:3, 3] = place
    return pose


def test_what_has_alpha_shows_its_inside():
    glass = icosphere(1.0, 2)
    assert encloses(glass)
    glass.materials = [e3d.Material(color=(1.0, 1.0, 1.0, 0.5), alpha_mode="blend")]
    assert not encloses(glass)


def test_alpha_that_comes_later(renderer):
    ball = icosphere(1.0, 2)
    scene = scene_of(ball)
    first = picture(renderer, scene, "auto")[0]
    ball.materials[0].alpha_mode, ball.materials[0].color = "blend", (1.0, 1.0, 1.0, 0.5)
    auto, none = (picture(renderer, scene, cull)[0] for cull in ("auto", "none"))
    assert (auto == none).all()
    assert (first != auto).any()


def test_what_encloses_nothing():
    ball = icosphere(1.0, 1)
    assert not encloses(e3d.Mesh(ball.positions, ball.faces[1:]))
    assert not encloses(e3d.Mesh([(0, 0, 0)]))
    # A part that is inside out, beside one that is not.
    both = e3d.Mesh.concatenate([ball, inside_out(ball)], poses=[np.eye(4), _at(5, 0, 0)])
    assert not encloses(both)
    assert encloses(e3d.Mesh.concatenate([ball, ball], poses=[np.eye(4), _at(5, 0, 0)]))


def bowl():
    """A ball without its top: one looks in from above only."""
    ball = uv_sphere(1.0, (32, 16))
    low = ball.positions[ball.faces][..., 1].max(axis=1) < 0.6
    return e3d.Mesh(ball.positions, ball.faces[low], position_ids=ball.position_ids)


@pytest.mark.parametrize("height", [-2.0, 0.0, 0.4, 1.5, 4.0])
def test_holes_matter_to_those_who_look_in(renderer, height):
    scene = scene_of(bowl())
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=50.0)
    pose = e3d.linalg.look_at((0, height, 4), (0, 0, 0), (0, 1, 0))
    auto, none, back = (
        picture(renderer, scene, cull, (camera, pose)) for cull in ("auto", "none", "back")
    )
    assert (auto[0] == none[0]).all()
    assert (auto[2]["triangles_setup"] == back[2]["triangles_setup"]) == (height < 0.5)


def triangles(renderer, scene, camera):
    return [
        picture(renderer, scene, cull, camera)[2]["triangles_setup"]
        for cull in ("back", "auto", "none")
    ]


def test_backs_are_drawn_only_where_a_hole_is(renderer):
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=50.0)
    pose = e3d.linalg.look_at((0, 1.5, 4), (0, 0, 0), (0, 1, 0))
    back, auto, none = triangles(renderer, scene_of(bowl()), (camera, pose))
    assert back < auto < back + 0.7 * (none - back)
    many = scene_of(*[bowl()] * 40)  # more holes than a frame has apertures
    pose = e3d.linalg.look_at((50, 60, 90), (50, 0, 0), (0, 1, 0))
    auto, none = (
        picture(renderer, many, cull, (e3d.PerspectiveCamera(0.8, znear=0.1, zfar=300.0), pose))
        for cull in ("auto", "none")
    )
    assert (auto[0] == none[0]).all() and (auto[1] >= 0).sum() > 100


@pytest.mark.parametrize("options", [{}, {"samples": 4}, {"samples": 4, "antialiasing": "msaa"}])
def test_windows_are_the_same_on_all_backends(options):
    plane = e3d.Mesh.concatenate([e3d.primitives.plane((1, 1)), icosphere(0.3, 1)])
    scene = scene_of(bowl(), inside_out(plane), bowl())
    camera = e3d.PerspectiveCamera(0.5, znear=0.1, zfar=50.0)
    pose = e3d.linalg.look_at((2, 2.5, 7), (2, 0, 0), (0, 1, 0))
    expected = None
    for backend in ("scalar", *(name for name in e3d.backends() if name != "scalar")):
        for culling in ("all", "none"):
            with Renderer((150, 90), backend=backend, threads=2, **options) as one:
                frame = one.render(scene, (camera, pose), cull="auto", culling=culling)
                expected = frame.color.copy() if expected is None else expected
                assert (frame.color == expected).all(), (backend, culling)


@pytest.mark.parametrize("mirror", [1, -1])
def test_a_jagged_rim(renderer, mirror):
    ball = icosphere(1.0, 3)
    low = ball.positions[ball.faces][..., 1].max(axis=1) < 0.6
    jagged = e3d.Mesh(ball.positions, ball.faces[low], position_ids=ball.position_ids)
    assert len(holes_of(jagged).ends) == 1
    scene, culled = scene_of(jagged), 0
    next(iter(scene.nodes)).scale = (mirror, 1, 1)
    for height in np.linspace(-6, 6, 13):
        pose = e3d.linalg.look_at((0, height, 4), (0, 0, 0), (0, 1, 0))
        camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=50.0), pose
        auto, none, back = (
            picture(renderer, scene, cull, camera) for cull in ("auto", "none", "back")
        )
        assert (auto[0] == none[0]).all()
        culled += auto[2]["triangles_setup"] == back[2]["triangles_setup"]
    assert 2 <= culled <= 7


def test_an_open_sheet_and_holes_that_meet_are_no_volume():
    assert holes_of(e3d.primitives.plane((1, 1))) is None
    ball = icosphere(1.0, 2)
    at = ball.position_ids[ball.faces]
    around = np.flatnonzero((at == at[0, 0]).any(axis=1))
    holes = np.delete(ball.faces, around[[0, 2]], axis=0)  # two that touch at a point
    assert holes_of(e3d.Mesh(ball.positions, holes, position_ids=ball.position_ids)) is None
    assert holes_of(bowl()).ends.tolist() == [32] and holes_of(bowl()).points.shape == (32, 3)
    assert holes_of(inside_out(bowl())) is None


def test_instances_and_a_mirrored_node(renderer):
    ball = cylinder(0.7, 1.5)
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(ball, np.stack([_at(0, 0, 0), _at(2, 0, 0)])))
    scene.add(ball, translation=(0, 3, 0), scale=(-1, 1, 1))
    # Instances are looked at by their box alone, which the camera of such a scene touches.
    _, pose = e3d.frame_scene(scene, aspect=160 / 120)
    camera = e3d.PerspectiveCamera(znear=0.1, zfar=50.0), pose
    auto, none, back = (picture(renderer, scene, cull, camera) for cull in ("auto", "none", "back"))
    assert (auto[0] == none[0]).all()
    assert auto[2]["triangles_setup"] == back[2]["triangles_setup"]


def test_picking_takes_what_shows(renderer):
    scene = scene_of(inside_out(box((1, 1, 1))))
    frame = renderer.render(scene, cull="auto", outputs=("color", "depth", "face_id", "object_id"))
    hit = scene.pick(frame, 80, 60)
    assert hit.face_id == frame.face_id[60, 80]
