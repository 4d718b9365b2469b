"""What can be loaded: paths, bytes, file objects, and all of them compressed."""

import contextlib
import errno
import gzip
import io
import os
import tracemalloc
import warnings
import zipfile

import numpy as np
import pytest
from loaders.seeds import FILES
from missing_here import open_files

from engine3d.errors import Engine3DWarning, FileAccessError, FileFormatError, InvalidArgumentError
from engine3d.io.loaders import load_document, load_mesh, load_texture
from engine3d.io.reading import sources

OBJ = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
MTL = b"newmtl red\nKd 1 0 0\n"
PPM = b"P6 1 1 255 \x01\x02\x03"


def quietly(*arguments, **options):
    with pytest.warns(UserWarning, match="not looked for"):
        return load_mesh(*arguments, **options)


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview, io.BytesIO])
def test_content_without_a_name(kind, tmp_path, monkeypatch, write):
    write("a.mtl", MTL)
    monkeypatch.chdir(tmp_path)
    mesh = quietly(kind(OBJ))
    assert len(mesh.faces) == 1
    assert mesh.name == ""
    assert mesh.materials[0].color == (1, 1, 1)


def test_a_file_object_knows_its_folder(write):
    write("a.mtl", MTL)
    with open(write("a.obj", OBJ), "rb") as file:
        mesh = load_mesh(file)
    assert mesh.name == "a"
    assert mesh.materials[0].color == (1, 0, 0)


@pytest.mark.parametrize("name", ["a.obj.gz", "a.OBJ.GZ", "a.obj", "a.gz"])
def test_compressed_files(write, name):
    write("a.mtl", gzip.compress(MTL))
    mesh = load_mesh(write(name, gzip.compress(OBJ[:40]) + gzip.compress(OBJ[40:]) + bytes(9)))
    assert mesh.name == "a"
    assert mesh.materials[0].color == (1, 0, 0)
    assert load_document(write(name, gzip.compress(OBJ))).objects[0].name == "a"


def test_a_compressed_model_finds_its_image(write):
    write("a_diffuse.ppm", PPM)
    content = OBJ.replace(b"mtllib a.mtl\n", b"vt 0 0\n").replace(b"f 1", b"f 1/1")
    assert load_mesh(write("a.obj.gz", gzip.compress(content))).materials[0].texture is not None


def test_textures(write):
    for content in (PPM, io.BytesIO(PPM), gzip.compress(PPM), write("a.ppm", PPM)):
        assert load_texture(content, format="ppm").pixels[0, 0].tolist() == [1, 2, 3, 255]
    assert load_texture(write("b.ppm", PPM)).name == "b.ppm"


def test_the_format_may_be_named(write):
    path = write("a.xyz", b"OFF 3 0 0\n0 0 0\n1 0 0\n0 1 0\n")
    assert len(load_mesh(path, format="off").points) == 3
    assert len(load_mesh(path, format=".OFF").points) == 3
    with pytest.raises(FileFormatError, match="no vertices"):
        load_mesh(path, format="obj")
    with pytest.raises(
        InvalidArgumentError, match=r"format='tga' is no mesh format \(known: 3mf, asc"
    ):
        load_mesh(path, format="tga")


def test_what_is_no_file():
    with pytest.raises(InvalidArgumentError, match="not a path, bytes or a file object: int"):
        load_mesh(3)
    with pytest.raises(InvalidArgumentError, match="binary mode"):
        load_mesh(io.StringIO("v 0 0 0"))
    closed = io.BytesIO()
    closed.close()
    with pytest.raises(FileAccessError, match="<BytesIO>: cannot read"):
        load_mesh(closed)


@pytest.mark.parametrize("cut", [3, 8, 30, -9, -1])
def test_damaged_compression(write, cut):
    with pytest.raises(FileFormatError, match=r"a\.obj\.gz: .*(cut off|damaged)"):
        load_mesh(write("a.obj.gz", gzip.compress(OBJ)[:cut]))
    broken = bytearray(gzip.compress(OBJ))
    broken[20] ^= 0xFF
    with pytest.raises(FileFormatError):
        load_mesh(write("a.obj.gz", bytes(broken)))


def test_many_members():
    """What is behind a member's end is not copied whole for each: that took minutes."""
    empty = gzip.compress(b"")
    data = empty * 50_000 + gzip.compress(OBJ[:40]) + gzip.compress(OBJ[40:])
    assert len(quietly(data).faces) == len(quietly(OBJ).faces)


def test_more_than_a_piece_at_a_time():
    """Members larger than what is unpacked, and than what is fed, at a time."""
    noise = b"".join(b"# %d\n" % (k * 2654435761 % 2**32) for k in range(100_000))
    members = [gzip.compress(part, 1) for part in (noise + OBJ[:40], OBJ[40:] + noise)]
    assert len(members[0]) > 4 * sources._PACKED_PIECE
    assert len(quietly(b"".join(members), format="obj").faces) == len(quietly(OBJ).faces)


def test_a_bomb_is_refused_before_it_is_unpacked(write, monkeypatch):
    path = write("a.obj.gz", gzip.compress(bytes(200 << 20)))
    tracemalloc.start()
    try:
        with pytest.raises(FileFormatError, match="unpacks to more than"):
            load_mesh(path)
        assert tracemalloc.get_traced_memory()[1] < 64 << 20
    finally:
        tracemalloc.stop()
    monkeypatch.setattr(sources, "MAX_UNPACKED_BASE", 0)
    with contextlib.suppress(UserWarning), pytest.raises(FileFormatError, match="unpacks to more"):
        load_mesh(gzip.compress(OBJ + b"v 0 0 0\n" * 100_000))


def test_what_is_read_is_the_same(write):
    whole = quietly(OBJ)
    packed = quietly(gzip.compress(OBJ))
    assert np.array_equal(whole.positions, packed.positions)


@pytest.mark.parametrize("name", ["a.obj", "a.ply", "binary.ply", "a.stl", "binary.stl", "a.off"])
@pytest.mark.parametrize("piece", [1, 150])
def test_large_files_are_read_piece_by_piece(write, monkeypatch, name, piece):
    """They give what small ones give, sound or cut off, and are closed whatever happens."""
    content = FILES.get(name, OBJ)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for length in (len(content), len(content) - 3):
            path = write(name, content[:length])
            expected = outcome(path)
            with monkeypatch.context() as patch:
                patch.setattr(sources, "_LARGE", 0)
                patch.setattr(sources, "_PIECE", piece)
                before = open_files()
                assert outcome(path) == expected
                assert open_files() == before


def outcome(path):
    try:
        mesh = load_mesh(path)
    except FileFormatError as error:
        return str(error)
    return mesh.positions.tobytes(), mesh.faces.tobytes(), mesh.warnings


def test_a_folder_is_one_where_the_system_only_says_that_it_is_forbidden(tmp_path, monkeypatch):
    def forbidden(*_arguments):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    monkeypatch.setattr(os, "open", forbidden)
    for path, reason in ((tmp_path, "Is a directory"), (tmp_path / "a.obj", "Permission denied")):
        with pytest.raises(FileAccessError, match=f"cannot read: {reason}"):
            load_mesh(path)


@pytest.mark.parametrize("name", ["binary.ply", "binary.stl"])
def test_a_file_that_becomes_shorter(write, monkeypatch, name):
    path = write(name, FILES[name])
    source = sources.read_source(path)
    monkeypatch.setattr(sources, "_LARGE", 0)
    with sources.read_source(path) as large:
        assert large.head(20) == source.data[:20]
        assert large.size == len(FILES[name])
        os.truncate(path, 40)
        with pytest.raises(FileAccessError, match="became shorter"):
            list(large.pieces(0, 10, 5))


def test_resources_in_archives(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("models/a.obj", OBJ)
    folder = zipfile.Path(tmp_path / "a.zip") / "models"
    with pytest.warns(Engine3DWarning, match="a.mtl"):
        mesh = load_mesh(folder / "a.obj")
    assert len(mesh.faces) == 1
    assert mesh.name == "a"
    for name in ("b.obj", ""):
        with pytest.raises(FileAccessError, match="cannot read"):
            load_mesh(folder / name)
