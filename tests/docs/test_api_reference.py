"""Every public name has a docstring and a place in docs/api/; made pages are up to date."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import engine3d

DOCS = Path(__file__).resolve().parents[2] / "docs"
#: Public names without an entry: numbers of docs/versions.md, modules whose names have entries.
WITHOUT_ENTRY = {"PICTURES", "__version__", "choices", "errors", "primitives"}


@pytest.mark.parametrize("page", ("plan", "materials"))
def test_pages_that_are_made_are_up_to_date(page):
    command = [sys.executable, DOCS / f"make_{page}.py", "--check"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def listed(pattern):
    """The names of docs/api/ in lines of a pattern, with the module that a page says before."""
    found = []
    for path in sorted((DOCS / "api").glob("*.md")):
        module = ""
        for line in path.read_text(encoding="utf-8").splitlines():
            if match := re.fullmatch(r"\.\. currentmodule:: engine3d\.?(\w*)", line):
                module = f"{match[1]}." if match[1] else ""
            elif match := re.fullmatch(pattern, line):
                found.append(module + match[1])
    return sorted(found)


def test_every_public_name_has_its_entry():
    entries = listed(r"\.\. auto(?:class|function):: (\w+)")
    assert entries == listed(r"   (\w+)")
    whole = listed(r"\.\. automodule:: engine3d\.(\w+)")
    names = set(engine3d.__all__) - WITHOUT_ENTRY - set(whole)
    modules = {name for name in names if inspect.ismodule(getattr(engine3d, name))}
    inner = {
        f"{module}.{name}"
        for module in (*modules, "errors", "primitives")
        for name in getattr(engine3d, module).__all__
        if name not in names
    }
    assert entries == sorted(names - modules | inner)


def documented():
    """Every public function, class and method of a class."""
    for name in engine3d.__all__:
        thing = getattr(engine3d, name)
        if name.startswith("_") or isinstance(thing, int):
            continue
        yield name, thing
        if inspect.isclass(thing):
            for member, function in vars(thing).items():
                if not member.startswith("_") and inspect.isfunction(function):
                    yield f"{name}.{member}", function
        for member in getattr(thing, "__all__", ()) if inspect.ismodule(thing) else ():
            if inspect.isroutine(getattr(thing, member)) or inspect.isclass(getattr(thing, member)):
                yield f"{name}.{member}", getattr(thing, member)


@pytest.mark.parametrize(
    ("name", "thing"), list(documented()), ids=lambda value: value if isinstance(value, str) else ""
)
def test_every_public_name_has_a_docstring(name, thing):
    text = inspect.getdoc(thing) or ""
    assert text, f"{name} has no docstring"
    assert text.splitlines()[0].endswith((".", ":")), f"{name}: the first line is no sentence"
