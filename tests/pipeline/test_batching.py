"""Nodes of one mesh are one draw of the core, and it never shows."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

OUTPUTS = ("color", "depth", "ndc_depth", "face_id", "object_id", "instance_id", "material_id")
BOTH = ({"batching": True}, {"batching": False})
CAMERA = (e3d.PerspectiveCamera(0.9, znear=0.1, zfar=60.0), e3d.look_at((0, 1, 9), (0, 0, 0)))


def meshes():
    """Two of one shape, so that faces coincide; one with lines and points; an instanced one."""
    red, blue = e3d.box(1.0), e3d.box(1.0)
    red.materials = [e3d.Material(color=(220, 40, 30))]
    blue.materials = [e3d.Material(color=(30, 40, 220), two_sided=True)]
    marks = e3d.Mesh(
        [(-1, -1, 0.5), (1, -1, 0.5), (0, 1, 0.5)], [(0, 1, 2)], lines=[(0, 1), (1, 2)], points=[2]
    )
    crowd = e3d.InstancedMesh(red, [(0, 0, 0, 0.7), (1, 0.5, 0, 0.4), (0, 0, -90, 1)])
    return red, blue, marks, crowd


def mixed_scene(random, count=120):
    """Nodes of all kinds by turns, many of them at the same place as another."""
    scene = e3d.Scene(ambient=e3d.linear(0.3, 0.3, 0.3))
    scene.add(e3d.PointLight(intensity=30.0 * np.pi), translation=(2, 3, 5))
    group = scene.add(translation=(0.1, 0, 0))
    kinds = meshes()
    places = random.integers(-3, 4, (count, 3)).astype(float)
    for k, place in enumerate(places):
        turned = {} if k % 3 else {"rotation": random.normal(size=4), "scale": 0.7}
        parent = group if k % 4 else None
        scene.add(kinds[k % 4], parent=parent, translation=place, static=k % 2 == 0, **turned)
    return scene, group


def pictures(scene, renderer, **options):
    """All outputs with and without batches."""
    return [renderer.render(scene, CAMERA, outputs=OUTPUTS, **switch, **options) for switch in BOTH]


def assert_same(a, b):
    for name in OUTPUTS:
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name)


@pytest.mark.parametrize("backend", e3d.backends())
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"culling": "always"},
        {"culling": "none", "shading": "forward"},
        {"hidden_surfaces": "painter"},
        {"hidden_surfaces": "none", "mode": "object_id"},
        {"wireframe": "overlay", "line_width": 3, "point_size": 9},
        {"mode": "overdraw"},
    ],
)
def test_pictures_are_those_without_batches(backend, options):
    scene, _ = mixed_scene(np.random.default_rng(4))
    oracle = Renderer((96, 64), backend="scalar").render(
        scene, CAMERA, outputs=OUTPUTS, batching=False, **options
    )
    for threads in (1, 3):
        with Renderer((96, 64), backend=backend, threads=threads) as renderer:
            for frame in pictures(scene, renderer, **options):
                assert_same(frame, oracle)
    assert oracle.object_id.max() > 0


def test_equal_depths_go_to_the_node_that_was_added_first():
    """Boxes at one place, of two meshes by turns: the order is that of adding, not of draws."""
    red, blue, *_ = meshes()
    scene = e3d.Scene()
    scene.add(e3d.box(0.1), translation=(0, 0, -30))
    nodes = [scene.add(mesh) for mesh in (blue, red, blue, red)]
    for first in nodes:
        frame = render(scene, CAMERA, size=(32, 32), outputs=("object_id",))
        assert frame.object_id[16, 16] == first.id
        first.visible = False


def test_draws_are_counted():
    scene = e3d.Scene()
    red, blue, *_ = meshes()
    for k in range(60):
        scene.add((red, blue)[k % 2], translation=(k % 8 - 4, k // 8 - 4, 0), static=True)
    scene.add(red, translation=(0, 0, 500))  # behind the camera
    on, off = pictures(scene, Renderer((64, 64)))
    assert (on.stats["draws"], on.stats["draws_unbatched"]) == (2, 60)
    assert (off.stats["draws"], off.stats["draws_unbatched"]) == (60, 60)
    assert on.stats["instances_in_frustum"] == off.stats["instances_in_frustum"] == 60
    assert on.stats["instances"] == on.stats["objects"] == 61
    assert on.stats["clusters"] == off.stats["clusters"]


def test_nodes_are_left_out_one_by_one():
    """Of a batch, what no camera shows is culled as it is without batches."""
    scene = e3d.Scene()
    mesh = e3d.box(0.2)
    random = np.random.default_rng(8)
    for place in random.uniform(-40, 40, (3000, 3)):
        scene.add(mesh, translation=place, static=True)
    with Renderer((96, 64)) as renderer:
        for culling in ("all", "tree", "frustum", "always"):
            on, off = pictures(scene, renderer, culling=culling)
            assert_same(on, off)
            assert on.stats["nodes_in_frustum"] == off.stats["nodes_in_frustum"] < 1000
            assert on.stats["draws"] == 1


def test_a_batch_follows_its_nodes():
    random = np.random.default_rng(5)
    scene, group = mixed_scene(random)
    renderer = Renderer((96, 64))

    last = np.zeros(1)

    def check(changes=True):
        nonlocal last
        on, off = pictures(scene, renderer)
        fresh = Renderer((96, 64)).render(scene, CAMERA, outputs=OUTPUTS, batching=False)
        assert_same(on, fresh)
        assert_same(off, fresh)
        assert (on.color != last).any() == changes
        last = on.color.copy()

    check()
    static = [node for node in scene.nodes if node.static and isinstance(node.object, e3d.Mesh)]
    static[3].translation = (0, 0, 5)  # moved after all
    check()
    scene.remove(static[3])
    check()
    static[5].reparent(group)
    static[5].translation = (0.4, 0.5, 4.5)
    check()
    group.translation = (0.5, 0.2, 0)
    check()
    static[5].visible = False
    check()
    static[7].object.materials[0].color = (20, 200, 40)
    check()
    static[7].object.materials = [e3d.Material(color=(250, 250, 10))]
    check()
    scene.add(static[7].object, translation=(0, 0.5, 5), static=True)
    check()
    static[9].static = False
    check(changes=False)


def test_a_moving_camera_with_rounds():
    """What the last frame showed is remembered of each node of a batch."""
    scene = e3d.Scene()
    mesh = e3d.box(1.0)
    random = np.random.default_rng(6)
    for place in random.uniform(-12, 12, (2000, 3)):
        scene.add(mesh, translation=place)
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=60.0)
    renderer, other = Renderer((128, 96)), Renderer((128, 96))
    rounds = []
    for k in range(5):
        pose = e3d.look_at((0.2 * k, 0.1, 14 - k), (0.3 * k, 0, 0))
        on = renderer.render(scene, (camera, pose), outputs=OUTPUTS, culling="always")
        off = other.render(scene, (camera, pose), outputs=OUTPUTS, culling="none", batching=False)
        assert_same(on, off)
        rounds.append(on.stats["rounds"])
        assert on.stats["clusters_occluded"] > 0
    assert rounds[-1] == 2  # of what was seen, and of the others


def test_meshes_of_the_same_materials_share_them():
    """Whether meshes share materials or have equal ones of their own never shows."""
    base = e3d.uv_sphere(0.8, (12, 8))
    two = np.arange(len(base.faces)) % 2

    def scene(shared):
        made = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
        made.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
        colors = ((200, 80, 30), (30, 90, 200))
        common = [e3d.Material(color=color) for color in colors]
        for k in range(12):
            own = [e3d.Material(color=color) for color in colors]
            materials = list(common if shared else own)[:: -1 if k % 3 == 0 else 1]
            mesh = e3d.Mesh(
                base.positions,
                base.faces,
                normals=base.normals,
                materials=materials,
                material_ids=two,
            )
            made.add(mesh, translation=(1.5 * (k % 4) - 2.2, 1.5 * (k // 4) - 1.5, 0))
        return made, common

    with Renderer((96, 64)) as renderer:
        apart = renderer.render(scene(False)[0], CAMERA, outputs=OUTPUTS)
        made, common = scene(True)
        together = renderer.render(made, CAMERA, outputs=OUTPUTS)
        assert_same(together, apart)
        assert (apart.stats["materials"], together.stats["materials"]) == (24, 4)
        common[0].color = (10, 250, 10)
        assert (renderer.render(made, CAMERA).color != apart.color).any()
        made.nodes[3].object.materials[0] = e3d.Material(color=(255, 255, 255))
        assert renderer.render(made, CAMERA).stats["materials"] == 6


@pytest.mark.parametrize("backend", ["scalar", "auto"])
def test_draws_of_instances_fall_with_culling(backend):
    """However many runs of instances there are in the view, a node with them is one draw."""
    poses = np.zeros((4000, 4), np.float32)
    poses[:, :2] = np.indices((100, 40)).reshape(2, -1).T - (50, 20)
    poses[::3, 2] = 99  # behind the camera
    poses[:, 3] = 0.2
    scene = e3d.Scene()
    for z in (0, 300):
        scene.add(e3d.InstancedMesh(e3d.box(), poses), translation=(0, 0, z))
    camera = e3d.PerspectiveCamera(0.5), e3d.look_at((0, 0, 30), (0, 0, 0))
    counts = {}
    with Renderer((64, 64), backend=backend) as renderer:
        for culling in ("none", "frustum", "tree"):
            for _ in range(4):  # the tree of instances is made once they have stayed the same
                stats = renderer.render(scene, camera, culling=culling).stats
            assert (stats["objects"], stats["instances"]) == (2, 8000)
            counts[culling] = [
                stats[name] for name in ("draws", "instances_in_frustum", "instances_drawn")
            ]
    assert counts["none"][:2] == [2, 8000]
    assert counts["frustum"] == counts["tree"] and counts["tree"][0] == 1
    assert 10 < counts["tree"][2] <= counts["tree"][1] < 1500
