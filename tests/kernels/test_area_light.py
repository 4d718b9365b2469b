"""Area lights on every backend: matt surfaces against Lambert's integral in float64, cut at the
horizon, and physically based ones against the reference, byte for byte."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.lights import RectangleLight

COVERS = ("area_light", "area_physical")
POSE = e3d.look_at((-0.6, 0.2, -0.3), (0.5, 0, 0.4), (0, 1, 0))  # half of it is below the floor


def drawn(backend, **given):
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    floor = e3d.plane((4, 4))
    floor.materials = [e3d.Material(color=(1, 1, 1), **given)]
    scene.add(floor)
    scene.add(RectangleLight(intensity=2.0, width=1.5, height=1.1), pose=POSE)
    scene.add(e3d.PerspectiveCamera(yfov=0.8), pose=e3d.look_at((0.5, 2, 2), (0.3, 0, 0)))
    renderer = e3d.Renderer((21, 13), backend=backend)
    outputs = ("radiance", "world_position", "object_id")
    return renderer.render(scene, outputs=outputs)


def above(corners):
    """Return what of a polygon is above the floor."""
    kept = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if a[1] > 0:
            kept.append(a)
        if (a[1] > 0) != (b[1] > 0):
            kept.append(a + (b - a) * (a[1] / (a[1] - b[1])))
    return np.array(kept)


def irradiance(point):
    """Return what the rectangle adds at a point of the floor, over pi."""
    halves = np.array([(-0.75, -0.55), (0.75, -0.55), (0.75, 0.55), (-0.75, 0.55)])
    corners = POSE[:3, 3] + halves @ POSE[:3, :2].T - point
    if (POSE[:3, 3] - point) @ POSE[:3, 2] <= 0:
        return 0.0
    corners = above(corners)
    corners /= np.linalg.norm(corners, axis=1)[:, None]
    total = 0.0
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        across = np.cross(a, b)
        total += np.arccos(np.clip(a @ b, -1, 1)) * across[1] / np.linalg.norm(across)
    return 2.0 * total / (2 * np.pi)


@pytest.mark.parametrize("backend", e3d.backends())
def test_matt_surfaces_show_lamberts_integral(backend):
    frame = drawn(backend)
    shown = np.argwhere(frame.object_id >= 0)
    expected = [irradiance(frame.world_position[tuple(at)].astype(np.float64)) for at in shown]
    assert max(expected) > 0.3 and min(expected) == 0.0
    # Where the sample nearly lies on an edge, the sine in R235 cancels out.
    drawn_there = frame.radiance[..., 0][tuple(shown.T)]
    np.testing.assert_allclose(drawn_there, expected, rtol=1e-3, atol=2e-5)


@pytest.mark.parametrize("backend", e3d.backends())
def test_physical_surfaces_are_the_references(backend):
    given = {"metallic": 0.3, "roughness": 0.4, "clearcoat": 0.5, "anisotropy": 0.4}
    frame, expected = drawn(backend, **given), drawn("scalar", **given)
    assert frame.radiance.any()
    assert frame.radiance.tobytes() == expected.radiance.tobytes()
