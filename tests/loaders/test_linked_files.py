"""Files that models name, in folders that somebody changes while they are read."""

import os

import pytest

from engine3d.errors import FileAccessError
from engine3d.io.reading.linked_files import LinkedFiles


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "secret.txt").write_bytes(b"secret")
    model = tmp_path / "model"
    (model / "maps").mkdir(parents=True)
    (model / "maps" / "wood.txt").write_bytes(b"wood")
    (model / "link.txt").symlink_to(model / "maps" / "wood.txt")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "wood.txt").write_bytes(b"secret")
    return model


def swapped(monkeypatch, files, change):
    """Let ``change()`` happen when the path has been looked at, and nothing is open."""
    real_path = LinkedFiles._real_path

    def look(self, path):
        real = real_path(self, path)
        change()
        return real

    monkeypatch.setattr(LinkedFiles, "_real_path", look)


@pytest.mark.parametrize("name", ["maps/wood.txt", "link.txt", "./maps/../maps/wood.txt"])
def test_files_and_links_inside_are_read(folder, name):
    files = LinkedFiles(str(folder))
    assert files.read(files.find(name)).data == b"wood"


def test_a_link_that_takes_the_place_of_the_file(folder, monkeypatch):
    files = LinkedFiles(str(folder))
    path = files.find("maps/wood.txt")

    def change():
        os.unlink(path)
        os.symlink(folder.parent / "secret.txt", path)

    swapped(monkeypatch, files, change)
    with pytest.raises(FileAccessError, match=r"wood\.txt: cannot read: Too many levels of symb"):
        files.read(path)


def test_a_link_that_takes_the_place_of_a_folder(folder, monkeypatch):
    files = LinkedFiles(str(folder))
    path = files.find("maps/wood.txt")

    def change():
        (folder / "maps").rename(folder / "old")
        (folder / "maps").symlink_to(folder.parent / "elsewhere")

    swapped(monkeypatch, files, change)
    with pytest.raises(FileAccessError, match=r"wood\.txt: cannot read: Not a directory"):
        files.read(path)


def test_a_fifo_that_takes_the_place_of_the_file(folder):
    files = LinkedFiles(str(folder))
    path = files.find("maps/wood.txt")
    os.unlink(path)
    os.mkfifo(path)
    with pytest.raises(FileAccessError, match="not a regular file"):
        files.read(path)


def test_a_link_that_leads_out_by_now(folder):
    files = LinkedFiles(str(folder))
    path = files.find("maps/wood.txt")
    os.unlink(path)
    os.symlink(folder.parent / "secret.txt", path)
    with pytest.raises(FileAccessError, match="leaves the model's folder"):
        files.read(path)
