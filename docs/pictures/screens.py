"""Draws whole windows of the viewer, the course and the editor, as they open on three screens.

    python docs/pictures/screens.py            draw them all again
    python docs/pictures/screens.py learn      only those of some programs
    python docs/pictures/screens.py --check    draw, and compare with the digests

In: the programs, and models of engine3d.data. Out: the digest of each window in screens.json, and
small WebPs of those that pages show. A test opens real windows on virtual screens of these
kinds, which must show the same bytes.

Dear ImGui gives the editor's panels their places, and draws its letters. These follow its version
and the kind of processor, so that both are recorded, and the editor is compared where they are the
same: then to the byte, too.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import os
import platform
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import numpy as np
from digests import Digests
from places import MODELS
from windows import Glass, in_a_viewer

from engine3d.apps.learn.course_session import Session
from engine3d.apps.learn.learn_window import LearnWindow
from engine3d.apps.learn.lesson_programs import find_programs
from engine3d.apps.viewer.program_window import ProgramWindow

FOLDER = Path(__file__).resolve().parent
DIGESTS = Digests(FOLDER / "screens.json")
MADE_BY = FOLDER / "screens_made_by.json"
QUALITY = 82
#: The programs whose window on the smallest screen is shown by pages.
SHOWN = ("learn", "editor_with_model")
#: The lesson whose window is shown, counted from 0: lines.
LESSON = 2
#: The editor's pictures until all of its panels have their places.
SETTLING = 40


class Screen(NamedTuple):
    """A screen that a program's window fills."""

    width: int
    height: int
    dpi: int

    def __str__(self) -> str:
        return f"{self.width}x{self.height} at {self.dpi} dpi"

    def glass(self) -> Glass:
        return Glass((self.width, self.height), self.dpi / 96)


SCREENS = (Screen(1366, 768, 96), Screen(1920, 1080, 96), Screen(2880, 1800, 192))


def viewer(screen: Screen) -> np.ndarray:
    """The viewer with a model."""
    return in_a_viewer("island.obj", lambda viewer: None, screen.glass())


def learn(screen: Screen) -> np.ndarray:
    """A lesson of the course."""
    glass = screen.glass()
    LearnWindow(glass, Session(find_programs(), LESSON, "en")).run()
    return glass.pixels


def editor(model: str, screen: Screen) -> np.ndarray:
    """The editor with a model, or without one."""
    from engine3d.apps.editor.ui.console_panel import ConsolePanel
    from engine3d.apps.editor.ui.editor_window import EditorWindow
    from engine3d.apps.editor.ui.scene_panel import ScenePanel

    glass = screen.glass()
    with (
        nobodys_home(),
        # SDL's dummy screen is smaller than the window may be.
        patch.object(ProgramWindow, "fit_to_screen", lambda window: None),
        patch.object(ScenePanel, "_draw_times", lambda panel, corner: None),
        patch.object(ConsolePanel, "_draw_log", lambda panel: None),  # it names a folder of here
        EditorWindow(model, size=glass.size, ui_scale=glass.scale) as window,
    ):
        window.window.present = glass.present
        for _ in range(SETTLING):
            window._pictures_due = 1
            window.turn(0.0)
    return glass.pixels


@contextmanager
def nobodys_home() -> Iterator[None]:
    """Work among the models; let programs find no screen, and no settings of a user."""
    before = os.getcwd()
    os.chdir(MODELS)
    try:
        with tempfile.TemporaryDirectory() as home:
            variables = {"SDL_VIDEODRIVER": "dummy", "XDG_STATE_HOME": home, "XDG_CACHE_HOME": home}
            with patch.dict(os.environ, variables):
                yield
    finally:
        os.chdir(before)


class Program(NamedTuple):
    """A program in a window.

    Attributes
    ----------
    draw : function
        Takes a screen, and returns what the window shows there.
    arguments : tuple of str
        Of the command that opens the window, in the folder of the models.
    """

    draw: Callable[[Screen], np.ndarray]
    arguments: tuple[str, ...]

    def command(self, screen: Screen) -> list[str]:
        """Return the arguments for a screen. A window of a fixed usual size must be enlarged."""
        size = f"{screen.width}x{screen.height}"
        return [argument.format(size=size) for argument in self.arguments]


_SIZED = "--size", "{size}"


PROGRAMS = {
    "viewer": Program(viewer, ("run", "island.obj", *_SIZED)),
    "learn": Program(learn, ("learn", str(LESSON + 1))),
    "editor": Program(partial(editor, ""), ("edit", *_SIZED)),
    "editor_with_model": Program(partial(editor, "train.asc"), ("edit", "train.asc", *_SIZED)),
}


def window_name(program: str, screen: Screen) -> str:
    """Return the name of a window in screens.json."""
    return f"{program}, {screen}"


def why_not(program: str) -> str:
    """Return why a program's windows cannot be compared here; empty if they can."""
    if not program.startswith("editor"):
        return ""
    recorded, here = json.loads(MADE_BY.read_text()), makers()
    if not here["imgui-bundle"]:
        return "imgui-bundle is not installed: pip install -e .[editor]"
    return "" if recorded == here else f"recorded with {recorded}, here is {here}"


def makers() -> dict[str, str]:
    """Return what the editor's panels depend on beside the engine."""
    try:
        version = importlib.metadata.version("imgui-bundle")
    except importlib.metadata.PackageNotFoundError:
        version = ""
    return {"imgui-bundle": version, "machine": platform.machine()}


def record(program: str) -> None:
    """Draw a program's windows, and keep their digests, and a picture if a page shows it."""
    from PIL import Image

    for screen in SCREENS:
        picture = PROGRAMS[program].draw(screen)
        DIGESTS.record(window_name(program, screen), picture)
        if program in SHOWN and screen == SCREENS[0]:
            path = FOLDER / f"screen_{program}.webp"
            Image.fromarray(picture[:, :, :3]).save(path, method=6, quality=QUALITY)
            print(f"{path.name}: {path.stat().st_size:,} bytes")
    if program.startswith("editor"):
        MADE_BY.write_text(json.dumps(makers(), indent=2, sort_keys=True) + "\n")


def stale_windows(program: str) -> list[str]:
    """Return the names of a program's windows that are not as they were recorded."""
    return [
        window_name(program, screen)
        for screen in SCREENS
        if not DIGESTS.knows(window_name(program, screen), PROGRAMS[program].draw(screen))
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description="Draw the windows of the programs on screens.")
    parser.add_argument("programs", nargs="*", metavar="PROGRAM", help=", ".join(PROGRAMS))
    parser.add_argument("--check", action="store_true", help="compare with the digests instead")
    arguments = parser.parse_args()
    unknown = set(arguments.programs) - set(PROGRAMS)
    if unknown:
        parser.error(f"no such program: {', '.join(sorted(unknown))}")
    stale = []
    for program in arguments.programs or PROGRAMS:
        reason = why_not(program) if arguments.check else ""
        if reason:
            print(f"left out: {program}: {reason}", file=sys.stderr)
        elif arguments.check:
            stale += stale_windows(program)
        else:
            record(program)
    if stale:
        print(f"not what the programs show: {'; '.join(stale)}", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
