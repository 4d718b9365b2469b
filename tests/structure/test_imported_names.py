"""Modules have the names that others import from them, also inside of functions."""

import ast
import functools

from structure.python_sources import MODULES, ROOT, nodes, tree_of


@functools.cache
def has_any_name(module):
    """Whether a module makes names when they are asked for, or takes all of another."""
    tree = tree_of(module)
    return any(
        (isinstance(node, ast.FunctionDef) and node.name == "__getattr__")
        or (isinstance(node, ast.ImportFrom) and node.names[0].name == "*")
        or (isinstance(node, ast.Call) and ast.unparse(node.func) in ("globals", "vars"))
        for node, _ in nodes(tree)
    )


@functools.cache
def names_of(module):
    """The names that a module binds, also in its branches; of a package, its modules, too."""
    path, found = MODULES[module], {"*"}
    if path.name == "__init__.py":
        found |= {one.name.partition(".")[0] for one in path.parent.iterdir()}
    for node in ast.walk(tree_of(module)):
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
            found.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.add(node.id)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            found |= {alias.asname or alias.name.partition(".")[0] for alias in node.names}
    return found


def missing_names(tree, package):
    """What a module in this package imports from modules of engine/ that do not have it."""
    for node, _ in nodes(tree):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = [*package[: len(package) - node.level + 1], *filter(None, [node.module])]
        module = ".".join(base)
        if module not in MODULES or has_any_name(module):
            continue
        names = {alias.name for alias in node.names} - names_of(module)
        yield from (f"{module}.{name}" for name in sorted(names))


def test_imported_names_exist():
    missing = {}
    for name, path in MODULES.items():
        package = path.relative_to(ROOT / "engine").parent.parts
        missing[name] = list(missing_names(tree_of(name), package))
    assert {name: names for name, names in missing.items() if names} == {}


def test_a_name_that_moved_is_found():
    tree = ast.parse("def later():\n    from ..base.numbers import moved_away, shown")
    assert list(missing_names(tree, ("rendering",))) == ["base.numbers.moved_away"]


def test_tests_leave_no_folder_to_import_from():
    """Its modules would hide folders of tests that have their names, whichever test comes next."""
    changed = []
    for path in (ROOT / "tests").rglob("*.py"):
        statements = map(ast.unparse, ast.parse(path.read_text("utf-8")).body)
        changed += [path.name for one in statements if one.startswith("sys.path")]
    assert changed == []
