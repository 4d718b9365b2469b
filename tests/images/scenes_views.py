"""Cameras and sizes: every projection, planes that cut, pictures of one pixel and of one row."""

import math

import numpy as np
from images.objects import camera_at, checkerboard, floor, still_life, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d
from engine3d import linalg

EYE, TARGET = (1.6, 1.4, 2.8), (0, 0.35, 0)


def of_size(width, height, **options):
    return Picture(still_life(), camera_at(), (width, height), options=options)


for _width, _height in [(1, 1), (2, 3), (1, 211), (333, 1), (63, 65), (64, 64), (257, 31)]:
    variant(f"size_{_width}x{_height}", of_size, _width, _height)
variant("size_65x63_wireframe", of_size, 65, 63, wireframe="overlay")
variant("size_large", of_size, 640, 360)


@picture
def orthographic():
    camera = e3d.OrthographicCamera(1.1, znear=0.1, zfar=20)
    return Picture(still_life(), (camera, e3d.look_at(EYE, TARGET)))


@picture
def orthographic_depth_mode():
    camera = e3d.OrthographicCamera(1.1, xmag=2.0, znear=0.1, zfar=20)
    return Picture(still_life(), (camera, e3d.look_at(EYE, TARGET)), options={"mode": "depth"})


@picture
def intrinsics():
    """A measured camera whose axis is not in the middle, with unequal focal lengths."""
    camera = e3d.IntrinsicsCamera(150.0, 120.0, 90.0, 40.0, znear=0.1, zfar=50)
    return Picture(still_life(), (camera, e3d.look_at(EYE, TARGET)))


@picture
def automatic_camera():
    """A scene without a camera is framed by itself."""
    return Picture(still_life())


@picture
def camera_in_the_scene():
    """A camera node below another node, which turns it."""
    scene = still_life()
    turn = linalg.quaternion_from_axis_angle((0, 1, 0), math.radians(-50))
    pivot = scene.add(rotation=turn)
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=30)
    scene.add(camera, parent=pivot, pose=e3d.look_at((0, 1.5, 2.6), (0, 0.3, 0)))
    return Picture(scene)


@picture
def wide_angle():
    return Picture(still_life(), camera_at((0.3, 0.7, 1.0), (0, 0.3, 0), yfov=2.6, znear=0.01))


@picture
def near_plane_cuts():
    """The eye stands among the objects; the near plane cuts through ball and floor."""
    camera = camera_at((-0.4, 0.5, 0.75), (0.2, 0.15, -0.5), yfov=1.4, znear=0.3)
    return Picture(still_life(), camera, options={"cull": "none"})


@picture
def far_plane_cuts():
    return Picture(still_life(), camera_at(zfar=3.2))


@picture
def floor_to_the_horizon():
    """Triangles from behind the eye to far away, clipped at the near plane and the guard band."""
    scene = e3d.Scene(background=(150, 180, 220))
    ground = e3d.plane((4000, 4000), 1)
    ground.uvs = ground.uvs * 4000
    scene.add(with_material(ground, texture=checkerboard()))
    camera = camera_at((0, 1.5, 0), (0.3, 1.2, -3), znear=0.01, zfar=1e4)
    return Picture(scene, camera, options={"mode": "unlit"})


@picture
def floor_to_the_horizon_wireframe():
    scene = e3d.Scene(background=(10, 12, 20))
    scene.add(e3d.plane((400, 400), 80))
    camera = camera_at((0.2, 1.5, 0.1), (0.3, 1.2, -3), znear=0.01, zfar=1e4)
    return Picture(
        scene, camera, options={"wireframe": "overlay", "line_color": e3d.linear(0.2, 1, 0.4)}
    )


@picture
def extreme_depth_range():
    """Near at a thousandth and far at a hundred thousand: depth is coarse but ordered."""
    return Picture(still_life(), camera_at(znear=1e-3, zfar=1e5), options={"mode": "depth"})


@picture
def behind_the_camera():
    """Everything is behind the eye: only background."""
    return Picture(still_life(), camera_at((0, 0.5, -3), (0, 0.5, -9)))


@picture
def upside_down():
    pose = e3d.look_at(EYE, TARGET, (0, -1, 0.2))
    return Picture(still_life(), (e3d.PerspectiveCamera(0.8, znear=0.1, zfar=50), pose))


@picture
def skewed_projection():
    """Any matrix will do: an oblique one, with a mirror in it."""
    oblique = np.array([[-0.9, 0.2, 0.1, 0], [0.1, 1.2, 0.2, 0], [0, 0, -0.25, 0.1], [0, 0, 0, 1]])
    pose = e3d.look_at(EYE, TARGET)
    scene = still_life()
    scene.add(floor(0.5), translation=(0, 1.2, 0))
    return Picture(scene, (e3d.Camera(oblique), pose), options={"cull": "none"})
