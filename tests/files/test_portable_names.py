"""Names that every system takes for files, and for different ones."""

import ntpath
import os

import pytest

from engine3d import FileAccessError
from engine3d.base.files.atomic_write import atomic_write, checked_path
from engine3d.base.files.portable_names import fault_of, fault_on_windows, folded

NAMES = (
    *("con", "CON", "con.png", "con .x", "aux.1", "nul", "com1", "com\u00b9.x", "lpt9.tar.gz"),
    *("com", "com10", "conx", "x.con", "a.", "a ", "a?", "a/b", "a./b", "a\tb", "conin$"),
    *("CONOUT$.x", "lpt\u00b2", "xCOM1:x", " con", "..a", 'a"b', "plain.png", "\u00e9.png"),
)


@pytest.mark.skipif(not hasattr(ntpath, "isreserved"), reason="Python has it from 3.13 on")
@pytest.mark.parametrize("name", NAMES)
def test_faults_are_those_that_python_knows(name):
    assert (fault_of(name) is not None) == any(map(ntpath.isreserved, name.split("/")))


@pytest.mark.parametrize(
    ("path", "told"),
    [
        ("con.png", "'con.png' is a device"),
        ("out\\NUL.png", "'NUL.png' is a device"),
        ("C:\\aux\\a.png", "'aux' is a device"),
        ("folder/nul", "'nul' is a device"),
        ("a.png.", "drops the end of 'a.png.'"),
        ("abc:def.png", "allows no ':' in 'abc:def.png'"),
        ("a*.png", "allows no '*'"),
    ],
)
def test_windows_would_not_write_these_files(path, told):
    assert told in fault_on_windows(path)


@pytest.mark.parametrize(
    "path",
    [
        "NUL",
        "con",
        "C:\\a.png",
        "a:b.png",
        "..\\a.png",
        ".",
        "\\\\.\\NUL",
        "\\\\server\\share\\a.b",
    ],
)
def test_windows_writes_these(path):
    assert fault_on_windows(path) is None


def test_a_device_is_no_output_file_on_windows(tmp_path, monkeypatch):
    path = os.path.join(tmp_path, "con.png")
    monkeypatch.setattr("engine3d.base.files.atomic_write._ON_WINDOWS", True)
    with pytest.raises(FileAccessError) as told, atomic_write(path):
        pass
    assert str(told.value).endswith("cannot write: 'con.png' is a device on Windows")
    name = os.path.join(tmp_path, "turn_{:03}.png")  # variables are filled in later
    assert checked_path(name) == name


def test_names_that_some_system_takes_for_one_are_equal():
    assert folded("Chair.PNG") == folded("chair.png")
    assert folded("\u00c9t\u00e9") == folded("e\u0301te\u0301")
    assert folded("chair") != folded("chairs")
