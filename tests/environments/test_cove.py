"""What surfaces reflect in the look `studio`, and its light as a probe."""

import numpy as np
import pytest

from engine3d.model.environments import cove
from engine3d.model.environments._directions import directions
from engine3d.model.scene.orbiting import home_axes


def harmonics(x, y, z):
    """The real harmonics in the order of `LightProbe`."""
    pi = np.pi
    linear, mixed = np.sqrt(3 / (4 * pi)), np.sqrt(15 / (4 * pi))
    return [
        np.full(np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(z)), 0.5 / np.sqrt(pi)),
        *(linear * part for part in (y, z, x)),
        *(mixed * part for part in (x * y, y * z)),
        np.sqrt(5 / (16 * pi)) * (3 * z * z - 1),
        mixed * x * z,
        mixed / 2 * (x * x - y * y),
    ]


def test_the_probe_has_the_light_of_the_picture():
    pixels = cove.pixels(np.eye(3)).astype(float)
    rows = len(pixels)
    rays = directions(rows)
    level = np.sqrt(1 - rays[1] ** 2)
    solid = level * (np.pi / rows) ** 2
    found = [[(pixels[..., k] * part * solid).sum() for k in range(3)] for part in harmonics(*rays)]
    np.testing.assert_allclose(cove.PROBE, found, atol=2e-3)


@pytest.mark.parametrize("up", [(0, 0, 1), (1, 0, 0), (0, -1, 0)])
def test_it_stands_along_any_axis(up):
    axes = home_axes(up)
    upright, turned = cove.pixels(np.eye(3)), cove.pixels(axes)
    assert turned.shape == upright.shape and turned.dtype == np.float32
    assert turned.max() == pytest.approx(upright.max(), rel=0.02)
    x, y, z = (np.broadcast_to(part, turned.shape[:2]) for part in directions(len(turned)))
    level = np.sqrt(x * x + z * z)
    below = np.array([x, y, z]).transpose(1, 2, 0) @ np.array(up, float) < -0.9
    assert turned[below].min() > 0.35 and level.shape == below.shape  # the floor is light


def test_the_floor_is_about_as_light_as_the_ground():
    from engine3d.stage.overlays.theme import LIGHT

    floor = cove.pixels(np.eye(3))[-60, :, 1].mean()
    ground = (LIGHT.gradient.bottom[1] / 255) ** 2.2
    assert 0.7 * ground < floor < 1.25 * ground
