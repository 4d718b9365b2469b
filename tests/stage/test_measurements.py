"""Distances, angles, circles and boxes over pictures, and their texts."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.measuring import measure
from engine3d.stage.overlays.dimensions import draw_dimensions
from engine3d.stage.overlays.measurements import (
    COLOR,
    Measurement,
    angle_of,
    circle_of,
    draw_measurement,
    measurement_text,
    surface_text,
)
from engine3d.stage.overlays.theme import LIGHT


def points(*rows):
    return np.array(rows, float)


def frame_of(thing, size=(320, 240)):
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((2, 2, 4), (0, 0, 0))
    scene = e3d.Scene((255, 255, 255))
    scene.add(thing)
    return e3d.render(scene, camera, size=size)


@pytest.mark.parametrize(
    ("kind", "given", "text"),
    [
        ("distance", [(0, 0, 0), (3, 4, 0)], "distance 5 mm"),
        ("angle", [(1, 0, 0), (0, 0, 0), (0, 2, 0)], "angle 90°"),
        ("angle", [(1, 0, 0), (0, 0, 0), (-1, 0, 0)], "angle 180°"),
        ("angle", [(1, 0, 0), (1, 0, 0), (-1, 0, 0)], "no angle"),
        ("circle", [(2, 0, 1), (0, 2, 1), (-2, 0, 1)], "radius 2 mm"),
        ("circle", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], "no circle"),
    ],
)
def test_measures_as_text(kind, given, text):
    assert measurement_text(Measurement(kind, points(*given)), "mm") == text


def test_the_circle_through_three_random_points():
    random = np.random.default_rng(3)
    for _ in range(50):
        given = random.normal(size=(3, 3))
        circle = circle_of(given)
        away = np.linalg.norm(given - circle.center, axis=1)
        assert away == pytest.approx([circle.radius] * 3, rel=1e-6)
        assert (given - circle.center) @ circle.normal == pytest.approx([0.0] * 3, abs=1e-6)


def test_angles_are_those_of_numpy():
    a, b, c = np.random.default_rng(4).normal(size=(3, 3))
    u, v = a - b, c - b
    cosine = u @ v / np.linalg.norm(u) / np.linalg.norm(v)
    assert angle_of(np.stack([a, b, c])) == pytest.approx(math.acos(cosine))


def test_area_and_volume_as_text():
    assert surface_text(measure(e3d.box(2.0)), "m") == ["area 24 m²", "volume 8 m³"]
    assert surface_text(measure(e3d.plane(1.0)), "") == ["area 1", "no volume: it is open"]


@pytest.mark.parametrize(
    "measured",
    [
        Measurement("distance", points((-0.5, -0.5, 0.5), (0.5, -0.5, 0.5))),
        Measurement("angle", points((-0.5, -0.5, 0.5), (0.5, -0.5, 0.5), (0.5, 0.5, 0.5))),
        Measurement("circle", points((-0.5, 0.5, 0.5), (0.5, -0.5, 0.5), (0.5, 0.5, 0.5))),
    ],
    ids=lambda measured: measured.kind,
)
def test_marks_lie_on_their_points(measured):
    frame = frame_of(e3d.box())
    before = frame.color.copy()
    draw_measurement(frame, measured, "m", 1, LIGHT)
    pixels, _ = frame.project(measured.points)
    dots = [frame.color[int(y), int(x)].tolist() == list(COLOR) for x, y in pixels]
    assert sum(dots) >= len(dots) - 1  # a text may lie over one
    assert (frame.color != before).any(axis=2).sum() > 400


def test_a_point_alone_is_marked_without_a_text():
    frame = frame_of(e3d.box())
    before = frame.color.copy()
    draw_measurement(frame, Measurement("distance", points((0.5, 0.5, 0.5))), "", 1, LIGHT)
    assert 0 < (frame.color != before).any(axis=2).sum() <= 49


def test_the_box_has_three_lengths_beside_its_edges():
    frame = frame_of(e3d.box((1.0, 0.5, 0.25)))
    before = frame.color.copy()
    box = np.array([(-0.5, -0.25, -0.125), (0.5, 0.25, 0.125)])
    draw_dimensions(frame, box, "m", 1, LIGHT)
    changed = (frame.color != before).any(axis=2)
    assert changed.sum() > 1500
    edges, _ = frame.project((0.0, -0.25, 0.125))
    assert changed[int(edges[1]) - 1 : int(edges[1]) + 2, int(edges[0])].any()
