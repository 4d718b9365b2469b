"""Scenes that are copied, and nodes that look at places."""

import numpy as np
import pytest

import engine3d as e3d


def full():
    """A scene with all that refers to nodes."""
    scene = e3d.Scene(background=(9, 8, 7), exposure=0.5)
    scene.fog = e3d.Fog((1, 2, 3), 1.0, 9.0)
    child = scene.add(e3d.box(1.0), name="child", translation=(0, 1, 0), cast_shadows=False)
    group = scene.add(name="group", scale=(1, 2, 1), euler=(0, 0.3, 0))
    child.parent = group
    mesh = e3d.box(0.5)
    mesh.set_influences(np.zeros((24, 1), int), np.ones((24, 1)))
    bent = scene.add(mesh, name="bent", static=True)
    bent.skin = e3d.motion.Skin([child])
    bent.collider = e3d.colliders.SphereCollider(1.0)
    scene.add(e3d.PointLight(intensity=20.0), parent=group, translation=(2, 2, 2)).visible = True
    scene.add(e3d.PerspectiveCamera(), pose=e3d.look_at((3, 2, 4), (0, 1, 0)), name="eye")
    scene.add(e3d.box(0.1), name="hidden").visible = False
    animator = scene.animator = e3d.Animator(scene)
    animator.spin([group], period=3.0)
    return scene


def picture(scene):
    return e3d.render(scene, scene.find("eye"), size=(48, 36)).color


def test_a_copy_shows_the_same_and_moves_the_same():
    scene = full()
    copied = scene.copy()
    assert (picture(copied) == picture(scene)).all()
    for one in (scene, copied):
        one.animator.seek(0.7)
    assert (picture(copied) == picture(scene)).all()
    assert [node.name for node in copied.nodes] == [node.name for node in scene.nodes]
    assert [node.visible for node in copied.nodes] == [node.visible for node in scene.nodes]
    for name in ("cast_shadows", "static", "collider"):
        ours, theirs = ([getattr(n, name) for n in s.nodes] for s in (copied, scene))
        assert ours == theirs


def test_a_copy_is_a_tree_of_its_own():
    scene = full()
    before = picture(scene)
    copied = scene.copy()
    copied.animator.seek(1.0)
    copied.background = (200, 0, 0)
    lamp = next(n for n in copied.nodes if isinstance(n.object, e3d.PointLight))
    lamp.object.intensity = 0.0
    copied.remove(copied.find("bent"))
    assert (picture(scene) == before).all()
    assert copied.find("child").object is scene.find("child").object  # meshes are shared
    assert copied.find("child").parent is copied.find("group")
    assert scene.copy().find("bent").skin.joints[0].scene is not scene


def test_clips_are_those_of_the_copy():
    scene = full()
    node, lamp = scene.find("group"), next(n for n in scene.nodes if hasattr(n.object, "falloff"))
    keys = [0.0, 1.0]
    channels = [
        e3d.motion.Channel(node, "translation", keys, [(0, 0, 0), (1, 0, 0)]),
        e3d.motion.PropertyChannel(lamp.object, "intensity", keys, [[0.0], [9.0]]),
    ]
    scene.animations = {"go": e3d.motion.AnimationClip(channels, "go")}
    copied = scene.copy()
    moved, dimmed = copied.animations["go"].channels
    assert moved.node is copied.find("group") and dimmed.target is not lamp.object
    assert any(n.object is dimmed.target for n in copied.nodes)


@pytest.mark.parametrize("seed", range(8))
def test_a_node_looks_at_a_place_wherever_it_hangs(seed):
    rng = np.random.default_rng(seed)
    scene, node = e3d.Scene(), None
    for _ in range(3):
        scale = rng.uniform(0.5, 2.0, 3) * rng.choice([1, -1], 3)
        place, turn = rng.normal(size=3), rng.uniform(-1, 1, 3)
        node = scene.add(parent=node, translation=place, euler=turn, scale=scale)
    place, target = node.translation.copy(), rng.normal(size=3) * 4
    node.look_at(target)
    ahead = node.world_pose[:3, :3] @ (0, 0, -1)
    offset = target - node.world_pose[:3, 3]
    cosine = ahead @ offset / np.linalg.norm(ahead) / np.linalg.norm(offset)
    assert cosine == pytest.approx(1.0, abs=1e-12)
    assert (node.translation == place).all()


def test_it_is_the_pose_of_a_camera_that_looks_there():
    node = e3d.Scene().add(e3d.PerspectiveCamera(), translation=(1, 2, 3))
    node.look_at((4, 0, 1))
    assert np.allclose(node.pose, e3d.look_at((1, 2, 3), (4, 0, 1)), atol=1e-14)
    node.look_at((1, -5, 3))  # straight down
    assert np.allclose(node.pose[:3, 2], (0, 1, 0))


def test_a_lamp_shines_there():
    scene = e3d.Scene(ambient=(0, 0, 0))
    scene.add(e3d.box(1.0))
    lamp = scene.add(e3d.SpotLight(intensity=30.0, outer_cone_angle=0.3), translation=(3, 0, 1))
    camera = e3d.PerspectiveCamera(), e3d.look_at((3, 0, 2), (0, 0, 0))
    dark = e3d.render(scene, camera, size=(32, 32)).color[..., :3].max()
    lamp.look_at((0, 0, 0))
    assert dark == 0 and e3d.render(scene, camera, size=(32, 32)).color[..., :3].max() > 100


@pytest.mark.parametrize(
    ("target", "up"), [((1, 2, 3), (0, 1, 0)), ((0, 0, np.nan), (0, 1, 0)), ((0, 0, 0), (0, 0, 0))]
)
def test_places_that_cannot_be_looked_at(target, up):
    node = e3d.Scene().add(translation=(1, 2, 3))
    with pytest.raises(e3d.InvalidArgumentError):
        node.look_at(target, up)


def test_what_pictures_are_made_of_shows_itself():
    rng = np.random.default_rng(0)
    pixels = rng.integers(0, 255, (600, 300, 4), dtype=np.uint8)
    for thing in (e3d.Texture(pixels), e3d.Material(color=(1, 0, 0)), e3d.Environment.studio()):
        assert thing._repr_png_().startswith(b"\x89PNG")
