"""docs/plan.md says what the core's table says."""

import subprocess
import sys
from pathlib import Path

MAKE_PLAN = Path(__file__).resolve().parents[2] / "docs" / "make_plan.py"


def test_the_page_of_the_plan_is_up_to_date():
    run = subprocess.run([sys.executable, MAKE_PLAN, "--check"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
