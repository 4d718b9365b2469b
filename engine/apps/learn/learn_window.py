"""Shows the course in a window, or in the terminal: keys and mouse in, pages out.

A terminal whose graphics are cells of text gets lines of text; everything else gets pictures.
"""

from __future__ import annotations

from .. import events
from .course_session import Session
from .page_picture import Page, draw_page
from .page_text import text_page
from .words import say

#: Seconds until Ctrl-C is looked for.
PATIENCE = 0.25
#: Lines that the wheel moves the page.
WHEEL_LINES = 3


class LearnWindow:
    """Shows a session until the pupil leaves, or closes the window.

    Steps that nobody has asked for yet are drawn while nothing happens.

    Parameters
    ----------
    window : Window or TerminalWindow
    session : Session
    """

    def __init__(self, window, session: Session) -> None:
        self._window, self._session = window, session
        self._scroll = 0
        self._page: Page | None = None
        self._overflow = 0
        self._shown_lesson = session.number

    def run(self) -> None:
        """Run until the session is over."""
        self._show()
        while not self._session.is_over:
            happened = self._window.events(PATIENCE if self._session.is_complete else 0.0)
            changes = [self._handle(event) for event in happened]
            if any(changes):
                self._show()
            elif not happened and not self._session.is_complete:
                self._session.draw_more()
                if self._session.is_complete:
                    self._show()

    def _handle(self, event: events.Event) -> bool:
        """Do what an event asks for; return whether the page must be drawn again."""
        match event:
            case events.CloseRequested():
                self._session.leave()
            case events.KeyDown("C"):
                return self._copy()
            case events.KeyDown(key):
                return self._scrolls(key) or self._press(key)
            case events.Wheel(steps):
                return self._move(-round(steps * WHEEL_LINES))
            case events.MouseButton("left", True):
                return self._pressed(event.x, event.y)
            case events.MouseButton("right", True):
                return self._press("Left")
            case events.Resized() | events.Exposed():
                return True
        return False

    def _press(self, key: str) -> bool:
        """Give a key to the session; the answer is at the end of the page, and stays in sight."""
        before = self._session.answer
        changes = self._session.press(key)
        if self._session.answer != before:
            self._scroll = self._overflow
        return changes

    def _pressed(self, x: int, y: int) -> bool:
        return (self._page is not None and self._page.press(x, y)) or self._press("Right")

    def _scrolls(self, key: str) -> bool:
        """Move the page by a key; the letters of `less`."""
        return key in ("J", "K") and self._move(WHEEL_LINES if key == "J" else -WHEEL_LINES)

    def _move(self, lines: int) -> bool:
        self._scroll = min(max(self._scroll + lines, 0), self._overflow)
        return True

    def _copy(self) -> bool:
        """Copy the code; a terminal has no clipboard, but can print it."""
        texts, language = self._session.texts, self._session.language
        if hasattr(self._window, "clipboard"):
            self._window.clipboard = "\n".join(texts.code) + "\n"
            self._session.remark(say("copied", language))
        else:
            self._session.remark(say("print", language, texts.name[3:]))
        return True

    def _show(self) -> None:
        session, window = self._session, self._window
        if session.is_over:
            return
        if session.number != self._shown_lesson:
            self._shown_lesson, self._scroll = session.number, 0
        title = f"{session.title} - {session.place}"
        if window.writes_text:
            lines, self._overflow = text_page(session, window.cells, self._scroll)
            window.show_lines(lines)
            return
        self._page = draw_page(session, window.size, window.scale, self._scroll, self._copy)
        self._overflow = self._page.overflow
        window.present(self._page.pixels)
        window.title = title
