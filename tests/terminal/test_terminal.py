"""The commands in a terminal: one made of a pty that answers as kinds of terminals do, and tmux."""

import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import pytest

pytest.importorskip("termios", reason="terminals are POSIX's")
import fcntl
import pty
import struct
import termios

from patience import HUNG
from terminal import hostile_answers

from engine3d.apps.terminal.device import LARGEST_CELL, MOST_CELLS, Answers, Device
from engine3d.apps.terminal.keys import Decoder
from engine3d.apps.terminal.terminal_window import TerminalWindow, picture_size

COMMAND = (
    "import sys; from importlib.resources import files;"
    "from engine3d.start import main;"
    "model = str(files('engine3d.data') / 'models' / 'teapot.obj');"
    "sys.argv[1:] = [model if word == 'MODEL' else word for word in sys.argv[1:]];"
    "sys.exit(main())"
)
COLUMNS, ROWS = 60, 20
#: What terminals answer: kitty's graphics, sixels with cells of 9x18 pixels, neither.
KINDS = {
    "kitty": b"\x1b_Gi=31;OK\x1b\\\x1b[6;18;9t\x1b[?1016;2$y\x1b[?62;c",
    "sixel": b"\x1b[6;18;9t\x1b[?62;4;22c",
    "blocks": b"\x1b[?6c",
}
SHOWS = {"kitty": b"\x1b_Ga=T", "sixel": b'\x1bP0;1;0q"', "blocks": "\N{UPPER HALF BLOCK}".encode()}


class FakeTerminal:
    """A pty with a command in it, and a thread that reads what it writes and answers questions."""

    def __init__(self, kind, *arguments, size=(ROWS, COLUMNS)):
        self.written = b""
        self.pid, self.file = pty.fork()
        if self.pid == 0:
            os.execv(sys.executable, [sys.executable, "-c", COMMAND, *arguments])
        fcntl.ioctl(self.file, termios.TIOCSWINSZ, struct.pack("4H", *size, 0, 0))
        self.answer = KINDS.get(kind, kind)
        self.status = None
        self.thread = threading.Thread(target=self._read, daemon=True)
        self.thread.start()

    def _read(self):
        asked = 0
        while True:
            try:
                data = os.read(self.file, 1 << 16)
            except OSError:  # the command has ended
                return
            if not data:
                return
            self.written = (self.written + data)[-(1 << 20) :]
            if self.written.count(b"\x1b[c") > asked:
                asked += 1
                self.type(self.answer)

    def type(self, data):
        os.write(self.file, data)

    def wait_for(self, pattern):
        """Wait until what was written since the last wait holds a pattern; return that."""
        ends = time.monotonic() + HUNG
        while (match := re.search(pattern, self.written, re.S)) is None:
            assert time.monotonic() < ends, self.written[-300:]
            time.sleep(0.01)
        found, self.written = self.written[: match.end()], self.written[match.end() :]
        return found

    def endures(self, pieces):
        """Type pieces of anything, then that the viewer is to end; return its exit status."""
        with contextlib.suppress(OSError):  # it has ended already
            for piece in (*pieces, b"\x03"):
                for place in range(0, len(piece), 2048):
                    self.type(piece[place : place + 2048])
                time.sleep(0.1)
        return self.ends()

    def ends(self):
        """Wait for the command's end and return its exit status."""
        _, status = os.waitpid(self.pid, 0)
        self.thread.join(5)
        os.close(self.file)
        return os.waitstatus_to_exitcode(status)


@pytest.mark.parametrize("kind", KINDS)
def test_run_shows_pictures_and_obeys_keys(kind):
    terminal = FakeTerminal(kind, "run", "MODEL", "--terminal")
    begun = terminal.wait_for(re.escape(SHOWS[kind]))
    assert b"\x1b[?1049h" in begun
    terminal.wait_for(b"idle")
    terminal.type(b"4")
    terminal.wait_for(re.escape(SHOWS[kind]))
    terminal.type(b"q")
    terminal.wait_for(re.escape(b"\x1b[?1049l"))
    assert terminal.ends() == 0


@pytest.mark.parametrize("kind", KINDS)
def test_lessons_are_shown_and_answers_checked(kind):
    terminal = FakeTerminal(
        kind, "learn", "lines", "--terminal", "--language", "en", size=(60, 100)
    )
    assert SHOWS[kind] in terminal.wait_for(b"step 1 of 6")
    terminal.type(b"\x1b[C")
    assert SHOWS[kind] in terminal.wait_for(b"step 2 of 6")
    terminal.type(b"50\r")
    terminal.wait_for(b"Right!" if kind == "blocks" else re.escape(SHOWS[kind]))
    terminal.type(b"q")
    assert terminal.ends() == 0


@pytest.mark.parametrize("kind", KINDS)
def test_render_prints_a_picture(kind):
    terminal = FakeTerminal(kind, "render", "MODEL", "-o", "terminal:")
    terminal.wait_for(re.escape(SHOWS[kind]))
    assert terminal.ends() == 0
    assert b"\x1b[?1049h" not in terminal.written


def test_text_is_written_where_pixels_are_too_large_for_letters():
    terminal = FakeTerminal("blocks", "run", "MODEL", "--terminal")
    terminal.wait_for(b"all commands")
    terminal.type(b"h")
    terminal.wait_for(b"> wireframe")
    terminal.type(b"\x03")
    assert terminal.ends() == 0


def test_the_terminal_is_given_back_after_a_signal():
    terminal = FakeTerminal("blocks", "run", "MODEL", "--terminal")
    terminal.wait_for(b"idle")
    os.kill(terminal.pid, signal.SIGINT)
    terminal.wait_for(re.escape(b"\x1b[?1049l"))
    assert terminal.ends() != 0


def test_without_a_terminal_the_error_says_so():
    command = [sys.executable, "-c", COMMAND, "render", "MODEL", "-o", "terminal:"]
    run = subprocess.run(command, capture_output=True, text=True, start_new_session=True)
    assert run.returncode == 1
    assert run.stderr == "engine3d: error: there is no terminal to show pictures in\n"


@pytest.mark.parametrize(
    ("graphics", "size"),
    [("blocks", (60, 38)), ("sixel", (540, 342)), ("kitty", (540, 342))],
)
def test_a_picture_fills_its_cells(graphics, size):
    assert picture_size(Answers(graphics, (9, 18), False), (60, 19)) == size


def test_pictures_for_large_terminals_have_a_limit():
    assert picture_size(Answers("kitty", (20, 40), False), (200, 60)) == (1280, 768)
    assert picture_size(Answers("sixel", (20, 40), False), (200, 60)) == (640, 480)


@pytest.mark.parametrize("size", [(ROWS, COLUMNS), (0, 0), (65535, 65535)])
def test_the_viewer_goes_on_whatever_the_terminal_says(size):
    choice = random.Random(str(size))
    terminal = FakeTerminal(hostile_answers.answer(choice), "run", "MODEL", "--terminal", size=size)
    terminal.wait_for(re.escape(b"\x1b[?1049h"))
    assert terminal.endures([hostile_answers.keys(choice) for _ in range(4)]) == 0


class SilentDevice(Device):
    """A terminal without a system: what it is asked for comes in pieces."""

    def __init__(self, said, size):
        self._pieces = [said[place : place + 4096] for place in range(0, len(said), 4096)]
        self._size = size

    def write(self, data):
        pass

    def read(self, timeout):
        return self._pieces.pop(0) if self._pieces else b"\x1b[?62;c"

    def cells(self):
        return self._size

    def _cell_by_system(self):
        return None


def test_sizes_that_no_terminal_has_count_as_not_told():
    for number in range(100):
        choice = random.Random(number)
        size = choice.choice([(60, 19), (1, 2), MOST_CELLS])
        device = SilentDevice(hostile_answers.answer(choice), size)
        answers = device.ask()
        assert all(1 <= side <= LARGEST_CELL for side in answers.cell)
        width, height = picture_size(answers, size)
        assert 1 <= width <= 1280 and 1 <= height <= 1000
        window = TerminalWindow.__new__(TerminalWindow)
        window.answers, window._device = answers, device
        events = Decoder(window._place).decode(hostile_answers.keys(choice), ended=True)
        width, height = window.size
        places = [(event.x, event.y) for event in events if hasattr(event, "x")]
        assert all(-1 <= x <= width and -1 <= y <= height for x, y in places)


def test_an_endless_answer_is_not_waited_for():
    begun = time.monotonic()
    answers = SilentDevice(b"\x1b[?" + b"1;" * 10_000_000, (60, 19)).ask()
    assert answers.graphics == "blocks" and time.monotonic() - begun < 1.0


@pytest.mark.skipif(shutil.which("tmux") is None, reason="needs tmux")
def test_in_tmux(tmp_path):
    def tmux(*arguments):
        command = ["tmux", "-S", str(tmp_path / "socket"), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    def wait_for(text, *options):
        ends = time.monotonic() + HUNG
        while text not in (screen := tmux("capture-pane", "-p", *options)):
            assert time.monotonic() < ends, screen
            time.sleep(0.05)
        return screen

    python = f'{sys.executable} -c "{COMMAND}" run MODEL --terminal; echo left $?; sleep 60'
    tmux("new-session", "-d", "-x", str(COLUMNS), "-y", str(ROWS), python)
    try:
        wait_for("idle")
        before = tmux("capture-pane", "-p", "-e")
        tmux("send-keys", "4")
        ends = time.monotonic() + HUNG
        while tmux("capture-pane", "-p", "-e") == before:
            assert time.monotonic() < ends
            time.sleep(0.05)
        tmux("send-keys", "w")
        wait_for("wireframe: overlay")
        tmux("send-keys", "q")
        screen = wait_for("left 0")
        assert "\N{UPPER HALF BLOCK}" not in screen, "the other screen is still there"
    finally:
        tmux("kill-server")
