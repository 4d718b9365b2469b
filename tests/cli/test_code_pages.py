"""What commands print where the output's code page lacks letters of theirs."""

import io
import sys

import pytest

from engine3d.apps.cli import main
from engine3d.apps.cli.commands import COMMANDS
from engine3d.apps.cli.commands.completion import SCRIPTS

ENCODINGS = ("ascii", "cp932", "cp1250", "cp1251")
ARGUMENTS = [
    ["--help"],
    ["--list-readers"],
    *([name, "--help"] for name in COMMANDS),
    *([name, "--help-all"] for name, command in COMMANDS.items() if command.common),
    *(["completion", shell] for shell in SCRIPTS),
    ["learn", "--list"],
    ["info", "--system"],
]


def printed(monkeypatch, arguments, encoding, errors="strict"):
    out = io.TextIOWrapper(io.BytesIO(), encoding, errors)
    monkeypatch.setattr(sys, "stdout", out)
    assert main(arguments) == 0
    out.flush()
    return out.buffer.getvalue().decode(encoding)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("arguments", ARGUMENTS, ids=" ".join)
def test_every_help_and_list_can_be_redirected(arguments, encoding, monkeypatch):
    assert printed(monkeypatch, arguments, encoding)


def test_missing_letters_are_escaped_unless_the_user_asks_for_else(monkeypatch):
    whole = ["render", "--help-all"]
    assert "I/d²" in printed(monkeypatch, whole, "utf-8")
    for errors in ("strict", "surrogateescape"):
        assert r"I/d\xb2" in printed(monkeypatch, whole, "cp1251", errors)
    assert "I/d?" in printed(monkeypatch, whole, "cp1251", "replace")
