"""Processes that end together with what they have started."""

import signal
import subprocess
import sys
import time

from missing_here import KILL, is_running
from patience import HUNG

from engine3d.base.process_groups import LeadingProcess

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
