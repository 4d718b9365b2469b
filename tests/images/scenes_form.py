"""What models are made of: creases, both sides, depth far away, tiny models and models far away."""

import numpy as np
from images.objects import camera_at, still_life
from images.picture import Picture, picture

import engine3d as e3d


def welded(mesh, **options):
    """The mesh with its places alone, and without normals."""
    corners = mesh.positions[mesh.faces].reshape(-1, 3)
    places, faces = np.unique(corners, axis=0, return_inverse=True)
    return e3d.Mesh(places, faces.reshape(-1, 3), **options)


def creased(angle):
    scene = e3d.Scene((30, 34, 40), ambient=e3d.linear(0.2, 0.2, 0.2))
    scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
    shapes = e3d.box((0.9, 0.9, 0.9)), e3d.cylinder(0.45, 0.9), e3d.icosphere(0.5, 1)
    for number, mesh in enumerate(shapes):
        scene.add(welded(mesh, crease_angle=angle), translation=(1.1 * number - 1.1, 0.3, 0))
    return scene


@picture
def creases():
    """Sharp rims of a box and a cylinder, which is round; a coarse ball in between."""
    return Picture(creased(np.radians(35)), camera_at())


@picture
def creases_of_ten_degrees():
    return Picture(creased(np.radians(10)), camera_at())


@picture
def inside_out_and_open():
    """Both sides, but the backs of what is closed: an inside-out ball, a bowl, a box."""
    scene = e3d.Scene((30, 34, 40), ambient=e3d.linear(0.2, 0.2, 0.2))
    scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
    ball = e3d.uv_sphere(0.5, (24, 12))
    low = ball.positions[ball.faces][..., 1].max(axis=1) < 0.2
    turned = e3d.Mesh(ball.positions, ball.faces[:, ::-1], position_ids=ball.position_ids)
    bowl = e3d.Mesh(ball.positions, ball.faces[low], normals=ball.normals)
    for number, mesh in enumerate((turned, bowl, e3d.box((0.8, 0.8, 0.8)))):
        scene.add(mesh, translation=(1.1 * number - 1.1, 0.3, 0))
    return Picture(scene, camera_at(), options={"cull": "auto"})


@picture
def reversed_depth():
    return Picture(still_life(), camera_at(reversed_depth=True, znear=1e-3, zfar=1e4))


@picture
def reversed_depth_wireframe():
    camera = camera_at(reversed_depth=True, znear=0.05, zfar=100.0)
    return Picture(still_life(), camera, options={"wireframe": "overlay"})


@picture
def a_tiny_model():
    scene = e3d.Scene((30, 34, 40), ambient=e3d.linear(0.3, 0.3, 0.3))
    scene.add(e3d.torus(1.0, 0.4), scale=1e-9)
    scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
    return Picture(scene)


@picture
def a_model_on_a_map():
    scene = e3d.Scene((30, 34, 40), ambient=e3d.linear(0.3, 0.3, 0.3))
    scene.add(e3d.torus(1.0, 0.4), translation=(500_000.0, 4_649_776.0, 120.0))
    scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
    return Picture(scene)
