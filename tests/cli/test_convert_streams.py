"""``engine3d convert`` to standard output, and what a stream has no place for."""

import io
import subprocess
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.cli.options.convert_options import MODEL_FORMATS
from engine3d.errors import InvalidArgumentError
from engine3d.io.writers import formats

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.obj").write_text(SQUARE)
    return tmp_path


def convert(*arguments):
    command = [sys.executable, "-m", "engine3d", "convert", "a.obj", *arguments]
    done = subprocess.run(command, capture_output=True, timeout=60)
    return done.returncode, done.stdout, done.stderr.decode()


def test_the_parser_knows_the_formats_without_importing_them():
    assert list(MODEL_FORMATS) == [item.name for item in formats()]


@pytest.mark.parametrize(
    ("format", "way"),
    [*((name, ("-",)) for name in MODEL_FORMATS), ("ply", ("-o", "-")), ("stl", ("--output", "-"))],
)
def test_standard_output_gets_the_bytes_of_the_file(folder, format, way):
    status, out, _ = convert(*way, "--format", format)
    assert status == 0
    assert main(["convert", "a.obj", f"b.{format}"]) == 0
    assert out == (folder / f"b.{format}").read_bytes()


def test_text_on_standard_output():
    status, out, _ = convert("-o", "-", "--format", "ply", "--ascii")
    assert (status, out[:17]) == (0, b"ply\nformat ascii ")


def test_a_format_whatever_the_extension(folder):
    assert main(["convert", "a.obj", "b.bin", "--format", "ply"]) == 0
    assert (folder / "b.bin").read_bytes().startswith(b"ply\n")


def test_a_library_has_no_place_on_standard_output(folder):
    (folder / "a.mtl").write_text("newmtl m\nKd 1 0 0\n")
    (folder / "a.obj").write_text("mtllib a.mtl\nusemtl m\n" + SQUARE)
    status, out, err = convert("-o", "-", "--format", "obj")
    assert (status, out) == (1, b"")
    assert err.startswith("engine3d: error: obj files have their materials in a library beside")
    assert err.count("\n") == 1
    assert convert("-o", "-", "--format", "ply")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["-o", "-"], "- needs --format: one of glb, gltf, obj, ply, stl"),
        (["-", "--format", "dae"], "'dae' is not one of glb, gltf, obj, ply, stl"),
        (["-", "-o", "-", "--format", "ply"], "where to write"),
        ([], "where to write"),
        (["-o", "-", "--format", "obj", "--ascii"], "--ascii is for"),
    ],
)
def test_wrong_usage(arguments, part):
    status, out, err = convert(*arguments)
    assert (status, out) == (2, b"")
    assert part in err and err.count("\n") == 1


def test_meshes_are_saved_to_streams():
    mesh, stream = e3d.load_mesh("a.obj"), io.BytesIO(b"")
    mesh.save(stream, format="ply")
    assert not stream.closed
    assert np.array_equal(e3d.load_mesh(stream.getvalue()).faces, mesh.faces)
    with pytest.raises(InvalidArgumentError, match="extension"):
        mesh.save(io.BytesIO())
