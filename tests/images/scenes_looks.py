"""One still life in every mode, wireframe, cull, hidden-surface method, shading and sampling."""

from images.objects import CORAL, camera_at, still_life, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d
from engine3d._native.rasterizer import MODES


def look(scene=None, *, color_space="srgb", samples=1, camera=None, **options):
    camera = camera or camera_at()
    return Picture(
        scene or still_life(), camera, color_space=color_space, samples=samples, options=options
    )


def without_background():
    return still_life(e3d.Scene(background=None))


for _mode in MODES:
    variant(f"mode_{_mode}", look, mode=_mode)
    variant(f"mode_{_mode}_linear", look, mode=_mode, color_space="linear")
for _mode in ("lit", "unlit", "depth", "overdraw"):
    variant(f"forward_{_mode}", look, mode=_mode, shading="forward")

variant("wireframe_overlay", look, wireframe="overlay")
variant(
    "wireframe_overlay_wide", look, wireframe="overlay", line_width=3.5, line_color=(255, 90, 0)
)
variant("wireframe_overlay_depth", look, wireframe="overlay", mode="depth", line_color=(1, 0, 0))
variant("wireframe_overlay_painter", look, wireframe="overlay", hidden_surfaces="painter")
variant("wireframe_overlay_forward", look, wireframe="overlay", shading="forward")
variant("wireframe_only", look, wireframe="only")
variant("wireframe_only_forward", look, wireframe="only", shading="forward")
variant("wireframe_only_hidden_lines", look, wireframe="only", hidden_lines=True)
variant("wireframe_only_painter", look, wireframe="only", hidden_surfaces="painter")
variant("wireframe_only_overdraw", look, wireframe="only", mode="overdraw", line_width=2.0)
variant("wireframe_samples_4", look, wireframe="overlay", samples=4, line_width=1.5)
variant("wireframe_samples_16", look, wireframe="only", samples=16)

variant("cull_front", look, cull="front")
variant("cull_none", look, cull="none")
variant("painter", look, hidden_surfaces="painter")
variant("painter_forward", look, hidden_surfaces="painter", shading="forward")
variant("hidden_none", look, hidden_surfaces="none")
variant("hidden_none_overdraw", look, hidden_surfaces="none", mode="overdraw")
variant("normals_flat", look, normals="flat")
variant("normals_flat_mode", look, normals="flat", mode="normal")
variant("normals_smooth", look, normals="smooth")

variant("samples_4", look, samples=4)
variant("samples_16", look, samples=16)
variant("samples_4_forward", look, samples=4, shading="forward")
variant("samples_4_linear", look, samples=4, color_space="linear")
variant("samples_4_overdraw", look, samples=4, mode="overdraw")
variant("samples_16_random", look, samples=16, mode="random")


@picture
def transparent_background():
    return look(without_background())


@picture
def transparent_background_samples_16():
    return look(without_background(), samples=16)


@picture
def transparent_wireframe_samples_4():
    return look(without_background(), samples=4, wireframe="only", line_color=(0, 1, 0))


@picture
def wireframe_only_beside_lines():
    """Hidden edges show; lines and points that faces hide do not."""
    scene = still_life()
    ends = [
        (x, 0.1 + 0.2 * k, z) for k, x in enumerate((-1.2, -0.6, 0.2, 0.9)) for z in (-1.2, 1.2)
    ]
    lines = [(2 * k, 2 * k + 1) for k in range(4)]
    scene.add(e3d.Mesh(ends, lines=lines, points=[0, 2, 4, 6]))
    return look(
        scene, wireframe="only", hidden_lines=True, line_color=(70, 90, 120), point_size=6.0
    )


@picture
def two_sided_inside():
    """The eye is inside a box: its walls show because its material has two sides."""
    room = with_material(e3d.box(6), color=CORAL, two_sided=True)
    scene = still_life()
    scene.add(room)
    return look(scene)


@picture
def two_sided_beside_culled():
    """One mesh of two materials, of which one shows its back."""
    ball = e3d.icosphere(0.9, 3)
    ball.materials = [e3d.Material(color=e3d.linear(0.2, 0.5, 0.9)), e3d.Material(two_sided=True)]
    ball.material_ids = [face // 40 % 2 for face in range(len(ball.faces))]
    scene = e3d.Scene(background=(30, 38, 54))
    scene.add(ball)
    return look(scene, camera=camera_at((0, 0.6, 2.4), (0, 0, 0)))


@picture
def flat_material_beside_smooth():
    """Flat shading is a matter of the material, whatever stands beside it."""
    scene = e3d.Scene(background=(30, 38, 54))
    for x, flat in ((-0.6, True), (0.6, False)):
        ball = with_material(e3d.icosphere(0.55, 2), color=CORAL, flat_shading=flat)
        scene.add(ball, translation=(x, 0, 0))
    scene.add(e3d.DirectionalLight((-0.4, -0.6, -0.6)))
    return look(scene, camera=camera_at((0, 0.4, 2.6), (0, 0, 0)))
