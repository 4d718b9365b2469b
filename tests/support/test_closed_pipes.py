"""A pipe that nobody reads any more: Windows tells of it by an error of its own."""

import errno
import io
import pickle
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from patience import HUNG

from engine3d.apps import cli
from engine3d.apps.cli import outputs
from engine3d.base import system
from engine3d.errors import FileAccessError
from engine3d.io.output import video_files

NUMBERS = [errno.EPIPE, errno.EINVAL]


@pytest.fixture(params=NUMBERS)
def unread(request, monkeypatch):
    """What is raised by writing there, by systems that tell it so."""
    monkeypatch.setattr(system, "_UNREAD", NUMBERS)
    return OSError(request.param, "nobody reads")


def test_systems_tell_that_nobody_reads(unread):
    assert system.is_unread(unread)
    assert not system.is_unread(OSError(unread.errno, "no such name", "a?b"))
    assert not system.is_unread(OSError(errno.ENOSPC, "no space left"))
    assert not system.is_unread(FileAccessError("cannot read", "a.obj"))


def test_only_windows_tells_it_by_an_invalid_argument():
    assert system.is_unread(BrokenPipeError(errno.EPIPE, ""))
    assert system.is_unread(OSError(errno.EINVAL, "")) == (sys.platform == "win32")


def test_the_command_ends_without_a_word(unread, monkeypatch, capsys):
    left = []

    def obey(*_):
        raise unread

    monkeypatch.setattr(cli, "_obey", obey)
    monkeypatch.setattr(cli, "_leave_standard_output", lambda: left.append(True))
    assert cli.main(["info", "-"]) == 1
    assert (left, capsys.readouterr().err) == ([True], "")


def test_a_picture_that_nobody_reads_is_no_error_of_a_file(unread, monkeypatch):
    class Unread(io.BytesIO):
        def write(self, _):
            raise unread

    monkeypatch.setattr(sys, "stdout", SimpleNamespace(buffer=Unread()))
    with pytest.raises(OSError, match="nobody reads") as raised:
        outputs.write_standard_output(b"picture")
    assert raised.value is unread


def test_an_encoder_that_leaves_tells_its_reason(unread):
    def pictures():
        yield np.zeros((2, 2, 4), np.uint8) + 255
        raise unread

    command = [sys.executable, "-c", "raise SystemExit('no such codec')"]
    with pytest.raises(FileAccessError, match="ffmpeg says: no such codec"):
        video_files._feed(command, pictures(), "a.mp4")


@pytest.mark.parametrize("number", NUMBERS)
def test_a_process_whose_batch_is_gone_ends_quietly(number):
    program = (
        "from engine3d.apps.batch import worker\n"
        "from engine3d.base import system\n"
        f"system._UNREAD = {NUMBERS}\n"
        "def send(*_):\n"
        f"    raise OSError({number}, 'nobody reads')\n"
        "worker.send = send\n"
        "worker.main()\n"
    )
    call = pickle.dumps((abs, (-1,)))
    command = [sys.executable, "-c", program]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    process.stdin.write(len(call).to_bytes(8, "little") + call)
    process.stdin.flush()  # and stays open: only the answer tells that the batch is gone
    assert (process.wait(HUNG), process.stderr.read()) == (0, b"")
    process.communicate()
