"""Folders as file dialogs show them."""

import os

from engine3d.base.files.folder_listing import list_folder


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
        assert listing.items == () and listing.reason
        assert reason in listing.reason or os.name == "nt"  # which has words of its own
