"""Whatever a node holds, Properties shows it, and each of its fields can be changed and undone.

A hand takes the place of the mouse: it touches one field after the other, whichever there are.
"""

import re

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.scene_state import SceneState
from engine3d.io.scenes.object_kinds import KINDS
from engine3d.model.materials.material import PARAMETERS
from engine3d.model.scene import lights

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from imgui_bundle import imgui

from engine3d.apps.editor.ui import properties_panel
from engine3d.apps.editor.ui.editor_window import EditorWindow
from engine3d.apps.editor.ui.properties import fields
from engine3d.apps.editor.ui.properties.collider_fields import COLLIDERS

HELD = {
    "light probe": lambda: e3d.LightProbe(np.ones((9, 3))),
    "intrinsics camera": lambda: e3d.IntrinsicsCamera(300, 300, 100, 80),
    "camera": lambda: e3d.Camera(np.eye(4)),
    "fisheye camera": lambda: e3d.FisheyeCamera(100, 100, 80, 60),
    "brown-conrady camera": lambda: e3d.BrownConradyCamera(100, 100, 80, 60),
    "double-sphere camera": lambda: e3d.DoubleSphereCamera(100, 100, 80, 60),
    "orthographic camera": lambda: e3d.OrthographicCamera(1.0),
}
OTHERS = {
    "nothing": lambda: None,
    "mesh": e3d.box,
    "physical mesh": lambda: _painted(metallic=0.5, roughness=0.5, clearcoat=0.1, transmission=0.5),
    "transparent mesh": lambda: _painted(color=(10, 20, 30, 40), texture=_image()),
    "points": lambda: e3d.Mesh([[0, 0, 0]], [], points=[0]),
    "instances": lambda: e3d.InstancedMesh(e3d.box(), np.eye(4)[None]),
    "window light": lambda: e3d.PointLight(range=3.0, falloff="window"),
    "gltf light": lambda: e3d.PointLight(range=3.0, falloff="gltf"),
    "near spot light": lambda: e3d.SpotLight(range=3.0),
    "shadow light": lambda: e3d.DirectionalLight(shadow="exact"),
    "near camera": lambda: e3d.PerspectiveCamera(0.7, znear=0.1, zfar=5.0),
}
EVERYTHING = {
    **{kind: HELD.get(kind, cls) for kind, cls in KINDS.items()},
    **OTHERS,
    **{f"{kind} collider": e3d.box for kind in COLLIDERS},
}
ENVIRONMENTS = {"plain": {}, "foggy": {"fog": e3d.Fog((9, 8, 7), 1.0, 2.0)}}


def _image():
    return e3d.Texture(np.zeros((4, 4, 4), np.uint8))


def _painted(**values):
    mesh = e3d.box()
    mesh.materials = [e3d.Material(**values)]
    return mesh


class Hand:
    """Dear ImGui, but that one field is changed, and everything is unfolded.

    Attributes
    ----------
    at : int
        Which field to touch; none if negative.
    far : float, optional
        Drag as far as the field lets: to -1 or 1 times a large number.
    fields : list of str
        Those that were laid out.
    """

    def __init__(self):
        self.at, self.far, self.fields = -1, 0.0, []

    def __getattr__(self, name):
        return getattr(imgui, name)

    def _touches(self, label):
        self.fields.append(re.sub(r"^##|( \d+)?(##.*)?$", "", label))
        return len(self.fields) - 1 == self.at

    def _moved(self, value, low=-1e9, high=1e9):
        return min(max(value + (self.far * 1e6 or 0.01), low), high)

    def drag_float(self, label, value, speed, low, high, form):
        shown = imgui.drag_float(label, value, speed, low, high, form)
        whole = form == "%.0f"
        moved = self._moved(value + 0.99 * whole, low, high)
        return (True, moved) if self._touches(label) else shown

    def slider_float(self, label, value, low, high, form):
        shown = imgui.slider_float(label, value, low, high, form)
        return (True, self._moved(value - 0.02, low, high)) if self._touches(label) else shown

    def color_edit3(self, label, values):
        shown = imgui.color_edit3(label, values)
        return (True, [abs(value - 0.5) for value in values]) if self._touches(label) else shown

    def checkbox(self, label, value):
        shown = imgui.checkbox(label, value)
        return (True, not value) if self._touches(label) else shown

    def input_text(self, label, value, *flags):
        shown = imgui.input_text(label, value, *flags)
        return (True, value + "x") if self._touches(label) else shown

    def button(self, label):
        return imgui.button(label) | self._touches(label)

    def collapsing_header(self, label, *flags):
        imgui.collapsing_header(label, *flags)
        return True

    def tree_node(self, label):
        imgui.set_next_item_open(True)
        return imgui.tree_node(label)

    def begin_combo(self, label, value):
        imgui.label_text(label, value)
        return True

    def end_combo(self):
        pass

    def selectable(self, label, selected, *how):
        return (self._touches(label), selected)


@pytest.fixture(scope="module")
def editor(tmp_path_factory):
    folder = str(tmp_path_factory.mktemp("homes"))
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("SDL_VIDEODRIVER", "dummy")
        for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
            patched.setenv(variable, folder)
        with EditorWindow(size=(900, 600)) as editor:
            editor.window.present = lambda pixels: None
            editor._painter.draw = lambda *what: None  # what is laid out counts here
            editor._scene.draw = lambda: None
            yield editor


@pytest.fixture
def hand(editor, monkeypatch):
    editor._told.clear()  # of other tests
    hand = Hand()
    for module in (properties_panel, fields):
        monkeypatch.setattr(module, "imgui", hand)
    return hand


def lay_out(editor, hand, at=-1, far=0.0):
    """Draw once; return the labels of what can be changed."""
    hand.at, hand.far, hand.fields = at, far, []
    editor._pictures_due = 1
    editor.turn(0.0)
    assert not editor._told, editor._told
    return hand.fields


def edit_all(editor, hand):
    """Change each field, a little and as far as it goes, and undo it."""
    workspace = editor.workspace
    fields = list(lay_out(editor, hand))
    before = SceneState(workspace.scene)
    assert fields
    for number, label in enumerate(fields):
        for far in (0.0, -1.0, 1.0):
            told = len(workspace.console.entries)
            lay_out(editor, hand, number, far)
            said = [entry for entry in workspace.console.entries[told:] if entry.level == "error"]
            assert not (said and far == 0.0), (label, said)
            if editor._files._dialog._title:
                editor._files._dialog._title = ""
            elif workspace.document.is_modified:
                assert SceneState(workspace.scene) != before, label
                workspace.undo()
            workspace.document.selection.set(workspace.document.selection.nodes)
            assert SceneState(workspace.scene) == before, label
            assert not workspace.document.is_modified, label
    return fields


@pytest.mark.parametrize("kind", EVERYTHING)
def test_all_that_a_node_holds_is_shown_and_changed(editor, hand, kind):
    editor.workspace.new()
    scene = editor.workspace.scene
    node = scene.add(EVERYTHING[kind](), name=kind, translation=(1, 2, 3), scale=2.0)
    scene.add(e3d.icosphere(), name="other")
    if kind.endswith("collider"):
        node.collider = COLLIDERS[kind.partition(" ")[0]](node.object)
    editor.workspace.document.selection.set([node])
    fields = edit_all(editor, hand)
    assert {"Position", "Rotation", "Scale", "Visible"} <= set(fields)
    if isinstance(node.object, lights.LIGHTS):
        assert "Intensity" in fields


@pytest.mark.parametrize("kind", ENVIRONMENTS)
def test_all_of_a_scene_is_shown_and_changed(editor, hand, kind):
    editor.workspace.new()
    for name, value in ENVIRONMENTS[kind].items():
        setattr(editor.workspace.scene, name, value)
    assert "Exposure" in edit_all(editor, hand)


def test_what_all_kinds_of_lights_have_in_common_is_shown(editor, hand):
    """Each attribute of a light that is a colour, a number or a choice has a field."""
    editor.workspace.new()
    scene = editor.workspace.scene
    light = scene.add(e3d.SpotLight(range=2.0))
    editor.workspace.document.selection.set([light])
    assert {"Colour", "Intensity", "Inner cone, °", "Outer cone, °", "Range"} <= set(
        lay_out(editor, hand)
    )


def test_all_that_lights_a_physical_material_has_a_field(editor, hand):
    editor.workspace.new()
    node = editor.workspace.scene.add(_painted(metallic=0.5, roughness=0.5))
    editor.workspace.document.selection.set([node])
    numbers = {row.title for row in PARAMETERS.values() if row.gltf and row.kind.width}
    infinite = {PARAMETERS["attenuation_distance"].title}  # until it is given
    assert numbers - infinite <= set(lay_out(editor, hand))
