"""A walk through the course: which step, value and answer there is after which keys."""

import pytest

from engine3d.apps.learn.course_session import Session
from engine3d.apps.learn.lesson_programs import find_programs


@pytest.fixture
def session():
    """The first three lessons, at the third."""
    return Session(find_programs()[:3], 2, "en")


def press(session, *keys):
    for key in keys:
        assert session.press(key), key


def test_arrows_go_through_steps_and_lessons(session):
    assert session.place == "step 1 of …" and session.title == "3. Lines"
    first = session.step
    press(session, "Right", "Space", "Left", "Left")
    assert session.step is first
    press(session, "Left")
    assert session.title == "2. Points" and session.place == "step 4 of 4"
    press(session, "Return")
    assert session.title == "3. Lines" and session.place.startswith("step 1 of")


def test_home_and_end_go_to_the_ends_of_a_lesson(session):
    press(session, "End")
    assert session.place == "step 6 of 6"
    press(session, "Home")
    assert session.place == "step 1 of 6"


def test_the_last_step_says_what_comes_next(session):
    press(session, "P", "End")
    assert session.next_title == "3. Lines"
    press(session, "Left")
    assert session.next_title is None
    press(session, "N", "End")
    assert session.next_title == "The end of the course"
    press(session, "Right")
    assert session.is_at_end
    press(session, "Left")
    assert not session.is_at_end and session.place == "step 6 of 6"


def test_a_value_is_changed_and_the_step_is_drawn_anew(session):
    press(session, "Right")
    assert session.step.caption == "DDA: 16 directions from the middle"
    before = session.step.shown[0]
    press(session, "Up")
    assert session.step.caption == "DDA: 24 directions from the middle"
    assert (session.step.shown[0] != before).any()
    press(session, "Up", "Up", "Up")
    assert session.values == {"directions": 32}
    press(session, "Down", "Down", "Down", "Down", "Down")
    assert session.values == {"directions": 8}
    press(session, "P")
    assert session.values == {"yaw": 0.0}
    press(session, "N")
    assert session.values == {"directions": 16}


def test_parameters_are_chosen_in_turn():
    session = Session(find_programs(), 16, "en")
    press(session, "Tab", "Up")
    assert session.values == {"lamp": 0.7, "intensity": 1.6}
    press(session, "Tab", "Up")
    assert session.values == {"lamp": 1.0, "intensity": 1.6}


def test_an_answer_is_typed_and_checked(session):
    press(session, "4", "Keypad 9", "Return")
    assert (session.answer, session.said) == ("49", "Not yet: try again.")
    session.remark("copied")
    press(session, "Backspace", "Backspace", "5", "0", ".", "0", "Return")
    assert (session.said, session.mood) == ("Right!", "right")
    press(session, "-", "Return")
    assert (session.answer, session.said) == ("-", "That is no number.")
    assert session.mood == "wrong"
    place = session.place
    press(session, "Backspace", "Return")
    assert session.place != place


def test_help_is_shown_and_hidden(session):
    press(session, "H", "Right")
    assert not session.shows_help and session.place.startswith("step 1")
    press(session, "H", "H", "Q")
    assert session.is_over
    assert not session.press("F7")
