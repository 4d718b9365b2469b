"""The folders around a folder end at a root, whether that exists or not."""

import errno
import ntpath
import os

import pytest

from engine3d.apps.cli.outputs import check_folder
from engine3d.base.files.folders_above import folders_above
from engine3d.base.files.making_folders import make_folder_of
from engine3d.errors import FileAccessError


def test_they_end_at_the_root():
    assert list(folders_above("/a/b")) == ["/a/b", "/a", "/"]
    assert list(folders_above("a/b")) == ["a/b", "a", ""]


@pytest.mark.parametrize(
    "folder, expected",
    [
        ("Q:\\a\\b", ["Q:\\a\\b", "Q:\\a", "Q:\\"]),
        ("Q:a", ["Q:a", "Q:"]),
        ("\\\\server\\share\\a", ["\\\\server\\share\\a", "\\\\server\\share\\"]),
        ("\\\\?\\Q:\\a", ["\\\\?\\Q:\\a", "\\\\?\\Q:\\"]),
    ],
)
def test_they_end_at_a_drive_or_a_share(monkeypatch, folder, expected):
    monkeypatch.setattr(os, "path", ntpath)
    assert list(folders_above(folder)) == expected


@pytest.mark.parametrize("output", ["Q:\\a\\b.png", "Q:\\b.png", "\\\\server\\share\\a\\b.png"])
def test_a_drive_that_is_not_there_is_an_error(monkeypatch, output):
    def refused(path, **_):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)

    monkeypatch.setattr(os, "path", ntpath)
    monkeypatch.setattr(os, "makedirs", refused)
    for check in (check_folder, make_folder_of):
        with pytest.raises(FileAccessError, match="No such file or directory"):
            check(output)
