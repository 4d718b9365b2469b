"""Commands that name files themselves write nothing outside of the folder that they were given."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.editor.autosave import Autosave, left_behind
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.golden.golden_files import write_golden
from engine3d.batch import Task, run
from engine3d.datasets import FolderWriter, WebDatasetWriter

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def victim(tmp_path):
    """A file outside of every folder that is given to a command; it stays as it is."""
    path = tmp_path / "elsewhere" / "victim"
    path.parent.mkdir()
    path.write_bytes(b"before")
    yield path
    assert path.read_bytes() == b"before"
    assert os.listdir(path.parent) == ["victim"]


@pytest.fixture
def tasks(tmp_path):
    (tmp_path / "m.obj").write_text(OBJ)
    return [Task(name="a/p", model="m.obj", size=(8, 8), folder=str(tmp_path))]


def linked(link, target):
    link.parent.mkdir(parents=True, exist_ok=True)
    link.symlink_to(target)


@pytest.mark.parametrize("name", ["a/p.png", ".batch/a/p.json", "SHA256SUMS"])
def test_a_batch_replaces_links_in_the_place_of_its_files(name, tasks, victim, tmp_path):
    linked(tmp_path / "out" / name, victim)
    assert not run(tasks, tmp_path / "out", jobs=1).failures
    assert not (tmp_path / "out" / name).is_symlink()


@pytest.mark.parametrize("name", ["a", ".batch/a", ".batch", ".batch/lock"])
def test_a_batch_does_not_leave_its_folder(name, tasks, victim, tmp_path):
    linked(tmp_path / "out" / name, victim if name == ".batch/lock" else victim.parent)
    try:
        failures = run(tasks, tmp_path / "out", jobs=1).failures
    except e3d.FileAccessError as error:
        failures = [str(error)]
    assert failures and str(tmp_path / "out") in str(failures[0])


@pytest.mark.parametrize("writer", [FolderWriter(["color"]), WebDatasetWriter()])
def test_a_data_set_does_not_leave_its_folder(writer, tasks, victim, tmp_path):
    folder = "unpacked" if writer.kind == "webdataset" else "color"
    linked(tmp_path / "out" / folder, victim.parent)
    (failure,) = run(tasks, tmp_path / "out", writer=writer, jobs=1).failures
    assert "leads out of" in failure.error


def pictures(tmp_path):
    for name, value in (("new", 3), ("old", 5)):
        write_golden(str(tmp_path / name / "a.png"), np.full((4, 4, 3), value, np.uint8))
        write_golden(str(tmp_path / name / "b" / "c.png"), np.full((4, 4, 3), value, np.uint8))
    return str(tmp_path / "new"), str(tmp_path / "old")


def test_an_update_replaces_links(victim, tmp_path, capsys):
    new, old = pictures(tmp_path)
    (Path(old) / "a.png").unlink()
    linked(Path(old) / "a.png", victim)
    linked(tmp_path / "differences" / "b" / "c.png", victim)
    main(["diff", new, old, str(tmp_path / "differences"), "-U"])
    assert not (Path(old) / "a.png").is_symlink()
    assert not (tmp_path / "differences" / "b" / "c.png").is_symlink()
    assert main(["diff", new, old]) == 0


def test_an_update_does_not_leave_its_folder(victim, tmp_path, capsys):
    new, old = pictures(tmp_path)
    (Path(old) / "b" / "c.png").unlink()
    (Path(old) / "b").rmdir()
    linked(Path(old) / "b", victim.parent)
    assert main(["diff", new, old, "-U"]) == 1
    assert "leads out of" in capsys.readouterr().err


def test_a_golden_picture_replaces_a_link(victim, tmp_path):
    linked(tmp_path / "golden" / "a.png", victim)
    pixels = np.zeros((2, 2, 3), np.uint8)
    write_golden(str(tmp_path / "golden" / "a.png"), pixels, below=str(tmp_path / "golden"))


def test_images_beside_a_model_replace_links(victim, tmp_path):
    box = e3d.box()
    box.materials = [e3d.Material(texture=e3d.Texture(np.zeros((2, 2, 3), np.uint8)))]
    box.save(tmp_path / "a.obj")
    (tmp_path / "a_0.png").unlink()
    linked(tmp_path / "a_0.png", victim)
    box.save(tmp_path / "a.obj")
    assert not (tmp_path / "a_0.png").is_symlink()


def test_what_editors_were_writing_when_they_ended_is_removed(tmp_path):
    document = SceneDocument()
    document.scene.add(e3d.box())
    autosave = Autosave(document, tmp_path)
    autosave.save()
    (copy,) = tmp_path.glob("*.e3d.json")
    own = tmp_path / f".{copy.name}.0123456789abcdef.part"
    dead = tmp_path / ".0123456789abcdef.e3d.json.0123456789abcdef.part"
    other = tmp_path / ".notes.part"
    for path in (own, dead, other):
        path.write_bytes(b"half")
    left_behind(tmp_path)
    assert own.exists() and other.exists() and not dead.exists()
    os.close(autosave._lock)
    left_behind(tmp_path)
    assert not own.exists() and copy.exists()


def test_a_manifest_in_json_names_no_file_outside(tmp_path, victim, capsys):
    tasks = [{"model": "m.obj", "name": "../elsewhere/victim"}]
    path = tmp_path / "manifest.json"
    path.write_text(json.dumps({"version": 1, "tasks": tasks}))
    assert main(["batch", str(path), "-o", str(tmp_path / "out")]) == 1
