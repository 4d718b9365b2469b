"""Pages that scripts make are up to date; every public name has a docstring."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import engine3d

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.mark.parametrize("script", ["make_api.py", "make_plan.py"])
def test_pages_that_scripts_make_are_up_to_date(script):
    command = [sys.executable, DOCS / script, "--check"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def documented():
    """Every public function, class and method of a class."""
    for name in engine3d.__all__:
        thing = getattr(engine3d, name)
        if name.startswith("_"):
            continue
        yield name, thing
        if inspect.isclass(thing):
            for member, function in vars(thing).items():
                if not member.startswith("_") and inspect.isfunction(function):
                    yield f"{name}.{member}", function
        for member in getattr(thing, "__all__", ()) if inspect.ismodule(thing) else ():
            yield f"{name}.{member}", getattr(thing, member)


@pytest.mark.parametrize(
    ("name", "thing"), list(documented()), ids=lambda value: value if isinstance(value, str) else ""
)
def test_every_public_name_has_a_docstring(name, thing):
    text = inspect.getdoc(thing) or ""
    assert text, f"{name} has no docstring"
    assert text.splitlines()[0].endswith((".", ":")), f"{name}: the first line is no sentence"
