"""clang-format lays out the C code, but for the files that .clang-format-ignore lists."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TOOL = Path(sys.executable).with_name("clang-format")


@pytest.mark.skipif(not TOOL.exists(), reason="there is no clang-format: pip install -e .[test]")
def test_the_layout_is_that_of_clang_format():
    files = [p for p in (ROOT / "csrc").rglob("*") if p.suffix in (".c", ".h", ".inl")]
    command = [TOOL, "--dry-run", "--Werror", *sorted(files)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_files_laid_out_by_hand_are_there():
    lines = (ROOT / ".clang-format-ignore").read_text("utf-8").splitlines()
    patterns = [line for line in lines if line and not line.startswith("#")]
    assert [pattern for pattern in patterns if not [*ROOT.glob(pattern)]] == []
