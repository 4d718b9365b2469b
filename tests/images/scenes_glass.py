"""Materials that light passes through: how much, which colours, before what, in every look."""

import numpy as np
from images.objects import CORAL, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_alpha import leaf, pane
from images.scenes_physical import add_lights, bumps, waves

import engine3d as e3d

CLEAR = {"metallic": 0.0, "roughness": 0.1, "transmission": 1.0}


def ball(radius=0.4, **material):
    mesh = e3d.uv_sphere(radius, (20, 12))
    mesh.uvs1 = mesh.uvs[:, ::-1] * 2
    mesh.materials = [e3d.Material(**{**CLEAR, **material})]
    return mesh


def glasses():
    """One of each kind: (ball, place)."""
    dyed = {"thickness": 0.8, "attenuation_color": (0.9, 0.3, 0.1), "attenuation_distance": 0.5}
    second = e3d.PlacedTexture(waves(), uv_set=1)
    yield ball(), (-0.9, 0.5, 0.3)
    yield ball(color=(0.4, 0.9, 0.6), two_sided=True), (-0.3, 0.4, 0.6)
    yield ball(**dyed, two_sided=True), (0.35, 0.45, 0.5)
    yield ball(metallic=0.5, color=(1.0, 0.8, 0.3)), (0.9, 0.4, 0.2)
    yield (
        ball(transmission=0.9, transmission_texture=waves(), thickness_texture=second, **dyed),
        (-0.8, 1.1, -0.2),
    )
    layers = {"clearcoat": 0.7, "sheen_color": (0.5, 0.4, 0.9), "sheen_roughness": 0.5}
    yield ball(normal_texture=bumps(), emissive=(0.05, 0, 0.1), **layers), (0, 1.2, 0)
    faded = {"color": (0.8, 0.9, 1.0, 0.6), "alpha_mode": "blend"}
    yield ball(0.3, **faded), (0.7, 1.2, 0.1)


def behind_glass(background=(30, 38, 54)):
    scene = e3d.Scene(background=background, ambient=(0.2, 0.2, 0.22))
    scene.add(floor(), name="floor")
    for number, (mesh, place) in enumerate(glasses()):
        scale = (1, 1, 1) if number % 3 else (-1.1, 0.8, 0.9)
        scene.add(mesh, translation=place, scale=scale)
    cut = {"texture": leaf(), "alpha_mode": "mask"}
    scene.add(pane((1, 1, 1), size=0.8, **CLEAR, **cut), translation=(0.1, 0.1, 0.9))
    scene.add(pane((*CORAL, 0.5), alpha_mode="blend"), translation=(0.2, 0, 0.2))
    scene.add(with_material(e3d.box(0.4), color=(0.9, 0.9, 0.3)), translation=(0.5, 0.2, -0.4))
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
