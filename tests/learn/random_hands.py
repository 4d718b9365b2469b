"""Random hands on the course: keys, mouse, answers, sizes, both languages, windows and terminals.

In: a `random.Random`. Out: a session played to its end, and `Finding` if it shows what it must not.
By itself it runs for as long as it is told, through all lessons:

    python tests/learn/random_hands.py [--seconds 60] [--seed 0] [--actions 30]
"""

from __future__ import annotations

import argparse
import random
import sys
import time
import traceback
import warnings
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from engine3d import events
from engine3d.apps.learn.course_session import Session
from engine3d.apps.learn.learn_window import LearnWindow
from engine3d.apps.learn.lesson_file import LANGUAGES, plain_answer
from engine3d.apps.learn.lesson_programs import find_programs
from engine3d.apps.learn.page_html import lesson_html

PROGRAMS = find_programs()
_KEYS = ("Right", "Left", "Space", "Return", "Backspace", "PageUp", "Home", "End", "Tab", "Up")
_KEYS = (*_KEYS, "Down", "+", "H", "F1", "F7", "C", "J", "K", "Keypad 7", "Keypad Enter")
_TYPED = "0123456789.,-"
_SIZES = ((1240, 720), (64, 64), (300, 900), (1600, 200), (640, 480))
_CELLS = ((80, 24), (1, 1), (20, 5), (200, 60), (40, 2))


class Finding(AssertionError):
    """What must not be."""


class _Window:
    """A window that nobody sees, whose events hands make; `left` actions are left."""

    writes_text, scale, clipboard, title = False, 1.0, "", ""

    def __init__(self, rng: random.Random, count: int, done: list[str]) -> None:
        self._rng, self._left, self._done = rng, count, done
        self.size, self.cells = _SIZES[0], _CELLS[0]

    def events(self, timeout: float) -> list:
        if timeout == 0.0 and self._rng.random() < 0.5:
            return []  # while steps are drawn
        self._left -= 1
        if self._left < 0:
            return [events.CloseRequested()]
        event = self._event()
        self._done.append(repr(event))
        return [event]

    def _event(self):
        rng, (width, height) = self._rng, self.size
        kind, x, y = rng.random(), rng.randrange(width), rng.randrange(height)
        if kind < 0.6:
            key = rng.choice(_KEYS if rng.random() < 0.7 else _TYPED)
            return events.KeyDown(key, key)
        if kind < 0.8:
            button = rng.choice(("left", "left", "right", "middle"))
            return events.MouseButton(button, True, x=x, y=y)
        if kind < 0.9:
            return events.Wheel(rng.choice((-40.0, -1.0, 0.3, 2.0)), x, y)
        self.size, self.cells = rng.choice(_SIZES), rng.choice(_CELLS)
        self.scale = rng.choice((0.5, 1.0, 1.0, 2.0))
        return events.Resized(*self.size)

    def present(self, pixels) -> None:
        if pixels.shape[1::-1] != self.size:
            raise Finding(f"a picture of {pixels.shape} in a window of {self.size}")
        if (pixels[..., 3] != 255).any():
            raise Finding("a picture that is not opaque")


class _Terminal(_Window):
    """One that writes text, and has no clipboard."""

    writes_text = True
    clipboard = property()

    def show_lines(self, lines: list[str]) -> None:
        if len(lines) > max(self.cells[1], 1):
            raise Finding(f"{len(lines)} lines in a terminal of {self.cells}")


def play(rng: random.Random, lessons: list[Path], count: int, done: list[str]) -> None:
    """Play a course of some lessons; note what is done."""
    kind, language = rng.choice((_Window, _Terminal)), rng.choice(LANGUAGES)
    number = rng.randrange(len(lessons))
    done.append(f"{kind.__name__}, {language}, {lessons[number].stem}")
    LearnWindow(kind(rng, count, done), Session(lessons, number, language)).run()


def check_answers(rng: random.Random, lesson: Path, count: int = 50) -> None:
    """Give a lesson random answers: each is right, wrong or no number, and never fails."""
    session = Session([lesson], 0, "en")
    for _ in range(count):
        session.answer = "".join(rng.choices(_TYPED, k=rng.randrange(1, 13)))
        session.check()
        if (session.mood == "right") != session.texts.is_right(session.answer):
            raise Finding(session.answer)
        if plain_answer(session.answer) is None and session.mood != "wrong":
            raise Finding(f"{session.answer} is {session.mood}")


def main() -> None:
    """Run for some seconds: sessions, answers, pages."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--actions", type=int, default=30)
    given = parser.parse_args()
    warnings.simplefilter("error")
    end, seed, failed = time.monotonic() + given.seconds, given.seed, 0
    while time.monotonic() < end:
        rng, done = random.Random(seed), []
        try:
            begin = rng.randrange(len(PROGRAMS) - 1)
            play(rng, PROGRAMS[begin : begin + 2], given.actions, done)
            check_answers(rng, rng.choice(PROGRAMS))
            if rng.random() < 0.1:
                lesson_html(rng.choice(PROGRAMS), rng.choice(LANGUAGES))
        except Exception:
            failed += 1
            traceback.print_exc()
            print(f"^ seed {seed}, after: {done[:1]} ... {done[-3:]}\n", flush=True)
        seed += 1
    print(f"{seed - given.seed} runs, {failed} with findings")


if __name__ == "__main__":
    main()
