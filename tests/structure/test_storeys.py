"""Rooms import only those below them, programs no other but by arrows that are declared."""

import re
from collections import defaultdict

import pytest
from structure.graphs import circles
from structure.python_sources import MODULES, ROOT, imports, room_of
from structure.rooms import ARROWS, ENGINE, FACADES

import engine3d

MOST_ROOMS = 9
MOST_ROOMS_OF_CORE = 12


def arrow(found):
    return f"{found.importer} -> {found.imported}"


def test_the_ground_floor_has_these_rooms():
    folders = {path.parent.name for path in (ROOT / "engine").glob("*/__init__.py")}
    assert folders == ENGINE.keys() - {""}
    assert len(folders) <= MOST_ROOMS


def test_architecture_has_a_row_for_each_room():
    page = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)/` \|", page, re.M)
    rooms = {path.name for path in (ROOT / "csrc").iterdir() if path.is_dir()} - {"__pycache__"}
    assert sorted(rows) == sorted([*ENGINE.keys() - {""}, *rooms])
    assert len(rooms) <= MOST_ROOMS_OF_CORE


def test_a_row_names_rows_above_it():
    above = set()
    for name, room in ENGINE.items():
        assert set(room.imports) <= above
        above.add(name)


def test_rooms_import_only_those_below_them():
    upward = {
        arrow(found)
        for found in imports()
        if room_of(found.importer) not in ("", room_of(found.imported))
        and room_of(found.imported) not in ENGINE[room_of(found.importer)].imports
    }
    assert upward == FACADES


def program_of(name):
    return name.split(".")[1] if room_of(name) == "apps" and "." in name else None


def test_programs_import_each_other_by_declared_arrows_only():
    found = set()
    for one in imports():
        a, b = program_of(one.importer), program_of(one.imported)
        if a and b and a != b:
            found.add(f"{a} -> {b}")
    assert found == ARROWS


def test_programs_form_no_circle():
    graph = defaultdict(set)
    for line in ARROWS:
        a, b = line.split(" -> ")
        graph[a].add(b)
    assert circles(graph) == []


@pytest.mark.parametrize("room", [room for room in ENGINE if room])
def test_modules_of_a_room_import_each_other_in_no_circle(room):
    graph = {name: set() for name in MODULES if room_of(name) == room}
    for found in imports():
        if found.importer in graph and found.imported in graph and not found.is_typing:
            graph[found.importer].add(found.imported)
    assert circles(graph) == []


# Packages that tell by an underscore which of their modules nobody else needs. In the others, which
# offer what their __init__ lists or a command runs, all modules are their own business.
PACKAGES = {
    *("base.files", "extras.lod", "model.geometry", "model.materials", "model.navigation"),
    *("model.scene", "model.spatial", "rendering"),
}


def outsiders(name):
    """The modules that import one, but for those of its package."""
    package = name.rpartition(".")[0]
    importers = {one.importer for one in imports() if one.imported == name and not one.is_typing}
    return {other for other in importers if not other.startswith(f"{package}.")}


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_an_underscore_tells_what_a_package_keeps_to_itself(package):
    names = [
        name
        for name, path in MODULES.items()
        if name.rpartition(".")[0] == package and path.name != "__init__.py"
    ]
    offered = {name for name in names if name in engine3d._PUBLIC.values() or outsiders(name)}
    assert len(names) >= 3
    assert {name for name in names if "._" not in name} == offered


ALIASES = {"golden", "notebook", *engine3d._MODULES} - {"choices", "errors"}


def test_the_top_of_the_package_holds_no_helpers():
    top = {name for name, path in MODULES.items() if path.parent == ROOT / "engine"}
    assert top == {"", "__main__", "choices", "errors", "start", "version"} | ALIASES
    assert all(len(MODULES[name].read_text("utf-8").splitlines()) <= 12 for name in ALIASES)
