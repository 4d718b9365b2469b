"""Whatever is assigned, in whatever order, before a look or between looks: the end alone is seen.

The setters are found in the classes, so that a new one needs values here, or the test fails.
"""

import inspect
import itertools

import numpy as np
import pytest
from plain_picture import Renderer
from writers.any_scene import ARRAYS, MATERIALS, color, pick, target

import engine3d as e3d
from engine3d.base.validation import CheckedAttribute
from engine3d.model.geometry._arrays import ArrayAttribute
from engine3d.model.materials.material import TEXTURE_SLOTS

V, F, N = 6, 4, 2  # vertices, faces and materials of the meshes
FLAG = np.stack([*np.meshgrid([-1, 0.5], [-1, 0.2, 1.3]), np.zeros((3, 2))], axis=-1).reshape(-1, 3)
FACES = [(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 5, 4)]
SIZE = (30, 22)
OUTPUTS = ("color", "radiance", "depth", "object_id", "normal", "uv", "material_id", "albedo")
LOOKS = (
    {},
    {"wireframe": "overlay"},
    {"wireframe": "only", "cull": "auto"},
    {"normals": "flat", "cull": "none"},
    {"mode": "unlit", "outputs": ("color",)},
    {"ambient_occlusion": True, "transparent_outputs": True},
)


class Things:
    """A scene of one thing of each kind, by names."""

    def __init__(self):
        self.scene = e3d.Scene()
        self.texture = e3d.Texture(np.arange(4 * 4 * 4, dtype=np.uint8).reshape(4, 4, 4))
        self.materials = [e3d.Material(texture=self.texture), e3d.Material(metallic=0.5)]
        self.mesh, self.other = (
            e3d.Mesh(FLAG * scale, FACES, uvs=FLAG[:, :2], materials=self.materials)
            for scale in (1.0, 0.6)
        )
        self.instances = e3d.InstancedMesh(self.other, [(1, 1, 0, 0.5), (-1, -1, 0.3, 0.4)])
        self.group = self.scene.add(name="group")
        self.joints = [self.scene.add(translation=(x, 0, 0.1)) for x in (0, 0.3)]
        self.node = self.scene.add(self.mesh, name="node")
        self.place = self.scene.add(self.instances)
        self.camera = e3d.PerspectiveCamera(1.0, zfar=50)
        self.view = self.scene.add(self.camera, translation=(0.2, 0.3, 4))
        self.lights = (
            e3d.DirectionalLight((0, -0.3, -1)),
            e3d.PointLight(e3d.linear(1, 0.5, 0.2), 5.0, 20.0),
            e3d.SpotLight(e3d.linear(0.2, 0.5, 1), 9.0),
            e3d.HemisphereLight(intensity=0.2),
            e3d.LightProbe(np.linspace(0, 0.3, 27).reshape(9, 3)),
        )
        for light in self.lights:
            self.scene.add(light, translation=(0.5, 1, 3), name=type(light).__name__)
        self.of_kind = {
            e3d.Scene: (self.scene,),
            e3d.Node: (self.node, self.place, self.group),
            e3d.Mesh: (self.mesh, self.other),
            e3d.InstancedMesh: (self.instances,),
            e3d.Material: self.materials,
            e3d.Texture: (self.texture,),
            e3d.PerspectiveCamera: (self.camera,),
            **{type(light): (light,) for light in self.lights},
        }

    def skin(self):
        return e3d.motion.Skin(self.joints, np.tile(np.eye(4), (2, 1, 1)))


KINDS = (
    *(e3d.Scene, e3d.Node, e3d.Mesh, e3d.InstancedMesh, e3d.Material, e3d.Texture),
    *(e3d.PerspectiveCamera, e3d.DirectionalLight, e3d.PointLight, e3d.SpotLight),
    *(e3d.HemisphereLight, e3d.LightProbe),
)
PIXELS = lambda r, t: r.integers(0, 256, (4, 4, 4), np.uint8)  # noqa: E731
SHADOWS = {
    "shadow": lambda r, t: pick(r, "none", "map", "exact"),
    "shadow_map_size": lambda r, t: pick(r, 64, 96),
    "shadow_bias": lambda r, t: pick(r, 0.0, 0.02),
    "shadow_normal_bias": lambda r, t: pick(r, 0.0, 0.02),
    "shadow_radius": lambda r, t: pick(r, 0.5, 1.0),
    "shadow_taps": lambda r, t: pick(r, 3, 5),
    "shadow_softness": lambda r, t: pick(r, 0.0, 0.1),
}
LIGHT = {
    "color": lambda r, t: color(r),
    "intensity": lambda r, t: pick(r, 0.0, 2.0, 7.5),
}
#: A value for each setter of each kind, made of random numbers and the things.
VALUES = {
    e3d.Scene: {
        "background": lambda r, t: pick(r, None, color(r), e3d.Gradient(color(r), color(r))),
        "ambient": lambda r, t: color(r),
        "light_clamp": lambda r, t: pick(r, None, (0.1, 0.8)),
        "exposure": lambda r, t: pick(r, 0.0, 1.5),
        "environment": lambda r, t: pick(r, None, e3d.Environment.studio()),
        "environment_intensity": lambda r, t: pick(r, 0.3, 1.0),
        "environment_rotation": lambda r, t: pick(r, 0.0, 2.0),
        "background_blur": lambda r, t: pick(r, 0.0, 0.5),
        "fog": lambda r, t: pick(r, None, e3d.Fog(color(r), 1, 9)),
        "animator": lambda r, t: pick(r, None, e3d.Animator(t.scene)),
        "animations": lambda r, t: {},
        "warnings": lambda r, t: [],
    },
    e3d.Node: {
        "object": lambda r, t: pick(r, t.mesh, t.other, t.instances),
        "skin": lambda r, t: pick(r, None, t.skin()),
        "morph_weights": lambda r, t: pick(r, None, r.random(1), r.random(2)),
        "name": lambda r, t: pick(r, "", "a"),
        "parent": lambda r, t: pick(r, None, t.group, *t.joints),
        "pose": lambda r, t: np.vstack([np.eye(3, 4) + r.normal(0, 0.1, (3, 4)), (0, 0, 0, 1)]),
        "translation": lambda r, t: r.normal(0, 0.3, 3),
        "rotation": lambda r, t: r.normal(size=4),
        "euler": lambda r, t: r.normal(size=3),
        "scale": lambda r, t: pick(r, 1.0, (1, 2, 0.5)),
        "visible": lambda r, t: bool(r.integers(4)),
        "static": lambda r, t: bool(r.integers(2)),
        "cast_shadows": lambda r, t: bool(r.integers(2)),
        "receive_shadows": lambda r, t: bool(r.integers(2)),
        "collider": lambda r, t: pick(
            r, None, e3d.colliders.SphereCollider(0.5), e3d.colliders.MeshCollider(t.mesh)
        ),
    },
    e3d.Mesh: {
        "positions": lambda r, t: FLAG + r.normal(0, 0.2, (V, 3)),
        "faces": lambda r, t: r.permutation(FACES),
        "materials": lambda r, t: pick(r, t.materials, t.materials[::-1]),
        "morph_targets": lambda r, t: [target(r, V) for _ in range(r.integers(0, 3))],
        "groups": lambda r, t: {"g": [0, 1]},
        "values": lambda r, t: pick(
            r,
            {},
            {"heat": e3d.Values(r.random(V), on="vertices")},
            {"heat": e3d.Values(r.random((F, 2)), on="faces")},
        ),
        "name": lambda r, t: pick(r, "", "a"),
        "warnings": lambda r, t: [],
        **{
            name: lambda r, t, make=make: make(r, V, F, N)
            for name, make in ARRAYS.items()
            if name != "morph_targets"
        },
    },
    e3d.InstancedMesh: {
        "mesh": lambda r, t: pick(r, t.mesh, t.other),
        "poses": lambda r, t: r.normal(0, 0.6, (2, 4)),
        "colors": lambda r, t: pick(r, None, r.random((2, 3))),
    },
    e3d.Material: {
        **{name: lambda r, t, make=make: make(r) for name, make in MATERIALS.items()},
        **{
            name: lambda r, t: pick(r, None, t.texture, e3d.PlacedTexture(t.texture, uv_set=1))
            for name in TEXTURE_SLOTS
        },
    },
    e3d.Texture: {
        "pixels": PIXELS,
        "color_space": lambda r, t: pick(r, "srgb", "linear"),
        "filter": lambda r, t: pick(r, "trilinear", "bilinear", "nearest"),
        "wrap": lambda r, t: pick(r, "repeat", "clamp", ("mirror", "clamp")),
        "name": lambda r, t: pick(r, "", "a"),
        "anisotropy": lambda r, t: pick(r, 1, 4),
        "lod_bias": lambda r, t: pick(r, 0.0, 1.0),
    },
    e3d.PerspectiveCamera: {
        "yfov": lambda r, t: pick(r, 0.7, 1.3),
        "aspect": lambda r, t: pick(r, None, 1.5),
        "znear": lambda r, t: pick(r, 0.1, 0.5),
        "zfar": lambda r, t: pick(r, None, 20.0),
        "reversed_depth": lambda r, t: bool(r.integers(2)),
    },
    e3d.DirectionalLight: {
        **LIGHT,
        **SHADOWS,
        "direction": lambda r, t: r.normal(size=3),
        "shadow_cascades": lambda r, t: pick(r, 1, 2),
    },
    e3d.PointLight: {
        **LIGHT,
        **SHADOWS,
        "range": lambda r, t: pick(r, 5.0, 30.0),
        "falloff": lambda r, t: pick(r, "gltf", "window"),
    },
    e3d.SpotLight: {
        **LIGHT,
        **SHADOWS,
        "range": lambda r, t: pick(r, 5.0, 30.0),
        "inner_cone_angle": lambda r, t: pick(r, 0.0, 0.2),
        "outer_cone_angle": lambda r, t: pick(r, 0.4, 1.0),
    },
    e3d.HemisphereLight: {
        "sky_color": lambda r, t: color(r),
        "ground_color": lambda r, t: color(r),
        "intensity": lambda r, t: pick(r, 0.0, 0.5),
    },
    e3d.LightProbe: {
        "coefficients": lambda r, t: r.random((9, 3)),
        "intensity": lambda r, t: pick(r, 0.0, 0.5),
    },
}
#: What is changed without a setter.
CALLS = {
    e3d.Scene: {
        "a node comes and goes": lambda r, t, scene: scene.remove(scene.add(t.mesh)),
        "a node goes and comes": lambda r, t, scene: (scene.remove(t.node), scene.restore(t.node)),
    },
    e3d.Mesh: {
        "influences": lambda r, t, mesh: mesh.set_influences(
            *pick(r, (None, None), (r.integers(0, 2, (V, 2)), r.random((V, 2)) + 0.1))
        ),
        "materials in place": lambda r, t, mesh: mesh.materials.reverse(),
    },
    e3d.InstancedMesh: {"replace": lambda r, t, each: each.replace(r.normal(size=(3, 4)))},
}
#: Which setters the end leaves out, because others set the same.
PARTS = {"translation", "rotation", "euler", "scale"}
END_CALLS = {"influences"}
#: What decides whether skins, weights and colliders fit: what comes first in the end.
FIRST = {"object", "influences", "morph_targets"}


def setters_of(kind):
    """The attributes that can be assigned."""
    found = set()
    for base in kind.__mro__:
        if base.__module__.startswith("engine3d"):
            found |= set(getattr(base, "__annotations__", {}))
            found |= {n for n, v in vars(base).items() if isinstance(v, property) and v.fset}
            kinds = (CheckedAttribute, ArrayAttribute)
            found |= {name for name, value in vars(base).items() if isinstance(value, kinds)}
    held = {name: inspect.getattr_static(kind, name, None) for name in found}
    fixed = {name for name, v in held.items() if isinstance(v, property) and not v.fset}
    return {name for name in found if name[0] != "_"} - {"version"} - fixed


def test_every_setter_has_values():
    for kind in KINDS:
        of_others = {"matrix"} if issubclass(kind, e3d.Camera) else set()  # that have no angle
        assert setters_of(kind) - of_others == VALUES[kind].keys(), kind.__name__
    lights_and_cameras = {e3d.OrthographicCamera, e3d.IntrinsicsCamera, e3d.Camera}
    closed = {kind for kind in vars(e3d).values() if inspect.isclass(kind)}
    assert {*KINDS, *lights_and_cameras} <= closed


def steps(end):
    """All changes: kind, number of the thing, and the name of the setter or of the call."""
    things = Things()
    for kind in KINDS:
        calls = [name for name in CALLS.get(kind, {}) if not end or name in END_CALLS]
        names = [name for name in VALUES[kind] if not (end and name in PARTS)]
        yield from itertools.product([kind], range(len(things.of_kind[kind])), [*names, *calls])


def is_taken(things, step, seed):
    """Make a change, if what is there allows it."""
    try:
        take(things, step, seed)
    except e3d.errors.InvalidArgumentError:
        return False
    return True


def take(things, step, seed):
    kind, number, name = step
    thing, r = things.of_kind[kind][number], np.random.default_rng(seed)
    if name in VALUES[kind]:
        setattr(thing, name, VALUES[kind][name](r, things))
    else:
        CALLS[kind][name](r, things, thing)


def take_all(things, changes):
    """Take steps; those that need others first come later."""
    left = [change for change in changes if not is_taken(things, *change)]
    return take_all(things, left) if len(left) < len(changes) else left


def look(things, renderer, which):
    """What pictures and rays show: the same again at once."""
    seen = []
    for _ in range(2):
        options = {"outputs": OUTPUTS, **LOOKS[which]}
        frame = renderer.render(things.scene, things.view, **options)
        seen.append({name: getattr(frame, name).tobytes() for name in frame.outputs})
        seen[-1]["bounds"] = things.scene.bounds.tobytes()
        hits = [things.scene.raycast((x, 0.2, 9), (0, 0, -1)) for x in (-0.5, 0.1)]
        seen[-1]["hits"] = [hit and (hit.node.id, hit.distance) for hit in hits]
        near = things.scene.overlap_sphere((0.1, 0.2, 0), 0.3)
        seen[-1]["near"] = [node.id for node in near]
    assert seen[0] == seen[1]
    return seen[0]


def differing(one, other):
    return [name for name in one if one[name] != other[name]]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("seed", range(32))
def test_only_the_end_is_seen(seed):
    rng = np.random.default_rng(seed)
    settings = {"threads": 1, "backend": ("auto", "portable", "scalar")[seed % 8 // 3 * (seed % 2)]}
    things, kept = Things(), Renderer(SIZE, **settings)
    possible = list(steps(end=False))
    for number in range(60):
        step = possible[rng.integers(len(possible))]
        take_all(things, [(step, 1000 * seed + number)])
        if seed % 2 and rng.random() < 0.2:
            look(things, kept, rng.integers(len(LOOKS)))
    end = [(step, 7000 * seed + number) for number, step in enumerate(steps(end=True))]
    first = [change for change in end if change[0][2] in FIRST]
    others = [change for change in end if change[0][2] not in FIRST]
    for node in things.of_kind[e3d.Node]:
        node.skin = node.morph_weights = node.collider = node.parent = None
    left = [
        *take_all(things, [first[k] for k in rng.permutation(len(first))]),
        *take_all(things, [others[k] for k in rng.permutation(len(others))]),
    ]
    fresh = Things()
    expected_left = [*take_all(fresh, first), *take_all(fresh, others)]
    assert sorted(map(str, left)) == sorted(map(str, expected_left))
    for which in range(len(LOOKS)):
        expected = look(fresh, Renderer(SIZE, **settings), which)
        assert not differing(look(things, kept, which), expected), LOOKS[which]
