"""The pictures of the documentation are what the engine draws, pixel for pixel, here and now."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "pictures"
MAX_BYTES = 2_500_000


@pytest.mark.slow
@pytest.mark.parametrize("program", ["make.py", "screens.py"])
def test_pictures_are_what_the_engine_draws(program):
    run = subprocess.run(
        [sys.executable, FOLDER / program, "--check"],
        env=os.environ | {"ENGINE3D_BACKEND": "auto"},
        capture_output=True,
        text=True,
    )
    again = f"to draw them again: python docs/pictures/{program}"
    assert run.returncode == 0, f"{run.stderr}\n{again}"


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in FOLDER.glob("*.webp")) < MAX_BYTES
