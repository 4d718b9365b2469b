"""Random hands on the viewer's window: keys, mouse, sizes, files, through SDL's own events.

In: a `random.Random`. Out: actions, each a list of SDL's events; `Hands.act` does one and draws
until nothing changes, and raises `Finding` if that takes too long. By itself it runs for as long
as it is told, each model for some actions, and ends with how to see what it found again:

    python tests/viewer/random_hands.py [--seconds 60] [--seed 0] [--actions 40]
"""

from __future__ import annotations

import argparse
import ctypes
import os
import random
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from typing import get_args

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    os.environ["SDL_VIDEODRIVER"] = "dummy"

from viewer.shown_models import DEMOS, demo, write_models

from engine3d.apps.viewer.keymap import BINDINGS
from engine3d.apps.viewer.model_files import ModelFiles
from engine3d.apps.viewer.program_window import ProgramWindow
from engine3d.apps.viewer.sampling import Sampling
from engine3d.apps.viewer.sdl import load_sdl
from engine3d.apps.viewer.viewer import Viewer
from engine3d.choices import LookName
from engine3d.errors import Engine3DError, Engine3DWarning
from engine3d.stage.look import check_look
from engine3d.stage.open_models import open_models
from engine3d.stage.played_clips import play_clips
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

sdl2 = load_sdl()

SIZE = 320, 240
#: Seconds that an action may take, of the clock and of all processors.
SECONDS = 2.0
#: Turns of the loop in which what does not move comes to rest.
TURNS = 6
#: Actions whose inverse is themselves, or a step back.
INVERTIBLE = tuple(
    one.action
    for one in BINDINGS
    if one.action.startswith(("cycle_", "toggle_"))
    and one.action
    not in (
        "cycle_animations",  # begins at their start
        "cycle_debug",  # draws the frustum of the moment
        "cycle_theme",  # takes the place of a scene's own background
        "cycle_lists",  # takes the place of another panel, as all panels do
        "toggle_edges",  # as three others: off is the usual picture, not the one before
        "toggle_normals_mode",
        "toggle_unlit",
        "toggle_explosion",
        "toggle_flat",  # of three
        "toggle_fullscreen",
        "toggle_help",
        "toggle_measuring",
        "toggle_pointing",
        "toggle_section",
        "toggle_walking",  # moves down to the ground
    )
)
_KEYS = tuple(key for one in BINDINGS for key in one.keys if one.action not in ("quit",))
_OTHERS = ("Escape", "Backspace", "Home", "End", "Delete", "F7", "Keypad 5", "W", "A", "Left")
_TYPED = ("h", "/", "é", "語", "wire", "..", "~", "/", ".o", "\0", " ", "%s{x}")
_BUTTONS = (1, 2, 3, 4)


class Finding(AssertionError):
    """What must not be."""


class Hands:
    """Hands on a viewer in a window of SDL's dummy driver.

    Parameters
    ----------
    rng : random.Random
    folder : Path
        Of `write_models`: the files that are opened.
    viewed : ViewedScene or None
        What is shown first; None for one that is chosen at random.
    """

    def __init__(self, rng: random.Random, folder: Path, viewed=None) -> None:
        self._rng, self._files = rng, sorted(folder.glob("*.*"))
        paths = []
        if viewed is None:
            paths = [rng.choice([path for path in self._files if _is_sound(path)])]
            viewed = open_models(paths, animation=play_clips)
        self._window = ProgramWindow(SIZE, SIZE, "hands", vsync=False)
        self._number = sdl2.SDL_GetWindowID(self._window._window)
        settings = Settings({}, look=check_look(rng.choice(get_args(LookName))))
        self._renderer = ViewRenderer(viewed, settings, SIZE)
        files = ModelFiles(paths, watch=rng.random() < 0.3, remembered=True)
        self.viewer = Viewer(self._renderer, self._window, files=files, sampling=Sampling())
        self.viewer.controls.shown = True
        self._modifiers = 0
        self.viewer.run(1)

    def __enter__(self) -> Hands:
        return self

    def __exit__(self, *exception: object) -> None:
        self._renderer.close()
        self._window.close()

    def act(self) -> str:
        """Do something; return what."""
        kind = self._rng.choices(list(_ACTIONS), list(_ACTIONS.values()))[0]
        said = f"{kind.__name__}{kind(self)}"
        begun, worked = time.perf_counter(), time.process_time()
        self.turn()
        worked = (time.process_time() - worked) / os.cpu_count()
        taken = min(time.perf_counter() - begun, worked)  # others may keep the machine busy
        if taken > SECONDS:
            raise Finding(f"{said} took {taken:.1f} s")
        self.viewer.running = True
        return said

    def turn(self) -> None:
        """Let the loop turn until what happened is drawn."""
        for _ in range(TURNS):
            self.viewer.run_once()
            if not self.viewer.changed and not self.viewer.lively:
                break

    def picture(self):
        """Draw the picture as it is at this moment, without messages; return its pixels."""
        self.viewer.messages.said = ""
        self.viewer.draw(1)
        return self.viewer.frame.color.copy()

    def check_rest(self) -> None:
        """Let go of everything: the loop draws no frame then."""
        viewer = self.viewer
        self._window_event(sdl2.SDL_WINDOWEVENT_FOCUS_LOST)
        self.turn()
        viewer.playing, viewer.messages.said = False, ""
        for _ in range(TURNS):
            viewer.run_once()
        frame = viewer.frame
        viewer.run_once()
        if viewer.lively or viewer.frame is not frame:
            raise Finding("the window does not come to rest")

    # What hands do

    def press(self, key: str | None = None) -> str:
        """Press a key of a command, mostly, and let it go, mostly."""
        rng = self._rng
        key = key or rng.choice(_KEYS if rng.random() < 0.8 else _OTHERS)
        if key == "Ctrl+F12" and rng.random() < 0.95:  # 48 pictures
            key = "F12"
        name = key.removeprefix("Ctrl+").removeprefix("Shift+") or "+"
        shift = "Shift+" in key or rng.random() < 0.3
        self._modifiers = sdl2.KMOD_CTRL * key.startswith("Ctrl+") | sdl2.KMOD_SHIFT * shift
        repeats = rng.choice((1, 1, 1, 3))
        for repeat in range(repeats):
            self._key(sdl2.SDL_KEYDOWN, name, repeat)
        if rng.random() < 0.9:
            self._key(sdl2.SDL_KEYUP, name)
        if not key.startswith("Ctrl+") and len(name) == 1:
            self._text(name.lower())
        self._modifiers = 0
        return f"({key!r}, shift={shift}, repeats={repeats})"

    def _key(self, kind: int, name: str, repeat: int = 0) -> None:
        event = self._event(kind)
        symbol = sdl2.SDL_GetKeyFromName(name.encode())
        event.key.keysym.sym = symbol
        event.key.keysym.scancode = sdl2.SDL_GetScancodeFromKey(symbol)
        event.key.keysym.mod = self._modifiers
        event.key.repeat = repeat
        self._push(event)

    def _text(self, text: str) -> None:
        event = self._event(sdl2.SDL_TEXTINPUT)
        event.text.text = text.encode()
        self._push(event)

    def type(self) -> str:
        """Type some text, sometimes followed by Return."""
        text = self._rng.choice(_TYPED)
        self._text(text)
        if enters := self._rng.random() < 0.3:
            self._key(sdl2.SDL_KEYDOWN, "Return")
            self._key(sdl2.SDL_KEYUP, "Return")
        return f"({text!r}, enters={enters})"

    def drag(self) -> str:
        """Press a button somewhere, move, let go: perhaps a click, perhaps never let go."""
        rng = self._rng
        button, clicks = rng.choice(_BUTTONS), rng.choice((1, 1, 2))
        places = [self._place() for _ in range(rng.choice((1, 1, 2, 4)))]
        self._button(sdl2.SDL_MOUSEBUTTONDOWN, button, places[0], clicks)
        for before, place in zip(places, places[1:], strict=False):
            self._motion(before, place)
        if lets_go := rng.random() < 0.9:
            self._button(sdl2.SDL_MOUSEBUTTONUP, button, places[-1], clicks)
        return f"(button={button}, clicks={clicks}, places={places}, lets_go={lets_go})"

    def hover(self) -> str:
        """Move the mouse, sometimes out of the window."""
        place = self._place()
        self._motion((0, 0), place)
        if leaves := self._rng.random() < 0.2:
            self._window_event(sdl2.SDL_WINDOWEVENT_LEAVE)
        return f"({place}, leaves={leaves})"

    def wheel(self) -> str:
        """Turn the wheel somewhere."""
        place, steps = self._place(), self._rng.choice((-40, -3, -1, 1, 3, 40))
        event = self._event(sdl2.SDL_MOUSEWHEEL)
        event.wheel.y, event.wheel.mouseX, event.wheel.mouseY = steps, *place
        self._push(event)
        return f"({steps}, {place})"

    def resize(self) -> str:
        """Change the window's size."""
        size = self._rng.choice((SIZE, (64, 64), (640, 360), (70, 500), (500, 70), (401, 303)))
        sdl2.SDL_SetWindowSize(self._window._window, *size)
        return str(size)

    def rescale(self) -> str:
        """Move to a screen with another scale."""
        scale = self._rng.choice((None, None, 0.5, 1.0, 2.0, 4.0))
        self._window._ui_scale = scale
        self._window_event(sdl2.SDL_WINDOWEVENT_EXPOSED)
        return f"({scale})"

    def leave(self) -> str:
        """Minimise the window and restore it, or give another one the focus."""
        names = self._rng.choice((("MINIMIZED", "RESTORED"), ("FOCUS_LOST",), ("EXPOSED",)))
        for name in names:
            self._window_event(getattr(sdl2, f"SDL_WINDOWEVENT_{name}"))
        return str(names)

    def drop(self) -> str:
        """Drop one or more files on the window."""
        paths = self._rng.sample(self._files, self._rng.choice((1, 1, 1, 2)))
        for path in paths:
            event, name = self._event(sdl2.SDL_DROPFILE), os.fsencode(path)
            sdl2.SDL_malloc.restype = ctypes.c_void_p
            memory = sdl2.SDL_malloc(len(name) + 1)
            ctypes.memmove(memory, name + b"\0", len(name) + 1)
            event.drop.file = ctypes.cast(memory, ctypes.c_char_p)
            self._push(event)
        self._push(self._event(sdl2.SDL_DROPCOMPLETE))
        return str([path.name for path in paths])

    def close(self) -> str:
        """Ask to close the window; `act` keeps it open."""
        self._window_event(sdl2.SDL_WINDOWEVENT_CLOSE)
        return "()"

    # Events

    def _place(self) -> tuple[int, int]:
        """Return a place of the window: anywhere, or where something is that hands aim at."""
        rng, layout, panel = self._rng, self.viewer.controls.layout, self.viewer.panel
        width, height = self._window.size
        parts = [(0, 0, width, height), (width - 70, 0, 70, 90)]
        parts += [tuple(one) for one in (layout.bar, layout.time, layout.side) if one is not None]
        if panel is not None:
            left, top, *size = panel._box
            parts += [(left + layout.picture.left, top + layout.picture.top, *size)] * 2
        left, top, width, height = rng.choice(parts)
        return int(left + rng.uniform(-2, width + 2)), int(top + rng.uniform(-2, height + 2))

    def _event(self, kind: int):
        event = sdl2.SDL_Event()
        event.type = kind
        event.window.windowID = self._number
        return event

    def _window_event(self, kind: int) -> None:
        event = self._event(sdl2.SDL_WINDOWEVENT)
        event.window.event = kind
        self._push(event)

    def _button(self, kind: int, button: int, place: tuple[int, int], clicks: int) -> None:
        event = self._event(kind)
        event.button.button, event.button.clicks = button, clicks
        event.button.x, event.button.y = place
        self._push(event)

    def _motion(self, before: tuple[int, int], place: tuple[int, int]) -> None:
        event = self._event(sdl2.SDL_MOUSEMOTION)
        event.motion.x, event.motion.y = place
        event.motion.xrel, event.motion.yrel = (b - a for a, b in zip(before, place, strict=True))
        self._push(event)

    def _push(self, event) -> None:
        assert sdl2.SDL_PushEvent(event) == 1


#: What hands do, and how often.
_ACTIONS = {
    Hands.press: 50,
    Hands.drag: 25,
    Hands.type: 5,
    Hands.hover: 5,
    Hands.wheel: 5,
    Hands.resize: 3,
    Hands.rescale: 2,
    Hands.leave: 2,
    Hands.drop: 2,
    Hands.close: 1,
}


def _is_sound(path: Path) -> bool:
    """Return whether a file is a model that can be shown."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Engine3DWarning)
            open_models([path])
    except Engine3DError:
        return False
    return True


def check_inverses(hands: Hands, rng: random.Random, count: int) -> None:
    """Do some commands and their inverses; raise `Finding` if the picture is another one then."""
    viewer = hands.viewer
    viewer.playing = False
    viewer.held_positions.clear()
    for action in rng.sample(INVERTIBLE, count):
        before = hands.picture()
        viewer.perform(action, 1)
        hands.picture()
        viewer.perform(action, -1)
        if not (after := hands.picture()).shape == before.shape or (after != before).any():
            raise Finding(f"{action} and its inverse give another picture")


def main() -> None:
    """Run for some seconds, on one model after another."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--actions", type=int, default=40)
    parser.add_argument("--one", action="store_true", help="one seed, and tell each action")
    given = parser.parse_args()
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", Engine3DWarning)
    end, seed, failed = time.monotonic() + given.seconds, given.seed, 0
    with tempfile.TemporaryDirectory() as place:
        (folder := Path(place) / "models").mkdir()
        write_models(folder)
        for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME", "HOME"):
            os.environ[variable] = place
        os.chdir(place)
        while time.monotonic() < end:
            done: list[str] = []
            try:
                _one(random.Random(seed), folder, given.actions, done, given.one)
            except Exception:
                failed += 1
                traceback.print_exc()
                print(f"^ seed {seed}, {done[0]}, after: {done[1:][-3:]}\n", flush=True)
            seed += 1
            if given.one:
                break
    print(f"{seed - given.seed} runs, {failed} with findings")


def _one(rng: random.Random, folder: Path, count: int, done: list[str], tells: bool) -> None:
    """Do some actions on a model."""
    name = rng.choice((None, *DEMOS))
    done.append(str(name))
    with Hands(rng, folder, None if name is None else demo(name)) as hands:
        for _ in range(count):
            done.append(hands.act())
            if tells:
                print(done[-1], flush=True)
        check_inverses(hands, rng, 4)
        hands.check_rest()


if __name__ == "__main__":
    main()
