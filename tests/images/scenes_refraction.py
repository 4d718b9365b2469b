"""Glass that bends and blurs what is behind it: rough, thick, dispersive, in every look."""

import numpy as np
from images.objects import CORAL, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_alpha import pane
from images.scenes_physical import add_lights, bumps, waves

import engine3d as e3d

CLEAR = {"metallic": 0.0, "roughness": 0.0, "transmission": 1.0}


def wall():
    """Stripes, some of which are not lit."""
    for number in range(9):
        bar = e3d.box((0.12, 1.6, 0.1))
        color = (CORAL, TEAL, (1.0, 1.0, 1.0))[number % 3]
        looks = {"color": e3d.linear(*color), "unlit": number % 3 == 2}
        yield with_material(bar, **looks), (0.4 * number - 1.6, 0.7, -1.0)


def glasses():
    """One of each kind: (mesh, place, scale)."""
    even = (1.0, 1.0, 1.0)
    body = {**CLEAR, "thickness": 0.7}
    ball = e3d.uv_sphere(0.35, (20, 12))
    block = e3d.box(0.5)
    yield with_material(ball.copy(), **body), (-1.2, 0.4, 0.5), even
    yield with_material(ball.copy(), **{**body, "roughness": 0.3}), (-0.4, 0.4, 0.6), (1, 0.7, -1.2)
    strong = {**body, "ior": 2.2, "dispersion": 6.0}
    yield with_material(block.copy(), **strong), (0.4, 0.4, 0.5), even
    varied = {"metallic_roughness_texture": waves(), "thickness_texture": waves()}
    yield with_material(ball.copy(), **{**body, "roughness": 1.0}, **varied), (1.1, 0.5, 0.3), even
    dyed = {"attenuation_color": e3d.linear(0.9, 0.4, 0.1), "attenuation_distance": 0.4}
    bumpy = {"normal_texture": bumps(), "two_sided": True}
    yield with_material(block.copy(), **body, **dyed, **bumpy), (-0.6, 1.1, -0.2), even
    yield (
        pane((1, 1, 1), size=0.9, **{**CLEAR, "roughness": 0.2}),
        (0.3, 0.7, 1.1),
        even,
    )
    faded = {**body, "color": e3d.linear(0.8, 0.9, 1.0, 0.6), "alpha_mode": "blend"}
    yield with_material(ball.copy(), **faded), (0.7, 1.2, 0.1), even


def bent(
    background=(60, 70, 96), *, sky=False, lens=None, color_space="srgb", samples=1, **options
):
    scene = e3d.Scene(background=background, ambient=e3d.linear(0.3, 0.3, 0.32))
    scene.add(floor())
    for mesh, place in wall():
        scene.add(mesh, translation=place)
    for mesh, place, scale in glasses():
        scene.add(mesh, translation=place, scale=scale)
    scene.add(pane(e3d.linear(*CORAL, 0.5), alpha_mode="blend"), translation=(-0.2, 0, 0.2))
    scene.add(with_material(e3d.box(0.15), color=(40, 200, 90)), translation=(0.0, 0.6, 1.4))
    add_lights(scene)
    if sky:
        y, x = np.mgrid[0:16, 0:32]
        light = np.stack([y / 16, 0.5 + 0.4 * np.sin(x / 2), 2 - y / 8], axis=-1)
        scene.environment = scene.background = e3d.Environment(light.astype(np.float32))
    antialiasing = options.pop("antialiasing", "ssaa")
    camera = camera_at((0.9, 1.2, 2.6), (0.1, 0.55, 0)) if lens is None else lens
    given = {"color_space": color_space, "samples": samples, "antialiasing": antialiasing}
    return Picture(scene, camera, **given, options=options)


_FLAT = e3d.OrthographicCamera(1.1), e3d.look_at((0.9, 1.2, 2.6), (0.1, 0.55, 0))
variant("bent", bent)
variant("bent_sky", bent, sky=True, tone_mapping="neutral")
variant("bent_sky_msaa", bent, sky=True, samples=4, antialiasing="msaa", tone_mapping="agx")
variant("bent_linear", bent, color_space="linear")
variant("bent_flat", bent, lens=_FLAT, normals="facet")
variant("bent_front", bent, transparent_outputs=True, wireframe="overlay")
variant("bent_gradient", bent, e3d.Gradient((200, 210, 255), (90, 60, 40)), tone_mapping="aces")
variant("bent_bloom", bent, sky=True, bloom=0.4, ambient_occlusion=True)
for _samples, _how in ((1, "ssaa"), (4, "ssaa"), (4, "msaa"), (16, "msaa")):
    _name = f"bent_without_background_{_how}_{_samples}"
    variant(_name, bent, None, samples=_samples, antialiasing=_how, tone_mapping="neutral")
