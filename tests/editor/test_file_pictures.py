"""Pictures of files, made in a thread of their own."""

import time

import numpy as np
from patience import HUNG

import engine3d as e3d
from engine3d.apps.editor import file_pictures
from engine3d.apps.editor.file_pictures import FilePictures


def picture_of(pictures, path):
    end = time.monotonic() + HUNG
    while time.monotonic() < end:
        picture, comes = pictures.get(str(path))
        if not comes:
            return picture
        time.sleep(0.01)
    raise AssertionError("it never came")


def test_models_and_images_have_pictures(tmp_path):
    pictures = FilePictures(48)
    e3d.box().save(tmp_path / "box.obj")
    scene = e3d.Scene(background=(9, 9, 9))
    scene.add(e3d.box())
    e3d.save_scene(scene, tmp_path / "scene.e3d.json")
    e3d.render(scene, size=(20, 10)).save(tmp_path / "image.png")
    for name in ("box.obj", "scene.e3d.json", "image.png"):
        picture = picture_of(pictures, tmp_path / name)
        assert picture.shape == (48, 48, 4) and len(np.unique(picture.reshape(-1, 4), axis=0)) > 1
        assert picture_of(pictures, tmp_path / name) is picture


def test_what_is_broken_large_or_no_file_has_none(tmp_path, monkeypatch):
    pictures = FilePictures(48)
    (tmp_path / "broken.obj").write_text("v 1 x 3\n")
    (tmp_path / "notes.txt").write_text("v 1 2 3\n")
    e3d.box().save(tmp_path / "large.obj")
    monkeypatch.setattr(file_pictures, "LARGEST", 100)
    for name in ("broken.obj", "notes.txt", "large.obj", "none.obj", "", "\0"):
        assert picture_of(pictures, tmp_path / name) is None


def test_a_file_that_changes_has_another_picture(tmp_path):
    pictures = FilePictures(48)
    e3d.box().save(tmp_path / "a.obj")
    first = picture_of(pictures, tmp_path / "a.obj")
    e3d.icosphere().save(tmp_path / "a.obj")
    assert (picture_of(pictures, tmp_path / "a.obj") != first).any()
