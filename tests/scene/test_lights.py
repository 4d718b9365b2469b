"""Lights keep what they are given, checked."""

import math

import pytest

import engine3d as e3d


def test_defaults():
    sun = e3d.DirectionalLight()
    assert tuple(sun.direction) == (0, 0, -1)
    lamp = e3d.PointLight()
    assert (lamp.intensity, lamp.range, lamp.falloff) == (math.pi, math.inf, "inverse_square")


def test_assigning_counts_versions():
    lamp = e3d.PointLight()
    before = lamp.version
    lamp.intensity = 2
    assert lamp.version > before


def test_window_needs_a_range():
    assert e3d.PointLight(range=5, falloff="window").range == 5
    with pytest.raises(e3d.InvalidArgumentError, match="needs a finite range"):
        e3d.PointLight(falloff="window")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: e3d.DirectionalLight((0, 0, 0)), "direction must not be the zero vector"),
        (lambda: e3d.DirectionalLight((0, 1)), r"direction must have shape \(3,\)"),
        (lambda: e3d.DirectionalLight(color=(1, 1)), "color"),
        (lambda: e3d.DirectionalLight(intensity=-1), "intensity"),
        (lambda: e3d.PointLight(intensity=math.inf), "intensity"),
        (lambda: e3d.PointLight(range=0), "range"),
        (lambda: e3d.PointLight(falloff="cubic"), "'inverse_square', 'window', 'gltf'"),
        (lambda: e3d.SpotLight(inner_cone_angle=1.0), "inner_cone_angle must be less than outer"),
        (
            lambda: e3d.SpotLight(outer_cone_angle=2.0),
            "outer_cone_angle must be from 0 to",
        ),
        (lambda: e3d.SpotLight(range=-1), "range"),
    ],
)
def test_invalid_arguments(make, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        make()
