"""Modules of scripts outside tests/, for tests that look at them."""

import sys
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


@contextmanager
def importable(folder):
    """Let `folder`, such as "csrc", be imported from, and no longer than that.

    A module of it would hide a folder of tests that has its name: docs/pictures/cad.py, tests/cad.
    """
    path = str(ROOT / folder)
    sys.path.append(path)
    try:
        yield
    finally:
        sys.path.remove(path)
