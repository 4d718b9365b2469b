"""Each compiled module has a stub that declares the public names which the module really has."""

import ast
import importlib
import inspect
from pathlib import Path
from types import ModuleType

import pytest

import engine3d as e3d
from engine3d import _native

NATIVE = Path(__file__).resolve().parents[2] / "engine" / "_native"
# What calls single kernels is built in place only, for tests and benchmarks.
TESTING = "kernels_testing"
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


def test_the_core_is_said_to_hold_what_is_built_into_it():
    assert sorted([*_native.MODULES, TESTING]) == MODULES


@pytest.mark.parametrize("name", MODULES)
def test_stub_matches_module(name):
    if name == TESTING:
        pytest.importorskip(f"engine3d._native.{name}", reason="it is built in place only")
    module = importlib.import_module(f"engine3d._native.{name}")
    stub = Path(_native.__file__).with_name(f"{name}.pyi")  # a wheel has it, too
    assert stub.is_file(), f"{name}.pyx has no stub"
    assert declared_names(stub.read_text("utf-8")) == defined_names(module)


def public_functions():
    """The functions and methods that ``import engine3d`` names."""
    for name in e3d.__all__:
        value = getattr(e3d, name)
        has_members = inspect.isclass(value) or isinstance(value, ModuleType)
        members = vars(value) if has_members else {name: value}
        for key, item in members.items():
            item = getattr(item, "__func__", item)
            is_ours = getattr(item, "__module__", "").startswith("engine3d")
            is_public = not key.startswith("_") or key == "__init__"
            if inspect.isfunction(item) and is_ours and is_public:
                yield item


def test_public_functions_declare_what_they_return():
    """To strict type checkers, calling one that doesn't is an error."""
    functions = list(public_functions())
    assert len(functions) > 100
    missing = [item.__qualname__ for item in functions if "return" not in item.__annotations__]
    assert missing == []


def test_public_functions_declare_what_they_take():
    """Editors complete and check only arguments whose types they know."""
    missing = [
        f"{item.__qualname__}({parameter.name})"
        for item in public_functions()
        for parameter in inspect.signature(item).parameters.values()
        if parameter.annotation is parameter.empty and parameter.name not in ("self", "cls")
    ]
    assert missing == []


def test_public_properties_declare_what_they_return():
    classes = [
        value for value in (getattr(e3d, name) for name in e3d.__all__) if inspect.isclass(value)
    ]
    properties = [
        (f"{owner.__name__}.{name}", member.fget)
        for owner in classes
        for name, member in vars(owner).items()
        if isinstance(member, property) and not name.startswith("_")
    ]
    assert len(properties) > 30
    assert [name for name, get in properties if "return" not in get.__annotations__] == []
    assert [name for name, get in properties if get.__annotations__["return"] == "np.ndarray"] == []
