"""Lists of choices stand once, as types in engine/choices.py."""

import ast
from typing import Literal, get_args, get_origin

from structure.python_sources import MODULES, ROOT

from engine3d import choices

# Lists that repeat a type of engine/choices.py.
COPIED_CHOICES = set()


def module_lists(path):
    """The lists of three and more constants that a module assigns, by name."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and isinstance(node.value, (ast.Tuple, ast.List, ast.Set)):
            if all(isinstance(element, ast.Constant) for element in node.value.elts):
                values = {element.value for element in node.value.elts}
                if len(values) >= 3:
                    yield ast.unparse(node.targets[0]), values


def test_choices_are_listed_once():
    types = [getattr(choices, name) for name in vars(choices)]
    known = [set(get_args(t)) for t in types if get_origin(t) is Literal]
    found = {
        f"{path.relative_to(ROOT / 'engine').as_posix()}: {name}"
        for path in MODULES.values()
        for name, values in module_lists(path)
        if values in known
    }
    assert found == COPIED_CHOICES
