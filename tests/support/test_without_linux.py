"""What the package and its scripts ask of Python's own modules that macOS lacks."""

import ast
from pathlib import Path

import pytest
from support.windows_names import PARTLY, missing, typeshed

import engine3d

pytestmark = pytest.mark.skipif(typeshed() is None, reason="pip install mypy: what macOS lacks")

PACKAGE = Path(engine3d.__file__).parent
ROOT = Path(__file__).resolve().parents[2]
# What docs/portability.md names, and where it is asked for: with hasattr or getattr, or on Linux.
KNOWN = {
    "O_PATH": {"base/system.py"},
    "memfd_create": {"compat/open3d/_stand_ins.py"},
}


def lacking_in(tree):
    """The names that a file asks for, and whether it does so as an attribute, without a guard."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id in PARTLY and node.attr in missing(node.value.id, "darwin"):
                yield node.attr
        elif isinstance(node, ast.ImportFrom) and node.module in PARTLY:
            yield from {name.name for name in node.names} & missing(node.module, "darwin")
        elif isinstance(node, ast.Call) and ast.unparse(node.func) in ("hasattr", "getattr"):
            module, name = map(ast.unparse, node.args[:2])
            if module in PARTLY:
                yield from {name.strip("'\"")} & missing(module, "darwin")


@pytest.mark.parametrize(
    "text, found",
    [
        ("import os\nos.sched_getaffinity(0)", {"sched_getaffinity"}),
        ("import os\ngetattr(os, 'O_PATH', 0)", {"O_PATH"}),
        ("from os import memfd_create", {"memfd_create"}),
        ("import os\nos.register_at_fork", set()),
    ],
)
def test_what_macos_lacks_is_found(text, found):
    assert set(lacking_in(ast.parse(text))) == found


def test_what_macos_lacks_is_known():
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        for name in set(lacking_in(ast.parse(path.read_text("utf-8")))):
            found.setdefault(name, set()).add(path.relative_to(PACKAGE).as_posix())
    assert found == KNOWN
    page = (ROOT / "docs" / "portability.md").read_text("utf-8")
    assert all(f"`{name}`" in page for name in found)


def test_scripts_that_macos_runs_ask_for_nothing_else():
    paths = [*ROOT.glob("benchmarks/*.py"), *ROOT.glob("csrc/*.py"), ROOT / "setup.py"]
    paths += [ROOT / ".ci" / name for name in ("build_driver.py", "zigcc")]
    found = {
        path.name: names
        for path in paths
        if (names := set(lacking_in(ast.parse(path.read_text("utf-8")))))
    }
    assert found == {"build_rules.py": {"sched_getaffinity"}}
