"""The texts that windows draw from lists: titles, helps, names of choices.

Each function yields pairs of a context and a text, read where the program reads them.
"""

import ast
import inspect
from typing import get_args

import pytest
from languages.drawn_texts import ENGINE, names_of_keys

from engine3d.stage.appearance import CHOICES


def of_viewer():
    """What the viewer draws of its keys, options, lists and statistics."""
    from engine3d.apps.viewer import actions, file_dialog, help_panel, keymap, list_panels, viewer
    from engine3d.apps.viewer.tools import (
        explosion_panel,
        measuring_panel,
        pointing_panel,
        section_panel,
    )
    from engine3d.stage.lighting import NO_LIGHTS, OWN_LIGHTS, SETUPS
    from engine3d.stage.overlays.debug_lines import DEBUG_DRAWINGS
    from engine3d.stage.overlays.theme import THEMES

    yield from of_keys(key for binding in keymap.BINDINGS for key in binding.keys)
    gestures = (*keymap.GESTURES, *keymap.WALKING_GESTURES)
    yield from _plain(gesture for gesture, _ in gestures)
    yield from _plain(text for _, text in (*gestures, *keymap.WALKING))
    yield from _plain(["Walking", "Mouse", *keymap.SECTIONS])
    yield from _plain(binding.help for binding in keymap.BINDINGS)
    yield from _plain(actions.LEFT_OUT.values())
    yield from _plain(file_dialog.SIZES)
    panels = list_panels.ObjectPanel, list_panels.MaterialPanel
    panels += file_dialog.FolderPanel, file_dialog.RecentPanel
    panels += explosion_panel.ExplosionPanel, section_panel.SectionPanel
    panels += help_panel.CommandPanel, measuring_panel.MeasuringPanel
    panels += (pointing_panel.PointingPanel,)
    yield from _plain(text for panel in panels for text in (panel.title, panel.hint))
    yield from _plain([help_panel._SHORT_HINT, measuring_panel._CLEAR, viewer.HINT])
    yield from _plain(measuring_panel._WORDS.values())
    yield from _plain(["corner", "edge", "face"])  # what a click snaps to
    yield from _plain(binding.button for binding in keymap.BINDINGS)
    for option in ("wireframe", "mode", "cull", "hidden_surfaces", "tone_mapping"):
        yield "", option.replace("_", " ")
        yield from ((option, value or "off") for value in CHOICES[option])
    yield from (("normals", value) for value in CHOICES["normals"])
    yield from (("culling", value) for value in CHOICES["culling"])
    yield from (("lights", name) for name in (*SETUPS, OWN_LIGHTS, NO_LIGHTS))
    yield from (("drawing", name or "nothing") for name in DEBUG_DRAWINGS)
    yield from (("theme", theme.name) for theme in THEMES)


def of_pictures():
    """What is drawn over pictures: statistics, why nothing shows, what files hold."""
    from engine3d.stage import blank
    from engine3d.stage.overlays.draw_counts import COLUMNS, EVERY_TEST, ROWS, TESTS
    from engine3d.stage.overlays.frame_statistics import _LISTED, _STAGES

    named = (name.replace("_", " ") for name in _LISTED)
    yield from _plain([*COLUMNS, *ROWS, *TESTS.values(), EVERY_TEST, *_STAGES, *named])
    source = ast.parse(inspect.getsource(blank))
    made = (node for node in ast.walk(source) if isinstance(node, ast.Call))
    yield from _plain(
        call.args[1].value for call in made if getattr(call.func, "id", "") == "Reason"
    )
    yield from _plain(_held_by_files())


def _held_by_files():
    """Yield the keys that formats give to `Document.counts`."""
    for path in sorted((ENGINE / "io").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef) and "counts" in node.name.split("_"):
                yield from _keys_of(part for part in ast.walk(node) if isinstance(part, ast.Dict))
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]).startswith("counts"):
                yield from _keys_of([node.value, node.targets[0]])
            if isinstance(node, ast.AnnAssign) and ast.unparse(node.target) == "counts":
                yield from _keys_of([node.value])


def _keys_of(nodes):
    for node in nodes:
        keys = node.keys if isinstance(node, ast.Dict) else [getattr(node, "slice", None)]
        named = (key.value for key in keys if isinstance(key, ast.Constant))
        yield from (name for name in named if isinstance(name, str))


def of_editor():
    """What the editor draws of its lists."""
    pytest.importorskip("imgui_bundle", reason="it is an extra", exc_type=ImportError)
    from engine3d.apps.editor.console import LEVELS
    from engine3d.apps.editor.motion_commands import NAMES
    from engine3d.apps.editor.new_things.adding import AREA_SIZES, GROUPS
    from engine3d.apps.editor.new_things.starts import STARTS
    from engine3d.apps.editor.ui import properties_panel, render_dialog, scene_tools
    from engine3d.apps.editor.ui.keys_window import KEYBOARD, MOUSE
    from engine3d.apps.editor.ui.materials import material_actions
    from engine3d.apps.editor.ui.motion.motion_fields import _ENDS
    from engine3d.apps.editor.ui.overlays import SHOWN
    from engine3d.apps.editor.ui.properties import collider_fields, fog_fields, material_fields
    from engine3d.apps.editor.ui.properties.light_fields import _CHOICES
    from engine3d.model.environments.environment import BUILT_IN
    from engine3d.model.materials.material import PARAMETERS

    yield from _plain(level.capitalize() for level in LEVELS)
    yield from _plain(title for titles in GROUPS for title in titles)
    yield from _plain(row.title for row in PARAMETERS.values())
    yield from _plain(tool.capitalize() for tool in scene_tools.TOOLS)
    yield from _plain(title for title, _ in SHOWN.values())
    yield from _plain(text for row in (*MOUSE, *KEYBOARD) for text in row)
    yield from _plain(text for start in STARTS for text in (start.title, start.hint))
    yield from _plain(_ENDS.values())
    yield from _plain(render_dialog._WHAT.values())
    yield from _plain(kind.capitalize() for kind in material_actions.KINDS)
    yield from _plain(material_fields._part(row) for row in PARAMETERS.values())
    yield from _plain(_arguments_of_primitives())
    yield from _plain(name.capitalize() for name in AREA_SIZES)
    yield from (("act", tool) for tool in scene_tools.TOOLS if tool != "select")
    yield from (("look", look or "auto") for look in scene_tools.LOOKS)
    yield from (("mode", mode) for mode in scene_tools.MODES)
    yield from (("collider", kind) for kind in collider_fields.COLLIDERS)
    yield from (("fog", kind) for kind in fog_fields.KINDS.values())
    yield from ((name, each) for name, (_, kind) in _CHOICES.items() for each in get_args(kind))
    yield from (("surface", kind) for kind in material_actions.KINDS)
    yield from (("motion", name) for name in NAMES.values())
    yield from (("holds", kind) for kind in ("light", "camera", *properties_panel._KINDS.values()))
    yield from (("environment", name) for name in ("none", *BUILT_IN))
    yield from (("resource", kind) for kind in ("mesh", "material", "texture"))


def of_lessons():
    """What the window of the lessons says besides them."""
    from engine3d.apps.learn.words import KEYS, WORDS

    yield from _plain(WORDS.values())
    yield from _plain(meaning for _, meaning in KEYS)
    yield from _plain(keys for keys, _ in KEYS if any(names_of_keys(keys)))


def _arguments_of_primitives():
    from engine3d.apps.editor.new_things.primitive_shapes import PRIMITIVES
    from engine3d.apps.editor.ui.properties.shape_fields import _title

    for make in PRIMITIVES.values():
        yield from (_title(name) for name in inspect.signature(make).parameters)


def of_keys(keys):
    """The names of keys on keyboards."""
    for key in keys:
        yield from (("key", name) for name in names_of_keys(key))


def _plain(texts):
    return (("", text) for text in texts if text)
