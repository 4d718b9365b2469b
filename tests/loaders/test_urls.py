"""Files at addresses: what they name is read beside them, and nothing else."""

import gzip
import itertools
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.io.addresses import linked_urls, url_names, urls

fsspec = pytest.importorskip("fsspec", exc_type=ImportError)

OBJ = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
_numbers = itertools.count()


@pytest.fixture
def put():
    """Return a function that writes a file into a folder in memory, and returns its address."""
    top = f"memory://models{next(_numbers)}"

    def write(name, content):
        with fsspec.open(f"{top}/{name}", "wb") as file:
            file.write(content)
        return f"{top}/{name}"

    return write


def png(color):
    return e3d.render(e3d.Scene(background=color), size=(2, 2), look="plain").encode("png")


def test_a_model_is_read_with_the_files_beside_it(put):
    url = put("a.obj", OBJ)
    put("a.mtl", b"newmtl m\nmap_Kd maps\\Red%20one.png\n")
    put("maps/Red one.png", png("red"))
    mesh = e3d.load_mesh(url)
    assert mesh.name == "a" and mesh.warnings == []
    assert mesh.materials[0].texture.pixels[0, 0].tolist() == [255, 0, 0, 255]
    assert e3d.render(url, size=(8, 6)).color.shape == (6, 8, 4)
    assert len(e3d.load(url).nodes) == 1


def test_files_named_by_a_library_may_lie_beside_the_library(put):
    url = put("a.obj", OBJ.replace(b"a.mtl", b"lib/a.mtl"))
    put("lib/a.mtl", b"newmtl m\nmap_Kd red.png\n")
    put("lib/red.png", png("red"))
    assert e3d.load_mesh(url).materials[0].texture is not None


@pytest.mark.parametrize(
    "name", ["../secret.png", "/secret.png", "memory://secret.png", "file:///etc/hostname", "a::b"]
)
def test_names_that_lead_out_are_refused(put, name, monkeypatch):
    url = put("inner/a.obj", OBJ)
    put("secret.png", png("red"))
    put("inner/a.mtl", f"newmtl m\nmap_Kd {name}\n".encode())
    asked = []

    def ask(address, real=urls.is_file_at):
        asked.append(address)
        return real(address)

    monkeypatch.setattr(linked_urls, "is_file_at", ask)
    with pytest.warns(e3d.Engine3DWarning):
        mesh = e3d.load_mesh(url)
    assert mesh.materials[0].texture is None
    assert all(each.startswith(url_names.folder_of(url)) and ".." not in each for each in asked)


def test_a_root_on_the_disk_may_hold_the_rest(put, tmp_path):
    url = put("a.obj", OBJ)
    (tmp_path / "a.mtl").write_bytes(b"newmtl m\nKd 1 0 0\n")
    assert e3d.load_mesh(url, root=tmp_path).materials[0].name == "m"


def test_a_missing_file_is_a_warning_and_a_missing_model_an_error(put):
    with pytest.warns(e3d.Engine3DWarning, match="a.mtl"):
        assert len(e3d.load_mesh(put("a.obj", OBJ)).faces) == 1
    with pytest.raises(e3d.FileAccessError, match="^memory://none/a.obj: cannot read: there is no"):
        e3d.load_mesh("memory://none/a.obj")


def test_compressed_files_textures_and_environments(put):
    plain = OBJ.replace(b"mtllib a.mtl\n", b"").replace(b"usemtl m\n", b"")
    assert len(e3d.load_mesh(put("a.obj.gz", gzip.compress(plain))).faces) == 1
    texture = e3d.load_texture(put("a.png", png("blue")))
    assert texture.name == "a.png" and texture.pixels[0, 0].tolist() == [0, 0, 255, 255]
    picture = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([9, 9, 9, 128] * 2)
    assert e3d.Environment.load(put("a.hdr", picture)).path is None


def test_a_saved_scene_holds_what_was_fetched(put, tmp_path):
    scene = e3d.load_scene(put("b.obj", OBJ.replace(b"mtllib a.mtl\n", b"")))
    e3d.save_scene(scene, tmp_path / "a.e3d.json")
    again = e3d.load_mesh(tmp_path / "a.e3d.json")
    assert np.array_equal(again.positions, e3d.load_mesh(OBJ, format="obj").positions)


def test_limits_on_size_hold(put, monkeypatch, capsys, tmp_path):
    url = put("a.obj", b"v 0 0 0\n" * 200_000)
    out = ["-o", str(tmp_path / "a.png")]
    assert main(["render", url, "--max-size", "1", *out]) == 1
    assert "1.5 MiB are more than --max-size 1" in capsys.readouterr().err
    monkeypatch.setattr(urls, "MAX_FETCHED", 1000)
    with pytest.raises(e3d.FileFormatError, match="a.obj: has more than 1000 bytes, the limit"):
        e3d.load_mesh(url)
    monkeypatch.setattr(urls, "MAX_FETCHED", 1 << 30)
    bomb = put("b.obj.gz", gzip.compress(bytes(100 << 20)))
    with pytest.raises(e3d.FileFormatError, match="unpacks to more than"):
        e3d.load_mesh(bomb)


def test_without_fsspec_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "fsspec.core", None)
    for url in ("https://host/a.obj", "s3://bucket/a.obj"):
        with pytest.raises(
            e3d.FileAccessError, match=r"^\w+://.*: .*pip install 'engine3d\[url\]'"
        ):
            e3d.load(url)


def test_an_unknown_protocol_is_told():
    with pytest.raises(e3d.FileAccessError, match=r"nowhere://a\.obj: cannot read: .*nowhere"):
        e3d.load_mesh("nowhere://a.obj")


@pytest.mark.parametrize(
    ("url", "file", "folder", "other"),
    [
        ("s3://b/m/a.obj", "s3://b/m/a.obj", "s3://b/m/", "s3://b/m/c"),
        ("https://h/m/a.obj?k=1#x", "https://h/m/a.obj", "https://h/m/", "https://h/m/c"),
        ("zip://m/a.obj::s3://b/z.zip", "zip://m/a.obj", "zip://m/", "zip://m/c::s3://b/z.zip"),
        ("zip://a.obj::/tmp/z.zip", "zip://a.obj", "zip://", "zip://c::/tmp/z.zip"),
        ("cached::s3://b/a.obj", "cached::s3://b/a.obj", "cached::s3://b/", "cached::s3://b/c"),
    ],
)
def test_the_parts_of_addresses(url, file, folder, other):
    assert url_names.is_url(url) and url_names.file_part(url) == file
    assert url_names.folder_of(url) == folder
    assert url_names.beside(url, folder, "c") == other


@pytest.mark.parametrize("path", ["a.obj", "/a/b.obj", "C:\\a.obj", "C://a.obj", "a::b", "://x"])
def test_paths_are_no_addresses(path):
    assert not url_names.is_url(path) and url_names.file_part(path) == path


def test_a_model_in_an_archive_is_read_with_the_files_beside_it(tmp_path):
    import zipfile

    with zipfile.ZipFile(tmp_path / "z.zip", "w") as archive:
        archive.writestr("a.obj", OBJ)
        archive.writestr("a.mtl", "newmtl m\nmap_Kd red.png\n")
        archive.writestr("red.png", png("red"))
    mesh = e3d.load_mesh(f"zip://a.obj::{tmp_path}/z.zip")
    assert mesh.materials[0].texture is not None and mesh.warnings == []
