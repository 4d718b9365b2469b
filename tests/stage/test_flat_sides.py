"""First views that would show one flat side alone, and those that stay."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_thing import viewed_of
from engine3d.stage.views.flat_sides import choose_azimuth, flat_share
from engine3d.stage.views.viewpoint import DEFAULT_AZIMUTH

QUARTER = math.pi / 2


def wedge():
    """A square towards +Z, from which all other sides run together at the back: only it shows."""
    front = [(x, y, 0.3) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    back = [(x * 0.1, y * 0.1, -1.0) for x, y, _ in front]
    sides = [[k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4][::-1] for k in range(4)]
    polygons = [[0, 1, 2, 3], [7, 6, 5, 4], *sides]
    mesh = e3d.Mesh.from_polygons(np.array(front + back), polygons)
    mesh.crease_angle = math.radians(35.0)  # as of files
    return mesh


def azimuth_of(thing, size=(160, 120)):
    return ViewRenderer(viewed_of(thing), Settings({}), size).filling_view().azimuth


def test_a_flat_side_alone_is_left_for_a_view_with_depth(tmp_path):
    turned = azimuth_of(wedge())
    quarters = (turned - DEFAULT_AZIMUTH) / QUARTER
    assert quarters == pytest.approx(round(quarters)) and round(quarters) in (1, 2, 3)
    path = tmp_path / "wedge.obj"
    wedge().save(path)
    assert azimuth_of(path) == turned
    for size in ((40, 400), (400, 40), (640, 480)):
        assert azimuth_of(wedge(), size) == turned


@pytest.mark.parametrize(
    "thing",
    [e3d.box(), e3d.box((2, 2, 0.1)), e3d.plane(2.0), e3d.torus(), np.zeros((5, 3))],
    ids=["box", "plate", "plane", "torus", "points"],
)
def test_usual_things_are_seen_as_ever(thing):
    assert azimuth_of(thing) == DEFAULT_AZIMUTH


def test_what_states_a_colour_or_is_a_scene_has_a_front():
    painted, tinted, scene = wedge(), wedge(), e3d.Scene()
    painted.materials = [e3d.Material(color="red")]
    tinted.colors = ["red"] * len(tinted.positions)
    scene.add(wedge())
    for thing in (painted, tinted, scene):
        assert azimuth_of(thing) == DEFAULT_AZIMUTH


def test_a_picture_does_not_depend_on_what_was_drawn_before():
    box, flat = e3d.box(), wedge()
    with e3d.Renderer((80, 60)) as renderer:
        first = renderer.render(flat).color.copy()
        renderer.render(box)
        assert (renderer.render(flat).color == first).all()
    assert (e3d.render(flat, size=(80, 60)).color == first).all()


def test_the_share_of_the_most_frequent_direction():
    assert flat_share(np.zeros((0, 3), np.float32)) == 0.0
    normals = np.array([(0, 0, 1)] * 3 + [(0, 1, 0)], np.float32)
    assert flat_share(normals) == 0.75


def test_the_least_flat_quarter_is_chosen_and_a_flat_one_is_none():
    def seen(shares):
        def normals_from(azimuth):
            flat = round(shares[round(azimuth / QUARTER)] * 100)
            others = [(math.cos(k), math.sin(k), 0.3) for k in range(100 - flat)]
            return np.array([(0, 0, 1)] * flat + others, np.float32)

        return normals_from

    assert choose_azimuth(0.0, seen((0.9, 0.6, 0.3, 0.4))) == 2 * QUARTER
    assert choose_azimuth(0.0, seen((0.8, 0.1, 0.1, 0.1))) == 0.0
    assert choose_azimuth(0.0, seen((0.95, 0.8, 0.9, 0.85))) == 0.0
