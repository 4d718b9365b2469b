"""The ball of axes: where its tips are, what is under the mouse, where a click looks from."""

import numpy as np
import pytest

from engine3d.rendering.canvas import Canvas
from engine3d.stage.overlays.axes_ball import BallPlace, draw_ball, tip_at, tips, turn_to
from engine3d.stage.overlays.theme import DARK, LIGHT
from engine3d.stage.views.viewpoint import UP_DIRECTIONS, Viewpoint

PLACE = BallPlace(60.0, 50.0, 40.0)


def looking(**angles):
    return Viewpoint(np.array([1.0, 2.0, 3.0]), 5.0, **angles)


def test_tips_are_where_the_camera_sees_the_axes():
    found = {tip.name: tip for tip in tips(looking(azimuth=0.0, elevation=0.0).rotation(), PLACE)}
    assert found.keys() == UP_DIRECTIONS.keys()
    assert found["+X"].x > PLACE.x + 20 and found["+X"].y == pytest.approx(PLACE.y)
    assert found["+Y"].y < PLACE.y - 20 and found["-Y"].y > PLACE.y + 20
    assert found["+Z"].nearness == pytest.approx(1) and found["-Z"].nearness == pytest.approx(-1)


@pytest.mark.parametrize("name", UP_DIRECTIONS)
@pytest.mark.parametrize("up", ["+Y", "+Z", "-X"])
def test_a_click_looks_from_a_direction_and_a_second_one_from_the_other(name, up):
    view = looking(azimuth=0.3, elevation=0.2, up=UP_DIRECTIONS[up])
    for direction in (np.array(UP_DIRECTIONS[name]), -np.array(UP_DIRECTIONS[name])):
        turn_to(view, name)
        np.testing.assert_allclose(view.rotation()[:, 2], direction, atol=1e-12)
        np.testing.assert_allclose(view.target, (1, 2, 3))
        assert view.distance == pytest.approx(5.0)


def test_the_nearest_tip_is_under_the_mouse():
    rotation = looking(azimuth=0.0, elevation=0.0).rotation()
    assert tip_at(rotation, PLACE, PLACE.x, PLACE.y) == "+Z"
    (right,) = (tip for tip in tips(rotation, PLACE) if tip.name == "+X")
    assert tip_at(rotation, PLACE, right.x + 3, right.y - 2) == "+X"
    assert tip_at(rotation, PLACE, PLACE.x + 15, PLACE.y + 15) is None
    assert PLACE.covers(PLACE.x + 15, PLACE.y + 15) and not PLACE.covers(PLACE.x + 41, PLACE.y)


@pytest.mark.parametrize("theme", [DARK, LIGHT])
def test_the_ball_shows_each_axis_in_its_colour_within_its_radius(theme):
    canvas = Canvas((120, 100))
    canvas.clear(theme.background)
    draw_ball(canvas, looking().rotation(), PLACE, theme=theme)
    changed = (canvas.pixels[..., :3] != theme.background).any(axis=2)
    rows, columns = np.nonzero(changed)
    away = np.hypot(columns + 0.5 - PLACE.x, rows + 0.5 - PLACE.y)
    assert changed.sum() > 500 and away.max() < PLACE.radius + 1
    red, green, blue = (canvas.pixels[..., k].astype(int) for k in range(3))
    for more, others in ((red, (green, blue)), (green, (red, blue)), (blue, (red, green))):
        assert all((more > other + 40).sum() > 50 for other in others)


def test_what_is_under_the_mouse_is_lit_and_the_ball_shows_as_a_disc():
    rotation = looking().rotation()
    pictures = []
    for lit, is_hovered in ((None, False), (None, True), ("-X", True)):
        canvas = Canvas((120, 100))
        draw_ball(canvas, rotation, PLACE, lit=lit, is_hovered=is_hovered)
        pictures.append(canvas.pixels)
    assert (pictures[0] != pictures[1]).any(axis=2).sum() > 1000
    changed = np.argwhere((pictures[1] != pictures[2]).any(axis=2))
    (tip,) = (tip for tip in tips(rotation, PLACE) if tip.name == "-X")
    assert len(changed) and np.abs(changed - (tip.y, tip.x)).max() < 14
