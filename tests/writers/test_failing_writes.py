"""Full disks, folders that cannot be written to, signals in the middle: what was there stays.

Every writer of the package tries to replace files. Whatever goes wrong, the folder holds afterwards
exactly what it held before, or (after SIGKILL, which nobody can answer) a temporary file besides.
"""

import contextlib
import errno
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest
from missing_here import KILL, is_superuser, needs_full_device
from patience import HUNG
from plain_picture import render

import engine3d as e3d
from engine3d.errors import FileAccessError
from engine3d.io.output.animation_files import save_animation

BEFORE = b"what was there before"
LIMIT = 64  # bytes: less than any of these files
FILLED = 1 << 16


def a_mesh():
    """With a texture, so that an OBJ file needs a library and an image."""
    pixels = np.random.default_rng(0).integers(0, 255, (16, 16, 4), np.uint8)
    mesh = e3d.box()
    mesh.materials = [e3d.Material(name="paint", texture=e3d.Texture(pixels))]
    return mesh


def save_mesh(path):
    a_mesh().save(path)


def save_frame(path):
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere())
    render(scene, size=(64, 48)).save(path)


def save_turntable(path):
    noise = np.random.default_rng(0).integers(0, 255, (3, 32, 32, 4), np.uint8)
    save_animation(noise, path, 0.1)


WRITERS = {
    **{f"frame.{suffix}": save_frame for suffix in ("png", "jpg", "tga", "webp")},
    **{f"turntable.{suffix}": save_turntable for suffix in ("gif", "webp", "apng")},
    **{f"mesh.{suffix}": save_mesh for suffix in ("obj", "ply", "stl")},
}
every_writer = pytest.mark.parametrize("name", WRITERS)


def prepare(folder, name):
    """Put old files where new ones would go; returns the path to write to."""
    old = {name: BEFORE}
    if name == "mesh.obj":
        # Others' files would not be replaced.
        old |= {"mesh.mtl": b"# written by engine3d\nmap_Kd mesh_0.png\n", "mesh_0.png": BEFORE}
    for file, content in old.items():
        (folder / file).write_bytes(content)
    return folder / name


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def check_failure(folder, name, reason):
    """The error names a file and the reason, and nothing changed."""
    path, before = prepare(folder, name), contents(folder)
    with pytest.raises(FileAccessError) as caught:
        yield path
    text = str(caught.value)
    assert text.startswith(str(folder / path.stem))
    assert text.endswith(f"cannot write: {os.strerror(reason)}")
    assert contents(folder) == before


fails = contextlib.contextmanager(check_failure)


@contextlib.contextmanager
def files_may_hold(size):
    """No file may grow over so many bytes; nor does Python then leave a cut-off .pyc behind."""
    resource = pytest.importorskip("resource", reason="limits of POSIX")
    limits, writes = resource.getrlimit(resource.RLIMIT_FSIZE), sys.dont_write_bytecode
    sys.dont_write_bytecode = True
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        sys.dont_write_bytecode = writes


@every_writer
def test_a_file_that_may_not_grow(tmp_path, name):
    with fails(tmp_path, name, errno.EFBIG) as path, files_may_hold(LIMIT):
        WRITERS[name](path)


@pytest.fixture(scope="module")
def full_disk(tmp_path_factory):
    """A folder on a file system of its own, with hardly any room left."""
    folder = tmp_path_factory.mktemp("full")
    command = ["mount", "-t", "tmpfs", "-o", f"size={FILLED}", "tmpfs", str(folder)]
    try:
        subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"needs to mount a small tmpfs, as root may: {error}")
    yield folder
    subprocess.run(["umount", "-l", str(folder)], check=True)


@every_writer
def test_a_full_disk(full_disk, name):
    for path in full_disk.iterdir():
        path.unlink()
    prepare(full_disk, name)
    with (full_disk / "filler").open("wb") as file, contextlib.suppress(OSError):
        while True:
            os.write(file.fileno(), bytes(1024))
    with fails(full_disk, name, errno.ENOSPC) as path:
        WRITERS[name](path)


def test_the_last_file_of_several_fails(tmp_path):
    """There is room for the library and the image of an OBJ file, but not for itself."""
    mesh = e3d.uv_sphere(segments=(64, 32))
    mesh.materials = a_mesh().materials
    with fails(tmp_path, "mesh.obj", errno.EFBIG) as path, files_may_hold(1 << 15):
        mesh.save(path)


@contextlib.contextmanager
def read_only_folder():
    """A folder that this process cannot write to, not even as root."""
    with tempfile.TemporaryDirectory() as name:
        folder, is_root = Path(name), is_superuser()
        yield folder, lambda: folder.chmod(0o555)
        if is_root:
            os.seteuid(0)
        folder.chmod(0o755)


@pytest.mark.skipif(sys.platform == "win32", reason="folders of Windows have no such bit")
@every_writer
def test_a_folder_that_cannot_be_written_to(name):
    with read_only_folder() as (folder, close):
        with fails(folder, name, errno.EACCES) as path:
            close()
            if is_superuser():
                os.seteuid(65534)
            try:
                WRITERS[name](path)
            finally:
                with contextlib.suppress(PermissionError):
                    os.seteuid(0)


# ---- signals ----

# The signal comes when all is written, and nothing has its name yet.
STOPPED = """
import os, signal, sys
if signal.getsignal(int(sys.argv[1])) == signal.SIG_IGN:  # the tests run under nohup
    signal.signal(int(sys.argv[1]), signal.SIG_DFL)
from engine3d.base.files import atomic_write
from engine3d.apps.cli import main
finish = atomic_write._Part.finish
def stop(part):
    part.file.flush()
    if sys.argv[2] == "killed":
        os.kill(os.getpid(), int(sys.argv[1]))
    signal.raise_signal(int(sys.argv[1]))
    finish(part)
atomic_write._Part.finish = stop
sys.exit(main(sys.argv[3:]))
"""
SMALL = ["--size", "48x32"]
COMMANDS = {
    "out.png": ["render", "--scene", "shapes", *SMALL, "-o", "out.png"],
    "out.gif": ["render", "--scene", "shapes", *SMALL, "--turntable", "2", "-o", "out.gif"],
    "run.gif": ["run", "--headless", "--frames", "2", *SMALL, "-o", "run.gif"],
    "mesh.obj": ["convert", "model.obj", "mesh.obj"],
    "out.ply": ["convert", "model.obj", "out.ply"],
    "out.stl": ["city", "out.stl", "--triangles", "20000"],
    "out.json": ["bench", "--workloads", "mesh", "--seconds", "0.01", *SMALL, "--json", "out.json"],
}


@pytest.mark.parametrize("name", COMMANDS)
def test_a_process_is_killed_in_the_middle(tmp_path, name):
    returncode, _, before, after = stopped(tmp_path, name, KILL, "killed")
    assert returncode == (KILL if sys.platform == "win32" else -KILL)
    assert {name: after[name] for name in after if not name.endswith(".part")} == before


ASKED = [(name, "SIGTERM") for name in COMMANDS]
ASKED += [("out.png", "SIGINT"), ("mesh.obj", "SIGINT"), ("out.png", "SIGHUP")]
ASKED += [("out.png", "SIGBREAK")]


@pytest.mark.parametrize(("name", "asked"), ASKED)
def test_a_signal_in_the_middle(tmp_path, name, asked):
    number = getattr(signal, asked, None) or pytest.skip("no signal of this system")
    returncode, said, before, after = stopped(tmp_path, name, number, "asked")
    assert returncode == 128 + number
    assert b"Traceback" not in said
    assert after == before


def stopped(folder, name, number, how):
    """Stop a command; return its status, what it said, and what was in the folder before, after."""
    a_mesh().save(folder / "model.obj")
    prepare(folder, name)
    before = contents(folder)
    done = subprocess.run(
        [sys.executable, "-c", STOPPED, str(int(number)), how, *COMMANDS[name]],
        cwd=folder,
        capture_output=True,
        timeout=HUNG,
    )
    return done.returncode, done.stderr, before, contents(folder)


@needs_full_device
@pytest.mark.parametrize(
    "arguments", [["info", "model.obj"], ["render", "model.obj", *SMALL, "-o", "-"]]
)
def test_standard_output_on_a_full_disk(tmp_path, arguments):
    a_mesh().save(tmp_path / "model.obj")
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "engine3d", *arguments],
            cwd=tmp_path,
            stdout=full,
            stderr=subprocess.PIPE,
            timeout=HUNG,
        )
    assert done.returncode == 1
    assert done.stderr.decode().startswith("engine3d: error: ")
    assert done.stderr.decode().endswith(f"{os.strerror(errno.ENOSPC)}\n")
