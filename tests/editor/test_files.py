"""Recent files, and folders as file dialogs show them."""

import os

import pytest

from engine3d.editor.recent_files import MOST, RecentFiles
from engine3d.files.folder_listing import list_folder


def test_recent_files_are_kept_the_latest_first(tmp_path):
    for name in "abc":
        (tmp_path / name).write_bytes(b"")
    store = tmp_path / "state" / "recent.json"
    recent = RecentFiles(store)
    assert recent.paths() == ()
    for name in ("a", "b", "c", "a"):
        recent.add(tmp_path / name)
    assert [os.path.basename(path) for path in RecentFiles(store).paths()] == ["a", "c", "b"]
    (tmp_path / "c").unlink()
    assert [os.path.basename(path) for path in recent.paths()] == ["a", "b"]
    for k in range(30):
        (tmp_path / f"f{k}").write_bytes(b"")
        recent.add(tmp_path / f"f{k}")
    assert len(recent.paths()) == MOST
    recent.clear()
    assert recent.paths() == ()


@pytest.mark.filterwarnings("ignore:.*begins anew")
def test_a_damaged_list_is_an_empty_one(tmp_path):
    store = tmp_path / "recent.json"
    for text in ("", "{", "3", "[" * 100_000, '[1, null, "/none"]', "\xff"):
        store.write_text(text, encoding="latin-1")
        assert RecentFiles(store).paths() == ()
    (tmp_path / "file").write_bytes(b"")
    RecentFiles(tmp_path / "file" / "recent.json").add("a")  # no error


def test_folders_come_first_and_files_by_name(tmp_path):
    for name in ("b.obj", "A.OBJ", "c.obj.gz", "d.png", ".hidden.obj"):
        (tmp_path / name).write_bytes(b"123")
    for name in ("zoo", "Animals", ".git"):
        (tmp_path / name).mkdir()
    os.mkfifo(tmp_path / "pipe.obj")
    (tmp_path / "link.obj").symlink_to(tmp_path / "none")
    (tmp_path / "real.obj").symlink_to(tmp_path / "b.obj")
    listing = list_folder(tmp_path)
    assert listing.reason == "" and listing.path == str(tmp_path)

    def names(*args, **options):
        return [item.name for item in listing.filtered(*args, **options)]

    folders = ["Animals", "zoo"]
    assert names() == [*folders, "A.OBJ", "b.obj", "c.obj.gz", "d.png", "real.obj"]
    assert names([".obj"]) == [*folders, "A.OBJ", "b.obj", "real.obj"]
    assert names([".obj", ".obj.gz"], "C.") == ["c.obj.gz"]
    assert names([".png"], hidden=True) == [".git", *folders, "d.png"]
    assert listing.filtered([".png"])[-1].size == 3 and listing.filtered()[0].is_folder


def test_a_folder_that_cannot_be_read_says_why(tmp_path):
    (tmp_path / "file").write_bytes(b"")
    for path, reason in (("none", "No such file"), ("file", "Not a directory"), ("\0", "null")):
        listing = list_folder(str(tmp_path / path))
        assert listing.items == () and reason in listing.reason
