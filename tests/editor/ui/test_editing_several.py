"""Several selected nodes are edited together: what differs is marked, an edit is one step."""

import numpy as np
import pytest
from editor.ui.editor_hands import settle

import engine3d as e3d
from engine3d.apps.editor.ui.motion import motion_fields
from engine3d.apps.editor.ui.properties import fields
from engine3d.apps.editor.ui.properties.fields import DIFFERS

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from imgui_bundle import imgui


class Fingers:
    """Dear ImGui, but that one field is set to a value.

    Attributes
    ----------
    label : str
        Which field to set.
    value : object
    formats : dict of str to str
        How the numbers of fields are shown, by label.
    """

    def __init__(self):
        self.label, self.value, self.formats = "", None, {}

    def __getattr__(self, name):
        return getattr(imgui, name)

    def _set(self, label, shown):
        if label != self.label:
            return shown
        self.label = ""
        return True, self.value

    def drag_float(self, label, value, speed, low, high, form):
        self.formats[label] = form
        return self._set(label, imgui.drag_float(label, value, speed, low, high, form))

    def checkbox(self, label, value):
        return self._set(label, imgui.checkbox(label, value))

    def color_edit3(self, label, values):
        return self._set(label, imgui.color_edit3(label, values))


@pytest.fixture
def fingers(monkeypatch):
    fingers = Fingers()
    monkeypatch.setattr(fields, "imgui", fingers)
    return fingers


@pytest.fixture
def pair(editor):
    """Two boxes that share a mesh, both selected."""
    editor.workspace.new()
    editor.workspace.panels.offers_start = False
    scene, mesh = editor.workspace.scene, e3d.box()
    nodes = [scene.add(mesh, name=f"box {k}", translation=(k, 0.5, 0.1 * k)) for k in range(2)]
    editor.workspace.document.selection.set(nodes)
    settle(editor)
    return nodes


def touch(editor, fingers, label, value):
    fingers.label, fingers.value = label, value
    settle(editor)
    assert fingers.label == "", f"{label} is not there"
    assert not editor._told


def test_a_number_of_all_is_set_and_the_others_stay(editor, fingers, pair):
    settle(editor)
    shown = [fingers.formats[f"##Position {place}"] for place in range(3)]
    assert shown == [DIFFERS, "0.5", DIFFERS]
    touch(editor, fingers, "##Position 1", 4.0)
    assert [node.translation.tolist() for node in pair] == [[0.0, 4.0, 0.0], [1.0, 4.0, 0.1]]
    touch(editor, fingers, "##Position 0", 7.0)
    assert [node.translation[0] for node in pair] == [7.0, 7.0]
    history = editor.workspace.document.history
    assert history.position == 2, "an edit of both is one step"
    editor.workspace.undo()
    assert [node.translation[0] for node in pair] == [0.0, 1.0]
    editor.workspace.undo()
    assert [node.translation.tolist() for node in pair] == [[0.0, 0.5, 0.0], [1.0, 0.5, 0.1]]


def test_a_switch_that_differs_is_set_for_all(editor, fingers, pair):
    pair[0].visible = False
    touch(editor, fingers, "Visible", True)
    assert [node.visible for node in pair] == [True, True]
    editor.workspace.undo()
    assert [node.visible for node in pair] == [False, True]


def test_the_size_of_primitives_is_changed_and_stays_shared(editor, fingers, pair):
    lone = editor.workspace.scene.add(pair[0].object, name="lone")
    touch(editor, fingers, "##Size 2", 3.0)
    assert pair[0].object is pair[1].object is not lone.object
    assert np.ptp(pair[0].object.positions, axis=0).tolist() == [1.0, 1.0, 3.0]
    assert pair[0].object.materials == lone.object.materials
    editor.workspace.undo()
    assert pair[0].object is lone.object


def test_a_shared_colour_is_set_once_and_copied_on_demand(editor, fingers, pair):
    lone = editor.workspace.scene.add(pair[0].object, name="lone")
    touch(editor, fingers, "##Colour", [1.0, 0.0, 0.0])
    assert lone.object.materials[0].color == (255, 0, 0)
    materials = editor._panels["Properties"]._materials
    materials._make_own(pair)
    assert pair[0].object.materials[0].name == "box 0", "so that lists tell it from the other"
    assert pair[0].object is pair[1].object is not lone.object
    touch(editor, fingers, "##Colour", [0.0, 0.0, 1.0])
    assert pair[1].object.materials[0].color == (0, 0, 255)
    assert lone.object.materials[0].color == (255, 0, 0)
    for _ in range(3):
        editor.workspace.undo()
    assert pair[0].object is lone.object and lone.object.materials[0].color == (1, 1, 1)


def test_lights_of_different_kinds_share_what_they_have(editor, fingers):
    editor.workspace.new()
    scene = editor.workspace.scene
    lamps = [scene.add(e3d.PointLight(intensity=2.0)), scene.add(e3d.SpotLight(intensity=5.0))]
    editor.workspace.document.selection.set(lamps)
    settle(editor)
    assert fingers.formats["##Intensity 0"] == DIFFERS
    assert not any("cone" in label for label in fingers.formats)
    touch(editor, fingers, "##Intensity 0", 3.0)
    assert [lamp.object.intensity for lamp in lamps] == [3.0, 3.0]


def test_cones_are_in_degrees(editor, fingers):
    editor.workspace.new()
    lamp = editor.workspace.scene.add(e3d.SpotLight())
    editor.workspace.document.selection.set([lamp])
    settle(editor)
    assert fingers.formats["##Outer cone, ° 0"] == "45"
    touch(editor, fingers, "##Outer cone, ° 0", 60.0)
    assert lamp.object.outer_cone_angle == pytest.approx(np.pi / 3)


def test_many_are_edited_without_being_compared(editor, fingers, monkeypatch):
    monkeypatch.setattr(fields, "MOST_COMPARED", 1)
    editor.workspace.new()
    scene = editor.workspace.scene
    nodes = [scene.add(e3d.box(), translation=(1, 2, 3)) for _ in range(3)]
    editor.workspace.document.selection.set(nodes)
    settle(editor)
    assert fingers.formats["##Position 0"] == DIFFERS
    touch(editor, fingers, "##Position 0", 9.0)
    assert [node.translation.tolist() for node in nodes] == [[9.0, 2.0, 3.0]] * 3


def test_a_new_selection_starts_at_its_top(editor):
    workspace = editor.workspace
    workspace.document.selection.set([workspace.scene.nodes[3]])
    top = settle(editor)[:, -200:].copy()
    panel = editor._panels["Properties"]
    panel._seen = None
    workspace.document.selection.set([workspace.scene.nodes[3]])
    assert (settle(editor)[:, -200:] == top).all()


class ListHand(Fingers):
    """Opens the list of a label, and chooses what it is told."""

    def begin_combo(self, label, now):
        self.formats[label] = now
        return label == self.label or imgui.begin_combo(label, now)

    def end_combo(self):
        if not self.label:
            imgui.end_combo()

    def selectable(self, label, chosen):
        is_it = bool(self.label) and label.partition("##")[0] == self.value
        return is_it, is_it


def test_simple_materials_become_physical_in_properties(editor, monkeypatch, pair):
    hand = ListHand()
    monkeypatch.setattr(fields, "imgui", hand)
    other = e3d.box()
    other.materials = [e3d.Material(metallic=1.0, roughness=0.2, name="steel")]
    scene = editor.workspace.scene
    pair[1].object = other
    editor.workspace.changes += 1
    settle(editor)
    assert hand.formats["##Kind"] == DIFFERS
    hand.label, hand.value = "##Kind", "physical"
    settle(editor)
    hand.label = ""
    settle(editor)
    plain = pair[0].object.materials[0]
    assert plain.is_physical and other.materials[0].roughness == 0.2 and not editor._told
    assert hand.formats["##Kind"] == "physical"
    editor.workspace.undo()
    assert not plain.is_physical and len(scene.nodes) == 4


def test_the_section_of_motion_says_whose_it_is(editor, monkeypatch, pair):
    titles = []

    class Reader(Fingers):
        def collapsing_header(self, title, *flags):
            titles.append(title.partition("###")[0])
            return imgui.collapsing_header(title, *flags)

    monkeypatch.setattr(motion_fields, "imgui", Reader())
    editor.workspace.document.selection.set(pair)
    settle(editor)
    assert titles[-1] == "Motion of box 1"
    editor.workspace.document.selection.set(pair[:1])
    settle(editor)
    assert titles[-1] == "Motion"
