"""Colours that stand for numbers, the bar beside them, and the grid with numbers around a model."""

import base64
import json

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.errors import InvalidArgumentError
from engine3d.loaders import load_document
from engine3d.rendering.canvas import Canvas
from engine3d.stage.coloring import ScalarBar
from engine3d.stage.open_model import open_model
from engine3d.stage.open_models import open_models
from engine3d.stage.overlays.axes_grid import AxesGrid
from engine3d.stage.overlays.colormaps import COLORMAPS, MISSING, colormap
from engine3d.stage.overlays.numbers import Numbers
from engine3d.stage.overlays.scalar_bar import draw_scalar_bar, place_bar
from engine3d.stage.overlays.ticks import label, ticks
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

GRAY = colormap("gray")
SIZE = (160, 120)


@pytest.fixture(scope="module")
def heat(tmp_path_factory):
    """A square from x = 0 to 2 whose heat goes from 10 to 30; a corner behind it has none."""
    path = tmp_path_factory.mktemp("heat") / "heat.ply"
    rows = ["0 0 0 10 1", "2 0 0 30 2", "2 2 0 30 3", "0 2 0 10 4", "0 0 -1 nan 5"]
    head = ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "heat", "label")]
    head += ["element face 3", "property list uchar int vertex_indices", "end_header"]
    path.write_text("\n".join([*head, *rows, "3 0 1 2", "3 0 2 3", "3 0 4 1"]) + "\n")
    return path


@pytest.fixture(scope="module")
def wind(tmp_path_factory):
    """A glTF file of a square from x = 0 to 2, and of another mesh that lacks an attribute."""
    arrays = {
        "POSITION": np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], np.float32),
        "_WIND": np.array([(0, 0, 0), (3, -4, 0), (3, -4, 0), (0, 0, 1)], np.float32),
        "_HEAT": np.array([-7, 1, 1, 2], np.float32),
        "_ID": np.array([(1 << 24) + 1, 1, 2, 3], np.uint32),
        "_SHARE": np.array([0, 255, 255, 0], np.uint8),
        "_MATRIX": np.zeros((4, 9), np.float32),
    }
    data, views, accessors = b"", [], []
    types = {1: "SCALAR", 3: "VEC3", 9: "MAT3"}
    kinds = {"float32": 5126, "uint32": 5125, "uint8": 5121}
    for array in (*arrays.values(), np.array([0, 1, 2, 0, 2, 3], np.uint32)):
        size = array.dtype.itemsize * array.size
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": size})
        width = 1 if array.ndim == 1 else array.shape[1]
        accessor = {"bufferView": len(accessors), "componentType": kinds[array.dtype.name]}
        accessor |= {"count": len(array), "type": types[width]}
        if array.dtype == np.uint8:
            accessor["normalized"] = True
        if len(accessors) == 0:
            accessor |= {"min": [0, 0, 0], "max": [2, 2, 0]}
        accessors.append(accessor)
        data += array.tobytes()
    named = {name: number for number, name in enumerate(arrays)}
    fewer = {name: named[name] for name in ("POSITION", "_HEAT")}
    indices = len(arrays)
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 1, "translation": [0, 0, -1]}],
        "meshes": [
            {"primitives": [{"attributes": named, "indices": indices}]},
            {"primitives": [{"attributes": fewer, "indices": indices}]},
        ],
        "buffers": [
            {
                "byteLength": len(data),
                "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode(),
            }
        ],
        "bufferViews": views,
        "accessors": accessors,
    }
    path = tmp_path_factory.mktemp("wind") / "wind.gltf"
    path.write_text(json.dumps(tree))
    return path


def by(colors, name=None, clim=None, component=-1, by_faces=False):
    return Numbers(name, colors, clim, component, "faces" if by_faces else None)


def shown(path, numbers, **settings):
    viewed = open_model(path, numbers=numbers)
    look = {"mode": "unlit"}
    with ViewRenderer(viewed, Settings(look, **settings), SIZE) as view_renderer:
        view = view_renderer.view()
        view.look_from((1.0, 1.0, 4.0), (1.0, 1.0, 0.0))
        frame = view_renderer.draw(view)
        return viewed, frame


def at(frame, *point):
    """The grey level at a place of the model."""
    x, y = np.floor(frame.project(point)[0]).astype(int)
    return int(frame.color[y, x, 0])


def test_numbers_are_interpolated_not_colours(heat):
    steps = np.array([(0, 0, 0)] * 128 + [(255, 255, 255)] * 128, np.uint8)
    viewed, frame = shown(heat, by(steps, "heat"))
    assert (viewed.bar.title, viewed.bar.low, viewed.bar.high) == ("heat", 10, 30)
    assert at(frame, 0.9, 1.2, 0) == 0 and at(frame, 1.1, 1.2, 0) == 255
    _, frame = shown(heat, by(GRAY, "heat"))
    for x in (0.25, 1.0, 1.75):
        assert abs(at(frame, x, 1.2, 0) - 255 * x / 2) <= 3
    _, frame = shown(heat, by(GRAY, "heat", (0.0, 20.0)))
    assert abs(at(frame, 0.5, 1.2, 0) - 191) <= 3 and at(frame, 1.5, 1.2, 0) == 255


def test_which_number_it_is(heat):
    assert shown(heat, by(GRAY))[0].bar.title == "heat"  # the first of them
    assert shown(heat, by(GRAY, "label"))[0].bar[1:3] == (1, 5)
    viewed, frame = shown(heat, by(GRAY, "y"))
    assert viewed.bar[:3] == ("y", 0, 2)
    assert abs(at(frame, 1, 0.5, 0) - 64) <= 3
    with pytest.raises(InvalidArgumentError, match=r"heat\.ply: no values 'cold'; .* has 'heat'"):
        open_model(heat, numbers=by(GRAY, "cold"))


def test_documents_have_the_numbers(heat):
    (entry,) = load_document(heat).objects
    assert list(entry.mesh.values) == ["heat", "label"]
    assert entry.mesh.values["label"].tolist() == [1, 2, 3, 4, 5]
    document = load_document(heat, values=False)
    assert document.objects[0].mesh.values == {} and document.arrays["vertices"]


def test_which_component_it_is(wind):
    bars = {
        number: open_model(wind, numbers=by(GRAY, "_WIND", component=number)).bar
        for number in (-1, 0, 1, 2)
    }
    assert [bar.title for bar in bars.values()] == ["|_WIND|", "_WIND[0]", "_WIND[1]", "_WIND[2]"]
    assert [bar[1:3] for bar in bars.values()] == [(0, 5), (0, 3), (-4, 0), (0, 1)]
    with pytest.raises(InvalidArgumentError, match="'_WIND' have no component 3: the last is 2"):
        open_model(wind, numbers=by(GRAY, "_WIND", component=3))
    # Of single numbers there is no length: negative ones stay.
    assert open_model(wind, numbers=by(GRAY, "_HEAT")).bar[:3] == ("_HEAT", -7, 2)
    viewed, frame = shown(wind, by(GRAY, "_WIND", component=1))
    assert abs(at(frame, 1.0, 1.2, 0) - 255 / 2) <= 3


def test_attributes_of_gltf_files(wind):
    first, second = (entry.mesh.values for entry in load_document(wind).objects)
    # Whole numbers stay such, those that stand for shares become shares.
    assert first["_ID"].tolist() == [16777217, 1, 2, 3] and "_MATRIX" not in first
    assert first["_SHARE"].tolist() == [0, 1, 1, 0]
    assert set(first) == {"_HEAT", "_ID", "_SHARE", "_WIND"} and set(second) == {"_HEAT"}
    assert open_model(wind, numbers=by(GRAY)).bar.title == "_HEAT"
    whole = e3d.load_mesh(wind).values  # of both: the second lacks all but one
    assert set(whole) == set(first) and whole["_HEAT"].tolist() == [-7, 1, 1, 2] * 2
    assert np.isnan(whole["_WIND"][4:]).all() and whole["_WIND"][:4].tolist()[1] == [3, -4, 0]


def test_numbers_that_are_colours(wind):
    viewed, frame = shown(wind, by(GRAY, "_SHARE", component=-2))
    assert viewed.bar is None
    assert at(frame, 0.01, 1.2, 0) < 50 and at(frame, 1.99, 1.2, 0) > 250
    viewed = open_model(wind, numbers=by(GRAY, "_ID", component=-2))
    mesh = next(node.object for node in viewed.scene.nodes if isinstance(node.object, e3d.Mesh))
    assert mesh.colors.tolist() == [[level] * 3 + [255] for level in (255, 1, 2, 3)]


def test_numbers_of_faces(tmp_path):
    path = tmp_path / "faces.ply"
    head = ["ply", "format ascii 1.0", "element vertex 6"]
    head += [f"property float {name}" for name in "xyz"]
    head += ["property list uchar float flow", "element face 2"]
    head += ["property list uchar int vertex_indices", "property int group", "property uchar red"]
    head += ["property uchar green", "property uchar blue", "property list uchar float force"]
    vertices = [f"{x} {y} 0 2 {x} {y}" for y in (0, 2) for x in (0, 1, 2)]
    faces = ["4 0 1 4 3 7 9 9 9 3 0 3 4", "4 1 2 5 4 -1 9 9 9 3 0 0 1"]
    path.write_text("\n".join([*head, "end_header", *vertices, *faces]) + "\n")
    viewed, frame = shown(path, by(GRAY, by_faces=True))
    assert viewed.bar[:3] == ("|force|", 1, 5)  # the first in alphabetical order
    viewed, frame = shown(path, by(GRAY, "group", by_faces=True))
    assert viewed.bar[:3] == ("group", -1, 7)
    assert [at(frame, x, 1, 0) for x in (0.1, 0.9, 1.1, 1.9)] == [255, 255, 0, 0]
    assert open_model(path, numbers=by(GRAY, "flow", component=1)).bar.high == 2
    for name, said in (("x", "'x' of faces; this mesh has 'force', 'g"), ("flow", "'flow' of")):
        with pytest.raises(InvalidArgumentError, match=f"no values {said}"):
            open_model(path, numbers=by(GRAY, name, by_faces=True))


def test_info_names_the_arrays(wind, heat, capsys):
    assert main(["info", str(wind), "--json"]) == 0
    names = ["_HEAT", "_ID", "_MATRIX", "_SHARE", "_WIND"]
    assert json.loads(capsys.readouterr().out)["arrays"] == {"vertices": names}
    assert main(["info", str(heat)]) == 0
    assert "\narrays of vertices: heat, label\n" in capsys.readouterr().out


def test_faces_without_numbers(heat):
    with pytest.raises(InvalidArgumentError, match="no values of faces; this mesh has none"):
        open_model(heat, numbers=by(GRAY, by_faces=True))


def test_normals_are_turned_with_their_mesh(tmp_path):
    scene, mesh = e3d.Scene(), e3d.Mesh([(0, 0, 0), (1, -1, 0), (1, -1, 1)], [(0, 1, 2)])
    scene.add(mesh, scale=(1.0, 2.0, 1.0))  # the normal is that of (1, -2, 0), not twice as high
    e3d.save_scene(scene, tmp_path / "plane.glb")
    for component, expected in ((0, 2 / 5**0.5), (1, 1 / 5**0.5), (2, 0.0)):
        coloring = by(GRAY, "normals", component=component)
        bar = open_model(tmp_path / "plane.glb", numbers=coloring).bar
        assert bar.title == f"normals[{component}]"
        assert abs(bar.low + bar.high) / 2 == pytest.approx(expected, abs=1e-6)


def test_several_models_share_a_range(heat, tmp_path):
    other = tmp_path / "other.ply"
    other.write_text(heat.read_text().replace("0 0 0 10 1", "0 0 0 -30 1"))
    with open(heat, "rb") as file:  # which can be read once only
        viewed = open_models([file, other], numbers=by(GRAY, "heat"))
    assert viewed.bar[:3] == ("heat", -30, 30)
    meshes = [node.object for node in viewed.scene.nodes if isinstance(node.object, e3d.Mesh)]
    first, second = (mesh.uvs[mesh.positions[:, 0] == 2, 0].tolist() for mesh in meshes)
    assert first == second
    assert viewed.appearance["tone_mapping"] == "none"


def test_what_has_no_number_is_grey(heat):
    mesh = next(
        node.object
        for node in open_model(heat, numbers=by(GRAY, "heat")).scene.nodes
        if isinstance(node.object, e3d.Mesh)
    )
    missing = mesh.positions[:, 2] == -1
    assert mesh.uvs[:, 1].tolist() == np.where(missing, 0.75, 0.25).tolist()
    assert (mesh.materials[0].texture.pixels[0, :, :3] == MISSING).all()


def test_clouds_and_models_without_numbers(tmp_path):
    cloud = e3d.Mesh([(0, 0, 0), (0, 0, 4), (0, 0, 2)], points=[0, 1, 2])
    e3d.save_mesh(cloud, tmp_path / "cloud.ply")
    viewed = open_model(tmp_path / "cloud.ply", numbers=by(GRAY, "z"))
    mesh = next(node.object for node in viewed.scene.nodes if isinstance(node.object, e3d.Mesh))
    assert mesh.colors[:, 0].tolist() == [0, 255, 128]
    e3d.save_mesh(e3d.box(2.0), tmp_path / "box.glb")
    viewed = open_model(tmp_path / "box.glb", numbers=by(GRAY))
    assert viewed.bar[:3] == ("y [m]", -1, 1)  # how high it is
    e3d.save_mesh(e3d.plane(), tmp_path / "flat.obj")
    viewed = open_model(tmp_path / "flat.obj", numbers=by(GRAY))
    assert viewed.bar[1:3] == (-0.5, 0.5)  # one number for all is in the middle


def test_colour_maps(tmp_path):
    for name in COLORMAPS:
        table = colormap(name)
        assert table.shape == (256, 3) and len(np.unique(table, axis=0)) > 200
    assert colormap("viridis")[[0, -1]].tolist() == [[0x44, 1, 0x54], [0xFD, 0xE7, 0x25]]
    Image.new("RGB", (3, 5), (1, 2, 3)).save(tmp_path / "map.png")
    assert colormap(str(tmp_path / "map.png")).tolist() == [[1, 2, 3]] * 3
    table = colormap("0,#000000,0.5,rgb(200,0,100),1,white")
    assert table[[0, -1]].tolist() == [[0, 0, 0], [255, 255, 255]]
    assert np.abs(table[128].astype(int) - (200, 0, 100)).max() <= 1
    assert (colormap("0, 0,0,0, 1, 1,0.5,0")[-1] == [255, 128, 0]).all()
    for wrong in (
        "0,red",
        "0,red,1",
        "1,red,0,blue",
        "0,red,2,blue",
        "0,rot,1,blue",
        "a,red,1,red",
    ):
        with pytest.raises(InvalidArgumentError):
            colormap(wrong)
    with pytest.raises(InvalidArgumentError, match="'jet' is neither a picture nor one of virid"):
        colormap("jet")


TITLE = "temperature at the surface"


def test_a_bar_has_more_than_one_number():
    assert place_bar(320, 160, ScalarBar("x", -3.1, 3.4, GRAY)).labels == ["-2", "0", "2"]


@pytest.mark.parametrize("size", [(300, 300), (90, 130)])
def test_the_bar_has_all_colours_from_bottom_to_top_or_from_left_to_right(size):
    canvas = Canvas(size)
    bar = ScalarBar("heat", 0.0, 1.0, GRAY)
    draw_scalar_bar(canvas, bar)
    place = place_bar(*size, bar)
    assert place.upright == (size[0] == 300)
    block = canvas.pixels[place.top :, place.left :, 0].astype(int)
    lines = block.T if place.upright else block
    line = next(line for line in lines if len(np.unique(line)) > 60)
    levels = line[line.argmax() :] if place.upright else line[line.argmax() :: -1]
    levels = levels[: place.length]
    assert (np.diff(levels) <= 0).all() and (levels[0], levels[-1]) == (255, 0)


@pytest.mark.parametrize("title", ["y", TITLE])
@pytest.mark.parametrize("turns", [False, True])
@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("size", [(64, 48), (128, 96), (320, 240), (300, 700)])
def test_the_model_is_beside_the_bar(tmp_path, size, orthographic, turns, title):
    e3d.save_mesh(e3d.box((2.0, 1.0, 1.5)), tmp_path / "box.obj")
    viewed = open_model(tmp_path / "box.obj", numbers=by(GRAY))
    viewed.bar = viewed.bar._replace(title=title)
    place = place_bar(*size, viewed.bar)
    look = {"mode": "unlit"}
    with ViewRenderer(viewed, Settings(look, bar=True), size) as view_renderer:
        view = view_renderer.view()
        view.orthographic = orthographic
        (view_renderer.frame if turns else view_renderer.fill)(view)
        shown = view_renderer.draw(view, outputs=("color", "depth")).depth > 0
    rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    right, bottom = (place.left, size[1]) if place.upright else (size[0], place.top)
    assert columns[0] > 0 and columns[-1] < right and rows[0] > 0 and rows[-1] < bottom
    if not turns:
        # It fills what is left, and has as much room on one side as on the other.
        share = max(np.ptp(columns) / right, np.ptp(rows) / bottom)
        assert share > 0.85
        assert abs(columns[0] - (right - 1 - columns[-1])) <= 3
        assert abs(rows[0] - (bottom - 1 - rows[-1])) <= 3


@pytest.mark.parametrize(
    "size", [(1, 1), (16, 16), (40, 400), (400, 40), (1024, 768), (3000, 2000)]
)
@pytest.mark.parametrize("ends", [(0.0, 1.0), (-1234567.0, 8e6), (1e-12, 3e-12)])
def test_the_bar_takes_a_part_of_the_picture(size, ends):
    width, height = size
    for title in ("", TITLE, "x" * 600):
        bar = ScalarBar(title, *ends, GRAY)
        place = place_bar(width, height, bar)
        draw_scalar_bar(Canvas((width, height)), bar)
        taken = place.taken(width, height)
        if min(size) >= 40:
            assert taken.right <= 0.25 and taken.bottom <= 0.4
            assert place.top >= 0 and place.left >= 0
        if min(size) >= 700:
            assert place.labels and bool(place.title) == (0 < len(title) < 600)


@pytest.mark.parametrize(
    ("low", "high", "most", "expected"),
    [
        (0.0, 1.0, 5, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        (-3.0, 7.0, 5, [-2.0, 0.0, 2.0, 4.0, 6.0]),
        (1.0, 1.0, 5, [1.0, 1.0]),
        (0.0, 1e-300, 5, [0.0, 2e-301, 4e-301, 6e-301, 8e-301, 1e-300]),
    ],
)
def test_round_numbers(low, high, most, expected):
    assert np.allclose(ticks(low, high, most), expected, rtol=1e-9, atol=0)


def test_labels_tell_neighbours_apart():
    assert [label(value, 200.0) for value in (0.0, 4_600_200.0)] == ["0", "4600200"]
    assert [label(value, 0.05) for value in (-0.05, 1.0)] == ["-0.05", "1.00"]
    assert label(3e-7, 1e-7) == "3e-07" and label(1.25e12, 1e10) == "1.25e+12"


def test_the_grid_is_behind_the_model():
    grid = AxesGrid(np.array([0.0, 0, 0]), np.array([4.0, 2, 1]), np.array([100.0, 0, 0]), "mm")
    assert grid.numbers(0) == [100, 101, 102, 103, 104]
    far = grid.far_sides(np.array([1.0, -1.0, 1.0]))
    assert far == (False, True, False)
    mesh = grid.lines(far)
    ends = mesh.positions[mesh.lines]
    sides = [(ends[:, :, axis] == value).all(axis=1) for axis, value in ((0, 0), (1, 2), (2, 0))]
    assert np.any(sides, axis=0).all()
    assert set(ends[..., 0].ravel().tolist()) == {0, 1, 2, 3, 4}


def test_the_grid_shows_moves_and_goes(heat):
    viewed = open_model(heat)
    with ViewRenderer(viewed, Settings({}, axes_grid=True), SIZE) as view_renderer:
        pictures = []
        view = view_renderer.view()
        for azimuth in (0.5, 2.5):
            view.azimuth = azimuth
            view_renderer.fill(view)
            pictures.append([])
            for shown_now in (True, False):
                view_renderer.settings.axes_grid = shown_now
                pictures[-1].append(view_renderer.draw(view).color.copy())
        for with_grid, without in pictures:
            assert (with_grid != without).any(axis=-1).sum() > 300
        beside = view_renderer.staging.scene.beside
        assert len([node for node in beside.nodes if node.name == "axes grid"]) == 1
    assert not [node for node in viewed.scene.nodes if node.name == "axes grid"]


def test_on_the_command_line(heat, capsys):
    path = heat.with_name("out.png")
    command = ["render", str(heat), "--size", "200x150", "-o", str(path)]
    seen = set()
    for options in ([], ["-s"], ["-b"], ["--coloring-range", "-5,50"], ["--colormap", "turbo"]):
        assert main([*command, *options]) == 0
        seen.add(path.read_bytes())
    assert len(seen) == 5
    assert main([*command, "-y", "0"]) == 0  # of single numbers, the only one
    assert path.read_bytes() in seen
    assert main([*command, "-y", "-3"]) == 2
    assert main([*command, "-c"]) == 1
    assert "heat.ply: no values of faces; this mesh has none" in capsys.readouterr().err
    assert main([*command, "--coloring-array", "cold"]) == 1
    assert main([*command, "--colormap", "jet"]) == 1
    assert main([*command, "--range", "2,1"]) == 2
    assert "the first number is the lower one" in capsys.readouterr().err
    assert main(["render", "--scene", "cube", "-b", "-o", str(path)]) == 2
    assert "--bar needs a MODEL" in capsys.readouterr().err


def test_numbers_of_the_grid_do_not_overlap(tmp_path, monkeypatch):
    e3d.save_mesh(e3d.box((2.0, 2.0, 0.02)), tmp_path / "plate.obj")
    written = []
    monkeypatch.setattr(
        Canvas, "text", lambda self, x, y, *texts, **_: written.append((x, y, *texts))
    )
    with ViewRenderer(
        open_model(tmp_path / "plate.obj"), Settings({}, axes_grid=True), (400, 300)
    ) as view_renderer:
        view = view_renderer.view()
        view_renderer.fill(view)
        view_renderer.draw(view)
    boxes = [(x, y, x + 8 * len(text), y + 14) for x, y, text, *_ in written]
    assert {"X", "Y", "-1.0", "0.5"} <= {text for _, _, text, *_ in written}
    for number, a in enumerate(boxes):
        for b in boxes[:number]:  # rounded to whole pixels, they may touch
            assert not (a[0] + 1 < b[2] and b[0] + 1 < a[2] and a[1] + 1 < b[3] and b[1] + 1 < a[3])


@pytest.mark.parametrize("scale", [1, 1.25, 2])
def test_numbers_of_the_grid_are_not_cut_by_the_picture_s_edge(heat, scale, monkeypatch):
    written, write = [], Canvas.text

    def text(canvas, x, y, string, color, **options):
        width, height = options["font"].text_size(string)
        written.append((x, y, x + width, y + height))
        return write(canvas, x, y, string, color, **options)

    monkeypatch.setattr(Canvas, "text", text)
    width, height = 400, 300
    settings = Settings({}, axes_grid=True, ui_scale=scale)
    with ViewRenderer(open_model(heat), settings, (width, height)) as view_renderer:
        for closer in (1.0, 1.3, 1.7, 2.3):
            for aside in (-0.8, 0.0, 0.6):
                view = view_renderer.view()
                view.distance /= closer
                view.target = view.target + aside * np.array([1.0, 0.7, 0.0])
                view_renderer.draw(view)
    corners = np.array(written)
    assert len(corners) > 40 / scale
    assert (corners >= 0).all() and (corners[:, 2:] <= (width, height)).all()
