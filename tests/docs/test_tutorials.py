"""The programs of the tutorials draw their pictures, and the game can be played."""

import re
import runpy
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from engine3d import events
from engine3d.apps.viewer.window import Window

DOCS = Path(__file__).resolve().parents[2] / "docs"
FOLDER = DOCS / "tutorials"
PAGES = sorted(FOLDER.glob("*.md"))
TUTORIALS = [page.stem for page in PAGES if page.stem != "index"]
PICTURE_BYTES, ALL_BYTES = 40_000, 1_500_000
GAME_LINES = 80


def shown(page):
    return set(re.findall(r"!\[[^\]]+\]\((pictures/[\w/]+\.webp)\)", page.read_text("utf-8")))


@pytest.mark.parametrize("page", TUTORIALS)
def test_programs_draw_the_pictures(page):
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    for package in ("pandas", "trimesh"):
        if f"import {package}" in text:
            pytest.importorskip(package)
    command = [sys.executable, DOCS / "pictures" / "tutorials.py", "--check", page]
    run = subprocess.run(command, capture_output=True, text=True)
    hint = "to draw them again: python docs/pictures/tutorials.py"
    assert run.returncode == 0, f"{run.stderr}\n{hint} {page}"


def test_pictures_are_small_and_shown():
    pictures = {path.relative_to(FOLDER).as_posix() for path in FOLDER.glob("pictures/*/*.webp")}
    assert set().union(*map(shown, PAGES)) == pictures
    sizes = {name: (FOLDER / name).stat().st_size for name in pictures}
    assert {name for name, size in sizes.items() if size > PICTURE_BYTES} == set()
    assert sum(sizes.values()) <= ALL_BYTES


@pytest.mark.parametrize("page", TUTORIALS)
def test_every_step_has_a_picture(page):
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    steps = [step for step in text.split("\n## ")[1:] if "```python" in step]
    names = [step.splitlines()[0] for step in steps if "](pictures/" not in step]
    assert names == [] or page == "game", "show what the step draws"


def test_the_game_is_short():
    lines = (FOLDER / "game.py").read_text(encoding="utf-8").splitlines()
    assert sum(bool(line) for line in lines) <= GAME_LINES


def test_the_game_can_be_played(monkeypatch):
    """A player holds keys for some frames, begins again and leaves."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    presented = Counter()
    present = Window.present
    script = {
        3: events.KeyDown("R", "R"),
        6: events.KeyDown("Escape", "Escape"),
    }

    def receive(window, timeout=0.0):
        event = script.get(presented["frames"])
        return [] if event is None else [event]

    def count(window, picture, format=None):
        presented["frames"] += 1
        present(window, picture, format)

    monkeypatch.setattr(Window, "events", receive)
    monkeypatch.setattr(Window, "present", count)
    monkeypatch.setattr(Window, "keys", frozenset({"Right", "Up"}))
    runpy.run_path(str(FOLDER / "game.py"), run_name="__main__")
    assert presented["frames"] == 6


def test_the_ball_collects_coins():
    game_of = runpy.run_path(str(FOLDER / "game.py"), run_name="game")
    game, advance = game_of["Game"](), game_of["advance"]
    coins = game.left
    target = game.coins[0].translation * (1, 0, 1)
    game.ball.translation = 0.8 * target + (0, game_of["BALL"], 0)
    for _ in range(60):
        advance(game, 1 / 60, frozenset())
    assert game.left < coins and game.ball.translation[1] == game_of["BALL"]
