"""What systems give in different ways."""

import errno
import os
import sys

import pytest

from engine3d.base import system


@pytest.mark.skipif(sys.platform == "win32", reason="locks by flock")
def test_a_lock_ends_with_its_file(tmp_path):
    def opened():
        return os.open(tmp_path / "lock", system.READ_WRITE | os.O_CREAT)

    first, second = opened(), opened()
    assert system.locked(first)
    assert not system.locked(second)
    os.close(first)
    assert system.locked(second)
    os.close(second)


@pytest.mark.skipif(sys.platform == "win32", reason="locks by flock")
@pytest.mark.parametrize("number, alone", [(errno.EWOULDBLOCK, False), (errno.ENOLCK, True)])
def test_where_there_are_no_locks_nobody_has_one(tmp_path, monkeypatch, number, alone):
    import fcntl

    def refused(handle, how):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", refused)
    with open(tmp_path / "lock", "wb") as file:
        assert system.locked(file.fileno()) is alone


@pytest.mark.parametrize(
    "name", [b"a", b"\xc3\xa9", b"\xe9t\xe9", b"\xed\xb3\xbf", bytes(range(256))]
)
def test_names_of_any_bytes(name):
    decoded, plain = system.decoded_name(name), name.decode("utf-8", "surrogateescape")
    assert decoded in (plain, "\udcff")  # Windows lets UTF-8 hold half a character
    assert sys.platform == "win32" or decoded == os.fsdecode(name)


def test_ending_signals_and_processors():
    assert "SIGTERM" in {number.name for number in system.ending_signals()}
    assert 1 <= system.usable_processors() <= os.cpu_count()
