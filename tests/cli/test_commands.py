"""The commands end to end: what they write, what they print, how they exit."""

import io
import json
import os
import shlex
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from cli.conftest import OBJ
from patience import HUNG
from PIL import Image

import engine3d as e3d
from engine3d.cli import main

SMALL = ("--resolution", "48x32")
pytestmark = pytest.mark.usefixtures("no_screen")


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGBA"))


def start(*arguments, **options):
    command = [sys.executable, "-m", "engine3d", *map(str, arguments)]
    return subprocess.Popen(command, stdout=-1, stderr=-1, **options)


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


def test_dash_writes_png_to_standard_output(model):
    process = start("render", model, *SMALL, "-o", "-")
    out, err = process.communicate()
    assert (process.returncode, err) == (0, b"")
    with Image.open(io.BytesIO(out)) as image:
        assert (image.format, image.size) == ("PNG", (48, 32))


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
        size = ["--resolution", "160x120"]
        assert main(["render", str(model), *size, *arguments, "-o", str(path)]) == 0
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
        ["--samples", "4"],
        ["--up", "-Z"],
        ["--camera-position", "-1,2,3"],
        ["--camera-focal-point", "1,1,0"],
        ["--camera-view-up", "1,0,0"],
        ["--camera-view-angle", "60"],
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
        assert main(["render", *arguments, "--resolution", "96x64", "-o", str(path)]) == 0
        return path.read_bytes()

    solid = ["--scene", "shapes"]
    assert draw(*solid) != draw(*solid, "--hidden-surfaces", "none", "--cull", "none")
    assert draw(*solid) != draw(*solid, "--flat")
    lines = [*solid, "--wireframe", "only"]
    assert draw(*lines) != draw(*lines, "--hidden-lines")
    points = ["--scene", "vertices"]
    assert draw(*points) != draw(*points, "--point-size", "3")


def test_a_texture_is_asked_for_or_found_beside_the_model(model, tmp_path):
    def draw(*arguments):
        path = tmp_path / "out.png"
        assert main(["render", str(model), *SMALL, "--unlit", *arguments, "-o", str(path)]) == 0
        return pixels(path)[16, 24, :3].tolist()

    Image.new("RGB", (4, 4), (200, 30, 10)).save(tmp_path / "elsewhere.png")
    assert draw() == [255, 255, 255]
    assert draw("--texture", str(tmp_path / "elsewhere.png")) == [200, 30, 10]
    Image.new("RGB", (4, 4), (10, 30, 200)).save(tmp_path / "square_diffuse.tga")
    assert draw() == [10, 30, 200]


def test_a_texture_or_a_colour_that_nothing_takes_is_warned_of(model, tmp_path, capsys):
    (tmp_path / "square.mtl").write_text("newmtl blue\nKd 0 0 1\n")
    model.write_text("mtllib square.mtl\nusemtl blue\n" + OBJ)
    Image.new("RGB", (4, 4), (200, 30, 10)).save(tmp_path / "red.png")
    for option in (("--texture", "red.png"), ("--color", "red")):
        assert main(["render", str(model), *SMALL, "--unlit", *option, "-o", "out.png"]) == 0
        assert "materials of its own" in capsys.readouterr().err
        assert pixels("out.png")[16, 24, :3].tolist() == [0, 0, 255]


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
    assert main([*base, "--resolution", "20x20", "--reference", path]) == 1
    assert "48x32" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["missing.obj"], "missing.obj"),
        (["broken.obj"], "broken.obj:2: "),
        (["square.obj", "--texture", "missing.png"], "missing.png"),
        (["square.obj", "--texture", "broken.obj"], "broken.obj"),
        (["square.obj", "--reference", "missing.png"], "missing.png"),
        (["square.obj", "--reference", "broken.obj"], "broken.obj"),
        (["square.obj", "-o", "no/folder/out.png"], "no/folder"),
        (["square.obj", "--camera-position", "0.5,0.5,0"], "same"),
        (["square.obj", "--camera-position", "1e300,0,0"], "too far apart"),
        (["."], "."),
    ],
)
def test_bad_input_is_one_line_and_status_1(model, tmp_path, capsys, arguments, part):
    (tmp_path / "broken.obj").write_text("v 0 0 0\nf 1 2 9\n")
    if "-o" not in arguments:
        arguments = [*arguments, "-o", "out.png"]
    assert main(["render", *SMALL, *arguments]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("engine3d: error: ")
    assert err.count("\n") == 1
    assert part in err


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["fly"],
        ["render"],
        ["render", "a.obj"],
        ["render", "-o", "out.png"],
        ["render", "a.obj", "-o", "out.xyz"],
        ["render", "a.obj", "-o", "out"],
        ["render", "a.obj", "-o", "out.gif"],
        ["render", "a.obj", "--turntable", "4", "-o", "out.png"],
        ["render", "a.obj", "--turntable", "4", "-o", "-"],
        ["render", "a.obj", "--turntable", "0", "-o", "out.gif"],
        ["render", "a.obj", "--no-background", "-o", "out.jpg"],
        ["render", "a.obj", "--scene", "cube", "-o", "out.png"],
        ["render", "--scene", "moon", "-o", "out.png"],
        ["render", "--scene", "cube", "--texture", "a.png", "-o", "out.png"],
        ["render", "--scene", "cube", "--triangles", "50000", "-o", "out.png"],
        ["city", "out.png"],
        ["city", "out.obj", "--seed", "x"],
        ["render", "a.obj", "-o", "out.png", "--resolution", "0x0"],
        ["render", "a.obj", "-o", "out.png", "--mode", "pretty"],
        ["render", "a.obj", "-o", "out.png", "--unlit", "--mode", "depth"],
        ["render", "a.obj", "-o", "out.png", "--backend", "gpu"],
        ["render", "a.obj", "-o", "out.png", "--no-such-option"],
        ["render", "a.obj", "-o", "out.png", "--reference-threshold", "0.1"],
        ["render", "a.obj", "--reference", "a.png", "--reference-threshold", "1.1"],
        ["render", "a.obj", "-o", "out.png", "--threads", "257"],
        ["render", "a.obj", "-o", "out.png", "--line-width", "256.5"],
        ["render", "a.obj", "-o", "out.png", "--point-size", "300"],
        ["render", "a.obj", "-o", "out.png", "--camera-view-up", "0,0,0"],
        [
            "render",
            "a.obj",
            "-o",
            "out.png",
            "--camera-position",
            "1,2,3",
            "--camera-focal-point",
            "1,2,3",
        ],
        ["render", "--scene", "city", "--triangles", "500", "-o", "out.png"],
        ["city", "out.obj", "--triangles", "500"],
        ["run", "--headless", "-o", "out.png"],
        ["run", "--watch"],
        ["run", "-", "--watch"],
        ["run", "-o", "out.gif"],
        ["info"],
    ],
)
def test_wrong_usage_is_status_2_and_writes_nothing(tmp_path, capsys, arguments):
    (tmp_path / "a.obj").write_text(OBJ)
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("engine3d") and "error: " in err
    assert err.count("\n") == 1
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.obj"]


@pytest.mark.parametrize(
    ("arguments", "work"),
    [
        (["render", "--scene", "cube", "-o", "no/a.png"], "options.viewed_scene"),
        (["run", "--scene", "cube", "--headless", "-o", "no/a.gif"], "options.viewed_scene"),
        (["convert", "square.obj", "no/a.ply"], "convert.load_mesh"),
        (["city", "no/a.obj"], "city.make_city"),
        (["bench", "--json", "no/a.json"], "bench.workloads.make"),
    ],
)
def test_a_folder_that_is_not_there_is_found_before_any_work(
    model, capsys, monkeypatch, arguments, work
):
    def begin(*arguments, **options):
        raise AssertionError("the work has begun")

    monkeypatch.setattr(f"engine3d.cli.{work}", begin)
    assert main(arguments) == 1
    path = arguments[-1]
    expected = f"engine3d: error: {path}: cannot write: No such file or directory\n"
    assert capsys.readouterr() == ("", expected)


@pytest.mark.parametrize(
    ("arguments", "meant", "program"),
    [
        (["--versoin"], "--version", "engine3d"),
        (["info", "square.obj", "--jsn"], "--json", "engine3d info"),
    ],
)
def test_a_misspelt_option_leads_to_the_help_that_lists_it(
    model, capsys, arguments, meant, program
):
    assert main(arguments) == 2
    wrong = f"{arguments[-1]}: did you mean {meant}?"
    expected = f"engine3d: error: unknown arguments: {wrong} (see {program} --help)\n"
    assert capsys.readouterr().err == expected


def test_a_backend_that_the_machine_lacks_is_an_error(model, capsys, monkeypatch):
    monkeypatch.setenv("ENGINE3D_BACKEND", "abacus")
    assert main(["render", str(model), *SMALL, "-o", "out.png"]) == 1
    assert "abacus" in capsys.readouterr().err


@pytest.mark.parametrize("position", ["1e300,0,0", "0,0,1e160"])
def test_a_light_may_be_as_far_away_as_numbers_reach(model, capsys, position):
    command = ["render", str(model), *SMALL, "-o", "out.png", "--light-position", position]
    assert main(command) == 0
    assert capsys.readouterr() == ("", "")


def give(monkeypatch, data):
    """Let ``data`` be what comes on standard input."""
    stream = io.TextIOWrapper(io.BytesIO(data))
    stream.buffer.name = "<stdin>"
    monkeypatch.setattr(sys, "stdin", stream)


def test_a_model_on_standard_input(model, tmp_path, capsys, monkeypatch):
    assert main(["convert", str(model), "square.stl"]) == 0
    capsys.readouterr()
    for name in ("square.obj", "square.stl"):
        data = (tmp_path / name).read_bytes()
        give(monkeypatch, data)
        assert main(["info", "-", "--json"]) == 0
        report = json.loads(capsys.readouterr().out)
        assert (report["file"], report["format"]) == ("<stdin>", name[-3:])
        assert report["counts"]["triangles"] == 2
        give(monkeypatch, data)
        assert main(["render", "-", *SMALL, "-o", "piped.png"]) == 0
        assert main(["render", name, *SMALL, "-o", "named.png"]) == 0
        assert np.array_equal(pixels("piped.png"), pixels("named.png"))
        give(monkeypatch, data)
        assert main(["convert", "-", "piped.ply"]) == 0
        capsys.readouterr()
        assert len(e3d.load_mesh("piped.ply").faces) == 2


def test_standard_input_without_a_model(capsys, monkeypatch):
    give(monkeypatch, b"")
    assert main(["info", "-"]) == 1
    assert capsys.readouterr().err.startswith("engine3d: error: <stdin>: unknown mesh format")
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    assert main(["info", "-"]) == 2
    monkeypatch.setattr(sys, "stdin", None)
    assert main(["info", "-"]) == 2
    assert capsys.readouterr().err.count("\n") == 2


@pytest.mark.parametrize("option", ["--list-readers", "--help", "--version"])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_what_is_printed_on_a_full_disk_ends_without_a_traceback(option, unbuffered):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "engine3d", option]
        environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
        done = subprocess.run(command, stdout=full, stderr=-1, env=environment, check=False)
    assert done.stderr in (b"", b"engine3d: error: No space left on device\n")
    assert done.returncode == (1 if done.stderr else 0)  # argparse swallows what it cannot print
    assert done.stderr or option != "--list-readers"


def test_a_loaders_warning_is_a_line(tmp_path, capsys):
    path = tmp_path / "model.obj"
    path.write_text("mtllib missing.mtl\n" + OBJ)
    assert main(["render", str(path), *SMALL, "-o", "out.png"]) == 0
    err = capsys.readouterr().err
    assert err.startswith("engine3d: warning: ")
    assert "missing.mtl" in err
    assert err.count("\n") == 1


def test_verbose_tells_what_was_loaded_and_drawn(model, capsys):
    assert main(["render", str(model), *SMALL, "-o", "out.png", "--verbose"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert "square.obj" in err and "48x32" in err and "triangles" in err
    counted = "triangles 2 total, 2 in frustum, 2 unoccluded, 2 drawn; materials 1; "
    assert sum(counted in line for line in err.splitlines()) == 1


def test_info(model, capsys):
    assert main(["info", str(model)]) == 0
    text = capsys.readouterr().out
    assert "square.obj" in text and "vertices" in text and "bounds" in text
    assert main(["info", str(model), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["counts"]["vertices"] == 4
    assert report["bounds"]["max"] == [1.0, 1.0, 0.0]
    assert report["warnings"] == []
    assert [item["faces"] for item in report["objects"]] == [2]


def test_info_shows_names_that_would_steer_the_terminal(tmp_path, capsys):
    path = tmp_path / "a\nb.obj"
    path.write_text("o \x1b[31mred\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert main(["info", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "a\\nb.obj: obj\n" in printed
    assert "object \\x1b[31mred: 3 vertices" in printed
    assert "\x1b" not in printed


def test_info_of_a_file_that_is_no_model(tmp_path, capsys):
    (tmp_path / "a.obj").write_text("v 1 2\n")
    assert main(["info", "a.obj"]) == 1
    assert "a.obj:1: " in capsys.readouterr().err


def test_info_lists_warnings(tmp_path, capsys):
    (tmp_path / "a.obj").write_text("mtllib none.mtl\n" + OBJ)
    assert main(["info", "a.obj", "--json"]) == 0
    out, err = capsys.readouterr()
    (warning,) = json.loads(out)["warnings"]
    assert "none.mtl" in warning
    assert err == ""


def test_list_readers_and_version(capsys):
    assert main(["--list-readers"]) == 0
    text = capsys.readouterr().out
    assert ".obj" in text and ".tga" in text and ".asc" in text
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"engine3d {e3d.__version__}\n"


@pytest.mark.parametrize("command", [[], ["run"], ["render"], ["info"]])
def test_help(command, capsys):
    assert main([*command, "--help"]) == 0
    assert "usage: engine3d" in capsys.readouterr().out


def test_run_without_a_screen_says_so_and_writes_a_turntable(model, tmp_path, capsys):
    command = ["run", str(model), *SMALL, "--cull", "none"]
    assert main([*command, "--frames", "3"]) == 0
    out, err = capsys.readouterr()
    assert err.count("\n") == 1
    assert "no screen" in err and "square-turntable-001.gif" in err
    with Image.open(tmp_path / "square-turntable-001.gif") as image:
        assert image.n_frames == 3
    assert main([*command, "--frames", "2"]) == 0
    assert (tmp_path / "square-turntable-002.gif").exists()


def test_run_headless_writes_what_it_is_told(model, tmp_path, capsys):
    headless = ["run", str(model), *SMALL, "--headless", "--cull", "none"]
    assert main([*headless, "--frames", "4", "-o", "out.webp"]) == 0
    with Image.open(tmp_path / "out.webp") as image:
        assert image.n_frames == 4
    assert main([*headless, "--frames", "1", "-o", "out.png"]) == 0
    assert pixels(tmp_path / "out.png").shape == (32, 48, 4)
    assert capsys.readouterr().err == ""


def test_run_in_a_dummy_window_stops_after_its_frames(model, monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    arguments = ["--animate", "--fps", "--no-vsync", "--frames", "3", "--camera", "fps"]
    assert main(["run", str(model), *SMALL, *arguments]) == 0
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(
    "scene",
    ["default", "vertices", "edges", "faces", "cube", "shapes", "textured", "asc", "city", "solar"],
)
def test_every_scene_draws_something_that_moves(scene, tmp_path):
    path = tmp_path / "out.webp"
    arguments = ["--headless", "--frames", "3", "-o", str(path)]
    assert main(["run", "--scene", scene, "--resolution", "96x64", *arguments]) == 0
    with Image.open(path) as image:
        assert image.n_frames == 3
        first = np.asarray(image.convert("RGB")).astype(int)
        image.seek(1)
        second = np.asarray(image.convert("RGB")).astype(int)
    assert np.ptp(first) > 100
    assert abs(first - second).max() > 30


def test_a_reader_that_leaves_is_no_traceback(model):
    process = start("info", model, "--json")
    process.stdout.close()
    assert b"Traceback" not in process.stderr.read()
    assert process.wait() in (0, 1)
    process.stderr.close()


@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams(model, tmp_path, closed):
    """Nobody is told anything; what is written is whole, without anybody's lines in it."""
    written, broken = tmp_path / "a.png", tmp_path / "b.obj"
    broken.write_text("v 0 0")
    for arguments, status in (
        (["info", model], 0),
        (["info", broken], 1),
        (["render", model, "-o", written, "--resolution", "8x8", "--verbose"], 0),
        (["render", model, "-o", "-", "--resolution", "8x8"], 0),
    ):
        command = shlex.join([sys.executable, "-m", "engine3d", *map(str, arguments)])
        done = subprocess.run(["sh", "-c", f"exec {command} {closed}"], capture_output=True)
        assert done.returncode == status, done.stderr
        assert b"Traceback" not in done.stderr
    with Image.open(written) as image:
        image.load()


def test_a_reader_of_a_picture_that_leaves():
    size = ["--resolution", "1280x720"]
    process = start("render", "--scene", "default", *size, "-o", "-")
    process.stdout.read(10)
    process.stdout.close()
    error = process.stderr.read()
    process.stderr.close()
    assert process.wait() == 1
    assert error == b""


def test_ctrl_c_is_quiet_and_leaves_no_file(model, tmp_path):
    output = tmp_path / "long.gif"
    process = start("render", model, "--turntable", "3000", "--verbose", "-o", output)
    assert b"loaded" in process.stderr.readline()
    time.sleep(0.5)
    os.kill(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=HUNG)
    assert process.returncode == 130
    assert out == b""
    assert all(b"] frame " in line for line in err.splitlines())
    assert [entry.name for entry in tmp_path.iterdir()] == [model.name]


def test_help_loads_neither_numpy_nor_pillow():
    code = (
        "import sys; from engine3d.cli import main; main(['render', '--help']);"
        "print([name for name in ('numpy', 'PIL', 'sdl2', 'rich') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_a_render_loads_neither_sdl_nor_rich(model):
    code = (
        "import sys; from engine3d.cli import main;"
        f"main(['render', {str(model)!r}, '--resolution', '20x20', '-o', 'out.png']);"
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


def test_convert(model, tmp_path, capfd):
    assert main(["convert", str(model), "out.ply"]) == 0
    mesh = e3d.load_mesh("out.ply")
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert main(["convert", "out.ply", "out.stl", "--ascii"]) == 0
    assert "do not hold texture coordinates" in capfd.readouterr().err
    assert (tmp_path / "out.stl").read_text().count("vertex") == 6
    assert main(["convert", "out.stl", "missing/out.obj"]) == 1


@pytest.mark.parametrize("name", ["out.obj", "out.ply", "out.stl"])
def test_convert_keeps_coordinates_whichever_axis_is_up(model, name):
    assert main(["convert", str(model), name]) == 0
    assert {tuple(corner) for corner in e3d.load_mesh(name).positions.tolist()} == {
        tuple(corner) for corner in e3d.load_mesh(model).positions.tolist()
    }


@pytest.mark.parametrize("arguments", [["out.png"], ["out"], ["out.obj", "--ascii"]])
def test_convert_refuses_what_it_cannot_write(model, capfd, arguments):
    assert main(["convert", str(model), *arguments]) == 2
    assert "engine3d: error:" in capfd.readouterr().err


def test_city_writes_a_model(tmp_path, capfd):
    assert main(["city", "town.stl", "--triangles", "20000", "--seed", "4"]) == 0
    assert len(e3d.load_mesh("town.stl").faces) == e3d.city(20_000, seed=4).triangles
    assert main(["city", "town.obj", "--triangles", "3"]) == 2
    assert "'3' is not from 20,000 to 50,000,000" in capfd.readouterr().err
    assert not (tmp_path / "town.obj").exists()


def test_the_size_of_the_city_scene(capsys):
    arguments = ["--triangles", "30000", *SMALL, "-o", "out.png", "--verbose"]
    assert main(["render", "--scene", "city", *arguments]) == 0
    assert "triangles" in "".join(capsys.readouterr())


def test_a_walk_without_a_screen(tmp_path):
    command = ["run", "--scene", "city", "--triangles", "30000", "--camera", "fps", "--headless"]
    assert main([*command, *SMALL, "--frames", "3", "-o", "walk.gif"]) == 0
    with Image.open(tmp_path / "walk.gif") as image:
        assert image.n_frames == 3
    assert main([*command, *SMALL, "--frames", "1", "-o", "first.png"]) == 0
    assert main([*command[:-3], "--headless", *SMALL, "--frames", "1", "-o", "above.png"]) == 0
    assert not np.array_equal(pixels(tmp_path / "first.png"), pixels(tmp_path / "above.png"))


@pytest.mark.parametrize("vertices", ["v 1 1 1", "v nan inf 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3"])
def test_models_without_extent_print_nothing(tmp_path, capsys, vertices):
    """A single point, and a triangle of which one corner is finite: no warnings of NumPy's."""
    path = tmp_path / "a.obj"
    path.write_text(vertices + "\n")
    with np.errstate(all="raise", under="ignore"):
        assert main(["render", str(path), *SMALL, "-o", str(tmp_path / "a.png")]) == 0
    assert capsys.readouterr() == ("", "")
