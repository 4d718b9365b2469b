"""Each compiled module has a stub that declares the public names which the module really has."""

import ast
import importlib
from pathlib import Path
from types import ModuleType

import pytest

NATIVE = Path(__file__).resolve().parents[2] / "engine" / "_native"
MODULES = sorted(path.stem for path in NATIVE.glob("*.pyx"))


def declared_names(stub):
    """The public names that the text of a stub defines, imports aside."""
    names = set()
    for node in ast.parse(stub).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
        elif isinstance(node, ast.Assign):
            names.update(target.id for target in node.targets)
    return {name for name in names if not name.startswith("_")}


def defined_names(module):
    """The public names that belong to the compiled `module`: neither modules nor imports."""
    return {
        name
        for name, value in vars(module).items()
        if not name.startswith("_")
        and not isinstance(value, ModuleType)
        and getattr(value, "__module__", module.__name__) == module.__name__
    }


def test_marker_for_type_checkers():
    assert (NATIVE.parent / "py.typed").is_file()


@pytest.mark.parametrize("name", MODULES)
def test_stub_matches_module(name):
    stub = NATIVE / f"{name}.pyi"
    assert stub.is_file(), f"{name}.pyx has no stub"
    module = importlib.import_module(f"engine3d._native.{name}")
    assert declared_names(stub.read_text("utf-8")) == defined_names(module)
