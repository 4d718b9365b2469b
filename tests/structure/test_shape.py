"""How large things are, and what is read across packages.

What breaks a rule today stands in allowed.py, which only shrinks: a breach that isn't listed fails,
and so does a listed one that is gone.
"""

import ast
from collections import Counter, defaultdict

import pytest
from structure import allowed
from structure.python_sources import MODULES, ROOT, room_of, tree_of

MOST_FILES = 30
MOST_PARAMETERS = 8
MOST_ATTRIBUTES = 20


def of(tree, *kinds):
    return (node for node in ast.walk(tree) if isinstance(node, kinds))


def parameters(function):
    arguments = function.args
    return [
        argument.arg
        for argument in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
        if argument.arg not in ("self", "cls")
    ]


def attributes(node):
    """What the methods of a class assign to."""
    return {
        found.attr
        for found in of(node, ast.Attribute)
        if isinstance(found.ctx, ast.Store)
        and isinstance(found.value, ast.Name)
        and found.value.id == "self"
    }


def long_signatures():
    for name in MODULES:
        for function in of(tree_of(name), ast.FunctionDef, ast.AsyncFunctionDef):
            if len(parameters(function)) > MOST_PARAMETERS:
                yield f"{name}.{function.name}"


def large_classes():
    for name in MODULES:
        for node in of(tree_of(name), ast.ClassDef):
            if len(attributes(node)) > MOST_ATTRIBUTES:
                yield f"{name}.{node.name}"


def is_by_hand(path):
    """Whether a path is a file that no build wrote."""
    is_made = path.suffix in (".c", ".pyi") and path.with_suffix(".pyx").exists()
    return path.is_file() and path.suffix not in (".so", ".pyc") and not is_made


def full_folders():
    for top in ("engine", "csrc"):
        for folder in (ROOT / top).rglob("*"):
            if folder.is_dir() and folder.name not in ("__pycache__", "seeds"):
                if sum(map(is_by_hand, folder.iterdir())) > MOST_FILES:
                    yield folder.relative_to(ROOT).as_posix()


def repeated_names():
    counts = Counter((room_of(name), path.name) for name, path in MODULES.items())
    for (room, file), count in counts.items():
        if count > 1 and room and file != "__init__.py":
            yield f"{room}: {file}"


def package_of(name):
    return MODULES[name].parent.relative_to(ROOT / "engine").as_posix()


def is_private(name):
    is_foreign = name in ("_mode", "_marker", "_replace")  # of images, lines, and tuples
    return name.startswith("_") and not name.startswith("__") and not is_foreign


def private_names():
    """Of each private attribute, function and class the packages that define one of its name."""
    homes = defaultdict(set)
    for name in MODULES:
        for node in ast.walk(tree_of(name)):
            match node:
                case ast.FunctionDef(name=found) | ast.ClassDef(name=found):
                    homes[found].add(package_of(name))
                case ast.Attribute(attr=found, value=ast.Name(id="self" | "cls"), ctx=ast.Store()):
                    homes[found].add(package_of(name))
                case ast.Name(id=found, ctx=ast.Store()):
                    homes[found].add(package_of(name))
    return {found: packages for found, packages in homes.items() if is_private(found)}


def private_reads():
    homes = private_names()
    for name in MODULES:
        for node in of(tree_of(name), ast.Attribute):
            its_own = isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")
            if is_private(node.attr) and not its_own and node.attr in homes:
                if package_of(name) not in homes[node.attr]:
                    yield f"{name}: {node.attr}"


@pytest.mark.parametrize(
    "rule",
    [long_signatures, large_classes, full_folders, repeated_names, private_reads],
)
def test_breaches_are_those_that_are_listed(rule):
    assert sorted(set(rule())) == sorted(getattr(allowed, rule.__name__.upper()))
