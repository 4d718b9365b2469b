"""Files appear whole or not at all, and keep their permissions."""

import ast
import os
import stat
import sys
from pathlib import Path

import pytest

import engine3d as e3d
from engine3d.base.files import atomic_write as module
from engine3d.base.files.atomic_write import atomic_write
from engine3d.base.files.making_folders import make_folder_of
from engine3d.errors import FileAccessError


def test_the_file_appears_whole(tmp_path):
    path = tmp_path / "out.bin"
    with atomic_write(path) as file:
        file.write(b"abc")
        assert not path.exists()
    assert path.read_bytes() == b"abc"
    assert os.listdir(tmp_path) == ["out.bin"]


def test_a_failure_leaves_what_was_there(tmp_path):
    path = tmp_path / "out.bin"
    path.write_bytes(b"before")
    with pytest.raises(KeyboardInterrupt), atomic_write(path) as file:
        file.write(b"half")
        raise KeyboardInterrupt
    assert path.read_bytes() == b"before"
    assert os.listdir(tmp_path) == ["out.bin"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such permissions")
def test_permissions_are_those_of_the_old_file_or_of_the_umask(tmp_path):
    new, old = tmp_path / "new", tmp_path / "old"
    old.write_bytes(b"")
    old.chmod(0o640)
    for path in (new, old):
        with atomic_write(path) as file:
            file.write(b"x")
    umask = os.umask(0)
    os.umask(umask)
    assert stat.S_IMODE(new.stat().st_mode) == 0o666 & ~umask
    assert stat.S_IMODE(old.stat().st_mode) == 0o640


def test_a_symbolic_link_keeps_pointing_to_the_file_that_is_replaced(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(b"")
    link.symlink_to(target)
    with atomic_write(link) as file:
        file.write(b"x")
    assert link.is_symlink()
    assert target.read_bytes() == b"x"


def test_a_missing_folder_is_a_clear_error(tmp_path):
    path = tmp_path / "missing" / "out.bin"
    with pytest.raises(FileAccessError, match=r"missing[/\\]out\.bin: cannot write: No such file"):
        with atomic_write(path):
            pass


def test_a_device_is_written_to_directly():
    with atomic_write(os.devnull) as file:
        file.write(b"x")


def test_an_exception_of_the_caller_passes_through(tmp_path):
    with pytest.raises(ZeroDivisionError), atomic_write(tmp_path / "x"):
        raise ZeroDivisionError


def outside_of(tmp_path):
    """A folder, and a file and a folder beside it that must stay as they are."""
    folder, other = tmp_path / "folder", tmp_path / "other"
    folder.mkdir()
    other.mkdir()
    (other / "victim").write_bytes(b"before")
    return folder, other


def test_below_a_folder_a_link_is_replaced_not_followed(tmp_path):
    folder, other = outside_of(tmp_path)
    (folder / "a").symlink_to(other / "victim")
    (folder / "b").symlink_to(other / "new")
    (folder / "inside").mkdir()
    (folder / "link").symlink_to("inside")
    for name in ("a", "b", "link/c"):
        with atomic_write(folder / name, below=folder) as file:
            file.write(b"x")
        assert not (folder / name).is_symlink() and (folder / name).read_bytes() == b"x"
    assert (other / "victim").read_bytes() == b"before"
    assert os.listdir(other) == ["victim"]


@pytest.mark.parametrize("name", ["out/victim", "out/deep/new", "inside/../out/victim", "../x"])
def test_below_a_folder_nothing_leads_out_of_it(name, tmp_path):
    folder, other = outside_of(tmp_path)
    (folder / "inside").mkdir()
    (folder / "out").symlink_to(other)
    (other / "deep").mkdir()
    with pytest.raises(FileAccessError, match="leads out of") as caught:
        make_folder_of(str(folder / name), below=str(folder))
    assert str(folder / name) in str(caught.value)
    with (
        pytest.raises(FileAccessError, match="leads out of"),
        atomic_write(folder / name, below=folder),
    ):
        pass
    assert (other / "victim").read_bytes() == b"before"
    assert sorted(os.listdir(other)) == ["deep", "victim"] and not os.listdir(other / "deep")
    assert not (tmp_path / "x").exists()


def test_the_folder_itself_may_be_a_link(tmp_path):
    folder, other = outside_of(tmp_path)
    (tmp_path / "link").symlink_to(other)
    with atomic_write(tmp_path / "link" / "victim", below=tmp_path / "link") as file:
        file.write(b"x")
    assert (other / "victim").read_bytes() == b"x"


def test_names_are_on_the_disk_when_the_block_ends(tmp_path, monkeypatch):
    synced, replaced = [], []
    monkeypatch.setattr(module, "sync_folder", lambda path: synced.append((path, len(replaced))))
    replace = os.replace
    monkeypatch.setattr(os, "replace", lambda *names: (replaced.append(1), replace(*names)))
    (tmp_path / "b").mkdir()
    with module.AtomicFiles() as files:
        for name in ("1", "2", "b/3"):
            files.create(tmp_path / name).write(b"x")
    assert sorted(synced) == [(str(tmp_path), 3), (str(tmp_path / "b"), 3)]


@pytest.mark.skipif(not hasattr(os, "O_DIRECTORY"), reason="no folder can be opened")
def test_folders_are_synced(tmp_path, monkeypatch):
    synced = []
    fsync = os.fsync
    monkeypatch.setattr(os, "fsync", lambda fd: (synced.append(os.fstat(fd).st_ino), fsync(fd)))
    make_folder_of(str(tmp_path / "a" / "b" / "c"))
    with atomic_write(tmp_path / "a" / "b" / "c") as file:
        file.write(b"x")
    expected = {place.stat().st_ino for place in (tmp_path, tmp_path / "a", tmp_path / "a" / "b")}
    assert expected <= set(synced)


#: Modules whose files somebody else names, one by one: what they give is followed where it leads.
NAMED_BY_OTHERS = {
    "apps/cli/commands/bench.py", "apps/cli/commands/sheet.py", "compat/pyrender/viewer.py",
    "apps/desktop/recent_files.py", "apps/editor/ui/panel_layout.py",
    "io/output/animation_files.py",
    "io/output/video_files.py", "apps/golden/html_report.py", "apps/golden/result_files.py",
    "rendering/frame.py", "apps/sheet/contact_sheet.py", "io/formats/gltf/gltf_writer.py",
    "io/formats/obj/obj_writer.py", "io/formats/ply/ply_writer.py", "io/writing/scene_saving.py",
    "io/formats/stl_writer.py", "io/plugins/plugin_writing.py", "apps/cli/commands/learn.py",
    "apps/agents/exporting.py",
    "apps/drawings/line_drawing.py", "io/output/value_files.py", "compat/pyvista/_saving.py",
    "compat/trimesh/windowed.py", "extras/sensors/cloud_files.py",
}  # fmt: skip


def test_every_file_is_written_by_this_module_and_below_its_folder():
    followed, direct = set(), set()
    engine = Path(module.__file__).parents[2]
    for path in engine.rglob("*.py"):
        name = path.relative_to(engine).as_posix()
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            called = getattr(node.func, "attr", getattr(node.func, "id", ""))
            owner = getattr(getattr(node.func, "value", None), "id", "")
            owner = owner or getattr(getattr(node.func, "value", None), "attr", "")
            writes = called == "atomic_write" or (called == "create" and "iles" in owner)
            if writes and not any(word.arg == "below" for word in node.keywords):
                followed.add(name)
            modes = [a.value for a in node.args[1:2] if isinstance(a, ast.Constant)]
            if (
                called == "open"
                and owner == ""
                and str(modes[:1]).strip("[']")[:1] in "wxa"
                and modes
            ):
                direct.add(name)
            if called in ("write_bytes", "write_text"):
                direct.add(name)
    assert followed - {"base/files/atomic_write.py"} == NAMED_BY_OTHERS
    # The first opens what leads nowhere, the other a file in a folder of its own for a moment.
    assert direct == {"apps/cli/__init__.py", "base/files/temporary_copy.py"}


def test_an_address_is_no_place_to_write_to(tmp_path, monkeypatch):
    frame = e3d.render(e3d.box(), size=(8, 6))
    for write in (
        lambda url: e3d.save_mesh(e3d.box(), f"{url}.obj"),
        lambda url: e3d.Scene().save(f"{url}.e3d.json"),
        lambda url: frame.save(f"{url}.png"),
        lambda url: e3d.save_animation([frame], f"{url}.gif"),
    ):
        with pytest.raises(e3d.FileAccessError, match="cannot write to an address: give a path"):
            write("https://host/a")
    if sys.platform == "win32":
        return  # no folder has a colon in its name
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s3:" / "bucket").mkdir(parents=True)  # a folder of that name can be meant
    frame.save("s3://bucket/a.png")
    assert (tmp_path / "s3:" / "bucket" / "a.png").is_file()
