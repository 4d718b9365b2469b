"""IDs without anything else are found another way than with colours: they are the same."""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

IDS = ("face_id", "object_id", "instance_id", "material_id")
OUTPUTS = (*IDS, "ndc_depth")
ASKED = (("face_id",), ("instance_id", "object_id"), IDS, OUTPUTS)
SIZE = (150, 100)  # two rows of tiles, three to four columns; the last of each is not whole
CAMERA = e3d.PerspectiveCamera(yfov=0.9, znear=0.2, zfar=60)
EYES = ((0.3, 0.6, 7.0), (0.4, 0.7, 6.9), (-2.0, 1.5, 6.0))


def masked_pane():
    """A pane of two materials, one of which has holes."""
    grid = np.indices((8, 8)).sum(axis=0) % 2
    texels = np.full((8, 8, 4), 255, np.uint8)
    texels[..., 3] = 255 * grid
    pane = e3d.primitives.quad()
    holes = e3d.Material(texture=e3d.Texture(texels), alpha_mode="mask", two_sided=True)
    pane.materials = [holes, e3d.Material(two_sided=True)]
    pane.material_ids = [0, 1]
    return pane


def lines_and_points():
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.5]], np.float32)
    return e3d.Mesh(corners, lines=[[0, 1], [1, 2], [2, 3], [3, 0]], points=[0, 2])


@pytest.fixture(scope="module")
def scene():
    """Small and large triangles, nodes of one mesh (one mirrored), instances, lines, holes."""
    scene = e3d.Scene()
    ball, box = e3d.icosphere(1.0, subdivisions=4), e3d.box()
    for k, x in enumerate((-2.2, 0.0, 2.2)):
        scene.add(ball, translation=(x, 0.2 * k, -k), scale=(-0.9 if k == 1 else 0.9, 0.9, 0.9))
    axis = np.arange(-3.0, 3.5)
    places = np.stack(np.meshgrid(axis, axis, [-2.0]), -1).reshape(-1, 3)
    poses = np.c_[places, np.full(len(places), 0.4)].astype(np.float32)
    scene.add(e3d.InstancedMesh(box, poses))
    scene.add(masked_pane(), translation=(0.5, 0.2, 2.5), scale=1.5)
    scene.add(lines_and_points(), translation=(-0.5, 0.3, 3.0))
    floor = e3d.primitives.quad((-40, 0, 40), (40, 0, 40), (40, 0, -40), (-40, 0, -40))
    scene.add(floor, translation=(0, -1.2, 0))  # it crosses the near plane
    return scene


def draw(renderer, scene, eye, outputs, **options):
    return renderer.render(scene, (CAMERA, e3d.look_at(eye, (0, 0, 0))), outputs=outputs, **options)


@pytest.fixture(scope="module")
def expected(scene):
    """What the reference draws along with colours, by samples per pixel and eye."""
    frames = {}
    for samples in (1, 4, 16):
        with Renderer(SIZE, backend="scalar", samples=samples) as renderer:
            for eye in EYES if samples == 1 else EYES[:1]:
                frame = draw(renderer, scene, eye, ("color", "barycentric", *OUTPUTS))
                frames[samples, eye] = {name: getattr(frame, name) for name in OUTPUTS}
    return frames


def assert_same(frame, wanted, names):
    for name in names:
        assert getattr(frame, name).tobytes() == wanted[name].tobytes(), (name, frame.stats["plan"])


def test_the_scene_has_what_it_is_to_have(expected):
    shown = expected[1, EYES[0]]
    faces, objects = shown["face_id"], shown["object_id"]
    assert set(np.unique(objects)) == {-1, *range(7)}
    assert ((faces < 0) & (objects >= 0)).any()  # lines and points
    assert len(np.unique(shown["instance_id"])) > 20
    assert set(np.unique(shown["material_id"])) == {-1, 0, 1}
    assert len(np.unique(faces)) > 500


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("backend", e3d.backends())
def test_same_ids_alone(scene, expected, backend, threads):
    for samples, eye in expected if backend != "scalar" else [(1, EYES[0]), (4, EYES[0])]:
        with Renderer(SIZE, backend=backend, threads=threads, samples=samples) as renderer:
            for names in ASKED:
                frame = draw(renderer, scene, eye, names, culling="none")
                assert_same(frame, expected[samples, eye], names)


@pytest.mark.parametrize("threads", [1, 3])
def test_same_ids_in_rounds(scene, expected, threads):
    """Tiles that another round adds to are written twice."""
    with Renderer(SIZE, threads=threads) as renderer:
        for eye in EYES * 2:
            for names in ASKED:
                frame = draw(renderer, scene, eye, names, culling="always")
                assert_same(frame, expected[1, eye], names)
                assert frame.stats["rounds"] > 1


@pytest.mark.parametrize("samples", [1, 4])
def test_large_triangles(samples):
    """Without depths, in tiles of few records."""
    scene = e3d.Scene()
    for place in ((0, 0, 0), (1.2, 0.4, -1), (-1, -0.5, 0.5)):
        scene.add(e3d.box(), translation=place)
    eye = (1.0, 1.5, 3.0)
    with Renderer(SIZE, backend="scalar", samples=samples) as renderer:
        frame = draw(renderer, scene, eye, ("color", *OUTPUTS))
        wanted = {name: getattr(frame, name) for name in OUTPUTS}
    for backend in e3d.backends():
        with Renderer(SIZE, backend=backend, threads=2, samples=samples) as renderer:
            for names in ASKED:
                assert_same(draw(renderer, scene, eye, names), wanted, names)


@pytest.mark.parametrize("backend", e3d.backends())
def test_two_triangles_that_meet_between_blocks(backend):
    """Whole blocks of 8 x 8 pixels show one of them, and their neighbours the other."""
    scene = e3d.Scene()
    corners = [(-16, -999, 0), (-16, 999, 0), (-999, 0, 0), (999, 0, 0)]
    scene.add(e3d.Mesh(corners, [(0, 1, 2), (1, 0, 3)]))
    for k in range(8):
        scene.add(e3d.primitives.quad(), translation=(0, 0, -1 - k), scale=128)  # behind them
    camera = e3d.OrthographicCamera(64), e3d.look_at((0, 0, 5), (0, 0, 0))
    with Renderer((128, 128), backend=backend) as renderer:
        frame = renderer.render(scene, camera, outputs=IDS, cull="none", culling="always")
    assert (frame.face_id == np.where(np.arange(128) < 48, 0, 1)).all()
    assert (frame.object_id == 0).all()


@pytest.mark.parametrize("hidden_surfaces", ["zbuffer", "painter", "none"])
@pytest.mark.parametrize("mode", ["lit", "overdraw"])
def test_how_they_are_found_does_not_show(scene, mode, hidden_surfaces):
    """Where the last triangle in order shows they are shaded; samples are counted alike."""
    with Renderer(SIZE) as renderer:
        options = {"mode": mode, "hidden_surfaces": hidden_surfaces, "culling": "none"}
        full = draw(renderer, scene, EYES[0], ("color", "barycentric", *IDS), **options)
        alone = draw(renderer, scene, EYES[0], IDS, shading="forward", **options)
        assert_same(alone, {name: getattr(full, name) for name in IDS}, IDS)
        assert "shades" in full.stats["plan"] and "identifies" not in full.stats["plan"]
        is_direct = hidden_surfaces == "zbuffer"
        assert ("identifies" in alone.stats["plan"]) == is_direct
        assert ("shades" in alone.stats["plan"]) != is_direct
        if is_direct:
            assert alone.stats["pixels_shaded"] == full.stats["pixels_shaded"] > 0
