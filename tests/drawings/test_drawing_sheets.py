"""Pages of drawings: lengths on paper, sections, layouts."""

import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.drawings.cut_faces import cap_of
from engine3d.drawings import drawing_sheet
from engine3d.model.measuring.cutting import Plane, cut_nodes


def lines_of(sheet, name):
    """Return the view of a name, as layers of polylines in millimetres."""
    group = next(group for group in sheet._page.groups if group.title == name)
    return {
        layer.name: [np.array(line) / 1000.0 for one in strokes for line in one.polylines]
        for layer, strokes in group.layers
    }


def extent(lines):
    points = np.concatenate(lines)
    return points.max(axis=0) - points.min(axis=0)


@pytest.mark.parametrize(("unit", "size"), [("mm", 1.0), ("cm", 0.1), ("in", 1 / 25.4), (None, 1)])
def test_views_have_their_size_on_paper(unit, size):
    box = e3d.box(np.array((60.0, 40.0, 20.0)) * size)
    sheet = drawing_sheet(box, unit=unit, scale="1:1")
    assert sheet.scale == 1.0 and sheet.size == (420.0, 297.0)
    for name, sides in (("front", (60, 40)), ("top", (60, 20)), ("right", (20, 40))):
        assert extent(lines_of(sheet, name)["outline"]) == pytest.approx(sides, abs=2e-3)


def test_a_scale_must_fit():
    box = e3d.box((60.0, 40.0, 20.0))
    assert drawing_sheet(box, scale="2:1", page="A2").scale == 2.0
    assert drawing_sheet(box, scale=0.1).scale == 0.1
    with pytest.raises(e3d.InvalidArgumentError, match="do not fit the page at 10:1; they do at 1"):
        drawing_sheet(box, scale="10:1", page="A4")


def test_a_section_is_outlined_hatched_and_hides_what_is_behind():
    scene = e3d.Scene()
    scene.add(e3d.box((60.0, 40.0, 20.0)), name="block")
    scene.add(e3d.icosphere(5.0), name="ball", translation=(0, 0, -30))
    sheet = drawing_sheet(scene, sections="z=0", views="front", hidden=True)
    layers = lines_of(sheet, "section z=0")
    assert extent(layers["section"]) == pytest.approx(
        (60 * sheet.scale, 40 * sheet.scale), abs=2e-3
    )
    assert len(layers["hatching"]) > 5
    # The ball is behind the cut face, and so are the far edges of the block.
    assert "outline" not in layers and len(layers["hidden-outline"]) >= 1
    without = lines_of(drawing_sheet(scene, sections="z=0", views="front"), "section z=0")
    assert set(without) == {"section", "hatching", "title"}


def test_a_cut_is_filled_where_it_winds():
    # A pipe: the inside of its bore is not material.
    turns = np.linspace(0, 2 * np.pi, 41)[:-1]
    ring = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    outer, inner = ring * 4.0, ring[::-1] * 2.0

    def walls(points):
        return [
            (np.append(a, z0), np.append(b, z1), np.append(c, z2))
            for a, b in zip(points, np.roll(points, -1, axis=0), strict=True)
            for (a, z0), (b, z1), (c, z2) in (
                ((a, -1), (b, -1), (b, 1)),
                ((a, -1), (b, 1), (a, 1)),
            )
            for a, b, c in ((a, b, c),)
        ]

    triangles = np.array(walls(outer) + walls(inner))
    mesh = e3d.Mesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    scene = e3d.Scene()
    scene.add(mesh)
    plane = Plane(2, 0.1, True)
    (outline,) = cut_nodes(scene.nodes, plane)
    cap = cap_of(outline, plane, 0.5)
    a, b, c = np.moveaxis(cap.triangles, 1, 0)
    area = np.abs(np.cross(b - a, c - a)[:, 2]).sum() / 2
    polygon = 40 / 2 * np.sin(2 * np.pi / 40) * (16 - 4)
    assert area == pytest.approx(polygon, rel=1e-6)
    lengths = np.linalg.norm(cap.hatching[:, 1] - cap.hatching[:, 0], axis=1)
    assert lengths.sum() * 0.5 == pytest.approx(polygon, rel=0.05)
    middles = np.linalg.norm(cap.hatching.mean(axis=1)[:, :2], axis=1)
    assert (middles < 4.0).all() and np.allclose(cap.hatching[..., 2], 0.1)


def test_wrong_pages_are_refused():
    box = e3d.box()
    wrong = e3d.InvalidArgumentError
    with pytest.raises(wrong, match="A3"):
        drawing_sheet(box, page="A9")
    with pytest.raises(wrong, match="one model"):
        drawing_sheet([box, box])
    with pytest.raises(wrong, match="unit"):
        drawing_sheet(box, unit="yard")
    with pytest.raises(wrong, match="no camera 0"):
        drawing_sheet(box, views="camera0")
    with pytest.raises(wrong, match="up"):
        drawing_sheet(box, up="up")


def test_cameras_and_empty_models_have_views():
    scene = e3d.Scene()
    scene.add(e3d.box())
    scene.add(e3d.PerspectiveCamera(0.7), pose=e3d.look_at((2, 2, 3), (0, 0, 0)))
    layers = lines_of(drawing_sheet(scene, views="camera0"), "camera0")
    assert len(layers["outline"]) >= 1
    assert "no lines" in drawing_sheet(e3d.Scene(), views="front").svg()


def test_a_page_shows_a_robot_as_its_joints_stand(tmp_path):
    path = tmp_path / "slide.urdf"
    link = '<link name="{}"><visual><geometry><box size=".1 .1 .1"/></geometry></visual></link>'
    path.write_text(
        f'<robot name="slide">{link.format("a")}{link.format("b")}'
        '<joint name="rail" type="prismatic"><parent link="a"/><child link="b"/>'
        '<axis xyz="1 0 0"/><limit lower="0" upper="1"/></joint></robot>'
    )
    sheet = drawing_sheet(path, views="front", scale="1:10", joints={"rail": 0.2})
    assert extent(lines_of(sheet, "front")["outline"])[0] == pytest.approx(30.0, abs=2e-3)
    with pytest.raises(e3d.Engine3DError, match="rail"):
        drawing_sheet(path, joints={"rial": 0.2})


@pytest.mark.parametrize(("section", "told"), [("x=0.51", 1), ("-z=-7", 1), ("x=0.5", 0), ("y", 0)])
def test_a_section_that_misses_the_model_is_named(section, told):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        drawing_sheet(e3d.box(1.0), sections=section)
    axis = section.strip("-")[0]
    assert len(caught) == told
    assert all(f"cuts nothing: {axis} is -0.5 to 0.5" in str(one.message) for one in caught)


@pytest.mark.parametrize(("wrong", "meant"), [("frnt", "front"), ("botom", "bottom"), ("i", None)])
def test_a_misspelt_view_suggests_the_nearest(wrong, meant):
    with pytest.raises(e3d.InvalidArgumentError, match="is none of front, right") as caught:
        drawing_sheet(e3d.box(1.0), views=wrong)
    assert str(caught.value).endswith(f"did you mean {meant}?" if meant else "NAME=DIRECTION")
