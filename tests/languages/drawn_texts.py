"""The texts that windows can draw, found in the source: what a catalogue has to have.

In: the modules of programs and of what they draw over pictures. Out: pairs of a context and a text
in English, with the place of each. Literal arguments of the calls that draw are read from the
source; lists of titles, helps and choices are read where they are defined.
"""

import ast
import functools
import re
from pathlib import Path
from typing import NamedTuple

import engine3d

ENGINE = Path(engine3d.__file__).parent
UI = ENGINE / "apps" / "editor" / "ui"
#: What draws texts, and what it asks for them.
FOLDERS = ("apps", "stage", "base/files")
#: Functions of `engine3d.base.language`, and how many of their first arguments are texts.
TRANSLATING = {"translated": 1, "translated_count": 2}
#: Methods that show messages in a viewer's window, by their folders.
SAYING = dict.fromkeys(("apps/viewer", "apps/viewer/tools", "apps/cli/commands"), "say")
#: Functions of Dear ImGui that draw their first argument as it is.
DRAWN_AS_GIVEN = ("text", "text_unformatted", "selectable")
#: Modules of the editor's window without labels.
UNLABELLED = ("imgui_input.py", "translated_imgui.py")
#: Keys whose names are the same everywhere.
SAME_KEY = re.compile(r"F\d+|Ctrl|Tab|Alt")
#: Names of keys that code compares with, which are no labels.
KEY_NAMES = ("Alt", "Ctrl", "Escape", "Shift", "Space", "Tab")


class Text(NamedTuple):
    """A text, and where it was found."""

    context: str
    text: str
    place: str


def texts_in_source():
    """Yield the texts of calls that draw, and the labels of the editor."""
    for folder in FOLDERS:
        for path in sorted((ENGINE / folder).rglob("*.py")):
            yield from _texts_of(path)


def counted_texts():
    """Yield what `translated_count` takes: a text for one thing, one for several, and the place."""
    for folder in FOLDERS:
        for path in sorted((ENGINE / folder).rglob("*.py")):
            for call in _calls(_tree(path)):
                if _function(call) == "translated_count":
                    one, many = (argument.value for argument in call.args[:2])
                    yield one, many, f"{_name(path)}:{call.lineno}"


def untranslatable():
    """Yield the places where words are put together before they are drawn."""
    for folder in FOLDERS:
        for path in sorted((ENGINE / folder).rglob("*.py")):
            for call in _calls(_tree(path)):
                for argument in _drawn(path, call):
                    for part in _parts(argument):
                        if isinstance(part, ast.JoinedStr) and _has_words(part):
                            yield f"{_name(path)}:{part.lineno}: {ast.unparse(part)}"
                if _function(call) in DRAWN_AS_GIVEN and _is_of_imgui(call) and call.args:
                    for part in _parts(call.args[0]):
                        if _has_words(part):
                            yield f"{_name(path)}:{part.lineno}: {ast.unparse(part)}"


@functools.cache
def _list_of(name):
    """Return a list of the module that translates, which needs imgui_bundle to be imported."""
    for node in _tree(UI / "translated_imgui.py").body:
        if isinstance(node, ast.Assign) and node.targets[0].id == name:
            return ast.literal_eval(node.value)
    raise AssertionError(name)


def untranslated_labels():
    """Yield the modules that lay out labels with Dear ImGui itself."""
    labelled = {*_list_of("LABELLED"), *_list_of("REMARKING"), "menu_item", "menu_item_simple"}
    for path in sorted(UI.rglob("*.py")):
        tree = _tree(path)
        modules = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom))
        itself = any(
            node.module == "imgui_bundle" and "imgui" in [one.name for one in node.names]
            for node in modules
        )
        draws = any(_is_of_imgui(call) and _function(call) in labelled for call in _calls(tree))
        if itself and draws and path.name not in UNLABELLED:
            yield _name(path)


def _texts_of(path):
    for call in _calls(_tree(path)):
        for argument in _drawn(path, call):
            for part in _parts(argument):
                if isinstance(part, ast.Constant) and isinstance(part.value, str):
                    yield Text("", part.value, f"{_name(path)}:{part.lineno}")
        if _function(call) == "translated_choice" and isinstance(call.args[0], ast.Constant):
            for part in _parts(call.args[1]):
                if isinstance(part, ast.Constant):
                    place = f"{_name(path)}:{part.lineno}"
                    yield Text(call.args[0].value, part.value, place)
    if path.is_relative_to(UI) and path.name not in UNLABELLED:
        yield from _labels_of(path)


def _calls(tree):
    return (node for node in ast.walk(tree) if isinstance(node, ast.Call))


def _tree(path):
    return ast.parse(path.read_text("utf-8"))


def _drawn(path, call):
    """Return the arguments of a call that are drawn in the chosen language."""
    name = _function(call)
    if name in TRANSLATING:
        return call.args[: TRANSLATING[name]]
    folder = path.parent.relative_to(ENGINE).as_posix()
    if isinstance(call.func, ast.Attribute) and SAYING.get(folder) == name:
        return call.args[:1]
    if _is_of_imgui(call) and name in _list_of("REMARKING"):
        return call.args[:1]
    if _is_of_imgui(call) and name == "input_text_with_hint":
        return call.args[1:2]
    return []


def _parts(argument):
    """Return an argument, or what it chooses between."""
    if isinstance(argument, ast.IfExp):
        return [*_parts(argument.body), *_parts(argument.orelse)]
    if isinstance(argument, ast.BoolOp):
        return [part for value in argument.values for part in _parts(value)]
    return [argument]


def _function(call):
    return getattr(call.func, "id", None) or getattr(call.func, "attr", "")


def _is_of_imgui(call):
    return isinstance(call.func, ast.Attribute) and getattr(call.func.value, "id", "") == "imgui"


def _has_words(part):
    constants = [part] if isinstance(part, ast.Constant) else getattr(part, "values", [])
    texts = (one.value for one in constants if isinstance(one, ast.Constant))
    shown = "".join(text for text in texts if isinstance(text, str)).partition("##")[0]
    return any(len(word) > 1 and word.isalpha() for word in shown.split())


def _labels_of(path):
    """Yield what begins with a capital letter and is no documentation: labels."""
    tree = _tree(path)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    spared = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and isinstance(node.body[0], ast.Expr)
    }
    spared |= {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.JoinedStr)
        for part in node.values
    }
    keys = [key for call in _calls(tree) for key in _keys(call)]
    spared |= set(map(id, keys))
    spared |= {id(call.args[0]) for call in _calls(tree) if _function(call) == "TypeVar"}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
            continue
        shown = node.value.partition("##")[0]
        if id(node) in spared or shown in KEY_NAMES or shown.startswith(("Ctrl+", "Shift+")):
            continue
        if shown[:1].isupper() and shown[1:2].islower():
            yield Text("", shown, f"{_name(path)}:{node.lineno}")
    for call in _calls(tree):
        if _function(call) == "ask" and isinstance(call.args[0], ast.Constant):
            first = call.args[0].value.split()[0]  # what the button of a dialog says
            yield Text("", first, f"{_name(path)}:{call.lineno}")
    for loop in (node for node in ast.walk(tree) if isinstance(node, ast.For)):
        for node in ast.walk(loop.iter):  # rows of labels and tooltips
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                if " " in node.value and _has_words(node):
                    yield Text("", node.value, f"{_name(path)}:{node.lineno}")
    for node in keys:
        for name in names_of_keys(node.value):
            yield Text("key", name, f"{_name(path)}:{node.lineno}")


def _keys(call):
    """Return the arguments of a call that name keys of a shortcut."""
    places = {"Entry": 2, "menu_item": 1, "menu_item_simple": 1, "of_selection": 1, "key": 1}
    place = places.get(_function(call))
    found = call.args[place : place + 1] if place else []
    return [one for one in found if isinstance(one, ast.Constant) and one.value]


def names_of_keys(keys):
    """Return the words of a shortcut that are not the same on all keyboards."""
    words = keys.replace("+", " ").split()
    return [word for word in words if len(word) > 1 and not SAME_KEY.fullmatch(word)]


def _name(path):
    return path.relative_to(ENGINE).as_posix()
