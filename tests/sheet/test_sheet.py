"""Sheets as a whole: the same bytes always, scenes left alone, files whole or absent."""

import json
import os

import numpy as np
import pytest
from PIL import Image
from sheet.conftest import SIZE, drawn, part, triangle

import engine3d as e3d
from engine3d.apps.sheet import marks
from engine3d.stage.overlays.lengths import length_text

OPTIONS = {"views": "front,iso,turned=20,30", "sections": "x=0.8", "size": SIZE}


def data_of(**options):
    sheet = e3d.sheets.contact_sheet(part(), **OPTIONS, **options)
    return sheet.encode(), sheet.json()


def test_the_same_bytes_on_every_backend_and_number_of_threads():
    expected = data_of(backend="scalar", threads=1)
    for backend in e3d.backends():
        assert data_of(backend=backend, threads=1) == expected, backend
    assert data_of(threads=3) == expected


def test_scenes_are_left_as_they_were():
    scene = part()
    scene.fog = e3d.Fog((1.0, 1.0, 1.0), 1.0, 20.0)
    scene.add(e3d.DirectionalLight((0, -1, 0)))
    metal = e3d.box()
    metal.materials = [e3d.Material(metallic=1.0)]
    scene.add(metal)
    values = [getattr(scene, n) for n in ("background", "ambient", "fog", "environment")]
    nodes, before = scene.nodes, e3d.render(scene, size=(64, 48), threads=1).color
    first = drawn(scene, **{k: v for k, v in OPTIONS.items() if k != "size"})
    assert scene.nodes == nodes
    after = [getattr(scene, n) for n in ("background", "ambient", "fog", "environment")]
    assert values == after
    assert scene.environment_intensity == 1.0
    assert np.array_equal(e3d.render(scene, size=(64, 48), threads=1).color, before)
    again = drawn(scene, **{k: v for k, v in OPTIONS.items() if k != "size"})
    assert again.encode() == first.encode() and again.json() == first.json()


def test_a_scene_is_left_alone_when_drawing_fails():
    scene = part()
    nodes = scene.nodes
    with pytest.raises(e3d.InvalidArgumentError):
        drawn(scene, views="camera0")
    with pytest.raises(e3d.errors.BackendError):
        e3d.sheets.contact_sheet(scene, size=SIZE, backend="none")
    assert scene.nodes == nodes and scene.ambient == pytest.approx((0.5, 0.4, 0.3))


def test_picture_and_report_are_written_together(tmp_path, part_sheet):
    part_sheet.save(tmp_path / "a.png", report=tmp_path / "a.json")
    with Image.open(tmp_path / "a.png") as image:
        assert np.array_equal(np.asarray(image), np.asarray(part_sheet))
    assert json.loads((tmp_path / "a.json").read_text()) == part_sheet.report
    with pytest.raises(e3d.FileAccessError):
        part_sheet.save(tmp_path / "b.png", report=tmp_path / "no" / "b.json")
    assert sorted(os.listdir(tmp_path)) == ["a.json", "a.png"]
    with pytest.raises(e3d.InvalidArgumentError, match=r"\.png"):
        part_sheet.save(tmp_path / "c.jpg")


def test_the_report_says_where_panels_are(part_sheet):
    assert part_sheet.report["version"] == 1
    assert part_sheet.report["size"] == list(SIZE)
    assert part_sheet.picture.pixels.shape == (360, 480, 4)
    assert (part_sheet.picture.pixels[..., 3] == 255).all()
    (model,) = part_sheet.report["models"]
    assert model["bounds"]["size"] == pytest.approx([4.0, 2.4, 2.0])
    assert (model["triangles"], model["up"], model["unit"]) == (
        sum(len(node.object.faces) for node in part().nodes),
        "+Y",
        None,
    )


def test_lists_of_numbers_are_on_one_line(part_sheet):
    lines = part_sheet.json().splitlines()
    assert any(line.strip().startswith('"rectangle": [') and line.endswith("],") for line in lines)
    assert json.loads(part_sheet.json()) == part_sheet.report


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
def test_files_say_their_format_and_unit(tmp_path):
    scene = part()
    e3d.save_scene(scene, tmp_path / "part.glb")
    (model,) = drawn(tmp_path / "part.glb", views="front").report["models"]
    assert (model["format"], model["unit"]) == ("glb", "m")
    assert model["file"] == str(tmp_path / "part.glb") and model["title"] == "part.glb"
    (model,) = drawn(tmp_path / "part.glb", views="front", unit="ft").report["models"]
    assert model["unit"] == "ft"


def test_several_models_have_a_part_each():
    meshes = [e3d.box(), e3d.uv_sphere(1.0, (12, 6)), part()]
    sheet = e3d.sheets.contact_sheet(meshes, size=(480, 200), views="front,iso", threads=1)
    assert (sheet.picture.width, sheet.picture.height) == (480, 600)
    assert [model["title"] for model in sheet.report["models"]] == ["box", "uv_sphere", "scene"]
    for number, model in enumerate(sheet.report["models"]):
        for view in model["views"]:
            assert 200 * number <= view["rectangle"][1] < 200 * (number + 1)
    one = e3d.sheets.contact_sheet(meshes[0], size=(480, 200), views="front,iso", threads=1)
    assert np.array_equal(sheet.picture.pixels[:200], one.picture.pixels)
    assert sheet.at(100, 300) is None or sheet.at(100, 300)["model"] == 1


def test_up_turns_the_views():
    scene = e3d.Scene()
    scene.add(e3d.box((1, 2, 4)))
    extents = {
        up: [
            view["extent"]
            for view in drawn(scene, views="front,top", up=up).report["models"][0]["views"]
        ]
        for up in ("+Y", "+Z")
    }
    assert extents == {"+Y": [[1.0, 2.0], [1.0, 4.0]], "+Z": [[1.0, 4.0], [1.0, 2.0]]}
    with pytest.raises(e3d.InvalidArgumentError, match="up must be"):
        drawn(scene, up="up")


@pytest.mark.parametrize(
    "positions",
    [np.eye(3) * 1e30, np.eye(3) * 1e-30, np.eye(3) + 1e7, np.eye(3) * (100.0, 5.0, 1.0)],
    ids=["huge", "tiny", "far", "needle"],
)
def test_odd_sizes_show(positions):
    report = drawn(
        triangle().nodes[0].object if positions is None else e3d.Mesh(positions, [[0, 1, 2]])
    )
    (model,) = report.report["models"]
    assert not model["blank"]
    assert json.loads(report.json())["models"][0]["views"][0]["camera"]["scale"] > 0


def test_one_point():
    mesh = e3d.Mesh([(5, 6, 7)], points=[0])
    (model,) = drawn(mesh).report["models"]
    assert model["bounds"]["low"] == [5.0, 6.0, 7.0]
    assert all(view["pixels"] > 0 for view in model["views"])


def test_hostile_names():
    scene = e3d.Scene()
    mesh = e3d.box()
    mesh.materials = [e3d.Material(name="\x07bell")]
    scene.add(mesh, name="\x1b[31m\n" + "x" * 500)
    (model,) = drawn(scene, views='\x1b"name=1,0,0').report["models"]
    assert model["nodes"][0]["name"].startswith("\\x1b[31m\\nx")
    assert model["materials"][0]["name"] == "\\x07bell"
    assert model["views"][0]["name"] == '\\x1b"name'


def test_the_dimensions_are_written_where_the_drawing_ends(part_sheet):
    # Below the base of the front view there is the line of its width, from side to side.
    (view,) = [v for v in part_sheet.report["models"][0]["views"] if v["name"] == "front"]
    x, y, width, height = view["box"]
    left, _, wide, _ = view["rectangle"]
    place = slice(y + height + 4, y + height + 24), slice(left, left + wide)
    rows = part_sheet.picture.pixels[place][..., :3]
    dark = (rows.max(axis=2) < 130).sum(axis=1)
    line = int(dark.argmax())
    columns = np.flatnonzero(rows[line].max(axis=1) < 130) + left
    assert abs(columns.min() - x) <= 1 and abs(columns.max() - (x + width - 1)) <= 1


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (12.0, None, "12"),
        (0.012346, "m", "0.01235 m"),
        (123456.0, "mm", "123456 mm"),
        (0.00001234, None, "0.00001234"),
        (2.6e30, None, "2.6e+30"),
        (0.0, "m", "0 m"),
        (99999.6, None, "100000"),
    ],
)
def test_lengths_are_short(value, unit, text):
    assert length_text(value, unit) == text


@pytest.mark.parametrize(
    ("most", "length"), [(1.0, 1.0), (4.9, 2.0), (99.0, 50.0), (0.0021, 0.002), (3e30, 2e30)]
)
def test_bars_have_round_lengths(most, length):
    assert marks.round_length(most) == length


def test_long_texts_lose_their_middle():
    width = e3d.Font("mono", 10).width  # 6 pixels a character
    assert marks.short("abcdefghijklmnop", 60, width) == "abcdef…nop"
    assert marks.short("abcdefghijklmnop", 10, len) == "abcdef…nop"
    assert marks.short("abc", 60, width) == "abc"
    assert marks.short("abcdefghijklmnop", 20, width) == "ab…"
    assert marks.short("abcdefghijklmnop", 5, width) == ""


@pytest.mark.parametrize("models", [[], 3, [3], [None]])
def test_what_is_no_model(models):
    with pytest.raises(e3d.InvalidArgumentError, match="model"):
        e3d.sheets.contact_sheet(models)


def test_sizes_that_are_too_small_or_too_large():
    with pytest.raises(e3d.InvalidArgumentError, match="too few"):
        drawn(part(), (120, 90))
    with pytest.raises(e3d.InvalidArgumentError, match="rows"):
        e3d.sheets.contact_sheet([part()] * 9, size=(400, 4000))


def test_lines_fade_where_there_are_many():
    from engine3d.apps.sheet.outlines import draw_outlines

    ids = np.zeros((40, 40), np.int64)
    ids[:, 20:] = np.arange(800).reshape(40, 20)  # each pixel is a thing of its own
    color = np.full((40, 40, 4), 200, np.uint8)
    depth, normals = np.ones((40, 40), np.float32), np.ones((40, 40, 3), np.float32)
    draw_outlines(color, ids, depth, normals, 10.0)
    assert color[20, 20, 0] < 130  # where the many begin
    assert (color[10:30, 28:34, 0] == 200).all()
    assert (color[:, :18, 0] == 200).all()
