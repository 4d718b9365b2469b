"""Physically based materials: numbers, maps in every slot, tangents, layers, many lights."""

import numpy as np
from images.objects import camera_at
from images.picture import Picture, variant

import engine3d as e3d

AROUND = {"background": e3d.linear(0.02, 0.03, 0.05), "ambient": e3d.linear(0.2, 0.25, 0.3)}


def waves(width=16, height=16, **options):
    """A texture whose channels change smoothly, each in another way."""
    y, x = np.mgrid[0:height, 0:width]
    planes = 128 + 120 * np.sin(x / 3), 128 + 120 * np.cos(y / 4), x * 255 / width, y * 255 / height
    return e3d.Texture(np.stack(planes, axis=-1).astype(np.uint8), **options)


def bumps(width=32, height=16, seed=1, **options):
    """Normals in tangent space."""
    slopes = np.random.default_rng(seed).normal(size=(height, width, 2)) * 0.25
    normals = np.dstack([slopes, np.ones((height, width))])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return e3d.Texture((normals * 127.5 + 127.5).round().astype(np.uint8), **options)


def ball(tangents=False, **material):
    mesh = e3d.uv_sphere(0.5, (16, 10))
    mesh.uvs1 = mesh.uvs[:, ::-1] * 3
    if tangents:
        x, _, z = mesh.positions.T
        along = np.stack([-z, 0 * x, x], axis=1)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        mesh.tangents = np.c_[along, np.full(len(x), -1.0)]
    mesh.materials = [e3d.Material(**material)]
    return mesh


def add_lights(scene):
    """One of each kind and falloff."""
    scene.add(e3d.DirectionalLight((-0.3, -1, -0.6), e3d.linear(1, 0.95, 0.9), 2.0))
    cool = e3d.PointLight(e3d.linear(0.6, 0.7, 1), 4, range=6, falloff="gltf")
    scene.add(cool, translation=(-2, 2, 2))
    green = e3d.PointLight(e3d.linear(0.6, 1, 0.7), 0.5, range=6, falloff="window")
    scene.add(green, translation=(2, -2, 2))
    spot = e3d.SpotLight(e3d.linear(1, 0.5, 0.5), 12, 9, inner_cone_angle=0.1, outer_cone_angle=0.4)
    scene.add(spot, translation=(0, 0.2, 4))


def row(balls, exposure=0.0, **picture):
    """Balls side by side, three in a column; every third is mirrored."""
    scene = e3d.Scene(**AROUND, exposure=exposure)
    for k, mesh in enumerate(balls):
        scale = (1, 1, 1) if k % 3 else (-1, 0.9, 1)
        place = (k // 3 * 1.05 - 1.6, k % 3 * 1.05 - 1.05, 0)
        scene.add(mesh, translation=place, rotation=(0.1, 0.3, 0, 0.9), scale=scale)
    add_lights(scene)
    return Picture(scene, camera_at((0, 0, 5.2), (0, 0, 0)), **picture)


def numbers(**picture):
    steps = [(m, r) for m in (0.0, 0.4, 1.0) for r in (0.0, 0.3, 0.7, 1.0)]
    return row(
        [ball(metallic=m, roughness=r, color=e3d.linear(0.9, 0.6, 0.3)) for m, r in steps],
        **picture,
    )


def maps(filter="trilinear", wrap="repeat", **picture):
    """A texture in every slot that is shaded, at both sets of coordinates, moved and not."""
    kind = {"filter": filter, "wrap": wrap}
    moved = {"uv_set": 1, "offset": (0.2, 0.1), "rotation": 0.5, "scale": (2.0, 1.0)}
    color, normals = waves(**kind), bumps(**kind)
    placed = e3d.PlacedTexture(color, **moved)
    numbers = e3d.PlacedTexture(waves(9, 7, **kind), uv_set=1)
    both = {"metallic": 1.0, "roughness": 1.0}
    many = {
        **both,
        "texture": color,
        "metallic_roughness_texture": color,
        "normal_texture": normals,
        "occlusion_texture": waves(8, 8, **kind),
        "occlusion_strength": 0.7,
        "emissive": e3d.linear(0.3, 0.2, 0.1),
        "emissive_strength": 1.5,
        "emissive_texture": placed,
    }
    coat = {"clearcoat_texture": numbers, "clearcoat_roughness_texture": placed}
    coat |= {"clearcoat_normal_texture": bumps(seed=2, **kind), "clearcoat_normal_scale": 0.5}
    sheen = {"sheen_color_texture": placed, "sheen_roughness_texture": numbers}
    specular = {"specular_texture": numbers, "specular_color_texture": color}
    two_sided = {"two_sided": True, "normal_scale": 0.6}
    balls = [
        ball(**many),
        ball(**both, texture=placed, normal_texture=e3d.PlacedTexture(normals, **moved)),
        ball(**both, normal_texture=normals, clearcoat=0.8, clearcoat_roughness=0.6, **coat),
        ball(
            metallic=0,
            color=e3d.linear(0.2, 0.2, 0.6),
            sheen_color=e3d.linear(1, 0.8, 0.6),
            sheen_roughness=1,
            **sheen,
        ),
        ball(metallic=0.1, specular_color=e3d.linear(1, 0.5, 0.2), ior=1.9, **specular),
        ball(tangents=True, **many, **two_sided),
        ball(specular=e3d.linear(0.5, 0.5, 0.5), normal_texture=normals, texture=placed),
        ball(tangents=True, roughness=0.3, normal_texture=normals, clearcoat=0.5),
        ball(unlit=True, texture=placed),
    ]
    return row(balls, **picture)


def layers(**picture):
    """Coats and sheens without any texture; a material that reflects everything."""
    balls = [
        ball(metallic=0, roughness=0.5, clearcoat=1, color=e3d.linear(0.8, 0.1, 0.1)),
        ball(metallic=1, roughness=0.5, clearcoat=0.6, clearcoat_roughness=0.4),
        ball(roughness=0.6, metallic=0.2, clearcoat=1, emissive=e3d.linear(0.1, 0.3, 0.2)),
        ball(
            metallic=0,
            sheen_color=e3d.linear(0.9, 0.7, 0.5),
            sheen_roughness=0.2,
            color=e3d.linear(0.1, 0, 0.2),
        ),
        ball(metallic=0, sheen_color=e3d.linear(0.9, 0.9, 0.9), sheen_roughness=0.9, clearcoat=0.5),
        ball(metallic=0, ior=0, roughness=0.3),
        ball(metallic=0, specular_intensity=0, roughness=0.3, flat_shading=True),
        ball(unlit=True, metallic=0, color=e3d.linear(0.2, 0.7, 0.4)),
    ]
    return row(balls, exposure=-0.7, **picture)


def floor(**options):
    """A floor with mapped normals that reaches behind the camera, so that its faces are clipped."""
    scene = e3d.Scene(**AROUND)
    ground = e3d.plane((60, 60), 3)
    ground.uvs = ground.uvs * 40 - 20
    ground.uvs1 = ground.uvs * 0.5
    second = e3d.PlacedTexture(waves(64, 32), uv_set=1)
    look = {"roughness": 0.5, "metallic": 1.0, "metallic_roughness_texture": second}
    ground.materials = [e3d.Material(normal_texture=bumps(), texture=waves(), **look)]
    scene.add(ground)
    add_lights(scene)
    return Picture(scene, camera_at((0.5, 0.8, 2.0), (0, 0.4, 0)), options=options)


def many_lights(count):
    """More lights than are chosen at a time."""
    rng = np.random.default_rng(4)
    scene = e3d.Scene(**AROUND)
    for k in range(3):
        mesh = ball(
            metallic=k / 2, roughness=0.3, clearcoat=k % 2, sheen_color=e3d.linear(0.2 * k, 0, 0)
        )
        scene.add(mesh, translation=(k - 1, 0, 0))
    for place in rng.uniform(-2, 2, (count, 3)):
        lamp = e3d.PointLight(e3d.linear(rng.uniform(0, 1, 3)), 0.2, range=1.5, falloff="gltf")
        scene.add(lamp, translation=place)
    return Picture(scene, camera_at((0, 0, 3.2), (0, 0, 0)))


def coloured(**options):
    """Vertex and instance colours; lines and points, which have nothing of this."""
    mesh = ball(roughness=0.4, metallic=0.8, normal_texture=bumps(), texture=waves())
    mesh.colors = e3d.linear(np.random.default_rng(5).uniform(0, 1, (len(mesh.positions), 4)))
    mesh.lines, mesh.points = [(0, 40), (20, 60)], [5, 50]
    poses = [(-1.1, 0, 0, 0.9), (0, 0.3, 0.2, -0.8), (1.1, 0, 0, 1.1)]
    scene = e3d.Scene(**AROUND)
    scene.add(
        e3d.InstancedMesh(
            mesh, poses, colors=e3d.linear([(1.0, 0.5, 0.4), (0.5, 1, 0.6), (1, 1, 1)])
        )
    )
    add_lights(scene)
    options = {"line_width": 3, "point_size": 5, **options}
    return Picture(scene, camera_at((0, 0, 3.2), (0, 0, 0)), options=options)


variant("physical_numbers", numbers)
variant("physical_numbers_linear", numbers, color_space="linear")
variant("physical_layers", layers)
variant("physical_layers_samples_4", layers, samples=4)
for _filter, _wrap in (("trilinear", "repeat"), ("bilinear", "clamp"), ("nearest", "mirror")):
    variant(f"physical_maps_{_filter}", maps, _filter, _wrap)
variant("physical_maps_of_two_wraps", maps, "bilinear", ("clamp", "repeat"))
for _name, _value in (
    ("mode", "normal"),
    ("mode", "unlit"),
    ("shading", "forward"),
    ("hidden_surfaces", "painter"),
    ("hidden_surfaces", "none"),
    ("normals", "flat"),
    ("cull", "front"),
    ("wireframe", "overlay"),
):
    variant(f"physical_{_name}_{_value}", maps, options={_name: _value})
variant("physical_floor", floor)
variant("physical_floor_forward", floor, shading="forward")
variant("physical_many_lights", many_lights, 300)
variant("physical_few_lights", many_lights, 20)
variant("physical_coloured", coloured)
variant("physical_coloured_painter", coloured, hidden_surfaces="painter")
