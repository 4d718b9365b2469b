"""Bytes of a terminal as events, in whatever pieces they come."""

import pytest

from engine3d.apps.terminal.keys import Decoder
from engine3d.events import (
    CloseRequested,
    FocusLost,
    KeyDown,
    MouseButton,
    MouseMotion,
    TextEntered,
    Wheel,
)


def decoder():
    return Decoder(lambda x, y: (10 * x, 20 * y))


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"w", [KeyDown("W", "W"), TextEntered("w")]),
        (b"W", [KeyDown("W", "W", shift=True), TextEntered("W")]),
        (b"7", [KeyDown("7", "7"), TextEntered("7")]),
        (b" ", [KeyDown("Space", "Space"), TextEntered(" ")]),
        ("é".encode(), [KeyDown("É", "É"), TextEntered("é")]),
        (b"\r", [KeyDown("Return", "Return")]),
        (b"\t", [KeyDown("Tab", "Tab")]),
        (b"\x1b[Z", [KeyDown("Tab", "Tab", shift=True)]),
        (b"\x7f", [KeyDown("Backspace", "Backspace")]),
        (b"\x0f", [KeyDown("O", "O", control=True)]),
        (b"\x03", [CloseRequested()]),
        (b"\x1b[A", [KeyDown("Up", "Up")]),
        (b"\x1bOD", [KeyDown("Left", "Left")]),
        (b"\x1b[1;2C", [KeyDown("Right", "Right", shift=True)]),
        (b"\x1b[1;5B", [KeyDown("Down", "Down", control=True)]),
        (b"\x1b[5~", [KeyDown("PageUp", "PageUp")]),
        (b"\x1bOP", [KeyDown("F1", "F1")]),
        (b"\x1b[24~", [KeyDown("F12", "F12")]),
        (b"\x1b[24;5~", [KeyDown("F12", "F12", control=True)]),
        (b"\x1b[O", [FocusLost()]),
        (b"\x1b[<0;3;4M", [MouseButton("left", True, x=30, y=80)]),
        (b"\x1b[<2;3;4m", [MouseButton("right", False, x=30, y=80)]),
        (b"\x1b[<20;3;4M", [MouseButton("left", True, True, True, 30, 80)]),
        (b"\x1b[<64;3;4M", [Wheel(1.0, 30, 80)]),
        (b"\x1b[<65;3;4M", [Wheel(-1.0, 30, 80)]),
        (b"\x1b[<35;3;4M\x1b[<35;5;3M", [MouseMotion(0, 0, 30, 80), MouseMotion(20, -20, 50, 60)]),
        (b"\x1b[?62;4c\x1b_Gi=31;OK\x1b\\", []),
        (b"\x1b[99~\x1b[999z", []),
    ],
    ids=repr,
)
def test_bytes_are_events(data, expected):
    assert decoder().decode(data, ended=True) == expected


def test_a_sequence_may_come_in_pieces():
    keys = decoder()
    assert keys.decode(b"\x1b[1;") == []
    assert keys.waits
    assert keys.decode(b"2A4") == [
        KeyDown("Up", "Up", shift=True),
        KeyDown("4", "4"),
        TextEntered("4"),
    ]
    assert not keys.waits


def test_escape_alone_is_a_key_once_nothing_follows():
    keys = decoder()
    assert keys.decode(b"\x1b") == []
    assert keys.decode(b"", ended=True) == [KeyDown("Escape", "Escape")]


@pytest.mark.parametrize(
    "data",
    [
        b"\x1b[" + b"9" * 5000 + b"~",
        b"\x1b[<0;" + b"9" * 5000 + b";5M",
        b"\x1b[<" + b"1;" * 3000 + b"M",
        b"\x1b_" + b"a" * 300_000,
        b"\x1b[?" + b"1;" * 200_000 + b"c",
        b"\x1b[38:2:1:2:3m",
        b"\x1b[<8;" + b"9" * 5000 + b";-1M",
        b"\x1b[1.5;" + b"9" * 5000 + b"A",
    ],
    ids=lambda data: repr(data[:8]),
)
def test_sequences_that_nobody_knows_are_passed_over(data):
    keys = decoder()
    happened = []
    for place in range(0, len(data), 4096):
        happened += keys.decode(data[place : place + 4096])
        assert len(keys._rest) < 10_000
    assert happened + keys.decode(b"", ended=True) == []
    assert keys.decode(b"w") == [KeyDown("W", "W"), TextEntered("w")]


def test_what_comes_late_of_a_long_sequence_is_no_key():
    keys = decoder()
    happened = []
    for piece in (b"\x1b[99", b"9" * 3000, b"9;9", b"9~"):
        happened += keys.decode(piece) + keys.decode(b"", ended=True)
    assert happened == []
    assert keys.decode(b"w") == [KeyDown("W", "W"), TextEntered("w")]
    assert keys.decode(b"\x1b[99") + keys.decode(b"", ended=True) == []
    assert keys.decode(b"\x03") == [CloseRequested()]


def test_two_quick_clicks_are_a_double_click():
    keys = decoder()
    presses = [keys.decode(b"\x1b[<0;3;4M\x1b[<0;3;4m") for _ in range(2)]
    assert [event.clicks for pair in presses for event in pair] == [1, 1, 2, 2]
