"""What systems give in different ways."""

import ctypes
import errno
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import engine3d
from engine3d._native import rasterizer
from engine3d.base import system
from engine3d.base.files.atomic_write import atomic_write

PACKAGE = Path(engine3d.__file__).parent


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


def test_programs_of_the_system_answer_or_do_not():
    python = sys.executable, "-S", "-c"
    assert system.answer_of(*python, "print(' a  b ')") == "a  b"
    assert system.answer_of(*python, "print('a'); raise SystemExit(1)") == ""
    assert system.answer_of("/nowhere/to/be/found") == ""


def test_ending_signals_and_processors():
    assert "SIGTERM" in {number.name for number in system.ending_signals()}
    assert 1 <= system.usable_processors() <= os.cpu_count()


def test_usable_processors_are_what_the_core_takes(monkeypatch):
    """A container's quota counts, and no module asks for those of the whole machine."""
    monkeypatch.setattr(rasterizer, "thread_count", lambda: 3)
    assert system.usable_processors() == 3
    asking = [path for path in PACKAGE.rglob("*.py") if "cpu_count" in path.read_text("utf-8")]
    assert [path.name for path in asking] == ["system_report.py"]  # which tells of the machine


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="sets the affinity")
def test_usable_processors_are_those_of_the_affinity():
    program = (
        "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))});"
        "from engine3d.base import system; print(system.usable_processors())"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
    assert done.stdout.split() == [b"1"]


def test_the_machine_tells_its_memory():
    assert system.machine_memory() > 2**28


@pytest.mark.parametrize("has_answer", [False, True])
def test_windows_tells_its_memory_in_a_structure(monkeypatch, has_answer):
    def ask(reference):
        status = reference._obj
        assert status.size == ctypes.sizeof(status) == 64
        status.percent_used, status.memory = 71, 2**35 + 5
        return int(has_answer)

    kernel = SimpleNamespace(GlobalMemoryStatusEx=ask)
    monkeypatch.setattr(ctypes, "WinDLL", {"kernel32": kernel}.get, raising=False)
    monkeypatch.setattr(sys, "platform", "win32")
    assert system.machine_memory() == (2**35 + 5 if has_answer else None)


@pytest.mark.skipif(sys.platform == "win32", reason="syncs by fcntl")
@pytest.mark.parametrize("has_call, is_refused", [(True, False), (True, True), (False, False)])
def test_files_and_folders_are_synced_through_the_disks_cache(
    tmp_path, monkeypatch, has_call, is_refused
):
    import fcntl

    asked, synced = [], []

    def call(handle, number):
        asked.append((os.fstat(handle).st_ino, number))
        if is_refused:
            raise OSError(errno.ENOTSUP, "not by this disk")

    monkeypatch.setattr(fcntl, "fcntl", call)
    monkeypatch.setattr(os, "fsync", lambda handle: synced.append(os.fstat(handle).st_ino))
    if has_call:
        monkeypatch.setattr(fcntl, "F_FULLFSYNC", 51, raising=False)
    else:
        monkeypatch.delattr(fcntl, "F_FULLFSYNC", raising=False)
    with atomic_write(tmp_path / "a") as file:
        file.write(b"x")
    written = [(tmp_path / "a").stat().st_ino, tmp_path.stat().st_ino]
    assert asked == ([(number, 51) for number in written] if has_call else [])
    assert synced == (written if is_refused or not has_call else [])


@pytest.mark.parametrize("moment, refusals, is_replaced", [(30.0, 2, True), (0.0, 1, False)])
def test_a_file_is_replaced_once_its_readers_are_gone(
    tmp_path, monkeypatch, moment, refusals, is_replaced
):
    (tmp_path / "new").write_text("new")
    (tmp_path / "old").write_text("old")
    replace, asked = os.replace, []

    def replaced(*paths):
        asked.append(paths)
        if len(asked) <= refusals:
            raise PermissionError(errno.EACCES, "another program reads it")
        replace(*paths)

    monkeypatch.setattr(os, "replace", replaced)
    monkeypatch.setattr(system, "_MOMENT", moment)
    if is_replaced:
        system.replace_file(tmp_path / "new", tmp_path / "old")
    else:
        with pytest.raises(PermissionError):
            system.replace_file(tmp_path / "new", tmp_path / "old")
    assert (tmp_path / "old").read_text() == ("new" if is_replaced else "old")
    assert len(asked) == 1 + (refusals if is_replaced else 0)


@pytest.mark.skipif(sys.platform == "win32", reason="has no such limit")
def test_no_file_is_opened_where_none_may_be(tmp_path):
    path = tmp_path / "a"
    path.write_text("a")
    with open(path) as before:
        with system.opening_no_files():
            with pytest.raises(OSError, match="Too many open files"):
                os.open(path, os.O_RDONLY)
            assert before.read() == "a"
        with open(path) as after:
            assert after.read() == "a"
