"""Copies and pickles of everything public: read-only arrays, state of their own, or a refusal."""

import copy
import inspect
import pickle

import numpy as np
import pytest
from public.public_names import public_things

import engine3d as e3d


def painted():
    mesh = e3d.uv_sphere(0.5, (12, 6))
    mesh = e3d.Mesh(mesh.positions, mesh.faces, uvs=mesh.uvs, name="ball")
    pixels = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    mesh.materials = [e3d.Material(texture=e3d.Texture(pixels), extras={"note": [1]})]
    mesh.groups = {"half": np.arange(20)}
    mesh.warnings.append("a warning")
    return mesh


def drawn():
    """A scene that was asked for everything, so that all that is computed once is there."""
    scene = e3d.Scene()
    scene.add(painted(), name="ball")
    scene.add(
        e3d.InstancedMesh(painted(), [(1, 0, 0, 0.5)], colors=[(1.0, 0.5, 0.0)]), name="crowd"
    )
    e3d.render(scene, size=(16, 12), threads=1, wireframe="overlay")
    assert scene.raycast((1, 0, 5), (0, 0, -1)) is not None
    return scene


def moved():
    return e3d.motion.Channel(drawn().nodes[0], "scale", [0.0], [(1, 1, 1)])


def frame():
    return e3d.render(drawn(), size=(16, 12), threads=1, outputs=("color", "depth"))


def resource():
    resources = e3d.resources.Resources()
    mesh = resources.share(painted())
    return resources.listed()[0]._replace(thing=mesh)


POSE = np.eye(4)


def moment():
    scene, outputs = drawn(), e3d.sensors.Moment.OUTPUTS
    return e3d.sensors.Moment(e3d.Renderer((4, 4)).render(scene, outputs=outputs), scene)


def stereo_pair():
    stereo = e3d.sensors.StereoCamera(e3d.PerspectiveCamera(), 0.1)
    return stereo.render(e3d.Renderer((4, 4)), drawn(), e3d.look_at((0, 0, 5), (0, 0, 0)))


COPIED = {
    "Mesh": lambda: drawn().find("ball").object,
    "InstancedMesh": lambda: drawn().find("crowd").object,
    "MorphTarget": lambda: e3d.motion.MorphTarget(np.ones((3, 3)), np.ones((3, 3))),
    "Values": lambda: e3d.Values(np.ones(3), on="faces"),
    "Texture": lambda: painted().materials[0].texture,
    "PlacedTexture": lambda: e3d.PlacedTexture(painted().materials[0].texture, uv_set=1),
    "Material": lambda: painted().materials[0],
    "Environment": lambda: e3d.Environment(np.ones((2, 4, 3))),
    "Fog": lambda: e3d.Fog(e3d.linear(1.0, 0.5, 0.2), 1.0, 9.0),
    "ExponentialFog": lambda: e3d.ExponentialFog(e3d.linear(1.0, 0.5, 0.2), 0.1),
    "Gradient": lambda: e3d.Gradient(e3d.linear(1.0, 0.5, 0.2), (9, 8, 7)),
    "Camera": lambda: e3d.Camera(np.eye(4)),
    "PerspectiveCamera": e3d.PerspectiveCamera,
    "OrthographicCamera": lambda: e3d.OrthographicCamera(2.0),
    "IntrinsicsCamera": lambda: e3d.IntrinsicsCamera(9, 9, 8, 6),
    "FisheyeCamera": lambda: e3d.FisheyeCamera(9, 9, 8, 6, (0.1, 0, 0, 0)),
    "BrownConradyCamera": lambda: e3d.BrownConradyCamera(9, 9, 8, 6, (0.1, 0, 0, 0)),
    "DoubleSphereCamera": lambda: e3d.DoubleSphereCamera(9, 9, 8, 6, 0.1, 0.6),
    "EquirectangularCamera": e3d.EquirectangularCamera,
    "CylindricalCamera": e3d.CylindricalCamera,
    "DirectionalLight": e3d.DirectionalLight,
    "PointLight": e3d.PointLight,
    "SpotLight": e3d.SpotLight,
    "RectangleLight": e3d.lights.RectangleLight,
    "DiscLight": e3d.lights.DiscLight,
    "TubeLight": e3d.lights.TubeLight,
    "HemisphereLight": e3d.HemisphereLight,
    "LightProbe": lambda: e3d.LightProbe(np.ones((9, 3))),
    "BoxCollider": lambda: e3d.colliders.BoxCollider((0, 0, 0), (1, 1, 1)),
    "SphereCollider": lambda: e3d.colliders.SphereCollider(1.0),
    "MeshCollider": lambda: e3d.colliders.MeshCollider(painted()),
    "NavigationGrid": lambda: e3d.navigation.NavigationGrid(e3d.plane((4, 4))),
    "Walker": lambda: e3d.navigation.Walker(
        e3d.navigation.NavigationGrid(e3d.plane((4, 4))), 0.0, 0.0
    ),
    "Canvas": lambda: e3d.Canvas((4, 3)),
    "Font": lambda: e3d.Font("sans", 12),
    "Frame": frame,
    "ResourceStats": lambda: e3d.resources.Resources().stats,
    "Resource": lambda: resource(),
    "RayHits": lambda: drawn().raycast_many((0, 0, 5), (0, 0, -1)),
    "RasterizeResult": lambda: e3d.rasterization.rasterize(
        np.zeros((3, 4), np.float32), [[0, 1, 2]], (4, 4)
    ),
    "RenderOptions": lambda: e3d.RenderOptions(line_color=(1, 2, 3)),
    "Look": e3d.Look.studio,
    "Impostor": lambda: e3d.detail.Impostor(painted(), views=2, texels=8),
    "DetailedInstances": lambda: e3d.detail.DetailedInstances([(painted(), 0.0)], [(0, 0, 0, 1)]),
    "DetailedMeshes": lambda: e3d.detail.DetailedMeshes([((painted(),), 0.0)]),
    "Sheet": lambda: e3d.sheets.contact_sheet(painted(), size=(240, 240), views="iso", threads=1),
    "LineDrawing": lambda: e3d.drawings.line_drawing(painted(), threads=1),
    "DrawingSheet": lambda: e3d.drawings.drawing_sheet(painted(), threads=1),
    "World": lambda: e3d.worlds.city(20_000, seed=1),
    "Measures": lambda: e3d.measuring.measure(painted()),
    "Faults": lambda: e3d.measuring.check(painted()),
    "Gap": lambda: e3d.measuring.distance(painted(), e3d.box()),
    "Deviation": lambda: e3d.measuring.hausdorff(painted(), e3d.box()),
    "Moment": lambda: moment(),
    "Flow": lambda: moment().flow_to(moment()),
    "StereoCamera": lambda: e3d.sensors.StereoCamera(e3d.PerspectiveCamera(), 0.1),
    "StereoPair": lambda: stereo_pair(),
    "Lidar": lambda: e3d.sensors.Lidar([0.0], [0.0, 0.1]),
    "LidarScan": lambda: e3d.sensors.Lidar([0.0], [0.0, 0.1]).scan(drawn(), np.eye(4)),
}


def robot():
    shape = "<visual><geometry><sphere radius='1'/></geometry></visual>"
    text = f"<robot name='r'><link name='a'>{shape}</link><link name='b'/>"
    text += "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>"
    return e3d.load_scene(text.encode()).robots["r"]


REFUSED = {
    "Scene": drawn,
    "Node": lambda: drawn().nodes[0],
    "NodeSelection": lambda: drawn().select(),
    "Animator": lambda: e3d.Animator(drawn()),
    "Skin": lambda: e3d.motion.Skin(drawn().nodes[:2]),
    "Channel": lambda: moved(),
    "PropertyChannel": lambda: e3d.motion.PropertyChannel(
        e3d.Material(), "roughness", [0.0], [[1.0]]
    ),
    "AnimationClip": lambda: e3d.motion.AnimationClip([moved()]),
    "AnimationPlayer": lambda: e3d.AnimationPlayer(drawn()),
    "Robot": robot,
    "Joint": lambda: robot().joints["j"],
    "Renderer": lambda: e3d.Renderer((4, 4)),
    "Resources": e3d.resources.Resources,
    "Window": lambda: e3d.Window((64, 48)),
}
WITH_NODES = {"RayHit", "ColliderHit"}  # tuples: what holds for their nodes holds for them
#: Their arrays are the caller's.
MAY_BE_WRITTEN = {
    *("Canvas", "Flow", "Frame", "LidarScan", "RayHits", "RasterizeResult", "StereoPair", "Values"),
    *("Deviation", "Faults", "Gap", "Measures"),
}
WAYS = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda thing: pickle.loads(pickle.dumps(thing)),
    "old pickle": lambda thing: pickle.loads(pickle.dumps(thing, 2)),
}


def test_every_public_class_is_tried():
    classes = {name: thing for name, thing in public_things().items() if inspect.isclass(thing)}
    errors = {name for name, kind in classes.items() if issubclass(kind, (Exception, Warning))}
    assert classes.keys() - errors == {*COPIED, *REFUSED, *WITH_NODES}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", REFUSED)
def test_what_belongs_to_something_refuses(name, way, monkeypatch):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    with pytest.raises(TypeError, match=f"an? {name} |{name} cannot"):
        WAYS[way](REFUSED[name]())


def public_arrays(thing):
    """The arrays that a thing shows, by name."""
    found = {}
    for name in dir(thing):
        if not name.startswith("_"):
            value = getattr(thing, name, None)
            if isinstance(value, np.ndarray):
                found[name] = value
            elif isinstance(value, dict):
                found.update((key, v) for key, v in value.items() if isinstance(v, np.ndarray))
    return found


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", COPIED)
def test_copies_have_the_same_arrays_which_nobody_can_write_to(name, way):
    thing = COPIED[name]()
    other = WAYS[way](thing)
    assert type(other) is type(thing) and other is not thing
    before, after = public_arrays(thing), public_arrays(other)
    assert before.keys() == after.keys()
    for what, array in after.items():
        assert np.array_equal(array, before[what], equal_nan=array.dtype.kind == "f"), what
        if name not in MAY_BE_WRITTEN:
            assert not array.flags.writeable or before[what].flags.writeable, what


@pytest.mark.parametrize("way", WAYS)
def test_copies_of_what_is_drawn_go_their_own_way(way):
    scene = drawn()
    ball, crowd = (scene.find(name).object for name in ("ball", "crowd"))
    expected = e3d.render(scene, size=(32, 24), threads=1).color
    ball_copy, crowd_copy = WAYS[way](ball), WAYS[way](crowd)
    twin = e3d.Scene()
    twin.add(ball_copy)
    twin.add(crowd_copy)
    assert np.array_equal(e3d.render(twin, size=(32, 24), threads=1).color, expected)
    with pytest.raises(ValueError, match="read-only"):
        ball_copy.faces[:] = 10**6

    normals, bounds = ball.normals.copy(), scene.bounds.copy()
    ball_copy.positions = ball_copy.positions * 2
    ball_copy.groups["other"] = np.arange(3)
    ball_copy.warnings.append("another")
    ball_copy.materials.append(e3d.Material())
    crowd_copy.poses = [(2, 0, 0, 0.5)]
    assert np.array_equal(e3d.render(scene, size=(32, 24), threads=1).color, expected)
    assert np.array_equal(ball.normals, normals) and np.array_equal(scene.bounds, bounds)
    assert list(ball.groups) == ["half"] and ball.warnings == ["a warning"]
    assert len(ball.materials) == 1
    assert not np.array_equal(e3d.render(twin, size=(32, 24), threads=1).color, expected)
    assert twin.bounds[1, 0] == pytest.approx(2.25)
    assert twin.raycast((2.2, 0, 5), (0, 0, -1)).node is twin.nodes[1]


def test_a_material_s_extras_are_its_own():
    material = painted().materials[0]
    copy.copy(material).extras["more"] = 1
    assert material.extras == {"note": [1]}


def test_buffers_that_others_can_write_to_are_copied():
    """Pickles with buffers aside: what is unpickled may lie in memory that is somebody's."""
    buffers = []
    data = pickle.dumps(painted(), 5, buffer_callback=buffers.append)
    aside = [bytearray(buffer) for buffer in buffers]
    mesh = pickle.loads(data, buffers=aside)
    expected = mesh.faces.copy()
    for memory in aside:
        memory[:] = b"\x7f" * len(memory)
    assert np.array_equal(mesh.faces, expected)


def test_hits_are_copied_as_tuples():
    hit = drawn().raycast((1, 0, 5), (0, 0, -1))
    assert copy.copy(hit) == hit
    with pytest.raises(TypeError, match="a Node belongs to its Scene"):
        pickle.dumps(hit)
