"""Masks and glass: what is cut out, what is seen through, in every mode, method and sampling."""

import numpy as np
from images.objects import CORAL, TEAL, camera_at, floor, with_material
from images.picture import Picture, variant

import engine3d as e3d
from engine3d._native.rasterizer import MODES

WHITE_GLASS = (1.0, 1.0, 1.0, 0.35)


def leaf(side=32, **options):
    """A green disc with a soft edge, transparent around it, and a hole."""
    rows, columns = np.mgrid[0:side, 0:side]
    distance = (2 * rows + 1 - side) ** 2 + (2 * columns + 1 - side) ** 2
    pixels = np.empty((side, side, 4), np.uint8)
    pixels[..., :3] = 30, 150, 60
    pixels[..., 3] = np.clip(400 - 400 * distance // side**2, 0, 255)
    pixels[distance < side**2 // 12, 3] = 0
    return e3d.Texture(pixels, **options)


def pane(color, turned=0, size=1.5, **options):
    """A square that stands upright, along x or along z."""
    corner = np.array([(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)], np.float32) * (size / 2)
    if turned:
        corner = corner[:, [2, 1, 0]]
    mesh = e3d.Mesh(corner, [[0, 1, 2], [0, 2, 3]], uvs=[(0, 0), (1, 0), (1, 1), (0, 1)])
    return with_material(mesh, color=color, two_sided=True, **options)


def dots():
    """Instances whose colours have alpha, and a vertex alpha beside."""
    mesh = pane((1.0, 1.0, 1.0), size=0.3, alpha_mode="blend")
    mesh.colors = np.array([(255, 255, 255, 255)] * 2 + [(255, 255, 255, 40)] * 2, np.uint8)
    count = 12
    step = np.arange(count, dtype=np.float32)
    poses = np.stack([step * 0.2 - 1.1, 0.1 + step * 0.05, 0.9 - step * 0.1, 1 + 0 * step], -1)
    colors = np.stack([20 * step, 255 - 20 * step, 128 + 0 * step, 60 + 15 * step], -1)
    return e3d.InstancedMesh(mesh, poses, colors=colors.astype(np.uint8))


def seen_through(background=(30, 38, 54)):
    scene = e3d.Scene(background=background, ambient=e3d.linear(0.2, 0.2, 0.22))
    scene.add(pane(e3d.linear(*CORAL, 0.5), alpha_mode="blend"), translation=(0.2, 0, 0))
    scene.add(floor(), name="floor")
    ball = with_material(
        e3d.uv_sphere(0.4, (24, 12)),
        color=WHITE_GLASS,
        specular=e3d.linear(0.9, 0.9, 0.9),
        shininess=60.0,
        two_sided=True,
        alpha_mode="blend",
    )
    scene.add(ball, name="ball", translation=(-0.55, 0.5, 0.1))
    scene.add(pane(e3d.linear(*TEAL, 0.6), 1, alpha_mode="blend"), translation=(0.2, 0, 0))
    scene.add(
        pane((1, 1, 1), size=0.9, texture=leaf(), alpha_mode="mask"), translation=(-0.6, 0, 0)
    )
    scene.add(dots())
    wire = e3d.Mesh([(-1, 1, 0.6), (1, 0.2, 0.6), (0.6, 1.1, 0.7)], lines=[(0, 1)], points=[2])
    scene.add(with_material(wire, color=e3d.linear(1.0, 1.0, 0.2, 0.5), alpha_mode="blend"))
    scene.add(
        with_material(e3d.box(0.4), color=e3d.linear(0.9, 0.9, 0.3)), translation=(0.5, 0.2, -0.4)
    )
    scene.add(e3d.DirectionalLight(direction=(-0.4, -0.8, -0.45)))
    return scene


def look(background=(30, 38, 54), *, color_space="srgb", samples=1, **options):
    scene = seen_through(background)
    return Picture(scene, camera_at(), color_space=color_space, samples=samples, options=options)


def leaves(kind, color_space):
    """The same leaf, cut and blended, near and far, wrapped each way."""
    scene = e3d.Scene(background=(90, 60, 120))
    for number, (wrap, mode) in enumerate(
        (wrap, mode) for wrap in ("repeat", "clamp", "mirror") for mode in ("mask", "blend")
    ):
        mesh = pane(
            e3d.linear(1.0, 1.0, 1.0, 0.9), alpha_mode=mode, texture=leaf(filter=kind, wrap=wrap)
        )
        mesh.uvs = mesh.uvs * 2.5 - 0.7
        scene.add(mesh, translation=(0.7 * number - 1.6, -0.2, 0.5 - 0.5 * number))
    options = {"mode": "unlit"}
    return Picture(scene, camera_at(), color_space=color_space, samples=1, options=options)


for _mode in MODES:
    variant(f"alpha_mode_{_mode}", look, mode=_mode)
variant("alpha_linear", look, color_space="linear")
variant("alpha_front", look, transparent_outputs=True)
variant("alpha_front_samples_4", look, transparent_outputs=True, samples=4)
variant("alpha_without_background", look, background=None)
for _samples in (4, 16):
    variant(f"alpha_samples_{_samples}", look, samples=_samples)
    variant(f"alpha_samples_{_samples}_without_background", look, None, samples=_samples)
variant("alpha_forward", look, shading="forward")
variant("alpha_painter", look, hidden_surfaces="painter")
variant("alpha_painter_front", look, hidden_surfaces="painter", transparent_outputs=True)
variant("alpha_hidden_none", look, hidden_surfaces="none")
variant("alpha_cull_none", look, cull="none")
variant("alpha_wireframe_overlay", look, wireframe="overlay")
variant("alpha_wireframe_only", look, wireframe="only", transparent_outputs=True)
variant("alpha_wireframe_only_hidden_lines", look, wireframe="only", hidden_lines=True)
variant("alpha_overdraw_samples_4", look, mode="overdraw", samples=4)
for _filter in ("nearest", "bilinear"):
    for _space in ("srgb", "linear"):
        variant(f"alpha_leaf_{_filter}_{_space}", leaves, _filter, _space)
