"""What the report says of what shows: pixels, boxes, shares hidden."""

import numpy as np
import pytest
from sheet.conftest import drawn, part, views_of

import engine3d as e3d

GROUPS = """usemtl red
g left
v 0 0 0
v 1 0 0
v 2 0 0
v 0 1 0
v 1 1 0
v 2 1 0
f 1 2 5 4
g right upper
usemtl blue
f 2 3 6 5
"""


def nodes(view):
    return {node["name"]: node for node in view["nodes"]}


def test_pixels_are_areas(part_sheet):
    view = views_of(part_sheet)["front"]
    scale = view["camera"]["scale"]
    base = nodes(view)["base"]
    assert base["pixels"] == pytest.approx(4.0 * scale * scale, abs=5.0 * scale + 4)
    assert base["hidden"] == 0.0
    assert view["pixels"] == sum(node["pixels"] for node in view["nodes"])
    left, top, width, height = view["rectangle"]
    assert view["coverage"] == view["pixels"] / (width * height)


def test_pixels_and_boxes_are_those_of_the_picture(part_sheet):
    for view in part_sheet.report["models"][0]["views"]:
        left, top, width, height = view["rectangle"]
        found = {}
        for y in range(top, top + height, 7):
            for x in range(left, left + width, 5):
                at = part_sheet.at(x, y)
                if "name" in at:
                    found.setdefault(at["name"], []).append((x, y))
        for name, places in found.items():
            x, y, wide, high = nodes(view)[name]["box"]
            columns, rows = np.array(places).T
            assert x <= columns.min() and columns.max() < x + wide
            assert y <= rows.min() and rows.max() < y + high
            assert columns.max() - columns.min() > wide - 12 and nodes(view)[name]["pixels"] > 0


def test_shares_hidden():
    scene = e3d.Scene()
    scene.add(e3d.box((2, 2, 0.1)), name="wall")
    scene.add(e3d.box((1, 1, 0.1)), name="half", translation=(1, 0, -1))
    scene.add(e3d.box((1, 1, 0.1)), name="free", translation=(3, 0, -1))
    front, side, back = drawn(scene, views="front,right,back").report["models"][0]["views"]
    assert nodes(front)["half"]["hidden"] == pytest.approx(0.5, abs=0.03)
    assert nodes(front)["free"]["hidden"] == nodes(front)["wall"]["hidden"] == 0.0
    assert nodes(back)["wall"]["hidden"] == pytest.approx(0.125, abs=0.01)
    assert nodes(back)["half"]["hidden"] == 0.0
    assert "half" not in nodes(side)  # the free one is before it


def test_alone_is_what_a_frame_without_the_others_shows():
    scene = part()
    sheet = drawn(scene, views="turned=30,20")
    (view,) = sheet.report["models"][0]["views"]
    (panel,) = sheet._panels[0]
    for node in scene.nodes:
        node.visible = False
    for entry in view["nodes"]:
        node = scene.find(entry["name"])
        node.visible = True
        options = {"outputs": ("object_id",), "threads": 1, "size": tuple(view["rectangle"][2:])}
        ids = e3d.render(scene, (panel.camera, panel.pose), **options).object_id
        assert entry["alone"] == (ids == node.id).sum()
        assert entry["hidden"] == 1.0 - entry["pixels"] / entry["alone"]
        node.visible = False


def test_what_is_never_visible(part_sheet):
    report = part_sheet.report["models"][0]
    assert report["never_visible"] == [2]
    assert report["nodes"][2]["name"] == "inside"


def test_materials_and_named_parts(tmp_path):
    (tmp_path / "groups.obj").write_text(GROUPS)
    report = drawn(tmp_path / "groups.obj", views="front").report["models"][0]
    (view,) = report["views"]
    parts = {part["name"]: part for part in view["parts"]}
    assert {"left", "right", "upper"} <= parts.keys()
    assert parts["right"]["pixels"] == parts["upper"]["pixels"]
    assert parts["left"]["pixels"] + parts["right"]["pixels"] == view["pixels"]
    left, right = parts["left"]["box"], parts["right"]["box"]
    assert left[0] + left[2] == right[0] and left[1] == right[1]
    assert [m["name"] for m in report["materials"]] == ["red", "blue"]
    assert [m["pixels"] for m in view["materials"]] == [
        parts["left"]["pixels"],
        parts["right"]["pixels"],
    ]


def test_one_material_of_many_nodes_is_one():
    scene, paint = e3d.Scene(), e3d.Material(color=(200, 50, 50), name="paint")
    for place in (-1, 1):
        mesh = e3d.box()
        mesh.materials = [paint]
        scene.add(mesh, translation=(place, 0, 0))
    report = drawn(scene, views="front").report["models"][0]
    assert len(report["materials"]) == 1
    (view,) = report["views"]
    (material,) = view["materials"]
    assert material["pixels"] == view["pixels"]
    assert material["box"] == view["box"]


def test_glass_shows_and_hides():
    scene = e3d.Scene()
    pane = e3d.box((3, 3, 0.1))
    pane.materials = [e3d.Material(color=(1.0, 1.0, 1.0, 0.3), alpha_mode="blend")]
    scene.add(pane, name="pane", translation=(0, 0, 1))
    scene.add(e3d.box(), name="behind")
    (view,) = drawn(scene, views="front").report["models"][0]["views"]
    assert set(nodes(view)) == {"pane"}


def test_too_many_overlapping_nodes_are_left_unknown(monkeypatch):
    monkeypatch.setattr("engine3d.apps.sheet.hidden.MOST_PICTURES", 2)
    scene = e3d.Scene()
    for number in range(4):
        scene.add(e3d.box((4 - number, 1, 1)), name=str(number), translation=(0, 0, number))
    (view,) = drawn(scene, views="front").report["models"][0]["views"]
    assert nodes(view)["3"]["hidden"] is None and nodes(view)["3"]["alone"] is None


def test_instances_count_as_one_node():
    scene = e3d.Scene()
    crowd = e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1), (2, 0, 0, 1), (4, 0, 0, 0.5)])
    scene.add(crowd, name="crowd")
    report = drawn(scene, views="front").report["models"][0]
    assert report["triangles"] == 36
    assert report["bounds"]["size"] == [4.75, 1.0, 1.0]
    assert [node["name"] for node in report["views"][0]["nodes"]] == ["crowd"]
