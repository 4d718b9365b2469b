"""Lines wider than a pixel have that width at any angle; thin ones take a pixel a step (R11)."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.linalg import quaternion_from_axis_angle

SIZE = 512
LENGTH = 400.0
#: None a multiple of 45 degrees, where samples lie in step with the line.
ANGLES = np.arange(2.0, 180.0, 12.7)


def line_at(angle):
    """A scene and a camera that show a line of LENGTH pixels through the middle."""
    across = LENGTH / SIZE * np.array([np.cos(angle), np.sin(angle), 0.0])
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(e3d.Mesh([-across, across], lines=[(0, 1)]))
    return scene, (e3d.Camera(np.eye(4)), np.eye(4))


def area(angle, width, samples=1, backend="auto"):
    """The pixels that it covers, by their brightness in linear light."""
    scene, view = line_at(angle)
    with Renderer((SIZE, SIZE), samples=samples, color_space="linear", backend=backend) as renderer:
        frame = renderer.render(scene, view, mode="unlit", line_width=width)
    return frame.color[..., 0].sum() / 255.0


@pytest.mark.parametrize("width", [1.25, 2.0, 5.0, 40.0])
@pytest.mark.parametrize(("backend", "angles"), [("scalar", ANGLES[::5]), ("auto", ANGLES)])
def test_a_wide_line_has_its_width_at_any_angle(backend, angles, width):
    for angle in np.radians(angles):
        found = area(angle, width, 16, backend) / LENGTH
        assert found == pytest.approx(width, rel=0.02), np.degrees(angle)


@pytest.mark.parametrize("width", [0.3, 1.0])
def test_a_thin_line_has_one_extent_along_its_minor_axis(width):
    """So that a line of 1 takes a single pixel for each step, also at 45 degrees."""
    for angle in np.radians(ANGLES):
        steps = LENGTH * max(abs(np.cos(angle)), abs(np.sin(angle)))
        assert area(angle, width, 16) == pytest.approx(width * steps, rel=0.05)
        if width == 1.0:
            assert area(angle, width) == pytest.approx(steps, abs=1.5)


@pytest.mark.parametrize("width", [1.5, 3.0])
def test_edges_of_a_wireframe_are_as_wide(width):
    """A square nearly along the axes, and nearly on its corner."""
    square = e3d.primitives.quad((-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0))
    view = e3d.Camera(np.eye(4)), np.eye(4)
    options = {"mode": "unlit", "wireframe": "only", "line_width": width}
    options |= {"line_color": (255, 255, 255), "size": (SIZE, SIZE), "color_space": "linear"}
    areas = []
    for angle in np.radians([2.0, 43.0]):
        rotation = quaternion_from_axis_angle((0, 0, 1), angle)
        scene = e3d.Scene(background=(0, 0, 0))
        scene.add(square, rotation=rotation)
        color = render(scene, view, samples=16, **options).color
        areas.append(color[..., 0].sum() / 255.0)
    assert areas == [pytest.approx(2 * SIZE * width, rel=0.03)] * 2
