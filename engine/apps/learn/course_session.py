"""Where a pupil is in the course: lesson, step, values of the parameters, answer.

In: keys. Out: what the views show. Steps are drawn one at a time, so that the first one shows at
once; `draw_more` draws the next.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from .captions import number as number_text
from .lesson_file import LessonFile, plain_answer
from .lesson_programs import Step, first_values, steps_of, texts_of
from .words import say

LONGEST_ANSWER = 12
_TYPED = "0123456789.,-"


class Session:
    """A walk through the course.

    Parameters
    ----------
    programs : sequence of Path
        Of the lessons, in order.
    number : int
        Index of the lesson to begin with.
    language : {"en", "fr"}

    Attributes
    ----------
    language : str
    answer : str
        To the exercise, as far as it is typed.
    said : str
        What is said of the answer, or of what was done last.
    mood : {"right", "wrong", "plain"}
        Whether that is that the answer is right or wrong, or something else.
    shows_help, is_at_end : bool
        Whether the list of keys, or the end of the course, is shown in place of a step.
    is_over : bool
        Whether the pupil has left.
    """

    def __init__(self, programs: Sequence[Path], number: int, language: str) -> None:
        self._programs, self.language = programs, language
        self.shows_help = self.is_at_end = self.is_over = False
        self.open(number)

    def open(self, number: int) -> None:
        """Begin a lesson: at its first step, with the usual values."""
        self.number = number
        self.values = first_values(self._programs[number])
        self._chosen = 0
        self.answer = ""
        self.remark("")
        self.is_at_end = False
        self._place = 0
        self._begin()

    def _begin(self) -> None:
        """Draw the steps anew, those up to the present one at once."""
        program = self._programs[self.number]
        self._rest: Iterator[Step] | None = steps_of(program, self.language, self.values)
        self._steps: list[Step] = []
        while len(self._steps) <= self._place and self.draw_more():
            pass
        self._place = min(self._place, len(self._steps) - 1)

    def draw_more(self) -> bool:
        """Draw one more step of the lesson, if there is one; return whether there was."""
        step = next(self._rest, None) if self._rest is not None else None
        if step is None:
            self._rest = None
            return False
        self._steps.append(step)
        return True

    def draw_all(self) -> None:
        """Draw all steps of the lesson."""
        while self.draw_more():
            pass

    @property
    def is_complete(self) -> bool:
        """Whether all steps of the lesson are drawn."""
        return self._rest is None

    @property
    def texts(self) -> LessonFile:
        """The texts of the lesson."""
        return texts_of(self._programs[self.number])

    @property
    def title(self) -> str:
        """Number and title of the lesson."""
        return self.texts.title(self.language)

    @property
    def step(self) -> Step:
        """The step that is shown."""
        return self._steps[self._place]

    @property
    def place(self) -> str:
        """Which step it is of how many, in words; dots until all are drawn."""
        count = len(self._steps) if self.is_complete else "…"
        return say("step", self.language, self._place + 1, count)

    def word(self, value: float | str) -> str:
        """Return the value of a parameter as it is shown."""
        if isinstance(value, str):
            return self.texts.words(self.language).get(value, value)
        return number_text(value, "", self.language)

    def remark(self, text: str) -> None:
        """Say something that is neither right nor wrong."""
        self.said, self.mood = text, "plain"

    @property
    def chosen(self) -> int:
        """Index of the parameter that the keys change."""
        return self._chosen

    @property
    def next_title(self) -> str | None:
        """The title of the lesson that follows, or that of the end, at a lesson's last step."""
        if not self.is_complete or self._place + 1 < len(self._steps):
            return None
        if self.number + 1 < len(self._programs):
            return texts_of(self._programs[self.number + 1]).title(self.language)
        return say("end", self.language)

    # What keys do

    def press(self, key: str) -> bool:
        """Do what a key does; return whether it does anything."""
        if self.shows_help and key not in ("Q", "H"):
            self.shows_help = False
            return True
        key = key.removeprefix("Keypad ")
        if len(key) == 1 and key in _TYPED:
            self._type(key)
        elif key == "Backspace" and self.answer:
            self.answer = self.answer[:-1]
            self.remark("")
        elif key in ("Return", "Enter") and self.answer and self.mood != "right":
            self.check()
        elif key in _KEYS:
            if self.mood == "plain":
                self.remark("")
            _KEYS[key](self)
        else:
            return False
        return True

    def go_on(self) -> None:
        """Go to the next step, or to the next lesson after the last step."""
        if self._place + 1 == len(self._steps):
            self.draw_more()
        if self._place + 1 < len(self._steps):
            self._place += 1
        elif self.number + 1 < len(self._programs):
            self.open(self.number + 1)
        else:
            self.is_at_end = True

    def go_back(self) -> None:
        """Go to the step before, or to the last step of the lesson before."""
        if self.is_at_end:
            self.is_at_end = False
        elif self._place > 0:
            self._place -= 1
        elif self.number > 0:
            self.open(self.number - 1)
            self.go_to_last()

    def go_to_first(self) -> None:
        """Go to the first step."""
        self._place, self.is_at_end = 0, False

    def go_to_last(self) -> None:
        """Go to the last step."""
        self.draw_all()
        self._place = len(self._steps) - 1

    def open_next(self) -> None:
        """Go to the next lesson, or to the end of the course."""
        if self.number + 1 < len(self._programs):
            self.open(self.number + 1)
        else:
            self.is_at_end = True

    def open_last(self) -> None:
        """Go to the lesson before, from the end of the course to its last lesson."""
        if self.is_at_end:
            self.is_at_end = False
        else:
            self.open(max(self.number - 1, 0))

    def choose(self, by: int = 1) -> None:
        """Choose another parameter."""
        count = len(self.texts.parameters)
        self._chosen = (self._chosen + by) % count if count else 0

    def change(self, by: int, parameter: int | None = None) -> None:
        """Take the next value of a parameter, or the one before, and draw the lesson with it."""
        parameters = self.texts.parameters
        if not parameters or self.is_at_end:
            return
        if parameter is not None:
            self._chosen = parameter
        chosen = parameters[self._chosen]
        place = chosen.values.index(self.values[chosen.name]) + by
        if 0 <= place < len(chosen.values):
            self.values[chosen.name] = chosen.values[place]
            self._begin()

    def check(self) -> None:
        """Tell whether the answer is right."""
        is_right = self.texts.is_right(self.answer)
        is_number = plain_answer(self.answer) is not None
        word = "right" if is_right else "wrong" if is_number else "none"
        self.said, self.mood = say(word, self.language), "right" if is_right else "wrong"

    def leave(self) -> None:
        """End the session."""
        self.is_over = True

    def toggle_help(self) -> None:
        """Show the list of keys, or hide it."""
        self.shows_help = not self.shows_help

    def _type(self, key: str) -> None:
        before = "" if self.mood == "right" else self.answer
        self.answer = (before + key)[:LONGEST_ANSWER]
        self.remark("")


_ACTIONS: dict[Callable[[Session], None], tuple[str, ...]] = {
    Session.go_on: ("Right", "Space", "Return", "Enter", "PageDown"),
    Session.go_back: ("Left", "Backspace", "PageUp"),
    Session.go_to_first: ("Home",),
    Session.go_to_last: ("End",),
    Session.open_next: ("N",),
    Session.open_last: ("P",),
    Session.choose: ("Tab",),
    lambda session: session.change(1): ("Up", "+"),
    lambda session: session.change(-1): ("Down",),
    Session.toggle_help: ("H", "F1"),
    Session.leave: ("Q", "Escape"),
}
_KEYS = {key: action for action, keys in _ACTIONS.items() for key in keys}
