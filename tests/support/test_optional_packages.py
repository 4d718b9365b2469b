"""Packages that are missing: who needs one says so, and how to install it."""

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import engine3d as e3d
import engine3d.compat

ROOT = Path(__file__).resolve().parents[2]
#: Doors that import nothing of their package.
FREE = {"pandas", "pyrender"}

#: Hides one package at a time, as where it was never installed, and goes through its door.
PROBE = """
import importlib, json, sys
said = {}
for name in json.loads(sys.argv[1]):
    sys.modules[name] = None
    try:
        door = importlib.import_module("engine3d.compat." + name)
        if hasattr(door, "install"):
            door.install()
        said[name] = None
    except ModuleNotFoundError as error:
        said[name] = [error.name, str(error)]
print(json.dumps(said))
"""


@pytest.fixture(scope="module")
def said():
    names = json.dumps(engine3d.compat.__all__)
    command = [sys.executable, "-c", PROBE, names]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", sorted(set(engine3d.compat.__all__) - FREE))
def test_a_door_names_the_package_that_it_needs(said, name):
    package, message = said[name]
    assert package == name
    start = f"engine3d.compat.{name} needs the package {name}: pip install "
    assert message in (f"{start}{name}", f"{start}'engine3d[{name}]'")


@pytest.mark.parametrize("name", sorted(FREE))
def test_other_doors_open_without(said, name):
    assert said[name] is None


def calls():
    """Yield file, package and extra of every message about a missing package."""
    for path in sorted(Path(e3d.__file__).parent.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            called = getattr(getattr(node, "func", None), "id", None)
            if called == "needed" and path.name != "optional_packages.py":
                yield path.name, [ast.literal_eval(one) for one in node.args[1:]]
            elif called == "require":
                yield path.name, [ast.literal_eval(one) for one in [node.args[0], *node.args[2:]]]


def test_the_extras_bring_what_messages_say():
    tomllib = pytest.importorskip("tomllib", reason="came with Python 3.11", exc_type=ImportError)
    with open(ROOT / "pyproject.toml", "rb") as file:
        extras = tomllib.load(file)["project"]["optional-dependencies"]
    found = list(calls())
    assert len(found) >= 18
    for file, (package, *extra) in found:
        if extra:
            brought = {re.split(r"[\[<>=]", one)[0] for one in extras[extra[0]]}
            assert package in brought, file
        else:
            assert package not in extras, file
