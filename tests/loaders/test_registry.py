"""The choice of a reader, and what loading costs at most."""

import contextlib
import subprocess
import sys
import tracemalloc
from types import SimpleNamespace

import numpy as np
import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

from engine3d import Mesh, box
from engine3d.errors import Engine3DError, FileFormatError, InvalidArgumentError
from engine3d.io.loaders import formats, load_document, load_mesh, load_texture
from engine3d.io.reading import loading
from engine3d.io.reading import reader_registry as registry

MIB = 1 << 20


def test_formats_are_listed():
    names = {entry.name for entry in formats()}
    assert {"obj", "asc", "ply", "stl", "off", "gltf", "tga", "png", "jpeg"} <= names
    assert {entry.name for entry in formats("mesh")} >= {"obj", "asc", "ply", "stl", "off"}
    assert all(extension.startswith(".") for f in formats() for extension in f.extensions)


def test_an_unknown_format_is_a_clear_error(write):
    with pytest.raises(
        FileFormatError, match=r"a\.what: unknown mesh format '\.what' \(known: \.3dxml"
    ):
        load_mesh(write("a.what", "1 2 3\n"))


@pytest.mark.parametrize("extension", ["txt", "3d", ""])
def test_text_is_recognised_without_its_extension(write, extension):
    text = "# made by hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    assert len(load_mesh(write(f"a.{extension}", text)).faces) == 1


@pytest.mark.parametrize("is_text", [False, True])
def test_stl_is_recognised_without_a_name(tmp_path, is_text):
    path = tmp_path / "a.stl"
    Mesh(box().positions, box().faces).save(path, ascii=is_text)
    data = path.read_bytes()
    assert np.array_equal(load_mesh(data).positions, load_mesh(path).positions)
    if not is_text:
        with pytest.raises(FileFormatError, match="<bytes>: unknown mesh format without an ext"):
            load_mesh(data + b"more")


def test_loading_a_mesh_does_not_import_pillow(write):
    path = write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = (
        "import sys, engine3d.loaders as loaders; "
        f"loaders.load_mesh({str(path)!r}); sys.exit('PIL' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@needs_conformance
@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("kinds", [("obj", "mtl", "asc"), ("ply",), ("tga",)])
def test_memory_stays_within_its_limit(kinds):
    """64 MiB and 40 times the file, and for images their pixels besides."""
    load = load_texture if kinds == ("tga",) else load_mesh
    tracemalloc.start()
    try:
        for case in (parameter.values[0] for parameter in cases_of(*kinds)):
            limit = 64 * MIB + 40 * case["size"] + 4 * case.get("width", 0) * case.get("height", 0)
            tracemalloc.reset_peak()
            before = tracemalloc.get_traced_memory()[0]
            with contextlib.suppress(Engine3DError):
                load(CONFORMANCE / case["file"])
            assert tracemalloc.get_traced_memory()[1] - before <= limit, case["file"]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("kind", [MemoryError, InvalidArgumentError])
@pytest.mark.parametrize("load", [load_mesh, load_document, load_texture])
def test_whatever_a_reader_meets_names_the_file(write, monkeypatch, load, kind):
    def read(source, split=False):
        raise kind("more than 2147483647 rows")

    monkeypatch.setattr(loading, "find_reader", lambda *_: SimpleNamespace(read=read))
    with pytest.raises(FileFormatError, match=r"a\.ply: (more than|needs more memory)"):
        load(write("a.ply", "ply"))


_VERTICES = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + "".join(
    f"property uchar {axis}\n" for axis in "xyz"
)
_LIST = "property list uchar uchar vertex_indices\n"
_COUNT = 300_000


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.ply", f"element face {_COUNT}\n{_LIST}end_header\n" + "\0" * (9 + _COUNT)),
        ("mixed.ply", f"element face {_COUNT}\n{_LIST}end_header\n" + "\0" * 9 + "\0\1\0" * _COUNT),
        ("a.off", f"OFF\n3 {_COUNT} 0\n" + "0 0 0\n" * 3 + "0\n" * _COUNT),
        ("comments.off", "OFF\n" + "#\n" * _COUNT),
        ("a.stl", "solid\n" + "endloop\n" * _COUNT),
        ("b.stl", "solid\n" + "vertex 0 0 0\n" * _COUNT + "endloop\n"),
    ],
)
def test_memory_for_rows_of_next_to_nothing(write, name, content):
    content = _VERTICES + content if name.endswith("ply") else content
    path = write(name, content)
    tracemalloc.start()
    try:
        with contextlib.suppress(Engine3DError):
            load_mesh(path)
        assert tracemalloc.get_traced_memory()[1] <= 64 * MIB + 40 * len(content)
    finally:
        tracemalloc.stop()


def test_a_document_knows_which_way_is_up_by_custom():
    assert load_document(b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", format="off").up == "+Y"
    facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    assert load_document(f"{facet}endloop\nendfacet\nendsolid\n".encode(), format="stl").up == "+Z"
    standing = {reader.name for reader in registry.readers() if reader.up == "+Z"}
    assert standing >= {"3mf", "asc", "iges", "step", "stl"}
