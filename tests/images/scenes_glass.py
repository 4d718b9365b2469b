"""Materials that light passes through, before what, in every look; brushed metal; thin films."""

import numpy as np
from images.objects import CORAL, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_alpha import leaf, pane
from images.scenes_physical import add_lights, bumps, waves
from images.scenes_physical import ball as physical_ball

import engine3d as e3d

CLEAR = {"metallic": 0.0, "roughness": 0.1, "transmission": 1.0}


def ball(radius=0.4, **material):
    mesh = e3d.uv_sphere(radius, (20, 12))
    mesh.uvs1 = mesh.uvs[:, ::-1] * 2
    mesh.materials = [e3d.Material(**{**CLEAR, **material})]
    return mesh


def glasses():
    """One of each kind: (ball, place)."""
    dyed = {
        "thickness": 0.8,
        "attenuation_color": e3d.linear(0.9, 0.3, 0.1),
        "attenuation_distance": 0.5,
    }
    second = e3d.PlacedTexture(waves(), uv_set=1)
    yield ball(), (-0.9, 0.5, 0.3)
    yield ball(color=e3d.linear(0.4, 0.9, 0.6), two_sided=True), (-0.3, 0.4, 0.6)
    yield ball(**dyed, two_sided=True), (0.35, 0.45, 0.5)
    yield ball(metallic=0.5, color=e3d.linear(1.0, 0.8, 0.3)), (0.9, 0.4, 0.2)
    yield (
        ball(transmission=0.9, transmission_texture=waves(), thickness_texture=second, **dyed),
        (-0.8, 1.1, -0.2),
    )
    layers = {"clearcoat": 0.7, "sheen_color": e3d.linear(0.5, 0.4, 0.9), "sheen_roughness": 0.5}
    yield ball(normal_texture=bumps(), emissive=e3d.linear(0.05, 0, 0.1), **layers), (0, 1.2, 0)
    faded = {"color": e3d.linear(0.8, 0.9, 1.0, 0.6), "alpha_mode": "blend"}
    yield ball(0.3, **faded), (0.7, 1.2, 0.1)


def behind_glass(background=(30, 38, 54)):
    scene = e3d.Scene(background=background, ambient=e3d.linear(0.2, 0.2, 0.22))
    scene.add(floor(), name="floor")
    for number, (mesh, place) in enumerate(glasses()):
        scale = (1, 1, 1) if number % 3 else (-1.1, 0.8, 0.9)
        scene.add(mesh, translation=place, scale=scale)
    cut = {"texture": leaf(), "alpha_mode": "mask"}
    scene.add(pane((1, 1, 1), size=0.8, **CLEAR, **cut), translation=(0.1, 0.1, 0.9))
    scene.add(pane(e3d.linear(*CORAL, 0.5), alpha_mode="blend"), translation=(0.2, 0, 0.2))
    scene.add(
        with_material(e3d.box(0.4), color=e3d.linear(0.9, 0.9, 0.3)), translation=(0.5, 0.2, -0.4)
    )
    thing = e3d.Mesh([(-1, 1, 0.6), (1, 0.2, 0.6), (0.6, 1.1, 0.7)], lines=[(0, 1)], points=[2])
    scene.add(with_material(thing, color=TEAL, **CLEAR))
    add_lights(scene)
    return scene


def look(background=(30, 38, 54), *, color_space="srgb", samples=1, sky=False, **options):
    scene = behind_glass(background)
    if sky:
        y, x = np.mgrid[0:16, 0:32]
        light = np.stack([y / 16, 0.5 + 0.4 * np.sin(x / 5), 1 - y / 16], axis=-1)
        scene.environment = e3d.Environment(light.astype(np.float32))
        scene.background = scene.environment
    options = {"point_size": 4, "line_width": 2, **options}
    return Picture(scene, camera_at(), color_space=color_space, samples=samples, options=options)


def row(balls, **options):
    """Balls side by side, three in a column, some of them mirrored."""
    scene = e3d.Scene(
        background=e3d.linear(0.02, 0.03, 0.05), ambient=e3d.linear(0.1, 0.1, 0.1), exposure=-1.5
    )
    for k, mesh in enumerate(balls):
        scale = (1, 1, 1) if k % 3 else (-1, 0.9, 1)
        place = (k // 3) * 0.9 - 1.35, 0.9 - (k % 3) * 0.9, 0
        scene.add(mesh, translation=place, scale=scale)
    add_lights(scene)
    y, x = np.mgrid[0:16, 0:32]
    light = np.stack([y / 16, 0.5 + 0.4 * np.sin(x / 5), 1 - y / 16], axis=-1)
    scene.environment = e3d.Environment(light.astype(np.float32))
    camera = camera_at((0, 0, 3.6), (0, 0, 0))
    return Picture(scene, camera, samples=options.pop("samples", 1), options=options)


def metal(tangents=False, uvs=True, **material):
    mesh = physical_ball(
        tangents,
        **{"metallic": 1.0, "roughness": 0.3, "color": e3d.linear(0.6, 0.6, 0.6), **material},
    )
    if not uvs:
        mesh.uvs = mesh.uvs1 = None
    return mesh


def brushed(**options):
    """Anisotropy along tangents, by a texture, with mapped normals, without any tangent."""
    turned = {"anisotropy": 0.8, "anisotropy_rotation": 1.2}
    placed = e3d.PlacedTexture(bumps(seed=3), uv_set=1, rotation=0.4, scale=(2, 1))
    balls = [
        metal(anisotropy=1.0),
        metal(True, roughness=0.15, color=e3d.linear(0.9, 0.6, 0.3), **turned),
        metal(anisotropy=0.9, anisotropy_texture=bumps()),
        metal(anisotropy=0.9, anisotropy_texture=placed, normal_texture=bumps(seed=2)),
        metal(uvs=False, **turned),
        metal(metallic=0.0, clearcoat=0.5, roughness=0.5, **turned),
        metal(roughness=0.0, two_sided=True, **turned),
        metal(unlit=True, **turned),
        metal(metallic=0.2, transmission=0.8, sheen_color=e3d.linear(0.3, 0.2, 0.1), **turned),
    ]
    return row(balls, **options)


def films(**options):
    """Thin films on metal and none, by numbers and by textures, under a coat, on glass."""
    film = {"iridescence": 1.0, "roughness": 0.2}
    placed = e3d.PlacedTexture(waves(filter="bilinear"), uv_set=1)
    balls = [
        metal(**film),
        metal(
            metallic=0.0,
            color=e3d.linear(0.05, 0.05, 0.05),
            iridescence_thickness_maximum=550,
            **film,
        ),
        metal(metallic=0.3, iridescence_ior=1.8, iridescence_thickness_texture=waves(), **film),
        metal(iridescence_texture=waves(), iridescence_thickness_texture=placed, **film),
        metal(iridescence_thickness_minimum=0, iridescence_thickness_texture=placed, **film),
        metal(metallic=0.0, transmission=1.0, iridescence_ior=1.0, **film),
        metal(metallic=0.0, ior=0, clearcoat=0.6, anisotropy=0.7, **film),
        metal(
            metallic=0.0,
            ior=1,
            specular_color=e3d.linear(1, 0.5, 0),
            sheen_color=e3d.linear(0.2, 0.2, 0.2),
            **film,
        ),
        metal(iridescence_thickness_maximum=0, **film),
    ]
    return row(balls, **options)


variant("brushed", brushed)
variant("brushed_samples_4", brushed, samples=4)
variant("films", films)
for _kind, _of in (("brushed", brushed), ("films", films)):
    variant(f"{_kind}_forward", _of, shading="forward")
    variant(f"{_kind}_painter", _of, hidden_surfaces="painter")
    variant(f"{_kind}_unlit", _of, mode="unlit")
variant("glass", look)
variant("glass_linear", look, color_space="linear")
variant("glass_sky", look, sky=True)
variant("glass_front", look, transparent_outputs=True)
for _samples in (1, 4):
    variant(f"glass_without_background_{_samples}", look, None, samples=_samples)
variant("glass_samples_16", look, samples=16, transparent_outputs=True)
for _mode in ("unlit", "normal", "overdraw"):
    variant(f"glass_mode_{_mode}", look, mode=_mode)
for _name, _value in (
    ("shading", "forward"),
    ("hidden_surfaces", "painter"),
    ("hidden_surfaces", "none"),
    ("cull", "none"),
    ("wireframe", "overlay"),
    ("wireframe", "only"),
):
    variant(f"glass_{_name}_{_value}", look, **{_name: _value})
