"""``engine3d render``: pictures of each format, what options change, reference pictures."""

import subprocess
import sys

import numpy as np
import pytest
from cli.conftest import OBJ, SMALL, pixels
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.cli.options.scene_options import viewed_scene
from engine3d.apps.cli.parser import parse

pytestmark = pytest.mark.usefixtures("no_screen")


@pytest.mark.parametrize("suffix", [".png", ".tga", ".webp", ".jpg", ".JPEG"])
def test_render_writes_each_format(model, tmp_path, capsys, suffix):
    path = tmp_path / f"out{suffix}"
    assert main(["render", str(model), *SMALL, "-o", str(path)]) == 0
    picture = pixels(path)
    assert picture.shape == (32, 48, 4)
    assert picture[16, 24, :3].min() > 100
    assert capsys.readouterr() == ("", "")


def test_the_same_picture_on_every_backend(model, tmp_path):
    pictures = set()
    for backend in e3d.backends():
        path = tmp_path / "out.png"
        assert main(["render", str(model), *SMALL, "--backend", backend, "-o", str(path)]) == 0
        pictures.add(path.read_bytes())
    assert len(pictures) == 1


def test_no_background_is_transparent_where_nothing_is(model, tmp_path):
    path = tmp_path / "out.png"
    assert main(["render", str(model), *SMALL, "--no-background", "-o", str(path)]) == 0
    alpha = pixels(path)[..., 3]
    assert alpha[0, 0] == 0
    assert alpha[16, 24] == 255


def test_background_color_is_what_it_says(model, tmp_path):
    path = tmp_path / "out.png"
    arguments = ["--background-color", "12,34,56", "-o", str(path)]
    assert main(["render", str(model), *SMALL, *arguments]) == 0
    assert pixels(path)[0, 0].tolist() == [12, 34, 56, 255]


@pytest.mark.parametrize("suffix", [".gif", ".webp", ".apng"])
def test_turntable(model, tmp_path, suffix):
    path = tmp_path / f"out{suffix}"
    arguments = ["--turntable", "5", "--cull", "none", "-o", str(path)]
    assert main(["render", str(model), *SMALL, *arguments]) == 0
    with Image.open(path) as image:
        assert image.n_frames == 5


def test_appearance_options_change_the_picture(model, tmp_path):
    def draw(*arguments):
        path = tmp_path / "out.png"
        size = ["--size", "160x120"]
        look = ["--look", "plain", *arguments]
        assert main(["render", str(model), *size, *look, "-o", str(path)]) == 0
        return path.read_bytes()

    plain = draw()
    for arguments in (
        ["--unlit"],
        ["--mode", "normal"],
        ["--wireframe"],
        ["--edges"],
        ["--edges", "--line-width", "3"],
        ["--edges", "--line-color", "red"],
        ["--cull", "front"],
        ["--color", "red"],
        ["--light-position", "0,0,5"],
        ["--light-intensity", "0.3"],
        ["--grid"],
        ["--axis"],
        ["--metadata"],
        ["--samples", "1"],
        ["--up", "-Z"],
        ["--camera-position", "-1,2,3"],
        ["--camera-focal-point", "1,1,0"],
        ["--camera-view-up", "1,0,0"],
        ["--camera-yfov", "60"],
        ["--camera-azimuth-angle", "-20"],
        ["--camera-elevation-angle", "-10"],
        ["--camera-zoom-factor", "2"],
        ["--camera-orthographic"],
    ):
        assert draw(*arguments) != plain, arguments
    assert draw("--shading", "forward") == plain


def test_hidden_surfaces_flat_normals_and_points_change_a_solid(tmp_path):
    def draw(*arguments):
        path = tmp_path / "out.png"
        assert main(["render", *arguments, "--size", "96x64", "-o", str(path)]) == 0
        return path.read_bytes()

    solid = ["--scene", "shapes"]
    assert draw(*solid) != draw(*solid, "--hidden-surfaces", "none", "--cull", "none")
    flat = draw(*solid, "--normals", "flat")
    assert draw(*solid) != flat != draw(*solid, "--normals", "facet") != draw(*solid)
    lines = [*solid, "--wireframe", "only"]
    assert draw(*lines) != draw(*lines, "--hidden-lines")
    points = ["--scene", "vertices"]
    assert draw(*points) != draw(*points, "--point-size", "3")


def test_a_built_in_scene_is_painted_where_it_is_plain():
    def colors_of(scene):
        held = [node.object for node in scene.nodes if isinstance(node.object, e3d.Mesh)]
        return {m: tuple(m.rgb) for mesh in held for m in mesh.materials}

    def opened(*options):
        args = parse(["run", "--scene", "shapes", *options])
        return viewed_scene(args).scene

    before, after = colors_of(opened()), colors_of(opened("--color", "red"))
    red = (255, 0, 0)
    kept = [color for color in after.values() if color != red]
    assert len(after) == len(before) == 6 and list(after.values()).count(red) == 2
    assert all(color in before.values() for color in kept)


@pytest.mark.parametrize("name", ["default", "textured", "asc"])
def test_a_built_in_model_is_painted_all_over(name, recwarn):
    scene = viewed_scene(parse(["run", "--scene", name, "--color", "red"])).scene
    meshes = [node.object for node in scene.nodes if isinstance(node.object, e3d.Mesh)]
    assert meshes and not recwarn.list
    for mesh in meshes:
        (material,) = mesh.materials
        assert tuple(material.rgb) == (255, 0, 0) and material.texture is None
        assert mesh.colors is None


@pytest.mark.parametrize("name", ["shapes", "solar"])
def test_what_glows_is_bright_without_light(name):
    scene = viewed_scene(parse(["run", "--scene", name])).scene
    meshes = [node.object for node in scene.nodes if isinstance(node.object, e3d.Mesh)]
    glowing = [m for mesh in meshes for m in mesh.materials if m.unlit]
    assert len(glowing) >= 3
    assert all(max(material.rgb) > 0.9 for material in glowing)


def test_edges_of_shapes_are_cut_into_parts():
    def counts(*options):
        args = parse(["run", "--scene", "shapes", *options])
        nodes = {node.name: node.object for node in viewed_scene(args).scene.nodes}
        return [len(nodes[name].faces) for name in ("sphere", "box", "floor")]

    assert counts() == [64 * 31 * 2, 12, 2]
    assert counts("--subdivisions", "1") == [2 * 3, 12, 2]
    assert counts("--subdivisions", "5") == [10 * 4 * 2, 6 * 50, 50]
    args = parse(["run", "--scene", "shapes", "--subdivisions", "5"])
    cube = next(node.object for node in viewed_scene(args).scene.nodes if node.name == "box")
    middles = cube.positions[cube.faces].mean(axis=1)
    assert ((middles * cube.face_normals).sum(axis=1) > 0.4).all(), "faces look outward"
    assert np.allclose(np.abs(cube.positions).max(axis=1), 0.5, atol=1e-6)


def test_a_texture_is_asked_for_or_found_beside_the_model(model, tmp_path):
    def draw(*arguments):
        path = tmp_path / "out.png"
        assert main(["render", str(model), *SMALL, "--unlit", *arguments, "-o", str(path)]) == 0
        return pixels(path)[16, 24, :3].tolist()

    Image.new("RGB", (4, 4), (200, 30, 10)).save(tmp_path / "elsewhere.png")
    assert draw() == [172, 169, 164]  # what states no material
    assert draw("--texture", str(tmp_path / "elsewhere.png")) == [200, 30, 10]
    Image.new("RGB", (4, 4), (10, 30, 200)).save(tmp_path / "square_diffuse.tga")
    assert draw() == [10, 30, 200]


def test_a_texture_may_be_refused_and_a_colour_replaces_all(model, tmp_path, capsys):
    (tmp_path / "square.mtl").write_text("newmtl blue\nKd 0 0 1\n")
    model.write_text("mtllib square.mtl\nusemtl blue\n" + OBJ)
    Image.new("RGB", (4, 4), (200, 30, 10)).save(tmp_path / "red.png")
    draw = ["render", str(model), *SMALL, "--unlit", "-o", "out.png"]
    assert main([*draw, "--texture", "red.png"]) == 0
    assert "materials of its own" in capsys.readouterr().err
    assert pixels("out.png")[16, 24, :3].tolist() == [0, 0, 255]
    assert main([*draw, "--color", "red"]) == 0
    assert not capsys.readouterr().err
    assert pixels("out.png")[16, 24, :3].tolist() == [255, 0, 0]


def test_a_reference_decides_the_exit_status(model, tmp_path, capsys):
    path = str(tmp_path / "reference.png")
    base = ["render", str(model), *SMALL]
    assert main([*base, "-o", path]) == 0
    assert main([*base, "--reference", path]) == 0
    assert main([*base, "--reference", path, "--unlit"]) == 1
    error = capsys.readouterr().err
    assert error.startswith("engine3d: error: ") and error.count("\n") == 1
    assert "pixels" in error
    assert main([*base, "--reference", path, "--unlit", "--reference-threshold", "1"]) == 0
    assert main([*base, "--size", "20x20", "--reference", path]) == 1
    assert "48x32" in capsys.readouterr().err


@pytest.mark.parametrize("position", ["1e300,0,0", "0,0,1e160"])
def test_a_light_may_be_as_far_away_as_numbers_reach(model, capsys, position):
    command = ["render", str(model), *SMALL, "-o", "out.png", "--light-position", position]
    assert main(command) == 0
    assert capsys.readouterr() == ("", "")


def test_a_render_loads_neither_sdl_nor_rich(model):
    code = (
        "import sys; from engine3d.apps.cli import main;"
        f"main(['render', {str(model)!r}, '--size', '20x20', '-o', 'out.png']);"
        "print([name for name in ('sdl2', 'rich') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.parametrize(
    "data", [b"", b"P6\n4 \xff4\n255\n", b"GIF89a" + bytes(9), b"\x89PNG\r\n\x1a\n"]
)
def test_a_damaged_reference_is_one_line(model, tmp_path, capfd, data):
    (tmp_path / "old.ppm").write_bytes(data)
    arguments = [*SMALL, "-o", "new.png", "--reference", "old.ppm"]
    assert main(["render", str(model), *arguments]) == 1
    error = capfd.readouterr().err
    assert error.startswith("engine3d: error: old.ppm: ") and error.count("\n") == 1


@pytest.mark.parametrize(
    ("vertices", "said"),
    [
        ("v 1 1 1", ""),
        (
            "v nan inf 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3",
            "2 of 3 vertices have coordinates that are not finite",
        ),
    ],
)
def test_models_without_extent_print_no_warnings_of_numpy(tmp_path, capsys, vertices, said):
    """A single point, and a triangle of which one corner is finite."""
    path = tmp_path / "a.obj"
    path.write_text(vertices + "\n")
    with np.errstate(all="raise", under="ignore"):
        assert main(["render", str(path), *SMALL, "-o", str(tmp_path / "a.png")]) == 0
    out, err = capsys.readouterr()
    assert out == "" and said in err and err.count("\n") == 2 * bool(said)
    assert ("nothing shows" in err) == bool(said)
