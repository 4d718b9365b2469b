"""Writes a page that a script makes, or tells whether it is out of date.

In: the page's path, the text that it should have, and the script's arguments. Out: the exit status;
with ``--check`` nothing is written, and 1 says that the page has another text.
"""

from __future__ import annotations

import sys
from pathlib import Path

from engine3d.base.files.atomic_write import atomic_write


def write_or_check(page: Path, text: str, arguments: list[str]) -> int:
    if "--check" not in arguments:
        with atomic_write(page) as file:
            file.write(text.encode())
        return 0
    if page.exists() and page.read_text(encoding="utf-8") == text:
        return 0
    script = f"docs/make_{page.stem}.py"
    print(f"docs/{page.name} is out of date: run `python {script}`", file=sys.stderr)
    return 1
