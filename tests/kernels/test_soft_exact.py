"""Soft exact shadows on every backend: as the reference, and in shares of 32 points."""

import numpy as np
import pytest

import engine3d as e3d

COVERS = ("soft_exact_shadows",)
LIGHTS = {
    "sun": lambda **how: e3d.DirectionalLight((0.2, -1, 0.1), **how),
    "lamp": lambda **how: e3d.PointLight(intensity=30.0, **how),
}


def drawn(backend, kind, size, shadow):
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    floor = e3d.plane((6, 6))
    floor.materials = [e3d.Material(color=(1, 1, 1))]
    scene.add(floor)
    for x in (-0.8, 0.0, 0.7):
        scene.add(e3d.box((0.3, 0.05, 2.0)), translation=(x, 0.8 + 0.3 * x, 0))
    scene.add(LIGHTS[kind](shadow=shadow, shadow_softness=0.4), translation=(0.3, 3, 0.2))
    scene.add(e3d.PerspectiveCamera(yfov=0.8), pose=e3d.look_at((0.5, 4, 3), (0, 0, 0)))
    return e3d.Renderer(size, backend=backend).render(scene, outputs=("radiance", "object_id"))


@pytest.mark.parametrize("kind", LIGHTS)
@pytest.mark.parametrize("backend", e3d.backends())
def test_shares_of_points_as_in_the_reference(backend, kind):
    for size in ((1, 1), (3, 2), (37, 23), (64, 48)):
        there = drawn(backend, kind, size, "exact")
        expected = drawn("scalar", kind, size, "exact")
        assert there.radiance.tobytes() == expected.radiance.tobytes()
    floor = there.object_id == 0
    lit = drawn(backend, kind, size, "none").radiance[..., 0][floor]
    points = 32 * there.radiance[..., 0][floor] / lit
    assert np.abs(points - np.rint(points)).max() < 1e-3
    assert len(set(np.rint(points))) > 12 and points.min() < 1 and points.max() > 31
