"""What a hostile terminal answers, and sends as keys and motions of the mouse.

In: a `random.Random`. Out: bytes. By itself it gives such bytes to the viewer in a pty, for as long
as it is told; the viewer must go on, and end with status 0 when it is asked to:

    python tests/terminal/hostile_answers.py [--seconds 60] [--seed 1]
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import time
from pathlib import Path

NUMBERS = ("0", "1", "2", "8", "16", "999", "1000", "1001", "9999", "65535", "65536", "99999999")
NUMBERS += ("-1", "", "00000000000000000001", "9" * 30, "9" * 400, "9" * 5000, "1.5", "-0")
ATTRIBUTES = (b"\x1b[?62;c", b"\x1b[?62;4;22c", b"\x1b[?c", b"\x1b[?" + b"1;" * 100 + b"4c")


def answer(choice: random.Random) -> bytes:
    """What comes instead of an answer; mostly it ends as answers do."""
    parts = [noise(choice) for _ in range(choice.randrange(3))]
    if choice.random() < 0.5:
        parts.append(b"\x1b_Gi=31;OK\x1b\\")
    sizes = range(choice.randrange(3))
    parts += [f"\x1b[6;{number(choice)};{number(choice)}t".encode() for _ in sizes]
    if choice.random() < 0.5:
        parts.append(f"\x1b[?1016;{choice.choice('0123')}$y".encode())
    choice.shuffle(parts)
    return b"".join(parts) + choice.choice(ATTRIBUTES)


def keys(choice: random.Random) -> bytes:
    """What comes instead of keys; none of it asks the viewer to end."""
    return b"".join(noise(choice) for _ in range(choice.randrange(1, 6)))


def number(choice: random.Random) -> str:
    return choice.choice(NUMBERS)


def noise(choice: random.Random) -> bytes:
    """A sequence that is no sequence, or one of numbers that nothing has."""
    numbers = ";".join(number(choice) for _ in range(choice.choice((1, 2, 3, 3, 40))))
    kind = choice.randrange(8)
    if kind == 0:
        place = ";".join(number(choice) for _ in range(3))
        return f"\x1b[<{place}{choice.choice('Mm')}".encode()
    if kind == 1:
        return f"\x1b[{numbers}{choice.choice('ABCDHFZt~')}".encode()
    if kind == 2:
        end = choice.choice(" $!") + choice.choice("yzpl")
        return f"\x1b[{choice.choice('?<>=')}{numbers}{end}".encode()
    if kind == 3:
        return (
            b"\x1b_" + b"a" * choice.choice((0, 10, 5000)) + choice.choice((b"\x1b\\", b"\x1b\\"))
        )
    if kind == 4:
        return choice.choice((b"\xff\xfe", b"\xf0\xc3", b"\xe2\x96", b"\x80", b"\x00", b"\x1e"))
    if kind == 5:
        return b"\x1b[<" + b";".join([b"1"] * 3000) + b"M"
    if kind == 6:
        return b"\x1b[6;0;0t"
    return f"\x1b[{'9' * choice.choice((3, 20, 20000))}~".encode()


def main() -> int:
    """Show a model to hostile terminals; return how often the viewer did not go on."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    from terminal.test_terminal import FakeTerminal

    parser = argparse.ArgumentParser(description="Show the viewer to hostile terminals.")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    ends, tried, failed = time.monotonic() + given.seconds, 0, 0
    while time.monotonic() < ends:
        choice = random.Random(f"{given.seed} {tried}")
        size = choice.choice(((20, 60), (1, 1), (0, 0), (65535, 65535), (2, 65535), (65535, 1)))
        terminal = FakeTerminal(answer(choice), "run", "MODEL", "--terminal", size=size)
        terminal.wait_for(re.escape(b"\x1b[?1049h"))
        status = terminal.endures([keys(choice) for _ in range(5)])
        tried += 1
        if status != 0:
            failed += 1
            print(f"{given.seed} {tried - 1}: {size}: status {status}: {terminal.written[-200:]!r}")
    print(f"{tried} hostile terminals, {failed} times the viewer did not go on")
    return failed


if __name__ == "__main__":
    sys.exit(main() > 0)
