"""The modules of engine/, read as syntax trees."""

import ast
import functools
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]


def modules():
    """The modules of engine/ by their names within it."""
    folder = ROOT / "engine"
    paths = {path.relative_to(folder).with_suffix("").parts: path for path in folder.rglob("*.py")}
    return {".".join(part for part in p if part != "__init__"): path for p, path in paths.items()}


MODULES = modules()


@functools.cache
def tree_of(name):
    return ast.parse(MODULES[name].read_text(encoding="utf-8"))


class Import(NamedTuple):
    importer: str
    imported: str
    is_typing: bool


@functools.cache
def imports():
    """All imports of modules of engine/ by others, at once, in functions, and for type checkers."""
    return {found for name in MODULES for found in imports_of(name)}


def imports_of(name):
    package = MODULES[name].relative_to(ROOT / "engine").parent.parts
    for node, is_typing in nodes(tree_of(name)):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = [*package[: len(package) - node.level + 1], *filter(None, [node.module])]
            for alias in node.names:
                longest = ".".join([*base, alias.name])
                found = longest if longest in MODULES else ".".join(base)
                if found != name:
                    yield Import(name, found, is_typing)


def nodes(tree, is_typing=False):
    """The nodes of a syntax tree, and whether only type checkers read them."""
    for node in ast.iter_child_nodes(tree):
        within = is_typing or (
            isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        )
        yield node, within
        yield from nodes(node, within)


def room_of(name):
    """The room of a module; the modules beside the rooms have none."""
    path = MODULES.get(name)
    if path is None:  # a compiled module
        return name.partition(".")[0]
    parts = path.relative_to(ROOT / "engine").parts
    return parts[0] if len(parts) > 1 else ""
