"""Pictures on sheets are those of `render` with the same camera, whatever is drawn."""

import io

import numpy as np
import pytest
from sheet.conftest import SIZE, part

import engine3d as e3d

VIEWS = "front,iso"


def coloured():
    mesh = e3d.torus()
    mesh.materials = [e3d.Material(color=(90, 160, 40), metallic=0.2, roughness=0.5)]
    return mesh


def scene():
    made = e3d.Scene()
    made.add(coloured(), translation=(1, 0, 0))
    made.add(e3d.box(), rotation=(0, 0.2, 0, 1))
    return made


def lit():
    made = scene()
    made.add(e3d.DirectionalLight((-1, -2, -1)))
    return made


def saved(kind, folder):
    path = folder / f"thing.{kind}"
    if kind == "e3d.json":
        e3d.save_scene(lit(), path)
    else:
        coloured().save(path)
    return path


def open_file(folder):
    return io.BytesIO(saved("ply", folder).read_bytes())


def points(folder):
    return np.random.default_rng(1).normal(size=(60, 3))


POSES = np.array([(0, 0, 0, 1), (2, 0, 0, 0.5)], np.float32)
THINGS = {
    "obj": lambda folder: saved("obj", folder),
    "glb": lambda folder: str(saved("glb", folder)),
    "stl": lambda folder: saved("stl", folder),
    "scene file": lambda folder: saved("e3d.json", folder),
    "mesh": lambda folder: coloured(),
    "scene": lambda folder: scene(),
    "lit scene": lambda folder: lit(),
    "node": lambda folder: scene().nodes[0],
    "instances": lambda folder: e3d.InstancedMesh(e3d.box(), POSES),
    "points": points,
    "trimesh": lambda folder: pytest.importorskip("trimesh").creation.box((1, 2, 3)),
}


def same_as_rendered(sheet, thing, view="iso", **options):
    frame = sheet.frame(view)
    size = frame.width, frame.height
    drawn = e3d.render(thing, sheet.camera(view), size=size, **options)
    assert np.array_equal(frame.color, drawn.color)


@pytest.mark.parametrize("name", THINGS)
def test_a_picture_is_that_of_render(name, tmp_path):
    thing = THINGS[name](tmp_path)
    sheet = e3d.sheets.contact_sheet(thing, views=VIEWS, size=SIZE)
    same_as_rendered(sheet, thing)
    left, top, width, height = sheet.report["models"][0]["views"][1]["rectangle"]
    panel = np.asarray(sheet)[top : top + height, left : left + width]
    inner = np.s_[height // 3 : 2 * height // 3, width // 3 : 2 * width // 3]
    assert np.array_equal(panel[inner], sheet.frame("iso").color[inner])


def test_file_objects_are_models(tmp_path):
    from_memory = e3d.sheets.contact_sheet(open_file(tmp_path), views=VIEWS, size=SIZE)
    same_as_rendered(from_memory, saved("ply", tmp_path))


@pytest.mark.parametrize(
    "options",
    [
        {"look": "plain"},
        {"look": e3d.Look.studio(ground=False, background="dark")},
        {"material": e3d.Material(color=(200, 30, 30))},
        {"color_by": "y", "colormap": "plasma", "clim": (-0.2, 0.2), "bar": True},
        {"color_by": "normals", "axes_grid": True},
    ],
)
def test_looks_materials_and_numbers_are_those_of_render(options):
    for thing in (coloured(), scene()):
        sheet = e3d.sheets.contact_sheet(thing, views=VIEWS, size=SIZE, **options)
        same_as_rendered(sheet, thing, **options)


def test_drawings_show_materials_and_numbers():
    mesh = coloured()
    red = e3d.Material(color=(255, 0, 0))
    drawn = [
        e3d.sheets.contact_sheet(mesh, views="front", size=SIZE, **options).frame("front").color
        for options in ({}, {"material": red}, {"color_by": "y"}, {"color_by": "y", "clim": (5, 6)})
    ]
    assert len({picture.tobytes() for picture in drawn}) == 4
    assert mesh.materials[0].metallic == 0.2


def test_cameras_of_the_scene_give_pictures():
    thing = part()
    pose = e3d.look_at((6, 5, 8), (0, 1, 0))
    thing.add(e3d.PerspectiveCamera(0.6), pose=pose)
    sheet = e3d.sheets.contact_sheet(thing, views="camera0", size=SIZE)
    same_as_rendered(sheet, thing, "camera0")
    assert np.array_equal(sheet.camera("camera0")[1], pose)


def test_cameras_are_in_the_coordinates_of_the_file(tmp_path):
    shift = np.array((5.0e6, 4.0e6, 120.0))
    far = e3d.Mesh(e3d.box().positions.astype(float) + shift, e3d.box().faces)
    far.save(tmp_path / "far.ply")
    sheet = e3d.sheets.contact_sheet(tmp_path / "far.ply", views="iso", size=SIZE)
    assert np.abs(sheet.camera("iso")[1][:3, 3] - shift).max() < 20
    camera = e3d.frame_scene(tmp_path / "far.ply")
    assert np.abs(camera[1][:3, 3] - shift).max() < 20
    for one in (sheet.camera("iso"), camera):
        frame = e3d.render(tmp_path / "far.ply", one, size=(60, 60), outputs=("object_id",))
        assert (frame.object_id >= 0).mean() > 0.2


def test_what_is_no_model_and_no_keyword():
    with pytest.raises(e3d.InvalidArgumentError, match="models must be paths, scenes"):
        e3d.sheets.contact_sheet([3])
    with pytest.raises(TypeError, match="color_by"):
        e3d.sheets.contact_sheet(e3d.box(), colour_by="x")
    with pytest.raises(e3d.InvalidArgumentError, match="material must be"):
        e3d.sheets.contact_sheet(e3d.box(), material="red")
    sheet = e3d.sheets.contact_sheet(e3d.box(), views="front", size=SIZE)
    with pytest.raises(e3d.InvalidArgumentError, match="no view 'iso'"):
        sheet.frame("iso")
