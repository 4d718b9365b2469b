"""Cuts: their areas are exact, what is inside is filled, what is cut off does not show."""

import numpy as np
import pytest
from sheet.conftest import drawn, part, views_of

import engine3d as e3d


def cuts(scene, section, **options):
    view, _ = drawn(scene, views=(), sections=section, **options).report["models"][0]["views"]
    return view, {cut["name"]: cut for cut in view["cut"]}


def joined(*parts, name="solid"):
    mesh = e3d.Mesh.concatenate([p for p, _ in parts], poses=[pose for _, pose in parts])
    scene = e3d.Scene()
    scene.add(mesh, name=name)
    return scene


def at(x=0.0, y=0.0, z=0.0):
    return e3d.linalg.translation((x, y, z))


def turned_out(mesh):
    return e3d.Mesh(mesh.positions, mesh.faces[:, ::-1])


@pytest.mark.parametrize("section", ["x=0.25", "-x=0.25", "y=0.25", "-z=0.25", "z=62.5%"])
def test_the_area_of_a_box_is_exact(section):
    scene = e3d.Scene()
    scene.add(e3d.box((2, 4, 8)), name="box")
    view, found = cuts(scene, section)
    axis = "xyz".index(section.strip("-")[0])
    area = 64.0 / (2, 4, 8)[axis]
    assert found["box"]["area"] == area
    scale = view["camera"]["scale"]
    assert found["box"]["pixels"] == pytest.approx(area * scale**2, rel=0.05)
    assert view["pixels"] >= found["box"]["pixels"] * 0.98


def test_a_hollow_body_is_hollow():
    scene = joined((e3d.box((4, 4, 4)), at()), (turned_out(e3d.box((2, 2, 2))), at()))
    view, found = cuts(scene, "x=0.3")
    assert found["solid"]["area"] == 12.0
    sheet = drawn(scene, views=(), sections="x=0.3")
    panel, _ = sheet._panels[0]
    middle = sheet.project("section x=0.3", (0.3, 0, 0)) - view["rectangle"][:2]
    column, row = middle.astype(int)
    assert panel.caps.ids[row, column] == -1
    wall = sheet.project("section x=0.3", (0.3, 1.5, 0)) - view["rectangle"][:2]
    assert panel.caps.ids[int(wall[1]), int(wall[0])] == 0


def test_bodies_in_one_another_are_both_cut():
    _, found = cuts(part(), "z=0")
    assert found["base"]["area"] == 4.0
    assert found["inside"]["area"] == pytest.approx(0.09)
    assert found["base"]["pixels"] < 4.0 / 0.09 * found["inside"]["pixels"] * 1.2
    assert "post" not in found


def test_what_is_before_the_plane_is_gone():
    sheet = drawn(part(), views="front,back", sections=["z=-0.2", "-z=-0.2"])
    views = views_of(sheet)
    seen = {name: {n["name"] for n in view["nodes"]} for name, view in views.items()}
    assert "post" in seen["section z=-0.2"] and "post" not in seen["section -z=-0.2"]
    assert "ball" in seen["section -z=-0.2"]
    assert views["section z=-0.2"]["camera"]["scale"] == views["front"]["camera"]["scale"]


def test_a_body_that_is_inside_out_is_filled_as_well():
    scene = joined((turned_out(e3d.box((2, 2, 2))), at()))
    _, found = cuts(scene, "y=0.1")
    assert found["solid"]["area"] == 4.0 and found["solid"]["pixels"] > 1000


def test_an_open_body_has_no_area_but_is_filled():
    ball = e3d.uv_sphere(1.0, (24, 12))
    # Without what is right above.
    low = ball.positions[ball.faces][:, :, 1].max(axis=1) < 0.8
    scene = e3d.Scene()
    scene.add(e3d.Mesh(ball.positions, ball.faces[low]), name="bowl")
    _, found = cuts(scene, "x=0.1")
    assert found["bowl"]["area"] is None
    assert found["bowl"]["pixels"] > 1000


def test_a_surface_that_is_open_all_round_has_no_inside():
    scene = e3d.Scene()
    scene.add(e3d.plane((2, 2)), name="floor", rotation=(0.6, 0, 0, 0.8))
    _, found = cuts(scene, "x=0.1")
    assert found["floor"] == {"id": 0, "name": "floor", "pixels": 0, "area": None}


def test_a_pipe_without_ends_is_closed_by_straight_lines():
    pipe = e3d.cylinder(1.0, 6.0, 24)
    sides = np.abs(pipe.face_normals[:, 1]) < 0.5
    scene = e3d.Scene()
    scene.add(e3d.Mesh(pipe.positions, pipe.faces[sides]), name="pipe")
    view, found = cuts(scene, "z=0.2")
    assert found["pipe"]["area"] is None
    whole = 6.0 * 2.0 * np.sqrt(1.0 - 0.04) * view["camera"]["scale"] ** 2
    assert found["pipe"]["pixels"] == pytest.approx(whole, rel=0.05)


def test_instances_are_cut_one_by_one():
    scene = e3d.Scene()
    boxes = e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1), (2, 0.75, 0, 2), (4, 9, 0, 1)])
    scene.add(boxes, name="boxes")
    _, found = cuts(scene, "y=0.25")
    assert found["boxes"]["area"] == 5.0
    poses = np.array([np.eye(4), e3d.linalg.translation((2, 0, 0))])
    boxes.replace(poses)
    assert cuts(scene, "y=0.25")[1]["boxes"]["area"] == 2.0


def test_beside_the_model_nothing_is_cut():
    with pytest.warns(e3d.Engine3DWarning, match="section x=-50 cuts nothing: x is ") as told:
        view, found = cuts(part(), "x=-50")
    assert len(told) == 1
    assert found == {}
    assert (view["blank"], view["why"]) == (True, "behind_camera")


@pytest.mark.filterwarnings("ignore:section .* cuts nothing")
def test_a_plane_far_before_the_model_leaves_all_of_it():
    far, near, whole = (
        drawn(part(), views=views, sections=sections).report["models"][0]["views"]
        for views, sections in (((), "x=1e9"), ((), "x=2.001"), ("right,other=1,0,0", ()))
    )
    assert [view["box"] for view in far] == [view["box"] for view in near]
    assert [view["pixels"] for view in far] == [view["pixels"] for view in near]
    assert far[0]["extent"] == whole[0]["extent"] and far[0]["pixels"] > 1000


def test_a_plane_through_vertices_closes_all_outlines():
    ball = e3d.uv_sphere(1.0, (16, 8))
    scene = e3d.Scene()
    scene.add(ball, name="ball")
    for section in ("x=0", "y=0", "z=0"):
        _, found = cuts(scene, section)
        assert 2.7 < found["ball"]["area"] < 3.15


def test_cut_material_is_hatched():
    sheet = drawn(part(), views=(), sections="z=0")
    panel, _ = sheet._panels[0]
    colors = panel.frame.color[panel.caps.ids >= 0][:, :3]
    cut = (colors == (232, 164, 124)).all(axis=1).mean()
    assert 0.6 < cut < 0.95


def test_a_cutaway_shows_the_same_cut_from_aside():
    sheet = drawn(part(), views="iso", sections="x=-1")  # through the base alone
    _, section, cutaway = sheet.report["models"][0]["views"]
    assert (section["kind"], cutaway["kind"]) == ("section", "cutaway")
    assert [cut["area"] for cut in section["cut"]] == [cut["area"] for cut in cutaway["cut"]]
    direction = cutaway["camera"]["direction"]
    scale = cutaway["camera"]["scale"]
    seen = sum(cut["pixels"] for cut in cutaway["cut"]) / scale**2
    assert seen == pytest.approx(2.0 * abs(direction[0]), rel=0.03)


@pytest.mark.parametrize("section", ["x=0.8", "-x=0.8", "-y=0.4", "z=10%"])
@pytest.mark.parametrize("up", ["+Y", "-Z"])
def test_pixels_of_cuts_are_places_on_the_plane(section, up):
    sheet = drawn(part(), (480, 300), views=(), sections=section, up=up)
    tried = 0
    for panel, view in zip(sheet._panels[0], sheet.report["models"][0]["views"], strict=True):
        left, top, width, height = view["rectangle"]
        axis = "xyz".index(section.strip("-")[0])
        plane = sheet.report["models"][0]["bounds"]["low"][2] + 0.2 if "%" in section else None
        plane = float(section.partition("=")[2]) if plane is None else plane
        for x in range(left, left + width, 9):
            for y in range(top, top + height, 9):
                found = sheet.at(x, y)
                if "position" not in found:
                    continue
                tried += 1
                back = sheet.project(view["name"], found["position"])
                assert back == pytest.approx([x + 0.5, y + 0.5], abs=1e-6)
                place = found["position"][axis]
                if panel.caps.ids[y - top, x - left] >= 0:
                    assert place == pytest.approx(plane, abs=1e-6)
                    assert found["face_id"] == -1
                else:
                    beyond = place - plane if section[0] == "-" else plane - place
                    assert beyond > -1e-5
    assert tried > 100
