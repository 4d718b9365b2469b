"""What is loaded twice is stored once; what changed on disk is loaded again when asked for."""

import gc
import os
import sys
import time

import numpy as np
import pytest
from PIL import Image
from plain_picture import Renderer

import engine3d as e3d
from engine3d.base.files.stamps import FileStamp

OBJ = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "m.obj").write_text(OBJ)
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd t.png\n")
    paint(tmp_path / "t.png", 200)
    return tmp_path


def paint(path, grey):
    Image.fromarray(np.full((4, 4, 3), grey, np.uint8)).save(path)
    stamp(path)


def stamp(path):
    """Give a file a later time than it had, whatever the clock's steps are."""
    stamp.later = getattr(stamp, "later", 0) + 10**9
    time = os.stat(path).st_mtime_ns + stamp.later
    os.utime(path, ns=(time, time))


def test_one_path_one_object(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    assert resources.load_mesh(str(folder / "." / "m.obj")) is mesh
    texture = resources.load_texture(folder / "t.png")
    assert resources.load_texture(folder / "t.png", filter="nearest") is not texture
    assert mesh.materials[0].texture is texture
    assert resources.stats.shared == 2


def test_one_content_one_object(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    (folder / "copy.obj").write_text("# the same\n" + OBJ)
    assert resources.load_mesh(folder / "copy.obj") is mesh
    assert resources.share(e3d.load_mesh(folder / "m.obj")) is mesh
    one = resources.share(e3d.box())
    assert resources.share(e3d.box()) is one
    assert resources.share(e3d.box((1, 1, 2))) is not one
    red = e3d.box()
    red.materials = [e3d.Material(color=(1, 0, 0))]
    assert resources.share(red) is red


def test_counts_and_sizes(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    resources.load_mesh(folder / "m.obj")
    stats = resources.stats
    assert (stats.meshes, stats.textures, stats.loads, stats.shared) == (1, 1, 2, 1)
    assert stats.texture_bytes == 4 * 4 * 4
    assert stats.mesh_bytes >= mesh.positions.nbytes + mesh.faces.nbytes + mesh.uvs.nbytes


def test_what_nobody_holds_is_let_go(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    texture = mesh.materials[0].texture
    del mesh
    gc.collect()
    assert resources.stats[:2] == (0, 1)
    del texture
    gc.collect()
    assert resources.stats[:4] == (0, 0, 0, 0)
    assert resources.reload_changed() == ()


def test_what_was_changed_is_not_shared_any_more(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    mesh.positions = mesh.positions * 2
    other = resources.load_mesh(folder / "m.obj")
    assert other is not mesh
    assert other.positions.max() == 1
    box = resources.share(e3d.box())
    box.materials[0].color = (0, 1, 0)
    assert resources.share(e3d.box()) is not box


def test_files_that_changed_are_loaded_again(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    texture = resources.load_texture(folder / "t.png")
    scene = e3d.Scene(ambient=(1, 1, 1))
    scene.add(mesh)
    camera = e3d.OrthographicCamera(1.0), e3d.look_at((0.3, 0.3, 2), (0.3, 0.3, 0))
    with Renderer((16, 16)) as renderer:
        assert resources.reload_changed() == ()
        before = renderer.render(scene, camera).color
        paint(folder / "t.png", 60)
        path = os.path.realpath(folder)
        assert set(resources.reload_changed()) == {
            os.path.join(path, name) for name in ("m.obj", "t.png")
        }
        assert resources.reload_changed() == ()
        after = renderer.render(scene, camera).color
        assert texture.pixels[0, 0, 0] == 60
        assert mesh.materials[0].texture.pixels[0, 0, 0] == 60
        assert (after != before).any()
        (folder / "m.obj").write_text(OBJ.replace("v 1 0 0", "v 5 0 0"))
        stamp(folder / "m.obj")
        assert resources.reload_changed() == (os.path.join(path, "m.obj"),)
        assert mesh.positions.max() == 5
        assert scene.bounds[1, 0] == 5


@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps no time of changes")
@pytest.mark.parametrize("name", ["m.obj", "m.mtl", "t.png"])
def test_a_change_that_keeps_size_and_time_is_found(folder, name):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    path = folder / name
    status, content = os.stat(path), path.read_bytes()
    time.sleep(0.05)  # longer than the clock's steps
    path.write_bytes(content)
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert resources.reload_changed() == (os.path.realpath(folder / "m.obj"),)
    assert mesh.positions.max() == 1


@pytest.mark.parametrize("name", ["m.obj", "m.mtl", "t.png"])
def test_permissions_and_links_are_no_change(folder, name):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    time.sleep(0.05)  # longer than the clock's steps
    (folder / name).chmod(0o600)
    assert resources.reload_changed() == ()
    os.link(folder / name, folder / "link")
    assert resources.reload_changed() == ()
    os.remove(folder / "link")
    assert resources.reload_changed() == ()
    (folder / "m.obj").write_text(OBJ.replace("v 1 0 0", "v 5 0 0"))
    assert len(resources.reload_changed()) == 1
    assert mesh.positions.max() == 5


def test_a_change_within_a_step_of_the_clock_is_found(folder, monkeypatch):
    """Once the step is over, by the content: the stamp is that of before."""
    monkeypatch.setattr(
        "engine3d.base.files.stamps.file_stamp",
        lambda path: FileStamp(1, 1, stamp.now, stamp.now, ()),
    )
    stamp.now = time.time_ns()
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    (folder / "m.obj").write_text(OBJ.replace("v 1 0 0", "v 4 0 0"))
    assert resources.reload_changed() == ()
    now = stamp.now + 10 * 10**9
    monkeypatch.setattr("engine3d.base.files.stamps.time.time_ns", lambda: now)
    assert len(resources.reload_changed()) == 1
    assert mesh.positions.max() == 4
    assert resources.reload_changed() == ()


def test_a_change_while_a_file_is_read_is_found(folder, monkeypatch):
    read = e3d.load_mesh

    def read_what_changes(path):
        mesh = read(path)
        (folder / "m.obj").write_text(OBJ.replace("v 1 0 0", "v 40 0 0"))
        return mesh

    monkeypatch.setattr("engine3d.io.resources.load_mesh", read_what_changes)
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    assert len(resources.reload_changed()) == 1
    assert mesh.positions.max() == 40


def test_damaged_files_leave_what_is_there(folder):
    resources = e3d.resources.Resources()
    mesh = resources.load_mesh(folder / "m.obj")
    (folder / "m.obj").write_text(OBJ + "f 1 2 99\n")
    stamp(folder / "m.obj")
    with pytest.warns(e3d.Engine3DWarning, match="not loaded again"):
        assert resources.reload_changed() == ()
    assert mesh.positions.max() == 1
    os.remove(folder / "m.obj")
    with pytest.warns(e3d.Engine3DWarning, match="not loaded again"):
        assert resources.reload_changed() == ()
    (folder / "m.obj").write_text(OBJ.replace("v 1 0 0", "v 3 0 0"))
    assert len(resources.reload_changed()) == 1
    assert mesh.positions.max() == 3


def test_arguments(tmp_path):
    with pytest.raises(e3d.InvalidArgumentError, match="Mesh or Texture"):
        e3d.resources.Resources().share(3)
    with pytest.raises(e3d.FileAccessError):
        e3d.resources.Resources().load_mesh(tmp_path / "none.obj")


@pytest.mark.parametrize("path", [None, 3, OBJ.encode()])
def test_only_paths_are_loaded(path):
    with pytest.raises(e3d.InvalidArgumentError, match="by their paths"):
        e3d.resources.Resources().load_mesh(path)


def test_what_is_held_is_listed_with_its_users(folder):
    resources = e3d.resources.Resources()
    ball = resources.load_mesh(folder / "m.obj")
    texture = ball.materials[0].texture
    own = resources.share(e3d.Mesh([[0, 0, 0]], points=[0], name="own"))
    resources.load_mesh(folder / "m.obj")
    scene, other = e3d.Scene(), e3d.Scene()
    for _ in range(3):
        scene.add(ball)
    gone = scene.add(ball)
    scene.add(e3d.InstancedMesh(ball, [(0, 0, 0, 1)]))
    other.add(own)
    scene.remove(gone)
    listed = {entry.thing: entry for entry in resources.listed(scene, other)}
    assert len(listed) == len(resources.listed()) == 3
    assert [listed[thing].kind for thing in (ball, texture, own)] == ["mesh", "texture", "mesh"]
    assert [listed[thing].users for thing in (ball, texture, own)] == [4, 4, 1]
    assert listed[ball].path == str((folder / "m.obj").resolve()) and listed[own].path is None
    assert listed[own].size == own.positions.nbytes + own.points.nbytes
    assert listed[texture].size == texture.pixels.nbytes
    assert resources.listed()[0].users == 0
    assert resources.find("own") is own and resources.find("none") is None
    assert resources.find(listed[ball].name) is ball
    stats = resources.stats
    assert stats.mesh_bytes == listed[ball].size + listed[own].size
