"""Files appear whole or not at all, and keep their permissions."""

import os
import stat

import pytest

from engine3d.errors import FileAccessError
from engine3d.files.atomic_write import atomic_write


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
    with pytest.raises(FileAccessError, match=r"missing/out\.bin: cannot write: No such file"):
        with atomic_write(path):
            pass


def test_a_device_is_written_to_directly():
    with atomic_write("/dev/null") as file:
        file.write(b"x")


def test_an_exception_of_the_caller_passes_through(tmp_path):
    with pytest.raises(ZeroDivisionError), atomic_write(tmp_path / "x"):
        raise ZeroDivisionError
