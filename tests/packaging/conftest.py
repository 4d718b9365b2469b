"""Where the source tree is, and how the packaging tests start another Python."""

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def source_tree():
    """The checkout, or the unpacked source distribution, that these tests belong to."""
    return Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def run_python():
    """Call with arguments, `cwd=` and variables to set: runs Python, returns what it printed."""

    def run(*arguments, cwd, **environment):
        done = subprocess.run(
            [sys.executable, *map(str, arguments)],
            cwd=cwd,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, f"{arguments} failed:\n{done.stdout}\n{done.stderr}"
        return done.stdout

    return run
