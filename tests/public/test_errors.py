"""The exceptions: the built-ins they inherit, their texts, pickling."""

import pickle

import pytest

from engine3d import errors


@pytest.mark.parametrize(
    ("kind", "builtin"),
    [
        (errors.FileFormatError, ValueError),
        (errors.FileAccessError, OSError),
        (errors.InvalidArgumentError, ValueError),
        (errors.BackendError, RuntimeError),
        (errors.OutOfMemoryError, MemoryError),
        (errors.DisplayError, RuntimeError),
        (errors.MissingOutputError, AttributeError),
        (errors.SceneChangedError, RuntimeError),
    ],
)
def test_every_exception_is_also_a_builtin(kind, builtin):
    assert issubclass(kind, errors.Engine3DError)
    assert issubclass(kind, builtin)
    assert str(kind("what is wrong")) == "what is wrong"


def test_a_format_error_names_the_file_and_the_line():
    error = errors.FileFormatError("not a number: 'x'", "a/b.obj", 12)
    assert str(error) == "a/b.obj:12: not a number: 'x'"
    assert (error.path, error.line) == ("a/b.obj", 12)


def test_a_format_error_without_a_line_names_the_file():
    assert str(errors.FileFormatError("cut short", "a.tga")) == "a.tga: cut short"


def test_errors_survive_pickling():
    error = pickle.loads(pickle.dumps(errors.FileFormatError("wrong", "a.obj", 3)))
    assert str(error) == "a.obj:3: wrong"
    error = pickle.loads(pickle.dumps(errors.FileAccessError("no such file", "a.obj")))
    assert str(error) == "a.obj: no such file"


@pytest.mark.parametrize(
    "path, shown",
    [
        ("a\nb.obj", "a\\nb.obj"),
        ("\x1b[31mred.obj", "\\x1b[31mred.obj"),
        ("not\udcffutf8.obj", "not\\udcffutf8.obj"),
        ("b\u00fccher ok.obj", "b\u00fccher ok.obj"),
        ("", "''"),
    ],
)
def test_a_message_is_one_line_whatever_the_file_is_called(path, shown):
    assert str(errors.FileFormatError("wrong", path, 2)) == f"{shown}:2: wrong"
    assert str(errors.FileAccessError("wrong", path)) == f"{shown}: wrong"
