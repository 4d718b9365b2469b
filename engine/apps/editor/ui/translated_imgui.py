"""Dear ImGui with labels in the language of the window.

In: the functions of `imgui_bundle.imgui`, called with English labels. Out: the same, drawn in the
chosen language. What follows ``###`` is the ID of an item, and the English label is put there in
every language, so that layouts, focus and open menus do not depend on the language. Texts that may
be names of the user's own (``text``, ``selectable``, …) are drawn as they are given.
"""

from __future__ import annotations

import functools
from types import SimpleNamespace
from typing import TYPE_CHECKING

from imgui_bundle import imgui as _imgui

from ....base.command_key import with_command_key
from ....base.language import translated, translated_keys
from ....base.line_breaks import unbroken

#: Functions whose first argument is a label.
LABELLED = (
    "begin",
    "begin_combo",
    "begin_menu",
    "begin_popup",
    "begin_popup_modal",
    "button",
    "checkbox",
    "collapsing_header",
    "color_edit3",
    "combo",
    "drag_float",
    "drag_float2",
    "drag_float3",
    "drag_int",
    "input_float",
    "input_int",
    "input_int2",
    "input_text",
    "label_text",
    "open_popup",
    "radio_button",
    "slider_float",
    "slider_int",
    "small_button",
    "table_setup_column",
    "tree_node",
)
#: Functions whose first argument is a remark of the editor.
REMARKING = ("separator_text", "set_item_tooltip", "text_disabled", "text_wrapped")


def label(text: str) -> str:
    """Return a label in the chosen language, with an ID that is the same in all languages.

    Parameters
    ----------
    text : str
        In English; ``###`` begins its ID, which is not shown. With ``##``, which tells equal names
        of the user's apart, it is such a name and stays.
    """
    shown, mark, identity = text.partition("###")
    if not mark and "##" in text:
        return text
    return f"{translated(shown)}###{identity if mark else text}"


def _labelled(function):
    @functools.wraps(function)
    def call(text, *others, **named):
        return function(label(text), *others, **named)

    return call


def _remarking(function):
    @functools.wraps(function)
    def call(text):
        return function(unbroken(with_command_key(translated(text))))

    return call


def _menu_item(function):
    @functools.wraps(function)
    def call(text, keys="", *others, **named):
        return function(label(text), translated_keys(keys) if keys else keys, *others, **named)

    return call


def _hinting(function):
    @functools.wraps(function)
    def call(text, hint, *others, **named):
        return function(label(text), translated(hint), *others, **named)

    return call


def _wrapped() -> dict:
    """Return the functions that are called instead of Dear ImGui's own, by name."""
    own = {name: _labelled(getattr(_imgui, name)) for name in LABELLED}
    own |= {name: _remarking(getattr(_imgui, name)) for name in REMARKING}
    own |= {name: _menu_item(getattr(_imgui, name)) for name in ("menu_item", "menu_item_simple")}
    return own | {"input_text_with_hint": _hinting(_imgui.input_text_with_hint)}


if TYPE_CHECKING:
    from imgui_bundle import imgui
else:
    imgui = SimpleNamespace(**(vars(_imgui) | _wrapped()))
