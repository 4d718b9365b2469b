"""The window of lessons: which step it shows after which keys, and how large."""

import numpy as np

from engine3d import events
from engine3d.apps.viewer.lesson_window import BACKDROP, Lesson, LessonWindow, enlarged


class FakeWindow:
    """Plays a script of events and keeps what it was shown."""

    size = (40, 30)

    def __init__(self, script=()):
        self.script, self.shown, self.title, self.closed = script, [], "", False

    def __iter__(self):
        for event in self.script:
            if self.closed:
                return
            yield event

    def present(self, picture):
        self.shown.append(int(picture[15, 20, 0]))

    def close(self):
        self.closed = True


def lesson(number, steps, drawn):
    """A lesson whose steps are squares of grey: ten times its number, plus the step's."""

    def draw():
        for step in range(steps):
            drawn.append(10 * number + step)
            yield np.full((4, 4, 4), 10 * number + step, np.uint8)

    return Lesson(f"lesson {number}", draw)


def play(*script, first=0):
    """What a window of lessons with 3, 1 and 2 steps shows, what was drawn, and its title."""
    drawn = []
    lessons = [lesson(number, steps, drawn) for number, steps in ((1, 3), (2, 1), (3, 2))]
    window = FakeWindow(script)
    LessonWindow(window, lessons, first).run()
    return window.shown, drawn, window.title


def keys(*names):
    return [events.KeyDown(name, name) for name in names]


def test_arrows_go_from_step_to_step_and_on_to_the_next_lesson():
    shown, drawn, title = play(*keys("Right", "Space", "Return", "PageDown", "Right", "Right"))
    assert shown == [10, 11, 12, 20, 30, 31, 31]
    assert drawn == [10, 11, 12, 20, 30, 31]
    assert title.startswith("lesson 3 - step 2")


def test_back_goes_to_the_last_step_of_the_lesson_before():
    shown, drawn, _ = play(*keys("Left", "Backspace", "PageUp", "Left", "Left"), first=1)
    assert shown == [20, 12, 11, 10, 10, 10]
    assert drawn == [20, 10, 11, 12]


def test_n_and_p_go_from_lesson_to_lesson():
    shown, drawn, _ = play(*keys("N", "N", "N", "Up", "P", "P"))
    assert shown == [10, 20, 30, 30, 20, 10, 10]
    assert drawn[:3] == [10, 20, 30]


def test_the_mouse_goes_on_and_back_and_other_events_do_nothing():
    left, right = (events.MouseButton(name, True) for name in ("left", "right"))
    up, motion = events.MouseButton("left", False), events.MouseMotion(1, 1)
    shown, _, _ = play(left, up, motion, left, right, events.Resized(40, 30))
    assert shown == [10, 11, 12, 11, 11]


def test_q_and_escape_leave():
    for key in ("Q", "Escape"):
        shown, _, _ = play(*keys(key, "Right"))
        assert shown == [10]


def test_pictures_are_enlarged_by_whole_numbers():
    picture = np.arange(2 * 3 * 4, dtype=np.uint8).reshape(2, 3, 4)
    large = enlarged(picture, (10, 7))
    assert large.shape == (7, 10, 4)
    assert (large[0:6, 0:9] == picture.repeat(3, 0).repeat(3, 1)).all()
    assert (large[6] == BACKDROP).all() and (large[:, 9] == BACKDROP).all()
    assert enlarged(picture, (2, 2)) is picture
