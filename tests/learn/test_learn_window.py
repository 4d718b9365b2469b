"""The window of the course: what it does with events, in a window and in a terminal of text."""

import numpy as np
import pytest

from engine3d import events
from engine3d.apps.learn.course_session import Session
from engine3d.apps.learn.learn_window import LearnWindow
from engine3d.apps.learn.lesson_programs import find_programs


class FakeWindow:
    """Plays a script of events, one at a time, and keeps what it was shown."""

    size, scale, writes_text, clipboard, title = (1240, 700), 1, False, "", ""

    def __init__(self, *script):
        self.script, self.shown = list(script), []

    def events(self, timeout):
        if timeout == 0.0:  # there are steps to draw
            return []
        return [self.script.pop(0) if self.script else events.CloseRequested()]

    def present(self, picture):
        self.shown.append(picture.copy())


class FakeTerminal(FakeWindow):
    """One that writes text, and has no clipboard."""

    writes_text, cells = True, (80, 24)
    clipboard = property()

    def show_lines(self, lines):
        self.shown.append(lines)


def play(*script, kind=FakeWindow):
    window, session = kind(*script), Session(find_programs(), 2, "en")
    LearnWindow(window, session).run()
    return window, session


def keys(*names):
    return [events.KeyDown(name, name) for name in names]


def test_steps_are_drawn_while_nothing_happens():
    window, session = play()
    assert session.is_complete and window.title == "3. Lines - step 1 of 6"
    assert len(window.shown) == 2  # before and after it is known how many there are


def test_keys_and_buttons_go_through_the_steps():
    left, right = (events.MouseButton(name, True, x=200, y=200) for name in ("left", "right"))
    up, motion = events.MouseButton("left", False), events.MouseMotion(1, 1)
    window, session = play(*keys("Right"), left, up, motion, left, right, *keys("F7"))
    assert session.place == "step 3 of 6" and len(window.shown) == 6
    assert session.is_over


def test_c_copies_the_code():
    window, session = play(*keys("C"))
    assert window.clipboard.splitlines() == list(session.texts.code)
    assert "clipboard" in session.said


@pytest.mark.parametrize("button", ["left", "right"])
def test_what_was_said_of_the_code_goes_with_the_next_step(button):
    _, session = play(*keys("Right", "C"), events.MouseButton(button, True, x=200, y=200))
    assert session.said == "" and session.place != "step 2 of 6"


def test_a_click_closes_the_list_of_keys_and_stays_at_the_step():
    _, session = play(*keys("H"), events.MouseButton("left", True, x=200, y=200))
    assert not session.shows_help and session.place == "step 1 of 6"


def test_the_wheel_moves_a_page_that_is_too_long():
    FakeWindow.size = (1000, 300)
    try:
        window, _ = play(
            events.Wheel(-1.0), events.Wheel(5.0), *keys("J", "K"), events.Resized(9, 9)
        )
    finally:
        FakeWindow.size = (1240, 700)
    _, top, moved, back, down, up, resized = window.shown
    assert (top != moved).any() and (moved == down).all()
    assert all((top == page).all() for page in (back, up, resized))


def test_an_answer_is_kept_in_sight():
    FakeWindow.size = (1000, 300)
    try:
        window, _ = play(*keys("4"), events.Wheel(-100.0))
    finally:
        FakeWindow.size = (1240, 700)
    _, top, typed, end = window.shown
    assert (top != typed).any() and (typed == end).all()


@pytest.mark.parametrize("size", [(1600, 200), (320, 120)])
def test_the_answer_is_reached_in_the_lowest_window(size, monkeypatch):
    monkeypatch.setattr(FakeWindow, "size", size)
    window, _ = play(events.Wheel(-1000.0), *keys("4", "9"))
    *_, end, four, many = window.shown
    assert (end != four).any() and (four != many).any()


@pytest.mark.parametrize("cells", [(80, 3), (80, 2), (80, 1), (1, 1)])
def test_a_terminal_gets_no_more_lines_than_it_has(cells, monkeypatch):
    monkeypatch.setattr(FakeTerminal, "cells", cells)
    window, _ = play(*keys("Right", "H", "H", "End"), kind=FakeTerminal)
    assert {len(lines) for lines in window.shown} == {cells[1]}


def test_a_terminal_gets_lines():
    window, session = play(*keys("Right", "C"), kind=FakeTerminal)
    assert all(len(lines) == 24 for lines in window.shown)
    assert "step 2 of 6" in window.shown[-1][0]
    assert session.said == "engine3d learn lines --code prints the code."


def test_what_is_shown_is_opaque():
    window, _ = play()
    assert window.shown[0].dtype == np.uint8 and (window.shown[0][:, :, 3] == 255).all()
