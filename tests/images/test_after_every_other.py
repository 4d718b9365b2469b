"""One renderer draws every feature after every other one, as a renderer does that drew nothing yet.

What a renderer keeps from frame to frame must never show. The features are those of the lists that
the engine has itself, so that a new one comes in, or fails the test that asks for it.
"""

import itertools
import typing
from dataclasses import fields

import numpy as np
import pytest
from images.golden import load
from images.picture import digests
from images.scenes import SCENES
from plain_picture import Renderer

import engine3d as e3d
from engine3d.model.scene.lights import LIGHTS
from engine3d.model.scene.surroundings import SCENE_VALUES
from engine3d.rendering.frame import OUTPUTS
from engine3d.rendering.options import RenderOptions

SIZE = (26, 18)
SHOWN = ("color", "radiance", "depth", "object_id", "normal")
PIXELS = np.random.default_rng(1).integers(0, 256, (9, 7, 4), np.uint8)
PROBE = np.linspace(-0.5, 1, 27).reshape(9, 3)
#: Values of options that are numbers or switches, besides the usual one.
NUMBERS = {
    "outputs": tuple((name,) for name in OUTPUTS) + (("color",), SHOWN),
    "line_width": (3.5,),
    "line_color": ((255, 0, 0),),
    "hidden_lines": (True,),
    "point_size": (5.0,),
    "batching": (False,),
    "transparent_outputs": (True,),
    "bloom": (1.0,),
    "alpha_to_coverage": (False,),
    "sample_shading": (True,),
    "specular_antialiasing": (False,),
    "ambient_occlusion": (True,),
    "ambient_occlusion_radius": (0.7,),
    "mirror_depth": (0, 1),
    "refraction": (False,),
}
#: Options that do something only with others.
BESIDE = {
    "line_width": {"wireframe": "overlay"},
    "line_color": {"wireframe": "overlay"},
    "line_shape": {"wireframe": "overlay", "line_width": 4.0},
    "hidden_lines": {"wireframe": "only"},
    "ambient_occlusion_radius": {"ambient_occlusion": True},
    "size_unit": {"line_width": 90.0, "point_size": 200.0, "wireframe": "overlay"},
}
VALUES = {
    "background": (None, (9, 80, 200), e3d.Gradient((1, 0, 0), (0, 0, 1)), e3d.Environment.sky()),
    "ambient": ((0.7, 0.2, 0.1),),
    "light_clamp": ((0.2, 0.4),),
    "exposure": (2.0,),
    "environment": (e3d.Environment.sky((1, 1, 0)), e3d.Environment(PIXELS[..., :3] / 99.0)),
    "environment_intensity": (0.3,),
    "environment_rotation": (1.5,),
    "background_blur": (0.5,),
    "fog": (e3d.Fog((1.0, 0, 0), 1, 9), e3d.ExponentialFog((0, 1.0, 0), 0.2)),
}
LIT = {
    "DirectionalLight": lambda **how: e3d.DirectionalLight((0.3, -1, -0.5), **how),
    "PointLight": lambda **how: e3d.PointLight(e3d.linear(1, 0.5, 0.2), 9.0, **how),
    "SpotLight": lambda **how: e3d.SpotLight(e3d.linear(0.2, 0.5, 1), 20.0, **how),
    "RectangleLight": lambda **how: e3d.lights.RectangleLight(intensity=4.0, width=2.0, **how),
    "DiscLight": lambda **how: e3d.lights.DiscLight((1, 0.5, 0.2), 4.0, radius=0.7, **how),
    "TubeLight": lambda **how: e3d.lights.TubeLight((0.2, 0.5, 1), 4.0, length=2.0, **how),
    "HemisphereLight": lambda: e3d.HemisphereLight(e3d.linear(1, 0.5, 0), (0, 0, 1)),
    "LightProbe": lambda: e3d.LightProbe(PROBE),
}
MATERIALS = {
    "flat": {"flat_shading": True},
    "two sides": {"two_sided": True},
    "unlit": {"unlit": True},
    "texture": {"texture": e3d.Texture(PIXELS)},
    "nearest": {"texture": e3d.Texture(PIXELS, filter="nearest", wrap="mirror")},
    "anisotropic": {"texture": e3d.Texture(PIXELS, anisotropy=8)},
    "normal map": {"normal_texture": e3d.Texture(PIXELS), "metallic": 0.4},
    "mask": {"texture": e3d.Texture(PIXELS), "alpha_mode": "mask"},
    "blend": {"color": (1, 0, 0, 0.4), "alpha_mode": "blend"},
    "glossy": {"specular": (1, 1, 1), "shininess": 9.0},
    "coat": {"metallic": 0.1, "clearcoat": 1.0},
    "cloth": {"roughness": 0.9, "sheen_color": (1, 0, 0), "sheen_roughness": 0.4},
    "brushed": {"metallic": 1.0, "roughness": 0.3, "anisotropy": 0.8},
    "film": {"metallic": 0.0, "roughness": 0.2, "iridescence": 1.0},
    "glass": {"roughness": 0.1, "transmission": 1.0, "thickness": 0.5},
    "leaf": {"roughness": 0.5, "diffuse_transmission": 0.7, "thickness": 0.1, "two_sided": True},
    "emissive": {"metallic": 0.0, "emissive": e3d.linear(3.0, 0, 0)},
}


def flag():
    x, y = np.meshgrid([0, 1.0], [0, 0.5, 1])
    faces = [(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 5, 4)]
    return e3d.Mesh(np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3), faces)


def skinned(scene):
    mesh = flag()
    joints = [scene.add(), scene.add(translation=(0.3, 0.2, 0.4))]
    mesh.set_influences([(0,), (0,), (0,), (1,), (1,), (1,)], np.ones((6, 1)))
    scene.add(mesh).skin = e3d.motion.Skin(joints, np.tile(np.eye(4), (2, 1, 1)))


def morphed(scene):
    mesh = flag()
    mesh.morph_targets = [e3d.motion.MorphTarget(np.linspace(0, 1, 18).reshape(6, 3))]
    scene.add(mesh).morph_weights = [0.7]


def instanced(scene):
    poses = [(-1, 0, 0, 0.5), (1, 0.5, 0, 0.7), (0, -1, 0.5, 0.3)]
    scene.add(e3d.InstancedMesh(e3d.box(), poses, colors=[(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0)]))


def marks(scene):
    points = np.random.default_rng(3).normal(size=(9, 3))
    scene.add(e3d.Mesh(points, lines=[(0, 1), (2, 3), (4, 8)], points=range(9)))


def many(scene):
    ball = e3d.icosphere(0.2, 1)
    for k in range(30):
        scene.add(ball, translation=(k % 6 - 2.5, k // 6 - 2, -1)).visible = k % 4 != 0


def open_box(scene):
    box = e3d.box()
    scene.add(e3d.Mesh(box.positions, box.faces[:-2]), euler=(0.6, 0.7, 0))


OBJECTS = {
    "nothing": lambda scene: [scene.remove(node) for node in scene.nodes],
    "skin": skinned,
    "morphs": morphed,
    "instances": instanced,
    "marks": marks,
    "many": many,
    "a hole": open_box,
    "orthographic": lambda scene: scene.add(e3d.OrthographicCamera(2), translation=(0, 0, 5)),
    "mirrored": lambda scene: scene.add(flag(), scale=(-1, 1, 1), translation=(0, 0, 1)),
    "a mirror": lambda scene: scene.add(
        e3d.plane((9, 9)), translation=(0, -0.5, 0)
    ).object.materials.__setitem__(0, e3d.Material(mirror=0.8)),
    "hidden light": lambda scene: setattr(scene.add(LIT["LightProbe"]()), "visible", False),
}


def base(material=None):
    """A ball over a ground."""
    scene = e3d.Scene()
    ball = e3d.icosphere(0.8, 2)
    ball.materials = [e3d.Material(metallic=0.3, roughness=0.4, name="ball")]
    if material is not None:
        ball.materials = [e3d.Material(**material)]
    scene.add(ball, translation=(0, 0.3, 0))
    scene.add(e3d.plane((6, 6)), translation=(0, -0.6, 0))
    return scene


def scene_with(change):
    scene = base()
    change(scene)
    return scene


def features():
    """Pairs of a scene and options, by name."""
    plain = base()
    plain.add(LIT["DirectionalLight"]())
    marks(plain)
    found = {}
    for field in fields(RenderOptions):
        kind = getattr(e3d.choices, field.type.split(" | ")[0], None)
        values = NUMBERS.get(field.name) or typing.get_args(kind)
        assert values, f"the option {field.name} has no value here"
        for value in values:
            options = {**BESIDE.get(field.name, {}), field.name: value}
            found[f"{field.name}={value}"] = plain, options
    for name in SCENE_VALUES:
        for number, value in enumerate(VALUES[name]):
            scene = scene_with(lambda scene, n=name, v=value: setattr(scene, n, v))
            if name.startswith(("environment_", "background_")):
                scene.background = scene.environment = VALUES["environment"][0]
            found[f"{name} {number}"] = scene, {}
    for kind in LIGHTS:
        ways = ({},) if kind.__name__ in ("HemisphereLight", "LightProbe") else SHADOWS
        for way in ways:
            light = LIT[kind.__name__](**way)
            scene = scene_with(lambda scene, obj=light: scene.add(obj, translation=(0, 3, 1)))
            found[f"{kind.__name__} {way}"] = scene, {}
    for name, material in MATERIALS.items():
        scene = base(material)
        scene.add(LIT["PointLight"](), translation=(1, 2, 2))
        found[f"material {name}"] = scene, {}
    for name, change in OBJECTS.items():
        found[name] = scene_with(change), {}
    return found


SHADOWS = ({}, {"shadow": "map", "shadow_map_size": 64}, {"shadow": "exact"})
CAMERA = e3d.PerspectiveCamera(1.0, zfar=50), e3d.look_at((1, 1.2, 3.5), (0, 0, 0))


def draw(renderer, feature, name):
    scene, options = feature
    camera = None if name == "orthographic" else CAMERA
    frame = renderer.render(scene, camera, **{"outputs": SHOWN, **options})
    return b"".join(getattr(frame, output).tobytes() for output in frame.outputs)


def every_pair(count, rng):
    """Numbers in an order in which each follows each, itself too: a walk over all edges, once."""
    left = [list(rng.permutation(count)) for _ in range(count)]
    walk, stack = [], [0]
    while stack:
        if left[stack[-1]]:
            stack.append(int(left[stack[-1]].pop()))
        else:
            walk.append(stack.pop())
    return walk[::-1]


def test_the_walk_has_every_pair():
    walk = every_pair(7, np.random.default_rng(0))
    assert sorted(itertools.pairwise(walk)) == list(itertools.product(range(7), repeat=2))


@pytest.mark.parametrize(
    ("backend", "settings", "share"),
    (
        ("auto", {}, 1.0),
        ("auto", {"samples": 4, "antialiasing": "msaa"}, 0.05),
        ("auto", {"samples": 4, "color_space": "linear"}, 0.03),
        ("portable", {}, 0.05),
        ("scalar", {}, 0.02),
    ),
)
def test_every_feature_after_every_other(backend, settings, share):
    made = features()
    names = list(made)
    rng = np.random.default_rng(len(names))
    settings = {"backend": backend, "threads": 1, **settings}
    expected = {}
    for name in names:
        with Renderer(SIZE, **settings) as fresh:
            twice = [draw(fresh, made[name], name) for _ in range(2)]
        assert twice[0] == twice[1], f"{name} is drawn otherwise the second time"
        expected[name] = twice[0]
    walk = every_pair(len(names), rng)
    with Renderer(SIZE, **settings) as kept:
        for before, number in itertools.pairwise(walk[: int(share * len(walk))]):
            name = names[number]
            if rng.random() < 0.02:
                kept.resize(rng.integers(1, 90, 2).tolist())
                draw(kept, made[name], name)
                kept.resize(SIZE)
            assert draw(kept, made[name], name) == expected[name], f"{name} after {names[before]}"


def test_pictures_in_any_order():
    """Some of the pictures whose hashes are kept, one after the other by the same renderers."""
    kept, hashes = {}, load()
    for name in np.random.default_rng(5).permutation(sorted(SCENES)).tolist()[:150]:
        picture = SCENES[name]()
        how = picture.color_space, picture.samples, picture.antialiasing
        if how not in kept:
            kept[how] = picture.renderer("auto")
        kept[how].resize(picture.size)
        drawn = {"outputs": tuple(OUTPUTS), **picture.options}
        frame = kept[how].render(picture.scene, picture.camera, **drawn)
        assert digests(frame) == hashes[name], name
