"""`render(color_by=…)` and the command's numbers: the same bytes, for each kind of elements."""

import warnings

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.errors import InvalidArgumentError
from engine3d.rendering.canvas import text_size
from engine3d.stage.overlays.colormaps import MISSING, SIZE, colormap
from engine3d.stage.overlays.numbers import take_marks
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_thing import viewed_thing

PICTURE = (160, 120)


def ball():
    mesh = e3d.uv_sphere(1, (16, 8))
    mesh.values["heat"] = mesh.positions[:, 1] ** 2 + mesh.positions[:, 0]
    mesh.values["wind"] = mesh.positions[:, :3] * (1, 2, 3)
    faces = np.random.default_rng(1).normal(size=len(mesh.faces))
    faces[::5] = np.nan
    mesh.values["load"] = faces
    mesh.values["flow"] = np.stack([faces, -faces], axis=1)
    return mesh


def cloud():
    positions = np.random.default_rng(2).normal(size=(300, 3))
    mesh = e3d.Mesh(positions, points=np.arange(300)[::-1])
    mesh.values["heat"] = e3d.Values(positions[::-1, 0], on="points")
    return mesh


def drawn(thing, **options):
    return e3d.render(thing, look="plain", mode="unlit", samples=1, size=PICTURE, **options)


@pytest.mark.parametrize("format", ["ply", "glb"])
@pytest.mark.parametrize(
    ("model", "said", "keywords"),
    [
        (ball, ["--coloring-array", "heat"], {"color_by": "heat"}),
        (ball, ["--coloring-array", "load"], {"color_by": "load"}),
        (ball, ["-c", "-y", "1"], {"on": "faces", "component": 1}),
        (ball, ["-s"], {}),
        (ball, ["--coloring-array", "wind"], {"color_by": "wind", "component": -1}),
        (ball, ["--coloring-array", "wind", "-y", "2"], {"color_by": "wind", "component": 2}),
        (ball, ["--coloring-array", "z", "--axes-grid"], {"color_by": "z", "axes_grid": True}),
        (ball, ["--coloring-array", "normals", "-y", "0"], {"color_by": "normals", "component": 0}),
        (
            ball,
            ["--coloring-array", "heat", "--colormap", "turbo", "--range", "0,0.5", "-e"],
            {"color_by": "heat", "colormap": "turbo", "clim": (0, 0.5), "edges": True},
        ),
        (cloud, ["--coloring-array", "heat"], {"color_by": "heat"}),
    ],
)
def test_the_command_draws_the_same_bytes(tmp_path, format, model, said, keywords):
    if format == "glb" and "--axes-grid" in said:
        pytest.skip("the file says that its numbers are metres, a mesh does not")
    mesh = model()
    lacking = format == "glb" and ("load" in said or "-c" in said)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what the format cannot hold
        mesh.save(tmp_path / f"model.{format}")
    command = ["render", str(tmp_path / f"model.{format}"), "-o", str(tmp_path / "command.png")]
    command += ["--look", "plain", "--unlit", "--samples", "1", "--size", "160x120"]
    command += ["--bar", "--point-size", "3", "-q", *said]
    assert main(command) == (1 if lacking else 0)
    loaded = e3d.load_mesh(tmp_path / f"model.{format}")
    if lacking:
        with pytest.raises(InvalidArgumentError, match="no values"):
            drawn(loaded, bar=True, **keywords)
        return
    drawn(loaded, bar=True, point_size=3, **keywords).save(tmp_path / "api.png")
    pictures = [Image.open(tmp_path / f"{name}.png").convert("RGB") for name in ("command", "api")]
    assert np.array_equal(*map(np.asarray, pictures))


@pytest.mark.parametrize("on", ["vertices", "faces", "points"])
def test_arrays(on):
    mesh = ball() if on != "points" else cloud()
    count = len(mesh.positions if on == "vertices" else getattr(mesh, on))
    array = np.linspace(3, 7, count)
    mesh.values["t"] = e3d.Values(array, on=on)
    named = drawn(mesh, color_by="t")
    before = mesh.version, mesh.materials[0], mesh.colors
    for given in ({"color_by": e3d.Values(array, on=on)}, {"color_by": array, "on": on}):
        assert np.array_equal(drawn(mesh, **given).color, named.color)
    assert (mesh.version, mesh.materials[0], mesh.colors) == before  # it is left alone
    assert not np.array_equal(drawn(mesh).color, named.color)


def test_the_title_of_a_series():
    class Series(np.ndarray):
        name = "heat"

    array = np.arange(len(ball().positions), dtype=float).view(Series)
    named = ball()
    named.values["heat"] = array
    same = drawn(ball(), color_by=array, bar=True), drawn(named, color_by="heat", bar=True)
    assert np.array_equal(same[0].color, same[1].color)


def test_where_there_is_no_number():
    square = e3d.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    outputs = ("color", "face_id")
    numbers = e3d.Values([np.nan, 1.0], on="faces")
    frame = drawn(square, color_by=numbers, clim=(0, 1), outputs=outputs)
    seen = {tuple(color) for color in frame.color[frame.face_id >= 0][:, :3].tolist()}
    assert seen == {MISSING, tuple(colormap("viridis")[-1].tolist())}


def test_colour_maps():
    table = np.linspace(0, 255, 3 * SIZE).astype(np.uint8).reshape(SIZE, 3)
    assert (colormap(table) == table).all()
    assert (colormap(table / 255) == table).all()
    assert colormap(["navy", "#f80", "White"]).tolist() == [[0, 0, 128], [255, 136, 0], [255] * 3]
    assert (colormap(lambda places: np.stack([places] * 4, axis=1))[[0, -1]] == [[0], [255]]).all()
    for wrong in (np.zeros(3), np.zeros((1, 3)), np.full((4, 3), 2.0), np.zeros((4, 3), int)):
        with pytest.raises(InvalidArgumentError, match="colormap"):
            colormap(wrong)


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"color_by": "cold"}, "no values 'cold'; this mesh has .*'heat', 'load', 'wind', 'x'"),
        ({"color_by": "heat", "on": "faces"}, "no values 'heat' of faces; this mesh has 'flow'"),
        ({"color_by": "heat", "component": 1}, "have no component 1: the last is 0"),
        ({"color_by": [1, 2]}, "values 'color_by' has 2 rows for"),
        ({"color_by": "heat", "clim": (1, 1)}, "clim must be two finite numbers"),
        ({"color_by": "heat", "clim": 3}, "clim must be two numbers"),
        ({"color_by": "heat", "component": -3}, "component must be a whole number"),
        (
            {"color_by": "heat", "colormap": "jet"},
            "colormap 'jet' is neither a picture nor one of virid",
        ),
        ({"color_by": "heat", "bar": "yes"}, "bar must be"),
    ],
)
def test_what_is_refused(keywords, said):
    with pytest.raises(InvalidArgumentError, match=said):
        drawn(ball(), **keywords)


def test_an_array_colours_one_mesh_only():
    scene = e3d.Scene()
    for _ in range(2):
        scene.add(ball())
    with pytest.raises(InvalidArgumentError, match="one mesh, not 2"):
        e3d.render(scene, size=PICTURE, color_by=[1.0])
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'colourmap'.*colormap"):
        e3d.render(scene, size=PICTURE, colourmap="gray")


def test_what_show_draws():
    marks = take_marks({"color_by": "load", "bar": True})
    viewed = viewed_thing(ball(), title=None, up="+Y", update=None, period=1.0, marks=marks)
    settings = Settings({"mode": "unlit"}, bar=marks.bar)
    with ViewRenderer(viewed, settings, PICTURE) as view_renderer:
        view = view_renderer.view()
        view_renderer.fill(view)
        frame = view_renderer.draw(view)
        expected = drawn(ball(), color_by="load", bar=True)
        assert np.array_equal(frame.color, expected.color)
        view_renderer.visibility.toggle_material(0)  # nothing is left
        assert (view_renderer.draw(view, outputs=("color", "object_id")).object_id == -1).all()


def test_letters_beside_a_small_picture_with_a_bar_are_whole(monkeypatch):
    """The names of the axes stay in the picture, and the bar covers no letter."""
    ring, written, text = e3d.torus(1.0, 0.4), {}, e3d.Canvas.text
    ring.values["height"] = ring.positions[:, 1] * 1234.5

    def note(canvas, x, y, what, *more, **options):
        written[what] = x, y
        text(canvas, x, y, what, *more, **options)

    monkeypatch.setattr(e3d.Canvas, "text", note)
    e3d.render(ring, size=(200, 150), color_by="height", bar=True, axes_grid=True)
    (left, _), (_, top), (_, numbers) = written["Y"], written["X"], written["1000"]
    colors = numbers - 12  # in the block of the bar, above its numbers
    assert left >= 0 and top + text_size("X")[1] < colors


def test_no_numbers_color_nothing():
    for numbers in ([], np.zeros((0, 2))):
        with pytest.raises(e3d.InvalidArgumentError, match="0 rows for 24 vertices, 12 faces"):
            e3d.render(e3d.box(), color_by=numbers, size=(16, 16))
        empty = e3d.Mesh(np.zeros((0, 3)))
        with pytest.warns(e3d.Engine3DWarning, match="nothing shows"):
            e3d.render(empty, color_by=numbers, size=(16, 16))
