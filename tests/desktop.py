"""A virtual screen, and hands and eyes on a program that has a window there.

Nothing here waits for a number of seconds: a program is done with what it was told when all of its
threads, and the screen's, sleep for a moment. On a busy machine they wait for a processor instead,
which is no sleep, so that this holds however loud it is.
"""

import contextlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from patience import HUNG
from PIL import ImageGrab, features

from engine3d.apps.viewer import sampling

MISSING = [tool for tool in ("Xvfb", "xdotool") if shutil.which(tool) is None]
if not features.check("xcb"):
    MISSING.append("a Pillow that reads X screens")
MARKS = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(MISSING), reason=f"needs {', '.join(MISSING)}"),
]
#: How long a program must sleep to be at rest: longer than what it does by the clock, such as
#: drawing again, with more samples, what has moved.
REST_SECONDS = 0.05 + sampling.REST_SECONDS

#: What share of a processor a program may take that has nothing to draw. It wakes a few times a
#: second, for 2 ms; on a virtual machine that has slept meanwhile, with cold caches, for 10.
IDLE_SHARE = 0.05


class Screen:
    """A virtual screen.

    Attributes
    ----------
    name : str
        Such as ``:5``.
    pid : int
        Of the process that draws it.
    size : tuple of int
    """

    def __init__(self, name, pid, size):
        self.name, self.pid, self.size = name, pid, size

    def environment(self):
        """Return the variables of a program on this screen."""
        others = ("WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "GDK_SCALE", "GDK_DPI_SCALE")
        kept = {name: value for name, value in os.environ.items() if name not in others}
        return {**kept, "DISPLAY": self.name}


@contextlib.contextmanager
def virtual_screen(width, height, *options):
    """Start a `Screen`; end it afterwards."""
    size = f"{width}x{height}x24"
    command = [
        "Xvfb",
        "-displayfd",
        "1",
        "-screen",
        "0",
        size,
        "-nolisten",
        "tcp",
        "-noreset",
        *options,
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as server:
        yield Screen(":" + server.stdout.readline().decode().strip(), server.pid, (width, height))
        server.terminate()


def until(condition):
    """Wait until something is so; return what it is."""
    end = time.monotonic() + HUNG
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.03)
    raise AssertionError("it took too long")


def _threads(pid):
    """The fields that the system has of each thread of a process, from its state on."""
    with contextlib.suppress(OSError):  # a thread, or the process, may end meanwhile
        files = Path(f"/proc/{pid}/task").glob("*/stat")
        return [file.read_text().rpartition(")")[2].split() for file in files]
    return []


def processor_seconds(pid):
    """What a process has had of processors."""
    ticks = sum(int(fields[11]) + int(fields[12]) for fields in _threads(pid))
    return ticks / os.sysconf("SC_CLK_TCK")


class Desktop:
    """A running program, and hands and eyes on its screen.

    Parameters
    ----------
    screen : Screen
    folder : Path
        Where the program runs.
    command : list of str
        What Python is called with.
    variables : dict of str to str
        Of the environment.
    """

    def __init__(self, screen, folder, command, **variables):
        self.folder, self.screen = folder, screen
        self.environment = {**screen.environment(), **variables}
        self.process = subprocess.Popen(
            [sys.executable, *command],
            cwd=folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        try:
            self.do("mousemove", *(side // 2 for side in screen.size))
            self.window = until(self._lasting_window)
            until(lambda: self.look().any())  # hands before the first picture find nothing
            self.settle()
        except BaseException:
            self.kill()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.kill()

    def _lasting_window(self):
        """The window's number once the program is at rest with it: SDL makes another one at first.

        The first one can have the keyboard, and the program seem at rest, before SDL replaces it.
        """
        window = self._focused_window()
        if window:
            self.settle()
        return window if window == self._focused_window() else ""

    def _focused_window(self):
        """The window's number if it has the keyboard."""
        assert self.process.poll() is None, self.process.communicate()
        which = ("--all", "--pid", self.process.pid, "--class", "engine3d")
        window = self.do("search", "--onlyvisible", *which, check=False)
        self.do("windowfocus", window, check=False)
        return window if window and self.do("getwindowfocus", "-f") == window else ""

    def do(self, *arguments, check=True):
        """Run xdotool; return what it prints."""
        command = ["xdotool", *map(str, arguments)]
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, check=check, timeout=HUNG
        )
        return done.stdout.strip()

    @property
    def title(self):
        return self.do("getwindowname", self.window)

    def look(self):
        """Return what the screen shows, (H, W, 3) uint8."""
        return np.asarray(ImageGrab.grab(xdisplay=self.screen.name).convert("RGB"))

    def settle(self):
        """Wait until the program and the screen are at rest; return what the screen shows."""
        slept, spent = time.monotonic(), -1.0
        end = slept + HUNG
        while (now := time.monotonic()) - slept < REST_SECONDS:
            pids = (self.process.pid, self.screen.pid)
            before, spent = spent, sum(map(processor_seconds, pids))
            asleep = all(fields[0] == "S" for pid in pids for fields in _threads(pid))
            if not asleep or spent != before:
                slept = now
            assert now < end, "the program did not come to rest"
            time.sleep(0.01)
        return self.look()

    def wait_for_change(self, before):
        """Wait until the screen shows something else than ``before``; return it."""

        def changed():
            now = self.look()
            return [now] if (now != before).any() else []

        return until(changed)[0]

    def finish(self):
        """Return the exit status and what was printed, once the program has ended."""
        out, err = self.process.communicate(timeout=HUNG)
        return self.process.returncode, out + err

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
