"""Whether a panel is blank, and the word for why."""

import tempfile
from pathlib import Path

import numpy as np
import pytest
from sheet.conftest import drawn, of_mesh, triangle

import engine3d as e3d


def switched_off():
    scene = triangle()
    scene.nodes[0].visible = False
    return scene


def clear(**options):
    return triangle(materials=[e3d.Material(color=(1.0, 1.0, 1.0, 0.0), **options)])


def with_camera(position, target, **options):
    scene = triangle()
    scene.add(e3d.PerspectiveCamera(0.6, **options), pose=e3d.look_at(position, target))
    return scene


def like_the_ground():
    flat = [(0, 0, 0), (9, 0, 0), (0, 9, 0)]
    scene = of_mesh(flat, [[0, 1, 2]], materials=[e3d.Material(color=(228, 231, 236), unlit=True)])
    # So near that no line of its outline shows.
    scene.add(e3d.PerspectiveCamera(0.6), pose=e3d.look_at((2, 2, 1), (2, 2, 0)))
    return scene


def small_beside_far():
    scene = e3d.Scene()
    scene.add(e3d.Mesh(np.eye(3) * 1e-3, [[0, 1, 2]]))
    scene.add(e3d.OrthographicCamera(1.0, zfar=100.0), pose=e3d.look_at((0, 0, 9), (0.3, 0.2, 0)))
    return scene


def file_seen_from_behind():
    """A glTF file, whose materials say that backs do not show."""
    path = Path(tempfile.mkdtemp()) / "flat.glb"
    of_mesh(FLAT, [[0, 1, 2]]).save(path)
    return path


FLAT = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
BLANK = {
    "no_geometry": (e3d.Scene, "front"),
    "no_faces": (lambda: of_mesh(np.eye(3), []), "front"),
    "hidden_nodes": (switched_off, "iso"),
    "not_finite": (lambda: of_mesh(np.full((3, 3), np.nan), [[0, 1, 2]]), "iso"),
    "zero_size": (lambda: of_mesh(np.ones((3, 3)), [[0, 1, 2]]), "iso"),
    "edge_on": (lambda: of_mesh(FLAT, [[0, 1, 2]]), "top"),
    "all_culled": (file_seen_from_behind, "back"),
    "transparent": (lambda: clear(alpha_mode="blend"), "iso"),
    "behind_camera": (lambda: with_camera((0, 0, 5), (0, 0, 9)), "camera0"),
    "beyond_far": (lambda: with_camera((0, 0, 50), (0, 0, 0), zfar=10), "camera0"),
    "outside": (lambda: with_camera((0, 0, 5), (40, 0, -30)), "camera0"),
    "far_away": (small_beside_far, "camera0"),
    "same_colour": (like_the_ground, "camera0"),
}


@pytest.mark.parametrize("word", BLANK)
def test_why_it_is_blank(word):
    make, name = BLANK[word]
    report = drawn(make(), (300, 220), views=name).report["models"][0]
    (view,) = report["views"]
    assert (view["blank"], view["why"]) == (True, word)
    assert (report["blank"], report["why"]) == (True, word) and view["sentence"]
    assert (view["pixels"] == 0) == (word != "same_colour")


def test_masked_away():
    report = drawn(clear(alpha_mode="mask"), (300, 220), views="iso").report
    assert report["models"][0]["views"][0]["why"] == "transparent"


def test_what_shows_is_not_blank():
    report = drawn(triangle(), (300, 220), views="iso").report["models"][0]
    (view,) = report["views"]
    assert not report["blank"] and view["why"] is None and view["sentence"] is None
    assert view["contrast"] > 30


def test_one_blank_panel_is_no_blank_sheet():
    report = drawn(of_mesh(FLAT, [[0, 1, 2]]), (300, 440), views="top,front").report["models"][0]
    assert [view["blank"] for view in report["views"]] == [True, False]
    assert (report["blank"], report["why"]) == (False, None)


def test_the_reason_is_written_in_the_panel():
    picture = np.asarray(drawn(of_mesh(FLAT, [[0, 1, 2]]), (600, 300), views="top"))
    assert (picture[40:70, 80:400, :3].min(axis=2) < 120).any()


@pytest.mark.parametrize(
    "lines_or_points", [{"lines": [[0, 1], [1, 2]]}, {"points": [0, 1, 2]}], ids=["lines", "points"]
)
def test_lines_and_points_show(lines_or_points):
    scene = e3d.Scene()
    scene.add(e3d.Mesh(np.eye(3), **lines_or_points))
    report = drawn(scene, views="front,iso").report["models"][0]
    assert not any(view["blank"] for view in report["views"])
