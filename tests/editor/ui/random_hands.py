"""Random hands on the editor's window: menus, keys, mouse, panels, files, lines of Python.

In: a `random.Random`, an `EditorWindow`. Out: actions; `Hands.act` does one and draws until
nothing changes, and raises `Finding` if a panel failed or it takes too long. `check_history` goes
to the first step and back, `check_file` saves and opens. By itself it runs for as long as it is
told, and ends with how to see what it found again:

    python tests/editor/ui/random_hands.py [--seconds 60] [--seed 0] [--actions 60]
"""

from __future__ import annotations

import argparse
import os
import random
import sys
import tempfile
import time
import traceback
import warnings
from importlib.resources import files
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    os.environ["SDL_VIDEODRIVER"] = "dummy"

from editor.ui.editor_hands import settle
from viewer.shown_models import write_models

from engine3d import data, events
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.new_things.adding import GROUPS
from engine3d.apps.editor.node_commands import JoinNodes, Reparent
from engine3d.apps.editor.ui import selection_actions
from engine3d.apps.editor.ui.editor_window import EditorWindow
from engine3d.apps.editor.ui.motion import motion_actions
from engine3d.apps.editor.ui.panel_layout import load_layout, save_layout
from engine3d.apps.viewer.sdl import load_sdl
from engine3d.errors import Engine3DWarning
from engine3d.io.writing.scene_saving import scene_text

sdl2 = load_sdl()

SIZE = 900, 600
#: Seconds that an action may take, of the clock and of all processors.
SECONDS = 2.0
#: Menus whose entries ask for files, or leave: hands do that in ways of their own.
_APART = ("File",)
_KEYS = ("Escape", "Return", "Tab", "Up", "Down", "Left", "Right", "Space", "Backspace", "A")
_TYPED = ("1", "-2.5", "1e9", "nan", "name", "é語", "", "0", "a/b")
_LINES = (
    "scene.nodes[0].translation += 0.25",
    "scene.add(e3d.box(0.2), parent=scene.nodes[-1])",
    "n = scene.nodes[-1]; scene.remove(n)",
    "scene.ambient = 0.3, 0.2, 0.1",
    "selection[0].name = 'x' * 300",
    "1 / 0",
    "animator.seek(1.5)",
)


class Finding(AssertionError):
    """What must not be."""


class Hands:
    """Hands on an editor.

    Parameters
    ----------
    rng : random.Random
    editor : EditorWindow
    models : Path
        A folder of `write_models`: the files that are dropped and opened.
    """

    def __init__(self, rng: random.Random, editor: EditorWindow, models: Path) -> None:
        self._rng, self.editor = rng, editor
        self._models = sorted(models.glob("*.*"))
        self._home = str(models)
        self._begin()

    def _begin(self) -> None:
        """Take note of a document that was opened."""
        self._document = self.editor.workspace.document
        self._first = content(self._document)

    def act(self) -> str:
        """Do something; return what."""
        kind = self._rng.choices(list(_ACTIONS), list(_ACTIONS.values()))[0]
        begun, worked = time.perf_counter(), time.process_time()
        said = f"{kind.__name__}{kind(self)}"
        self.turn()
        worked = (time.process_time() - worked) / os.cpu_count()
        taken = min(time.perf_counter() - begun, worked)  # others may keep the machine busy
        self._check(said, taken)
        return said

    def _check(self, said: str, taken: float) -> None:
        editor = self.editor
        if taken > SECONDS:
            raise Finding(f"{said} took {taken:.1f} s")
        if editor._told:
            raise Finding(f"{said}: {' '.join(editor._told)}")
        editor.workspace.wants_exit = False
        # Hands write nowhere else.
        if not editor._files._dialog._folder.startswith(self._home):
            editor._files._dialog._go(self._home)
        if editor.workspace.document is not self._document:
            self._begin()

    def turn(self) -> None:
        """Draw until what happened is done."""
        for _ in range(60):
            self.editor.turn(0.0)
            if not (self.editor._pictures_due or self.editor._late):
                break

    # What hands do

    def choose(self) -> str:
        """Choose an entry of a menu, as by a click."""
        listed = [one for one in self.editor._entries if one.menu not in _APART]
        entry = self._rng.choice(listed)
        if entry.is_enabled():
            entry.act()
        self.editor._pictures_due = 3
        return f"({entry.label!r})"

    def press(self) -> str:
        """Press a shortcut, or another key."""
        rng = self._rng
        keys = rng.choice([one.keys for one in self.editor._entries if one.keys])
        if rng.random() < 0.4 or keys in ("Ctrl+Q", "F12"):
            keys = rng.choice(_KEYS)
        *held, key = keys.split("+")
        modifiers = [f"Left {name}" for name in held]
        control, shift = "Ctrl" in held, "Shift" in held
        downs = [events.KeyDown(name, name, shift, control) for name in (*modifiers, key)]
        ups = [events.KeyUp(name, name) for name in (key, *modifiers)]
        self.editor._late += [*downs, *ups]
        return f"({keys!r})"

    def type(self) -> str:
        """Type a text, sometimes followed by Return."""
        text = self._rng.choice(_TYPED)
        self.editor._late.append(events.TextEntered(text))
        if enters := self._rng.random() < 0.6:
            self.editor._late += [events.KeyDown("Return", "Return"), _up("Return")]
        return f"({text!r}, enters={enters})"

    def add(self) -> str:
        """Add something, at the top or below a node."""
        workspace = self.editor.workspace
        what = self._rng.choice([what for group in GROUPS for what in group])
        parent = self._rng.choice([None, *workspace.scene.nodes])
        selection_actions.add(workspace, what, parent)
        return f"({what!r}, below={parent is not None})"

    def select(self) -> str:
        """Select some nodes."""
        nodes = self.editor.workspace.scene.nodes
        count = min(self._rng.choice((0, 1, 1, 1, 2, 5)), len(nodes))
        self.editor.workspace.document.selection.set(self._rng.sample(nodes, count))
        self.editor._pictures_due = 3
        return f"({count})"

    def move_in_tree(self) -> str:
        """Put nodes below another one, or join them."""
        workspace, rng = self.editor.workspace, self._rng
        nodes = workspace.scene.nodes
        if not nodes:
            return "()"
        some = rng.sample(nodes, min(2, len(nodes)))
        parent = rng.choice([None, *nodes])
        if rng.random() < 0.3 and any(_holds_mesh(node) for node in some):
            workspace.do(JoinNodes(workspace.scene, some))
            return "(join)"
        workspace.do(Reparent(workspace.scene, some, parent))
        return f"({len(some)})"

    def mouse(self) -> str:
        """Click, double click or drag somewhere, with any button."""
        rng = self._rng
        button = rng.choice(("left", "left", "left", "right", "middle"))
        width, height = self.editor.window.size
        x, y = rng.randrange(width), rng.randrange(height)
        happened = [events.MouseMotion(0, 0, x, y)]
        places = [(x, y)] * rng.choice((1, 1, 2))
        if drags := rng.random() < 0.4:
            places = [(x, y)]
        for place in places:
            at = {"x": place[0], "y": place[1]}
            happened.append(events.MouseButton(button, True, **at))
            if drags:
                x += rng.randrange(-120, 120)
                y += rng.randrange(-60, 60)
                happened.append(events.MouseMotion(5, 5, x, y))
            happened.append(events.MouseButton(button, False, x=x, y=y))
        self.editor._late += happened
        return f"({button}, {places}, drags={drags} to {x, y})"

    def wheel(self) -> str:
        """Turn the wheel somewhere."""
        width, height = self.editor.window.size
        place = self._rng.randrange(width), self._rng.randrange(height)
        steps = self._rng.choice((-5.0, -1.0, 1.0, 5.0))
        self.editor._late.append(events.Wheel(steps, *place))
        return f"({steps}, {place})"

    def time(self) -> str:
        """Go to a time."""
        time = self._rng.choice((0.0, 0.5, 1.0, 2.25, 7.0))
        motion_actions.seek(self.editor.workspace, time)
        return f"({time})"

    def run_python(self) -> str:
        """Enter a line of Python."""
        line = self._rng.choice(_LINES)
        self.editor.workspace.lines_to_run.append(line)
        return f"({line!r})"

    def step(self) -> str:
        """Undo or redo some steps."""
        workspace, count = self.editor.workspace, self._rng.choice((1, 1, 3))
        step = self._rng.choice((workspace.undo, workspace.undo, workspace.redo))
        for _ in range(count):
            step()
        self.editor._pictures_due = 3
        return f"({step.__name__}, {count})"

    def drop(self) -> str:
        """Drop a file on the window."""
        path = self._rng.choice(self._models)
        self.editor._late.append(events.FilesDropped((str(path),)))
        return f"({path.name})"

    def resize(self) -> str:
        """Change the window's size."""
        size = self._rng.choice((SIZE, (300, 200), (1200, 700), (64, 64), (700, 300)))
        sdl2.SDL_SetWindowSize(self.editor.window._window, *size)
        return str(size)

    # What must hold

    def check_history(self) -> None:
        """Undo all steps and do them again; the scene is the same to the byte, both times."""
        document = self.editor.workspace.document
        if any("history was cleared" in one.text for one in document.console.entries):
            raise Finding("the history was cleared")
        document.animator.seek(0.0)
        last, count = content(document), document.history.position
        while document.undo():
            pass
        document.animator.seek(0.0)
        if (found := content(document)) != self._first:
            raise Finding(f"undone, the document differs: {difference(self._first, found)}")
        for _ in range(count):
            document.redo()
        document.animator.seek(0.0)
        if (found := content(document)) != last:
            raise Finding(f"done again, the document differs: {difference(last, found)}")

    def check_file(self, folder: Path) -> None:
        """Save the document and open it: the same is saved again."""
        document, texts = self.editor.workspace.document, []
        for name in ("a.e3d.json", "b.e3d.json"):
            if not document.save(folder / name, overwrite=True):
                said = document.console.entries[-1].text
                raise Finding(f"not saved: {said}")
            texts.append((folder / name).read_bytes())
            document = SceneDocument.open(folder / name)
        if texts[0] != texts[1]:
            raise Finding(f"saved again, the file differs: {difference(*texts)}")

    def check_layout(self) -> None:
        """Save the layout and load it."""
        save_layout(self.editor.workspace)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            load_layout(self.editor.workspace, self.editor.window.size)

    def check_rest(self) -> None:
        """Let go of everything: the window draws no picture then."""
        editor = self.editor
        editor.workspace.plays = False
        for _ in range(4):
            editor._late += [events.KeyDown("Escape", "Escape"), _up("Escape")]
            self.turn()
        settle(editor)
        for _ in range(60):
            editor.turn(0.0)
        if editor._pictures_due or editor._is_unfinished():
            raise Finding("the window does not come to rest")


#: What hands do, and how often.
_ACTIONS = {
    Hands.choose: 25,
    Hands.press: 15,
    Hands.mouse: 25,
    Hands.select: 15,
    Hands.add: 6,
    Hands.move_in_tree: 4,
    Hands.type: 6,
    Hands.wheel: 2,
    Hands.time: 3,
    Hands.run_python: 2,
    Hands.step: 6,
    Hands.drop: 2,
    Hands.resize: 1,
}


def _up(key: str) -> events.KeyUp:
    return events.KeyUp(key, key)


def _holds_mesh(node) -> bool:
    return type(node.object).__name__ == "Mesh"


def content(document: SceneDocument) -> bytes:
    """Return the file of a document."""
    text, _ = scene_text(document.scene, "/", document.resources.kept_materials)
    return text


def difference(a: bytes, b: bytes) -> str:
    """Return where two files differ first."""
    place = next((k for k, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), len(a))
    around = slice(max(place - 150, 0), place + 80)
    return f"at {place} of {len(a)} and {len(b)}: {a[around]!r} and {b[around]!r}"


def open_editor(folder: Path, path: str = "") -> EditorWindow:
    """Open an editor that waits for no screen, with its own folders."""
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME", "HOME"):
        os.environ[variable] = str(folder)
    editor = EditorWindow(path or str(files(data) / "models" / "train.asc"), size=SIZE)
    editor.window.present = lambda pixels: None
    settle(editor)
    return editor


def _one(seed: int, models: Path, count: int, done: list[str], tells: bool) -> None:
    """Do some actions in a new editor, and look at what must hold."""
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as place, open_editor(Path(place)) as editor:
        hands = Hands(rng, editor, models)
        for _ in range(count):
            done.append(hands.act())
            if tells:
                print(done[-1], flush=True)
        hands.check_rest()
        hands.check_history()
        hands.check_file(Path(place))
        hands.check_layout()


def main() -> None:
    """Run for some seconds, one editor after another."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--actions", type=int, default=60)
    parser.add_argument("--one", action="store_true", help="one seed, and tell each action")
    given = parser.parse_args()
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", Engine3DWarning)
    end, seed, failed = time.monotonic() + given.seconds, given.seed, 0
    with tempfile.TemporaryDirectory() as place:
        (models := Path(place) / "models").mkdir()
        write_models(models)
        os.chdir(models)
        while time.monotonic() < end:
            done: list[str] = []
            try:
                _one(seed, models, given.actions, done, given.one)
            except Exception:
                failed += 1
                traceback.print_exc()
                print(f"^ seed {seed}, after: {done[-3:]}\n", flush=True)
            seed += 1
            if given.one:
                break
    print(f"{seed - given.seed} runs, {failed} with findings")


if __name__ == "__main__":
    main()
