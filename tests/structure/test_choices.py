"""Lists of names stand once; those of choices, as types in engine/choices.py."""

import ast
from collections import defaultdict
from typing import Literal, get_args, get_origin

from structure.allowed import REPEATED_LISTS
from structure.python_sources import MODULES, tree_of

from engine3d import choices


def module_lists(name):
    """The lists of three and more constants that a module assigns, by name."""
    for node in tree_of(name).body:
        if isinstance(node, ast.Assign) and isinstance(node.value, (ast.Tuple, ast.List, ast.Set)):
            if all(isinstance(element, ast.Constant) for element in node.value.elts):
                values = {element.value for element in node.value.elts}
                if len(values) >= 3:
                    yield ast.unparse(node.targets[0]), values


def test_choices_are_listed_once():
    types = [getattr(choices, name) for name in vars(choices)]
    known = [set(get_args(t)) for t in types if get_origin(t) is Literal]
    found = {
        f"{module}: {name}"
        for module in MODULES
        for name, values in module_lists(module)
        if values in known
    }
    assert found == set()


FEWEST_NAMES = 4


def list_of_names(node):
    """The names that a literal is a list of, or has a row for each of; None of any other node."""
    match node:
        case ast.Tuple(elts=found) | ast.List(elts=found) | ast.Set(elts=found):
            pass
        case ast.Dict(keys=found):
            pass
        case _:
            return None
    names = {getattr(element, "value", None) for element in found}
    is_list = len(names) >= FEWEST_NAMES and all(isinstance(name, str) for name in names)
    return tuple(sorted(names)) if is_list else None


def repeated_lists():
    """The lists of names that stand twice: where, and their first and last."""
    places = defaultdict(list)
    for module in MODULES:
        for node in ast.walk(tree_of(module)):
            if (names := list_of_names(node)) is not None:
                places[names].append(module)
    for names, found in places.items():
        if len(found) > 1:
            yield f"{', '.join(sorted(set(found)))}: {names[0]} to {names[-1]}"


def test_lists_of_names_stand_once():
    assert sorted(repeated_lists()) == sorted(sum(REPEATED_LISTS.values(), ()))
