"""Light from all around: ambient occlusion, hemisphere lights, light probes."""

import numpy as np
from images.objects import camera_at
from images.picture import Picture, variant

import engine3d as e3d
from engine3d import linalg

MIRRORED = np.diag([-1.0, 1.0, 1.0, 1.0])


def matter(mesh, **material):
    mesh.materials = [e3d.Material(**material)]
    return mesh


def corner(ambient=e3d.linear(0.7, 0.75, 0.8)):
    """A floor and a wall with things on them, of all kinds of materials."""
    scene = e3d.Scene(ambient=ambient, background=e3d.linear(0.1, 0.12, 0.15))
    scene.add(
        matter(e3d.box((3, 0.04, 3)), color=e3d.linear(0.9, 0.85, 0.8)), translation=(0, -0.02, 0)
    )
    wall = matter(
        e3d.box((3, 1.5, 0.04)), color=e3d.linear(0.8, 0.9, 0.8), metallic=0.0, roughness=0.8
    )
    scene.add(wall, translation=(0, 0.7, -1))
    scene.add(matter(e3d.box(0.5), color=e3d.linear(0.9, 0.3, 0.2)), translation=(0.4, 0.25, -0.5))
    scene.add(e3d.uv_sphere(0.3, (24, 12)), translation=(-0.5, 0.3, -0.3))
    gold = matter(
        e3d.uv_sphere(0.2, (24, 12)), color=e3d.linear(1, 0.8, 0.3), metallic=1.0, roughness=0.3
    )
    scene.add(gold, translation=(0.1, 0.2, 0.3))
    velvet = {"sheen_color": e3d.linear(0.4, 0.1, 0.5), "clearcoat": 0.7, "roughness": 0.6}
    scene.add(matter(e3d.box(0.3), **velvet), translation=(0.8, 0.15, 0.3))
    glass = matter(
        e3d.uv_sphere(0.25, (24, 12)), color=e3d.linear(0.2, 0.5, 1, 0.5), alpha_mode="blend"
    )
    scene.add(glass, translation=(-0.5, 0.25, 0.5))
    scene.add(e3d.DirectionalLight((-0.3, -1, -0.6), e3d.linear(1, 0.95, 0.9), 0.3 * np.pi))
    return scene


def occluded(camera=None, samples=1, color_space="srgb", **options):
    camera = camera_at((0.8, 1.2, 2.6), (0, 0.25, 0)) if camera is None else camera
    options = {"ambient_occlusion": True, **options}
    return Picture(corner(), camera, samples=samples, color_space=color_space, options=options)


def around(samples=1, probe=True, **options):
    scene = corner(e3d.linear(0.05, 0.05, 0.05))
    tilted = linalg.rotation_z(0.4)
    scene.add(
        e3d.HemisphereLight(e3d.linear(0.5, 0.7, 1.0), e3d.linear(0.35, 0.25, 0.15)), pose=tilted
    )
    if probe:
        numbers = np.sin(np.arange(27.0)).reshape(9, 3) * 0.4
        scene.add(e3d.LightProbe(numbers, 0.8), pose=linalg.rotation_x(0.7))
    camera = camera_at((0.8, 1.2, 2.6), (0, 0.25, 0))
    return Picture(scene, camera, samples=samples, options=options)


def flat_eye():
    return e3d.OrthographicCamera(1.1), linalg.look_at((1.5, 1.5, 2.5), (0, 0.3, 0))


def mirrored_eye():
    camera, pose = camera_at((0.8, 1.2, 2.6), (0, 0.25, 0))
    return camera, pose @ MIRRORED


variant("occlusion", occluded)
variant("occlusion_samples_4", occluded, samples=4)
variant("occlusion_samples_16_linear", occluded, samples=16, color_space="linear")
variant("occlusion_forward", occluded, shading="forward")
variant("occlusion_painter", occluded, hidden_surfaces="painter")
variant("occlusion_small_radius", occluded, ambient_occlusion_radius=0.1)
variant("occlusion_wide_radius", occluded, ambient_occlusion_radius=50.0)
variant("occlusion_orthographic", lambda: occluded(flat_eye()))
variant("occlusion_mirrored", lambda: occluded(mirrored_eye()))
variant("occlusion_wireframe", occluded, wireframe="overlay", line_width=2.0)
variant("hemisphere_light", around, probe=False)
variant("light_probe", around)
variant("light_probe_samples_4_forward", around, samples=4, shading="forward")
variant("light_probe_occlusion", around, ambient_occlusion=True)
