"""Processes that end together with what they have started."""

import ctypes
import signal
import subprocess
import sys
import time
from types import SimpleNamespace
from unittest.mock import Mock

from missing_here import KILL, is_running
from patience import HUNG

from engine3d.base.process_groups import LeadingProcess, _Job, without_launcher

PARENT = """
import subprocess, sys, time
child = subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(1000)"])
print(child.pid, flush=True)
time.sleep(1000)
"""


def test_a_group_ends_with_what_it_has_started():
    command = [sys.executable, "-S", "-c", PARENT]
    with LeadingProcess(command, stdout=subprocess.PIPE) as parent:
        child = int(parent.stdout.readline())
        assert is_running(parent.pid) and is_running(child)
        parent.kill_group()
        status = parent.wait(HUNG)
    assert status == (signal.SIGTERM if sys.platform == "win32" else -KILL)
    deadline = time.monotonic() + HUNG
    while is_running(child):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_an_ended_group_may_be_ended():
    with LeadingProcess([sys.executable, "-S", "-c", ""]) as process:
        assert process.wait(HUNG) == 0
        process.kill_group()


def test_python_itself_is_started_in_a_virtual_environment(monkeypatch):
    monkeypatch.setattr(sys, "executable", "venv/python.exe")
    monkeypatch.setattr(sys, "_base_executable", "base/python.exe", raising=False)
    command, environment = without_launcher(["venv/python.exe", "-c", ""], {"A": "b"})
    assert command == ["base/python.exe", "-c", ""]
    assert environment == {"A": "b", "__PYVENV_LAUNCHER__": "venv/python.exe"}
    _, environment = without_launcher(["venv/python.exe"], None)
    assert environment.items() > {"__PYVENV_LAUNCHER__": "venv/python.exe"}.items()


def test_other_commands_are_started_as_they_are(monkeypatch):
    assert without_launcher(["other.exe"], None) == (["other.exe"], None)
    monkeypatch.setattr(sys, "_base_executable", sys.executable, raising=False)
    assert without_launcher([sys.executable], None) == ([sys.executable], None)


def kernel(monkeypatch, job, is_assigned):
    """Let Windows' functions be ones that answer so, and return them."""
    names = ("AssignProcessToJobObject", "TerminateJobObject", "CloseHandle")
    found = SimpleNamespace(
        CreateJobObjectW=Mock(return_value=job), **{name: Mock(return_value=1) for name in names}
    )
    found.AssignProcessToJobObject.return_value = is_assigned
    monkeypatch.setattr(ctypes, "WinDLL", lambda name, **_: found, raising=False)
    return found


def test_a_job_ends_the_process_that_is_in_it(monkeypatch):
    asked = kernel(monkeypatch, 7, 1)
    job = _Job(5)
    job.end()
    assert job.is_led
    assert [one.value for one in asked.AssignProcessToJobObject.call_args.args] == [7, 5]
    assert asked.TerminateJobObject.call_args.args[0].value == 7
    del job
    assert asked.CloseHandle.call_count == 1


def test_a_process_may_be_in_no_job(monkeypatch):
    for job, is_assigned in ((None, 1), (7, 0)):
        asked = kernel(monkeypatch, job, is_assigned)
        found = _Job(5)
        found.end()
        assert not found.is_led and asked.TerminateJobObject.call_count == 0
        del found
        assert asked.CloseHandle.call_count == (job is not None)
