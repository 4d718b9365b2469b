"""The pictures of the documentation are what the engine draws, pixel for pixel, here and now."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "pictures"
MAX_BYTES = 2_500_000


def check(backend):
    return subprocess.run(
        [sys.executable, FOLDER / "make.py", "--check"],
        env=os.environ | {"ENGINE3D_BACKEND": backend},
        capture_output=True,
        text=True,
    )


@pytest.mark.slow
def test_pictures_are_what_the_engine_draws():
    run = check("auto")
    assert run.returncode == 0, f"{run.stderr}\nto draw them again: python docs/pictures/make.py"


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in FOLDER.glob("*.webp")) < MAX_BYTES
