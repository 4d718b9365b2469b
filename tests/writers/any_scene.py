"""Scenes of everything: each kind of node, object, material and motion, by a seed."""

import math

import numpy as np

import engine3d as e3d
from engine3d.model.materials.material import TEXTURE_SLOTS
from engine3d.model.scene.lights import FALLOFFS

#: What materials are given, by the generator of random numbers; a field that is not here is left.
MATERIALS = {
    "color": lambda r: color(r, pick(r, 3, 4)),
    "specular": lambda r: color(r),
    "shininess": lambda r: pick(r, 0.0, 32.0, 7.3, 1000),
    "emissive": lambda r: color(r),
    "two_sided": lambda r: bool(r.integers(2)),
    "flat_shading": lambda r: bool(r.integers(2)),
    "name": lambda r: pick(r, "m", "", "mat é", "m"),
    "extras": lambda r: pick(r, {}, {"a": 1, "z": [1, None, {"q": 1.5}]}, {"z": True, "i": 2**70}),
    "metallic": lambda r: pick(r, None, 0.0, 0.5, 1.0),
    "roughness": lambda r: pick(r, None, 0.0, 0.3, 1.0),
    "unlit": lambda r: bool(r.integers(2)),
    "alpha_mode": lambda r: pick(r, "opaque", "mask", "blend"),
    "alpha_cutoff": lambda r: pick(r, 0.5, 0.25, 2.0),
    "normal_scale": lambda r: pick(r, 1.0, -0.5, 2),
    "occlusion_strength": lambda r: r.random(),
    "emissive_strength": lambda r: pick(r, 1.0, 3.5, 0.0),
    "ior": lambda r: pick(r, 1.5, 0, 1.33, 1.0),
    "specular_intensity": lambda r: r.random(),
    "specular_color": lambda r: color(r),
    "mirror": lambda r: pick(r, 0.0, 0.5, 1),
    "clearcoat": lambda r: r.random(),
    "clearcoat_roughness": lambda r: r.random(),
    "clearcoat_normal_scale": lambda r: pick(r, 1.0, 0.3),
    "sheen_color": lambda r: color(r),
    "sheen_roughness": lambda r: r.random(),
    "transmission": lambda r: r.random(),
    "thickness": lambda r: r.random(),
    "diffuse_transmission": lambda r: r.random(),
    "diffuse_transmission_color": lambda r: color(r),
    "dispersion": lambda r: pick(r, 0.0, 0.7, 20.0),
    "attenuation_color": lambda r: color(r),
    "attenuation_distance": lambda r: pick(r, math.inf, 2.0, 0.1),
    "anisotropy": lambda r: r.random(),
    "anisotropy_rotation": lambda r: r.normal(),
    "iridescence": lambda r: r.random(),
    "iridescence_ior": lambda r: pick(r, 1.3, 2.0),
    "iridescence_thickness_minimum": lambda r: pick(r, 100.0, 0.0),
    "iridescence_thickness_maximum": lambda r: pick(r, 400.0, 1000),
}
#: What meshes are given besides positions, faces and materials; v and f are how many there are.
ARRAYS = {
    "normals": lambda r, v, f, n: r.normal(size=(v, 3)),
    "uvs": lambda r, v, f, n: r.random((v, 2)),
    "uvs1": lambda r, v, f, n: r.random((v, 2)),
    "tangents": lambda r, v, f, n: np.hstack([r.normal(size=(v, 3)), r.choice([-1, 1], (v, 1))]),
    "colors": lambda r, v, f, n: pick(
        r, r.integers(0, 256, (v, 4), np.uint8), r.random((v, 4)), e3d.linear(r.random((v, 3)) * 2)
    ),
    "material_ids": lambda r, v, f, n: r.integers(0, n, f),
    "lines": lambda r, v, f, n: r.integers(0, v, (2, 2)),
    "points": lambda r, v, f, n: r.integers(0, v, 3),
    "edge_visible": lambda r, v, f, n: r.random((f, 3)) < 0.5,
    "position_ids": lambda r, v, f, n: r.integers(0, v, v),
    "crease_angle": lambda r, v, f, n: 3 * r.random(),
    "morph_targets": lambda r, v, f, n: [target(r, v) for _ in range(r.integers(1, 3))],
}
PRIMITIVES = (
    lambda: e3d.box((1, 2, 0.5)),
    lambda: e3d.uv_sphere(0.5, (8, 5)),
    lambda: e3d.cylinder(0.3, segments=6),
    lambda: e3d.plane((2, 1), (2, 2)),
)


def pick(r, *choices):
    return choices[int(r.integers(len(choices)))]


def color(r, count=3):
    numbers = r.random(count).tolist(), map(int, r.integers(0, 256, count)), (1.0,) * count
    given = tuple(pick(r, *numbers, (1,) * count, (0.0,) * count))
    is_light = r.random() < 0.3 and all(isinstance(part, float) for part in given)
    return e3d.linear(given) if is_light else given


def texture(r):
    height, width, channels = (int(r.integers(1, most)) for most in (7, 7, 5))
    return e3d.Texture(
        r.integers(0, 256, (height, width, channels), np.uint8),
        color_space=pick(r, "srgb", "linear"),
        filter=pick(r, "trilinear", "bilinear", "nearest"),
        wrap=pick(r, "repeat", "clamp", ("clamp", "repeat"), ("mirror", "mirror")),
        name=pick(r, "", "t", "tex é"),
        anisotropy=pick(r, 1, 4, 16),
        lod_bias=pick(r, 0.0, -1.5, 0.1),
    )


def slot(r, textures):
    held = pick(r, None, pick(r, *textures))
    if held is None or r.random() < 0.5:
        return held
    return e3d.PlacedTexture(
        held,
        uv_set=pick(r, 0, 1),
        offset=pick(r, (0, 0), tuple(r.normal(size=2))),
        rotation=pick(r, 0.0, 0.3, -2),
        scale=pick(r, (1, 1), (2, 0.5)),
    )


def material(r, textures):
    given = {name: make(r) for name, make in MATERIALS.items() if r.random() < 0.35}
    if r.random() < 0.6:
        given.update((name, slot(r, textures)) for name in TEXTURE_SLOTS)
    return e3d.Material(**given)


def target(r, vertices):
    kinds = pick(r, "p", "n", "pn", "pt", "pnt")
    offsets = {"p": "positions", "n": "normals", "t": "tangents"}
    given = {offsets[kind]: r.normal(size=(vertices, 3)) for kind in kinds}
    return e3d.motion.MorphTarget(**given, name=pick(r, "", "up"))


def mesh(r, materials):
    if r.random() < 0.3:
        made = pick(r, *PRIMITIVES)()
        made.materials = pick(r, made.materials, [pick(r, *materials)])
        made.name = pick(r, made.name, "named", "")
        return made
    v, f, n = (int(r.integers(*span)) for span in ((3, 12), (0, 8), (1, 4)))
    given = {name: make(r, v, f, n) for name, make in ARRAYS.items() if r.random() < 0.35}
    if r.random() < 0.3:
        joints = pick(r, 1, 2, 4, 5)
        weights = r.random((v, joints)) * (r.random((v, joints)) < 0.7)
        weights[:, 0] += 0.1
        given.update(joints=r.integers(0, 3, (v, joints)), weights=weights)
    made = e3d.Mesh(
        r.normal(size=(v, 3)) * pick(r, 1, 1, 1e-20, 1e20),
        r.integers(0, v, (f, 3)),
        materials=[pick(r, *materials) for _ in range(n)],
        name=pick(r, "", "mesh", "Ü"),
        **given,
    )
    if f and r.random() < 0.2:
        made.groups = {"g é": r.integers(0, f, 2), "": [0]}
    return made


def light(r):
    common = {"color": color(r), "intensity": pick(r, 1.0, 0.0, 3.7)}
    common.update(shadow=pick(r, "none", "map", "exact"), shadow_map_size=pick(r, 1024, 64))
    common.update(shadow_bias=pick(r, 0.0, 0.01), shadow_taps=pick(r, 3, 5))
    common.update(shadow_softness=pick(r, 0.0, 0.125))
    makers = (
        lambda: e3d.DirectionalLight(pick(r, (0, 0, -1), (0, 0, 1), (1, -2, 0.5)), **common),
        lambda: e3d.PointLight(range=3.0, falloff=pick(r, *FALLOFFS), **common),
        lambda: e3d.PointLight(**common),
        lambda: e3d.SpotLight(range=pick(r, math.inf, 3.0), inner_cone_angle=0.2, **common),
        lambda: e3d.HemisphereLight(color(r), color(r), 2.5),
        lambda: e3d.LightProbe(r.normal(size=(9, 3)), 0.3),
    )
    return pick(r, *makers)()


def camera(r):
    makers = (
        lambda: e3d.PerspectiveCamera(pick(r, 0.7, 1.2), zfar=pick(r, None, 100.0, 50)),
        lambda: e3d.PerspectiveCamera(1.0, aspect=1.5),
        lambda: e3d.OrthographicCamera(2.0, xmag=pick(r, None, 3.0)),
        lambda: e3d.OrthographicCamera(2.0, znear=-5, zfar=5),
        lambda: e3d.IntrinsicsCamera(9, 9, 8, 6),
        lambda: e3d.Camera(e3d.linalg.perspective(1.0, 1.0, 0.1)),
    )
    return pick(r, *makers)()


def instances(r, meshes):
    count = int(r.integers(0, 4))
    poses = r.normal(size=(count, 4))
    if r.random() < 0.5:
        poses = np.tile(np.eye(4), (count, 1, 1))
        poses[:, :3] += r.normal(size=(count, 3, 4)) * pick(r, 0, 0.1)
    colors = pick(
        r,
        None,
        e3d.linear(2 * r.random((count, 4))),
        r.random((count, 4)),
        r.integers(0, 256, (count, 3), np.uint8),
    )
    return e3d.InstancedMesh(pick(r, *meshes), poses, colors=colors)


def collider(r, obj, meshes):
    sphere, box = (
        e3d.colliders.SphereCollider(2, (1, 0, 0.5)),
        e3d.colliders.BoxCollider((0, 0, 0), (1, 2, 3)),
    )
    own = (
        (e3d.colliders.BoxCollider(), e3d.colliders.MeshCollider())
        if isinstance(obj, e3d.Mesh)
        else ()
    )
    return pick(
        r, None, None, None, sphere, box, e3d.colliders.MeshCollider(pick(r, *meshes)), *own
    )


def pose(r):
    turned = {"rotation": r.normal(size=4), "scale": pick(r, 1.0, (1, 2, 3), (0, 1, -0.5))}
    matrix = {"pose": np.vstack([r.normal(size=(3, 4)), (0, 0, 0, 1)])}
    moved = {"translation": pick(r, (-0.0, 0, 0), (0.1, 0.2, 1e-30)), "euler": r.normal(size=3)}
    return pick(r, {}, turned, matrix, moved)


def channel(r, nodes):
    node, path = pick(r, *nodes), pick(r, "translation", "rotation", "scale")
    width = 4 if path == "rotation" else 3
    if isinstance(node.object, e3d.Mesh) and node.object.morph_targets:
        path, width = "weights", len(node.object.morph_targets)
    count, how = int(r.integers(1, 4)), pick(r, "linear", "step", "cubicspline")
    shape = (count, 3, width) if how == "cubicspline" else (count, width)
    return e3d.motion.Channel(
        node, path, np.cumsum(r.random(count) + 0.1), r.normal(size=shape), how
    )


def surroundings(r, scene):
    environments = e3d.Environment(r.random((2, 4, 3)), name=pick(r, "", "e")), None
    environments += (e3d.Environment.studio(), e3d.Environment.sky((1, 1, 0)))
    gradient = e3d.Gradient(color(r), color(r))
    scene.background = pick(r, None, color(r), gradient, *environments)
    scene.environment = pick(r, *environments)
    scene.ambient, scene.exposure = color(r), pick(r, 0.0, 1.5, -0.0, -3)
    scene.light_clamp = pick(r, None, (0.1, 0.9), (0, 2))
    scene.environment_intensity, scene.environment_rotation = pick(r, 1.0, 2), pick(r, 0.0, 7)
    scene.background_blur = pick(r, 0.0, 0.3, 1)
    scene.fog = pick(r, None, e3d.Fog(color(r), 1, 5), e3d.ExponentialFog(color(r), 0.2))


def any_scene(seed):
    r = np.random.default_rng(seed)
    scene = e3d.Scene()
    surroundings(r, scene)
    textures = [texture(r) for _ in range(4)]
    materials = [material(r, textures) for _ in range(4)]
    meshes = [mesh(r, materials) for _ in range(4)]
    objects = [None, None, *meshes, *meshes, *(light(r) for _ in range(3))]
    objects += [camera(r), camera(r), instances(r, meshes), instances(r, meshes)]
    nodes = []
    for number in range(int(r.integers(1, 24))):
        obj = pick(r, *objects)
        node = scene.add(
            obj,
            name=pick(r, None, f"n{number}", "é", "twin", ""),
            parent=pick(r, None, *nodes),
            static=bool(r.integers(2)),
            cast_shadows=bool(r.integers(4)),
            receive_shadows=bool(r.integers(4)),
            **pose(r),
        )
        node.visible, node.collider = bool(r.integers(6)), collider(r, obj, meshes)
        nodes.append(node)
    binds = np.tile(np.eye(4), (3, 1, 1))
    for node in nodes:
        if isinstance(node.object, e3d.Mesh) and node.object.joints is not None:
            node.skin = e3d.motion.Skin(
                [pick(r, *nodes) for _ in range(3)], binds, pick(r, "", "skin")
            )
        if isinstance(node.object, e3d.Mesh) and node.object.morph_targets:
            node.morph_weights = r.random(len(node.object.morph_targets))
    for number in range(int(r.integers(0, 3))):
        clip = e3d.motion.AnimationClip([channel(r, nodes) for _ in range(2)], pick(r, "", "same"))
        scene.animations[f"clip é {number}"] = clip
    if r.random() < 0.4:
        scene.animator = e3d.Animator(scene)
        scene.animator.spin(nodes[:2], axis=(1, 2, 3), period=-2.5, phase=0.25)
    return scene
