"""Brightness from dark to far above 1, fog and gradients: in every way of drawing."""

import numpy as np
from images.objects import CORAL, SAND, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_alpha import pane

import engine3d as e3d
from engine3d._native.rasterizer import TONE_MAPPINGS

SKY = e3d.Gradient((40, 90, 180), (235, 225, 205))
HAZE = (180, 190, 200)
FOGS = {
    "linear": e3d.Fog(HAZE, 2.0, 6.5),
    "exponential": e3d.ExponentialFog(HAZE, 0.25),
}


def lamps(background=(30, 38, 54), fog=None):
    """Rows of balls that shine more and more, of each kind of material, lines and points."""
    scene = e3d.Scene(background, ambient=e3d.linear(0.2, 0.2, 0.25), exposure=0.5)
    scene.fog = fog
    scene.add(floor(8.0, color=e3d.linear(0.5, 0.5, 0.5)))
    for number in range(5):
        shine = e3d.linear(np.array(CORAL) * 0.06 * 3.0**number)
        plain = with_material(e3d.uv_sphere(0.28, (16, 8)), color=CORAL, emissive=shine)
        scene.add(plain, translation=(0.7 * number - 1.4, 0.3, 0.9 - 0.6 * number))
        metal = with_material(
            e3d.uv_sphere(0.22, (16, 8)), color=SAND, metallic=0.8, roughness=0.1 + 0.2 * number
        )
        scene.add(metal, translation=(0.7 * number - 1.4, 0.95, 0.6 - 0.6 * number))
        flat = with_material(e3d.box(0.2), color=TEAL, unlit=True)
        scene.add(flat, translation=(0.7 * number - 1.4, 1.4, 0.4 - 0.6 * number))
    line = np.array([(-1.6, 0.1, 1.5), (2.5, 1.8, -3.0), (2.0, 0.2, -2.0)], np.float32)
    scene.add(e3d.Mesh(line, lines=[[0, 1]], points=[2]))
    glass = pane(
        e3d.linear(*TEAL, 0.5), size=1.2, alpha_mode="blend", emissive=e3d.linear(0.8, 0.2, 0.1)
    )
    scene.add(glass, translation=(0.3, 0.2, 0.4))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.45), intensity=3.0 * np.pi))
    return scene


def toned(mapping="none", background=(30, 38, 54), fog=None, **options):
    own = {key: options.pop(key) for key in ("samples", "color_space", "size") if key in options}
    scene = lamps(background, fog)
    options = {"tone_mapping": mapping, "line_width": 2.0, "point_size": 5.0, **options}
    return Picture(scene, camera_at(target=(0, 0.6, 0)), options=options, **own)


def glowing_glass(background=None, fog=None, **options):
    """Bright things behind grey and clear glass, and glass that shines itself."""
    scene = e3d.Scene(background, ambient=e3d.linear(0.1, 0.1, 0.12))
    scene.fog = fog
    for number in range(3):
        lamp = with_material(e3d.icosphere(0.22, 2), color=SAND, emissive=e3d.linear(6.0, 4.0, 1.5))
        scene.add(lamp, translation=(0.8 * number - 0.8, 0.4, -0.3))
    grey = pane(e3d.linear(0.1, 0.1, 0.1, 0.8), size=0.7, alpha_mode="blend")
    scene.add(grey, translation=(0, 0.1, 0.2))
    clear = {"metallic": 0.0, "roughness": 0.1, "transmission": 1.0}
    scene.add(pane(e3d.linear(0.3, 0.9, 0.4), size=0.7, **clear), translation=(0.8, 0.1, 0.2))
    shine = {"alpha_mode": "blend", "emissive": e3d.linear(0.5, 2.5, 5.0)}
    scene.add(pane(e3d.linear(*TEAL, 0.6), size=0.5, **shine), translation=(-0.4, 0.8, 0.4))
    scene.add(pane(e3d.linear(*CORAL, 0.3), 1, size=0.5, **shine), translation=(0.5, 0.8, 0.3))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.45), intensity=2.0 * np.pi))
    names = ("samples", "antialiasing")
    own = {key: options.pop(key) for key in names if key in options}
    return Picture(scene, camera_at(target=(0, 0.6, 0)), options={"bloom": 1.0, **options}, **own)


def behind(background, **options):
    """What the background shows: little stands before it."""
    scene = e3d.Scene(background, exposure=-0.5)
    scene.add(with_material(e3d.icosphere(0.4, 2), color=CORAL), translation=(0.2, 0.4, 0))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.45)))
    own = {key: options.pop(key) for key in ("samples", "color_space") if key in options}
    return Picture(scene, camera_at(), options=options, **own)


for name in TONE_MAPPINGS:
    variant(f"tone_{name}", toned, name)
    variant(f"tone_{name}_sky", behind, e3d.Environment.sky(), tone_mapping=name)
    for kind, mist in FOGS.items():
        variant(f"tone_{name}_fog_{kind}", toned, name, HAZE, mist)
for count in (4, 16):
    variant(f"tone_neutral_{count}", toned, "neutral", SKY, FOGS["linear"], samples=count)
    variant(
        f"tone_agx_sky_{count}", behind, e3d.Environment.sky(), tone_mapping="agx", samples=count
    )
    variant(f"gradient_{count}", behind, SKY, samples=count)
for kind in FOGS:
    variant(f"fog_{kind}", toned, fog=FOGS[kind])
    variant(f"fog_{kind}_unlit", toned, fog=FOGS[kind], mode="unlit")
variant("fog_depth", toned, fog=FOGS["linear"], mode="depth")
variant("fog_in_front", toned, "aces", fog=FOGS["exponential"], transparent_outputs=True)
variant("tone_forward", toned, "aces", SKY, FOGS["linear"], shading="forward")
variant("tone_painter", toned, "agx", SKY, FOGS["linear"], hidden_surfaces="painter")
variant("tone_wireframe", toned, "agx", SKY, FOGS["linear"], wireframe="overlay")
variant("tone_wireframe_only", toned, "agx", SKY, wireframe="only")
variant("tone_linear", toned, "neutral", SKY, FOGS["linear"], color_space="linear")
variant("bloom", toned, "neutral", SKY, bloom=0.4)
variant("bloom_4", toned, background=None, samples=4, bloom=2.0)
variant("bloom_sky", behind, e3d.Environment.sky(), tone_mapping="agx", bloom=1.0)
variant("bloom_linear", toned, "aces", bloom=0.4, color_space="linear")
variant("bloom_glass", glowing_glass, tone_mapping="neutral")
variant("bloom_glass_4", glowing_glass, HAZE, FOGS["linear"], samples=4, tone_mapping="agx")
variant("bloom_glass_msaa", glowing_glass, SKY, samples=4, antialiasing="msaa")
variant("gradient", behind, SKY)
variant("gradient_overdraw", behind, SKY, mode="overdraw")
variant(
    "gradient_linear",
    behind,
    e3d.Gradient(e3d.linear(0.2, 0.2, 0.8), e3d.linear(1.5, 0.5, 0.0)),
    color_space="linear",
)
