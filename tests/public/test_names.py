"""The public names: all importable, and the same for Python as for type checkers."""

import ast
import importlib.util
import sys
from pathlib import Path

import pytest

import engine3d

PACKAGE = Path(engine3d.__file__).parent


def test_stub_declares_the_public_names():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text("utf-8"))
    declared = {
        (node.module or alias.name, alias.name)
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    public = {(module, name) for name, module in engine3d._PUBLIC.items()}
    modules = {(name, name) for name in (*engine3d._MODULES, *engine3d._MODULES_APART)}
    assert declared == public | modules | {("version", "__version__"), ("version", "PICTURES")}


@pytest.mark.parametrize("name", sorted(engine3d._PUBLIC))
def test_public_name_is_documented(name):
    value = getattr(engine3d, name)
    assert value.__doc__
    assert getattr(engine3d, name) is value


def test_importing_everything_keeps_functions_functions():
    for module in sorted(set(engine3d._PUBLIC.values())):
        importlib.import_module(f"engine3d.{module}")
    assert all(
        callable(getattr(engine3d, name)) for name in ("backends", "box", "render", "look_at")
    )


def test_unknown_name():
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = engine3d.nonsense


def test_dir_lists_public_names_and_nothing_else():
    engine3d.Scene().add(engine3d.box())  # imports many modules behind them
    assert dir(engine3d) == sorted(engine3d.__all__)


def test_refuses_another_name(monkeypatch):
    spec = importlib.util.spec_from_file_location("engine", PACKAGE / "__init__.py")
    monkeypatch.delitem(sys.modules, "engine", raising=False)
    with pytest.raises(ImportError, match="imported as 'engine'"):
        spec.loader.exec_module(importlib.util.module_from_spec(spec))
