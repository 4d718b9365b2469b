"""Opening and saving: nothing is overwritten unasked, and at most a minute is lost."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from loaders.seeds import FILES

import engine3d as e3d
from engine3d.apps.editor.autosave import PERIOD, Autosave, forget, left_behind
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.node_commands import AddNodes
from engine3d.apps.editor.value_commands import SetValues
from engine3d.io.writing.scene_saving import scene_text


@pytest.fixture
def folder(tmp_path):
    for name in ("house.obj", "house.mtl", "house.tga"):
        (tmp_path / name).write_bytes(FILES[name])
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(tmp_path / "house.obj"), name="house")
    e3d.save_scene(scene, tmp_path / "a.e3d.json")
    return tmp_path


def change(document):
    document.do(AddNodes(document.scene, lambda scene: scene.add(e3d.box()), "Add a box"))


def said(document, level):
    return [entry.text for entry in document.console.entries if entry.level == level]


def test_a_scene_is_opened_changed_and_saved(folder):
    path = folder / "a.e3d.json"
    document = SceneDocument.open(path)
    assert document.path == str(path) and document.title == "a.e3d.json"
    change(document)
    assert document.title == "a.e3d.json*"
    assert document.save_would_overwrite() is None and document.save()
    assert document.title == "a.e3d.json"
    assert [node.name for node in SceneDocument.open(path).scene.nodes] == ["house", "box"]
    document.undo()
    assert document.is_modified
    assert document.save()
    document.redo()
    assert document.is_modified


def test_a_model_is_opened_as_a_scene_without_a_file(folder):
    document = SceneDocument.open(folder / "house.obj")
    assert document.path is None and document.title == "untitled"
    assert not document.is_modified
    with pytest.raises(e3d.InvalidArgumentError, match="give a path"):
        document.save()
    with pytest.raises(e3d.FileAccessError):
        SceneDocument.open(folder / "none.obj")


def test_a_scene_that_is_not_there_begins_empty_under_its_name(folder):
    path = folder / "new.e3d.json"
    document = SceneDocument.begin(path)
    assert document.path == str(path) and document.title == "new.e3d.json"
    assert not document.is_modified and document.scene.nodes == () and not path.exists()
    change(document)
    assert document.save_would_overwrite() is None and document.save()
    assert len(SceneDocument.begin(path).scene.nodes) == 1
    with pytest.raises(e3d.FileAccessError, match="none.obj"):
        SceneDocument.begin(folder / "none.obj")
    with pytest.raises(e3d.FileAccessError, match="its folder"):
        SceneDocument.begin(folder / "none" / "new.e3d.json")


def test_a_scene_that_another_program_made_meanwhile_is_asked_about(folder):
    path = folder / "new.e3d.json"
    document = SceneDocument.begin(path)
    change(document)
    path.write_bytes((folder / "a.e3d.json").read_bytes())
    assert "changed by another program" in document.save_would_overwrite()


def test_nothing_is_overwritten_unasked(folder):
    path = folder / "a.e3d.json"
    document = SceneDocument.open(folder / "house.obj")
    before = path.read_bytes()
    assert "is there already" in document.save_would_overwrite(path)
    assert not document.save(path) and path.read_bytes() == before
    assert "is there already" in said(document, "error")[-1]
    assert document.save(path, overwrite=True) and path.read_bytes() != before
    path.write_bytes(before)  # by another program
    assert "another program" in document.save_would_overwrite()
    change(document)
    assert not document.save() and path.read_bytes() == before
    assert document.save(overwrite=True)
    path.unlink()
    assert document.save_would_overwrite() is None and document.save()
    assert not document.save(folder / "none" / "b.e3d.json")
    assert "cannot write" in said(document, "error")[-1]
    assert document.path == str(path)


def test_a_copy_is_made_when_one_is_due(folder, tmp_path):
    document = SceneDocument.open(folder / "a.e3d.json")
    copies = tmp_path / "unsaved"
    autosave = Autosave(document, copies)
    assert not autosave.tick(0) and not copies.exists()
    change(document)
    assert not autosave.tick(10) and not autosave.tick(10 + PERIOD - 1)
    change(document)
    assert autosave.tick(10 + PERIOD)
    assert not autosave.tick(500)  # nothing is new
    assert PERIOD < 60
    assert left_behind(copies) == ()  # its editor is alive
    assert len(list(copies.glob("*.e3d.json"))) == 1
    document.save()
    autosave.tick(501)
    assert list(copies.iterdir()) == []


CRASH = """
import os, sys
import engine3d as e3d
from engine3d.apps.editor.autosave import Autosave
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.value_commands import SetValues
path, copies = sys.argv[1:]
house = os.path.join(os.path.dirname(path), "house.obj")
document = SceneDocument.open(path) if path else SceneDocument(e3d.Scene())
document.scene.add(e3d.load_mesh(house))
document.do(SetValues([document.scene], {"ambient": e3d.linear(0.5, 0.25, 0.125)}))
assert Autosave(document, copies).save()
os.abort()
"""


@pytest.mark.parametrize("has_file", [True, False])
def test_what_a_crash_left_behind_is_found_and_recovered(folder, tmp_path, has_file):
    copies = tmp_path / "unsaved"
    path = str(folder / "a.e3d.json") if has_file else ""
    command = [sys.executable, "-W", "ignore", "-c", CRASH, path, str(copies)]
    # Systems number it in their own ways; 1 is an exception's.
    assert subprocess.run(command, cwd=folder, check=False).returncode not in (0, 1)
    (copy,) = left_behind(copies)
    assert copy.document == (path or None)
    document = SceneDocument.recover(copy)
    assert document.scene.ambient == e3d.linear(0.5, 0.25, 0.125) and document.is_modified
    assert len(document.scene.nodes[-1].object.faces) > 0
    assert not [line for line in said(document, "warning") if "left out" in line]
    if has_file:
        assert document.save_would_overwrite()  # it is not known to be as it was opened
        assert document.save(overwrite=True)
    else:
        assert document.path is None and document.save(folder / "b.e3d.json")
    names = b'"file":"house.obj"'
    assert names in (folder / ("a.e3d.json" if has_file else "b.e3d.json")).read_bytes()
    forget(copy)
    assert left_behind(copies) == () and list(copies.iterdir()) == []


def test_what_was_recovered_is_copied_at_once(tmp_path):
    document = SceneDocument()
    assert not list(tmp_path.iterdir())
    document.history.mark_unsaved()
    autosave = Autosave(document, tmp_path)
    assert len(list(tmp_path.glob("*.e3d.json"))) == 1
    assert not autosave.tick(1e9)
    autosave.discard()
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="the system itself keeps them there")
def test_nothing_stays_where_open_files_cannot_be_removed(tmp_path, monkeypatch):
    document = SceneDocument()
    document.history.mark_unsaved()
    autosave, unlink = Autosave(document, tmp_path), Path.unlink

    def unlink_closed(path):  # as on Windows
        if path.suffix == ".lock" and os.path.exists(f"/dev/fd/{lock}"):
            raise PermissionError
        unlink(path)

    lock = autosave._lock
    monkeypatch.setattr(Path, "unlink", unlink_closed)
    autosave.discard()
    assert not list(tmp_path.iterdir())


@pytest.mark.filterwarnings("ignore:.*passed over")
def test_damaged_copies_are_not_offered(tmp_path):
    (tmp_path / "a.e3d.json").write_bytes(b"")
    (tmp_path / "b.e3d.json").write_bytes(b'{"autosave": 3,\n"format": 1}')
    (tmp_path / "c.e3d.json").write_bytes(b"[" * 100_000)
    (tmp_path / "d.e3d.json").write_bytes(b'{"autosave": {"document": 3, "time": 1},\n}')
    (copy,) = left_behind(tmp_path)
    with pytest.raises(e3d.FileFormatError):
        SceneDocument.recover(copy)
    assert left_behind(tmp_path / "none") == ()


def test_a_copy_that_cannot_be_made_is_a_warning(folder, tmp_path):
    document = SceneDocument.open(folder / "a.e3d.json")
    change(document)
    (tmp_path / "file").write_bytes(b"")
    assert not Autosave(document, tmp_path / "file").save()
    assert "no copy was made" in said(document, "warning")[-1]


def test_undoing_all_gives_the_file_that_was_opened(folder):
    document = SceneDocument.open(folder / "a.e3d.json")
    before = scene_text(document.scene, str(folder))[0]
    house = document.scene.find("house")
    material = house.object.materials[0]
    document.do(SetValues([material], {"color": (0, 0, 255)}))
    document.do(SetValues([house], {"collider": e3d.colliders.MeshCollider(), "static": True}))
    change(document)
    after = scene_text(document.scene, str(folder))[0]
    assert before == (folder / "a.e3d.json").read_bytes() != after
    while document.undo():
        pass
    assert scene_text(document.scene, str(folder))[0] == before
    while document.redo():
        pass
    assert scene_text(document.scene, str(folder))[0] == after
