"""How views and sections are spelt."""

import numpy as np
import pytest

from engine3d.apps.sheet.views import STANDARD, Section, check_views, parse_section, parse_views
from engine3d.errors import InvalidArgumentError

Y_UP, Z_UP = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def test_names_and_directions_in_one_list():
    specs = parse_views("front, iso,under=0,1,0,turned=30,-20,camera2,back")
    assert [spec.name for spec in specs] == ["front", "iso", "under", "turned", "camera2", "back"]
    assert specs[2].sight == (0.0, 1.0, 0.0)
    assert specs[3].angles == (30.0, -20.0)
    assert specs[4].camera == 2
    assert [spec.kind for spec in specs[:2]] == ["drawing", "isometric"]


def test_a_standard_view_may_get_another_name():
    (spec,) = parse_views("entrance=back")
    assert (spec.name, spec.angles) == ("entrance", STANDARD["back"])


@pytest.mark.parametrize(
    ("name", "right", "back"),
    [
        ("front", (1, 0, 0), (0, 0, 1)),
        ("right", (0, 0, -1), (1, 0, 0)),
        ("back", (-1, 0, 0), (0, 0, -1)),
        ("left", (0, 0, 1), (-1, 0, 0)),
        ("top", (1, 0, 0), (0, 1, 0)),
        ("bottom", (1, 0, 0), (0, -1, 0)),
    ],
)
def test_where_standard_views_look_from(name, right, back):
    (spec,) = parse_views(name)
    axes = spec.axes(Y_UP)
    assert axes[:, 0].tolist() == list(right) and axes[:, 2].tolist() == list(back)


def test_with_z_up_the_front_looks_along_y():
    (spec,) = parse_views("front")
    assert spec.axes(Z_UP)[:, 2].tolist() == [0.0, -1.0, 0.0]
    assert spec.axes(Z_UP)[:, 1].tolist() == [0.0, 0.0, 1.0]


@pytest.mark.parametrize("sight", ["0,-1,0", "0,1,0", "1,2,3", "-1e200,1e200,0"])
def test_directions_give_axes_at_right_angles(sight):
    (spec,) = parse_views(f"a={sight}")
    axes = spec.axes(Y_UP)
    assert np.allclose(axes.T @ axes, np.eye(3)) and np.linalg.det(axes) > 0
    wanted = np.array([float(number) for number in sight.split(",")])
    assert np.allclose(-axes[:, 2], wanted / np.abs(wanted).max() / np.linalg.norm(spec.sight))


@pytest.mark.parametrize(
    ("text", "section"),
    [
        ("x=0.5", Section(0, True, 0.5, False)),
        ("-y=20%", Section(1, False, 0.2, True)),
        ("Z", Section(2, True, 0.5, True)),
        ("-x=-3e2", Section(0, False, -300.0, False)),
    ],
)
def test_sections(text, section):
    assert parse_section(text) == section


def test_where_a_section_is():
    assert parse_section("x=25%").coordinate(2.0, 6.0) == 3.0
    assert parse_section("x=25").coordinate(2.0, 6.0) == 25.0


@pytest.mark.parametrize(
    "views",
    ["", "fronts", "a=1", "a=0,0,0", "a=1,2,3,4", "a=1,91", "a=nan,0,0", "=1,2,3", "front,front", 3]
    + [["front", None], ",".join(f"v{k}={k},0" for k in range(25))],
)
def test_what_is_no_view(views):
    with pytest.raises(InvalidArgumentError, match="view"):
        check_views(views, ())


@pytest.mark.parametrize("section", ["w=1", "x=", "x=a", "x=inf", "x=1%%", "", None])
def test_what_is_no_section(section):
    with pytest.raises(InvalidArgumentError, match="section"):
        check_views("front", [section])
