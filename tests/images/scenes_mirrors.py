"""Flat mirrors: in a room, in a floor, in one another; of all kinds of materials."""

import numpy as np
from images.objects import camera_at
from images.picture import Picture, variant

import engine3d as e3d
from engine3d import linalg

UPRIGHT = linalg.rotation_x(np.pi / 2)


def matter(mesh, **material):
    mesh.materials = [e3d.Material(**material)]
    return mesh


def furnished(**surroundings):
    """A floor with things on it, lit from the side, and the sun's shadow on the floor."""
    scene = e3d.Scene(ambient=e3d.linear(0.25, 0.25, 0.3), **surroundings)
    scene.add(
        matter(e3d.uv_sphere(0.3, (24, 12)), color=(220, 60, 40)), translation=(-0.5, 0.3, 0.5)
    )
    gold = matter(e3d.box(0.4), color=(255, 205, 80), metallic=1.0, roughness=0.3)
    scene.add(gold, translation=(0.4, 0.2, 0.3))
    glass = matter(e3d.uv_sphere(0.2, (24, 12)), color=(60, 130, 255, 128), alpha_mode="blend")
    scene.add(glass, translation=(0, 0.2, 0.9))
    light = e3d.DirectionalLight((-0.6, -1, -0.5), e3d.linear(1, 0.95, 0.9), 0.8 * np.pi)
    light.shadow = "map"
    scene.add(light)
    return scene


def hall(**mirror):
    """A mirror on the wall behind."""
    scene = furnished(background=e3d.linear(0.2, 0.3, 0.5))
    scene.add(matter(e3d.box((3, 0.04, 3)), color=(200, 190, 180)), translation=(0, -0.02, 0.5))
    look = {"color": (220, 230, 225), "mirror": 0.9, **mirror}
    pane = matter(e3d.plane((1.8, 1.2)), **look)
    scene.add(pane, pose=linalg.translation((0, 0.7, -0.8)) @ UPRIGHT)
    return scene


def wall(camera=None, samples=1, antialiasing="ssaa", mirror=None, fog=None, **options):
    scene = hall(**(mirror or {}))
    scene.fog = fog
    camera = camera_at((0.7, 1.1, 2.6), (0, 0.4, 0)) if camera is None else camera
    return Picture(scene, camera, samples=samples, antialiasing=antialiasing, options=options)


def polished_floor(**options):
    scene = furnished()
    scene.background = scene.environment = e3d.Environment.studio()
    tiles = matter(
        e3d.plane((3, 3), (4, 4)), color=(60, 60, 70), metallic=0.0, roughness=0.1, mirror=1.0
    )
    scene.add(tiles, translation=(0, 0, 0.5))
    return Picture(scene, camera_at((0.7, 0.9, 2.6), (0, 0.2, 0)), options=options)


def corridor(depth):
    """Two mirrors that face one another."""
    scene = hall(mirror=1.0)
    pane = matter(e3d.plane((4, 2)), color=(10, 10, 10), mirror=0.8)
    scene.add(pane, pose=linalg.translation((0, 0.7, 1.9)) @ linalg.rotation_x(-np.pi / 2))
    camera = camera_at((0.3, 0.9, 1.7), (0, 0.6, -0.8))
    return Picture(scene, camera, options={"mirror_depth": depth})


def flat_eye():
    return e3d.OrthographicCamera(1.1), linalg.look_at((1.0, 1.3, 2.5), (0, 0.4, 0))


def mirrored_eye():
    camera, pose = camera_at((0.7, 1.1, 2.6), (0, 0.4, 0))
    return camera, pose @ np.diag([-1.0, 1.0, 1.0, 1.0])


variant("mirror", wall)
variant("mirror_forward_agx", wall, shading="forward", tone_mapping="agx")
variant("mirror_samples_4", wall, samples=4)
variant("mirror_msaa_4", wall, samples=4, antialiasing="msaa")
variant("mirror_orthographic", lambda: wall(flat_eye()))
variant("mirror_mirrored", lambda: wall(mirrored_eye()))
variant("mirror_fog", wall, fog=e3d.Fog((160, 170, 180), 1.0, 6.0))
variant("mirror_blended", wall, mirror={"alpha_mode": "blend", "color": (200, 255, 200, 150)})
variant(
    "mirror_coated",
    wall,
    mirror={"metallic": 1.0, "roughness": 0.2, "clearcoat": 1.0, "anisotropy": 0.5},
    ambient_occlusion=True,
)
variant("mirror_floor", polished_floor)
variant("mirror_floor_occlusion", polished_floor, ambient_occlusion=True, tone_mapping="neutral")
variant("mirrors_facing_1", corridor, 1)
variant("mirrors_facing_3", corridor, 3)
