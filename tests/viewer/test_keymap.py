"""The keys: each is bound once, each action exists, and each is in the manual."""

from pathlib import Path

import pytest

from engine3d.apps.viewer import actions as viewer_actions
from engine3d.apps.viewer.keymap import BINDINGS, TYPED_KEYS, action_for
from engine3d.stage.views.fps import LOOKS, MOVES


def test_no_key_is_bound_twice():
    keys = [key for binding in BINDINGS for key in binding.keys]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize("binding", BINDINGS, ids=lambda binding: binding.action)
def test_every_binding_calls_an_action(binding):
    assert callable(getattr(viewer_actions, binding.action))


def test_every_public_action_is_bound():
    bound = {binding.action for binding in BINDINGS}
    actions = {
        name
        for name, value in vars(viewer_actions).items()
        if getattr(value, "__module__", "") == viewer_actions.__name__ and name[0] != "_"
    }
    assert actions == bound


def test_keypad_keys_and_digits_by_position_answer():
    assert action_for("Keypad 7") == "view_top"
    assert action_for("Keypad Enter") == "reset_view"
    assert action_for("&", "1") == "view_front"
    assert action_for("Z", "W") == "cycle_statistics"
    assert action_for("Escape") is None


def test_signs_that_are_typed_call_commands_that_are_bound():
    assert {"/": action_for("/")} == TYPED_KEYS


def test_walking_keys_are_positions_of_letters_and_arrows():
    assert {"W", "A", "S", "D"} <= set(MOVES)
    assert {"Up", "Down", "Left", "Right"} == set(LOOKS)


def test_the_manual_names_every_key():
    manual = Path(__file__).parents[2] / "docs" / "viewer" / "keys.md"
    rows = [line.split("|")[1].split() for line in manual.read_text().splitlines() if "|" in line]
    named = {key for row in rows for key in row}
    missing = {key for binding in BINDINGS for key in binding.keys} - named
    assert missing <= {"Enter", "="}
