"""Paths that are none, folders, FIFOs and devices; what a replaced file leaves to the new one."""

import errno
import os
import stat
import sys
import threading

import numpy as np
import pytest
from missing_here import needs_full_device
from plain_picture import render

import engine3d as e3d
from engine3d.base.files.atomic_write import atomic_write
from engine3d.errors import FileAccessError
from engine3d.io.output.animation_files import save_animation
from engine3d.loaders import load_document, load_mesh, load_texture


def save_frame(path):
    scene = e3d.Scene()
    scene.add(e3d.box())
    render(scene, size=(8, 8)).save(path)


def save_mesh(path):
    mesh = e3d.box()
    pixels = np.zeros((2, 2, 3), np.uint8)
    mesh.materials = [e3d.Material(name="paint", texture=e3d.Texture(pixels))]
    mesh.save(path)


SAVES = {
    ".png": save_frame,
    ".obj": save_mesh,
    ".ply": save_mesh,
    ".stl": save_mesh,
    ".gif": lambda path: save_animation(np.zeros((2, 4, 4, 4), np.uint8), path, 0.1),
}
PATHS = ["zero\0byte", "x" * 300, "folder", "nowhere/a", "file/a", "loop", "\N{GRINNING FACE}" * 70]


@pytest.fixture
def odd_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    for suffix in (*SAVES, ""):
        (tmp_path / f"folder{suffix}").mkdir()
        (tmp_path / f"loop{suffix}").symlink_to(f"loop{suffix}")
    return tmp_path


@pytest.mark.parametrize("suffix", SAVES)
@pytest.mark.parametrize("path", PATHS, ids=lambda path: ascii(path)[:12])
def test_paths_that_cannot_be_written(odd_folder, path, suffix):
    before = sorted(os.listdir())
    with pytest.raises(FileAccessError, match="cannot write: ") as caught:
        SAVES[suffix](path + suffix)
    assert str(caught.value).isprintable()
    assert sorted(os.listdir()) == before


@pytest.mark.parametrize("path", PATHS, ids=lambda path: ascii(path)[:12])
def test_paths_that_cannot_be_read(odd_folder, path):
    resources = e3d.resources.Resources()
    for load in (load_mesh, load_document, load_texture, e3d.load_scene, resources.load_mesh):
        with pytest.raises(FileAccessError, match="cannot read: "):
            load(path)


def test_a_name_of_letters_that_take_many_bytes(tmp_path):
    """The temporary name must not be longer than a file system takes."""
    name = "\N{GRINNING FACE}" * 61 + ".ply"
    e3d.box().save(tmp_path / name)
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize("suffix", SAVES)
def test_a_fifo_that_nobody_reads(tmp_path, suffix):
    path = tmp_path / f"fifo{suffix}"
    os.mkfifo(path)
    with pytest.raises(FileAccessError, match="cannot write: a FIFO that nobody reads"):
        SAVES[suffix](path)
    assert stat.S_ISFIFO(path.stat().st_mode)


def test_a_fifo_with_a_reader(tmp_path):
    """Slower than the writer, and of more bytes than a FIFO holds."""
    path = tmp_path / "fifo.ply"
    os.mkfifo(path)
    mesh = e3d.uv_sphere(segments=(128, 64))
    mesh.save(tmp_path / "file.ply")
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    os.set_blocking(handle, True)
    read = []

    def drain():
        with os.fdopen(handle, "rb") as file:
            read.append(file.read())

    reader = threading.Thread(target=drain)
    with atomic_write(path) as file:
        reader.start()
        file.write((tmp_path / "file.ply").read_bytes())
    reader.join()
    assert read[0] == (tmp_path / "file.ply").read_bytes()
    assert len(read[0]) > 1 << 16


@needs_full_device
def test_a_device(tmp_path):
    with pytest.raises(FileAccessError, match=os.strerror(errno.ENOSPC)):
        with atomic_write("/dev/full") as file:
            file.write(b"x")
    with atomic_write("/dev/null") as file:
        file.write(b"x")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such permissions")
@pytest.mark.parametrize("mode", [0o4755, 0o2755, 0o6711, 0o1644])
def test_bits_that_let_a_file_run_as_another_user_are_dropped(tmp_path, mode):
    path = tmp_path / "a.ply"
    path.touch()
    path.chmod(mode)
    e3d.box().save(path)
    assert stat.S_IMODE(path.stat().st_mode) == mode & 0o777


def test_the_bytes_are_on_the_disk_before_the_name(tmp_path, monkeypatch):
    done = []
    sync, replace = os.fsync, os.replace

    def synced(handle):
        done.append(os.fstat(handle).st_size)
        sync(handle)

    def replaced(old, new):
        done.append(os.path.basename(new))
        replace(old, new)

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(os, "replace", replaced)
    save_mesh(tmp_path / "a.obj")
    sizes = [(tmp_path / name).stat().st_size for name in ("a_0.png", "a.mtl", "a.obj")]
    assert done[:6] == [*sizes, "a_0.png", "a.mtl", "a.obj"]
    assert len(done) == 6 + hasattr(os, "O_DIRECTORY")  # and then the folder's names
