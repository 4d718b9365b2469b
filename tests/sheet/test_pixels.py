"""A pixel of the sheet is a place in the world, and a place in the world a pixel."""

import itertools

import numpy as np
import pytest
from sheet.conftest import drawn, part, views_of

import engine3d as e3d

LOW, HIGH = np.array([-2.0, 0.0, -1.0]), np.array([2.0, 2.4, 1.0])
CORNERS = np.array(list(itertools.product(*zip((-2, 0, -1), (2, 1, 1), strict=True))), float)


def far():
    mesh = e3d.box((4, 2, 3))
    return e3d.Mesh(mesh.positions.astype(float) + (5.0e6, 4.0e6, 120.0), mesh.faces)


@pytest.fixture(scope="module")
def through_cameras():
    scene = part()
    scene.add(e3d.PerspectiveCamera(0.6), pose=e3d.look_at((6, 5, 8), (0, 1, 0)))
    scene.add(e3d.OrthographicCamera(2.0), pose=e3d.look_at((6, 5, 8), (0, 1, 0)))
    tiny = e3d.PerspectiveCamera(0.6, znear=1e-6)  # whose projection is enlarged
    scene.add(tiny, pose=e3d.look_at((6, 5, 8), (0, 1, 0)))
    return drawn(scene, views="camera0,camera1,camera2")


def test_the_box_of_the_base_ends_where_its_corners_are(part_sheet):
    for name, view in views_of(part_sheet).items():
        if name in ("front", "right", "top", "below"):
            pixels = part_sheet.project(name, CORNERS)
            base = next(node for node in view["nodes"] if node["name"] == "base")
            x, y, width, height = base["box"]
            low, high = pixels.min(axis=0), pixels.max(axis=0)
            assert abs(x - low[0]) <= 1 and abs(x + width - high[0]) <= 1
            assert abs(y + height - high[1]) <= 1


@pytest.mark.parametrize("source", ["part_sheet", "through_cameras"])
def test_what_is_at_a_pixel_is_drawn_there(source, request):
    sheet = request.getfixturevalue(source)
    random = np.random.default_rng(7)
    tried = 0
    for view in sheet.report["models"][0]["views"]:
        left, top, width, height = view["rectangle"]
        places = random.integers((left, top), (left + width, top + height), (60, 2))
        for x, y in places.tolist():
            found = sheet.at(x, y)
            assert found["view"] == view["name"]
            if "position" in found:
                tried += 1
                back = sheet.project(view["name"], found["position"])
                assert back == pytest.approx([x + 0.5, y + 0.5], abs=1e-6)
                on_it(found)
    assert tried > 20


def on_it(found):
    """The position is on the surface of the node that is said to show."""
    x, y, z = found["position"]
    if found["name"] == "base":
        away = np.abs([x, y - 0.5, z]) - (2.0, 0.5, 1.0)
        assert abs(away.max()) < 1e-4
    elif found["name"] == "ball":
        assert 0.66 < np.linalg.norm(np.subtract((x, y, z), (0.8, 1.7, 0.3))) < 0.7001


def test_the_matrices_of_the_report_are_those(part_sheet, through_cameras):
    for sheet in (part_sheet, through_cameras):
        for view in sheet.report["models"][0]["views"]:
            camera = view["camera"]
            there, back = np.array(camera["pixel_from_world"]), np.array(camera["world_from_pixel"])
            assert np.allclose(there @ back, np.eye(4), atol=1e-9)
            x, y, _, w = there @ (*camera["target"], 1.0)
            left, top, width, height = view["rectangle"]
            assert [x / w, y / w] == pytest.approx([left + width / 2, top + height / 2])
            position = np.array(camera["view_from_world"]) @ (*camera["position"], 1.0)
            assert np.allclose(position, (0, 0, 0, 1), atol=1e-9)


def test_projections_are_told(through_cameras):
    views = views_of(through_cameras)
    kinds = [views[f"camera{k}"]["camera"]["projection"] for k in range(3)]
    assert kinds == ["perspective", "orthographic", "perspective"]
    assert views["camera0"]["camera"]["yfov"] == 0.6
    shown = [[n["name"] for n in views[f"camera{k}"]["nodes"]] for k in (0, 2)]
    assert shown[0] == shown[1] != []


def test_one_scale_for_all_drawings(part_sheet):
    views = views_of(part_sheet)
    scales = {view["camera"]["scale"] for view in views.values() if view["to_scale"]}
    assert len(scales) == 1
    (scale,) = scales
    x0, x1 = part_sheet.project("front", [(0, 0, 0), (1, 0, 0)])[:, 0]
    assert x1 - x0 == pytest.approx(scale)


def test_front_is_below_top_and_beside_right():
    sheet = drawn(part())
    top, front = (sheet.project(name, (2, 1, 1)) for name in ("top", "front"))
    right = sheet.project("right", (2, 1, 1))
    assert top[0] == pytest.approx(front[0]) and front[1] == pytest.approx(right[1])
    assert top[1] < front[1] and front[0] < right[0]


def test_far_from_the_origin_all_is_in_the_file_s_coordinates(tmp_path):
    e3d.save_mesh(far(), tmp_path / "far.ply")
    sheet = drawn(tmp_path / "far.ply", views="front,top")
    bounds = sheet.report["models"][0]["bounds"]
    assert bounds["low"] == pytest.approx((4999998.0, 3999999.0, 118.5), abs=0.3)
    (front, _) = sheet.report["models"][0]["views"]
    x, y, width, height = front["box"]
    found = sheet.at(x + width // 2, y + height // 2)
    assert found["position"] == pytest.approx(bounds["center"][:2] + [bounds["high"][2]], abs=0.1)
    assert sheet.project("front", found["position"])[0] == pytest.approx(x + width // 2 + 0.5)


def test_between_panels_there_is_nothing(part_sheet):
    assert part_sheet.at(0, 0) is None
    left, top, *_ = views_of(part_sheet)["front"]["rectangle"]
    assert part_sheet.at(left, top) == {"model": 0, "view": "front"}
    with pytest.raises(e3d.InvalidArgumentError, match="no view 'back'; it has front"):
        part_sheet.project("back", (0, 0, 0))
    with pytest.raises(e3d.InvalidArgumentError, match="no model 1"):
        part_sheet.project("front", (0, 0, 0), model=1)
