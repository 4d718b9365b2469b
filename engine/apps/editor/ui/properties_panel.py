"""The panel of the active node's editable properties: name, pose, object and materials.

In: the selection. Out: commands; a mouse drag is one step from press to release.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from typing import Any, get_args

import numpy as np

from ....base.language import (
    translated,
    translated_choice,
    translated_count,
    translated_number,
)
from ....choices import LightShadow
from ....model.environments.environment import BUILT_IN, Environment, named_environment
from ....model.geometry.mesh import Mesh
from ....model.materials.colors import split_alpha
from ....model.materials.display_colors import display_color
from ....model.materials.material import PARAMETERS, Material, textures_of
from ....model.materials.parameters import FLAG, Parameter, TextureSlot
from ....model.scene.cameras import Camera, OrthographicCamera, PerspectiveCamera
from ....model.scene.instances import InstancedMesh
from ....model.scene.lights import LIGHTS, Light
from ....model.scene.nodes import Node
from ....model.scene.scene import Scene
from ....model.scene.surroundings import MAX_EXPOSURE
from ....model.spatial.colliders import BoxCollider, MeshCollider, SphereCollider
from ..value_commands import SetValues
from .files import Files
from .fog_fields import draw_fog
from .panel_layout import begin_panel
from .translated_imgui import imgui
from .workspace import Workspace

_COLLIDERS = {
    "none": lambda mesh: None,
    "box": lambda mesh: BoxCollider(),
    "sphere": lambda mesh: SphereCollider(*_ball(mesh)),
    "mesh": lambda mesh: MeshCollider(),
}
_KINDS = {BoxCollider: "box", SphereCollider: "sphere", MeshCollider: "mesh"}
_LIGHT_COLORS = {"sky_color": "Sky", "ground_color": "Ground", "color": "Colour"}
_LIGHT_ANGLES = {"inner_cone_angle": "Inner cone", "outer_cone_angle": "Outer cone"}


class PropertiesPanel:
    """Shows the active node, or the scene if none is selected.

    Parameters
    ----------
    workspace : Workspace
    files : Files
        Asks for those that are to be loaded.
    """

    def __init__(self, workspace: Workspace, files: Files) -> None:
        self._workspace, self._files = workspace, files
        self._drag: Hashable = None

    def draw(self) -> None:
        """Lay the panel out."""
        shown = begin_panel(self._workspace, "Properties")
        if shown:
            imgui.push_item_width(-imgui.get_font_size() * 7)
            node = self._workspace.document.selection.active
            if node is None:
                self._draw_scene()
            else:
                imgui.push_id(node.id)
                self._draw_node(node)
                imgui.pop_id()
            imgui.pop_item_width()
        imgui.end()

    def _set(self, things, values: dict[str, Any]) -> None:
        self._workspace.do(SetValues(things, values), drag=self._drag)

    def _follow_drag(self) -> None:
        """Note that the mouse grabbed the last item."""
        if imgui.is_item_activated():
            self._drag = self._workspace.next_drag()

    # Kinds of values

    def _numbers(self, label: str, values, speed: float, factor: float = 1.0) -> list | None:
        """Lay out three numbers; return them if one changed, the others to the bit."""
        shown = [float(value) * factor for value in values]
        changed, new = imgui.drag_float3(label, shown, speed)
        self._follow_drag()
        if not changed:
            return None
        kept = [float(np.float32(old)) == now for old, now in zip(shown, new, strict=True)]
        pairs = zip(values, new, kept, strict=True)
        return [float(old) if same else now / factor for old, now, same in pairs]

    def _number(
        self, thing, name: str, label: str, speed: float, low: float, factor=1.0, high=1e9
    ) -> None:
        value = getattr(thing, name)
        if value is None or not math.isfinite(value):
            imgui.label_text(label, translated("none") if value is None else f"{value:g}")
            return
        changed, new = imgui.drag_float(label, value * factor, speed, low, high, "%.4g")
        self._follow_drag()
        if changed:
            self._set([thing], {name: new / factor})

    def _color(self, thing, name: str, label: str) -> None:
        color, alpha = split_alpha(getattr(thing, name))
        changed, new = imgui.color_edit3(label, list(display_color(color, "srgb")))
        self._follow_drag()
        if changed:
            rest = () if alpha == 1.0 else (round(255 * alpha),)
            self._set([thing], {name: (*(round(255 * part) for part in new), *rest)})

    def _share(self, thing, name: str, label: str) -> None:
        """Lay out a number from 0 to 1."""
        changed, new = imgui.slider_float(label, getattr(thing, name), 0.0, 1.0)
        self._follow_drag()
        if changed:
            self._set([thing], {name: min(max(new, 0.0), 1.0)})

    def _flag(self, things, name: str, label: str) -> None:
        changed, new = imgui.checkbox(label, bool(getattr(things[-1], name)))
        if changed:
            self._workspace.do(SetValues(things, {name: new}))

    # What there is

    def _draw_scene(self) -> None:
        scene = self._workspace.scene
        imgui.text_disabled(translated_count("{count:,} node", "{count:,} nodes", len(scene.nodes)))
        if imgui.collapsing_header("Scene", imgui.TreeNodeFlags_.default_open):
            if isinstance(scene.background, tuple):
                self._color(scene, "background", "Background")
            self._color(scene, "ambient", "Ambient")
            self._number(scene, "exposure", "Exposure", 0.02, -MAX_EXPOSURE, high=MAX_EXPOSURE)
            self._draw_environment(scene)
            radius = self._workspace.bounds.radius
            draw_fog(scene, radius, lambda fog: self._set([scene], {"fog": fog}), self._follow_drag)

    def _draw_environment(self, scene: Scene) -> None:
        """Lay out the environment: a built-in one, or from a file."""
        now = scene.environment
        name = _told(now)
        if imgui.begin_combo("Environment", name):
            for built_in in (None, *BUILT_IN):
                is_now = (
                    now is None
                    if built_in is None
                    else now is not None and now.built_in == built_in
                )
                if (
                    imgui.selectable(translated_choice("environment", built_in or "none"), is_now)[
                        0
                    ]
                    and not is_now
                ):
                    chosen = None if built_in is None else named_environment(built_in)
                    self._workspace.do(SetValues([scene], {"environment": chosen}))
            imgui.end_combo()
        if now is not None:
            self._number(scene, "environment_intensity", "Intensity", 0.01, 0.0)
            self._number(scene, "environment_rotation", "Turn", 0.5, -1e9, math.degrees(1.0))

    def _draw_node(self, node: Node) -> None:
        nodes = self._workspace.document.selection.nodes
        flags = imgui.InputTextFlags_.enter_returns_true
        entered, name = imgui.input_text("Name", node.name, flags)
        if entered and name != node.name:
            self._workspace.do(SetValues([node], {"name": name}, translated("Rename")))
        if len(nodes) > 1:
            imgui.text_disabled(
                translated("the last of {count:,} selected nodes", count=len(nodes))
            )
        self._flag(nodes, "visible", "Visible")
        imgui.same_line()
        self._flag(nodes, "static", "Static")
        self._flag(nodes, "cast_shadows", "Cast shadows")
        imgui.same_line()
        self._flag(nodes, "receive_shadows", "Receive shadows")
        if imgui.collapsing_header("Transform", imgui.TreeNodeFlags_.default_open):
            self._draw_transform(node)
        held = node.object
        if isinstance(held, Mesh | InstancedMesh):
            self._draw_mesh(node, held)
        elif isinstance(held, LIGHTS):
            self._draw_light(held)
        elif isinstance(held, Camera):
            self._draw_camera(node, held)
        elif imgui.collapsing_header("Mesh", imgui.TreeNodeFlags_.default_open):
            self._draw_shape(node, None)

    def _draw_transform(self, node: Node) -> None:
        step = max(self._workspace.bounds.radius / 200.0, 1e-4)
        moved = self._numbers("Position", node.translation, step)
        if moved is not None:
            self._set([node], {"translation": moved})
        turned = self._numbers("Rotation", node.euler, 0.5, math.degrees(1.0))
        if turned is not None:
            self._set([node], {"euler": turned})
        scaled = self._numbers("Scale", node.scale, 0.01)
        if scaled is not None:
            self._set([node], {"scale": scaled})
        if imgui.button("Reset"):
            identity = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": 1.0}
            self._workspace.do(SetValues([node], identity, translated("Reset the transform")))

    def _draw_mesh(self, node: Node, held: Mesh | InstancedMesh) -> None:
        mesh = held.mesh if isinstance(held, InstancedMesh) else held
        if imgui.collapsing_header("Mesh", imgui.TreeNodeFlags_.default_open):
            if isinstance(held, InstancedMesh):
                imgui.label_text("Instances", translated_number(len(held.poses), ","))
            else:
                self._draw_shape(node, mesh)
            imgui.label_text("Vertices", translated_number(len(mesh.positions), ","))
            imgui.label_text("Triangles", translated_number(len(mesh.faces), ","))
        for number, material in enumerate(mesh.materials):
            name = material.name or number
            title = f"{translated('Material {name}', name=name)}###material {number}"
            if imgui.collapsing_header(title, imgui.TreeNodeFlags_.default_open):
                imgui.push_id(number)
                self._choose("Use", "material", material, _in_place(mesh, number), [mesh])
                self._draw_material(material)
                imgui.pop_id()
        self._draw_collider(node, mesh)

    def _draw_shape(self, node: Node, mesh: Mesh | None) -> None:
        """Lay out the mesh of a node, and the file to replace it from."""
        self._choose("Shape", "mesh", mesh, lambda chosen: {"object": chosen}, [node])
        if imgui.button("Load new ..."):
            self._files.load_mesh(node)
        if mesh is not None:
            imgui.same_line()
            if imgui.button("Remove"):
                values = {"collider": None, "object": None}
                self._workspace.do(SetValues([node], values, translated("Remove the mesh")))

    def _choose(self, label: str, kind: str, now, values, things) -> None:
        """Lay out a choice of resources of a kind; then assign ``values(chosen)``."""
        name = translated("none") if now is None else now.name or translated("unnamed")
        if not imgui.begin_combo(label, name):
            return
        for number, entry in enumerate(self._workspace.resources.entries()):
            if entry.kind == kind:
                chosen = imgui.selectable(f"{entry.name}##{number}", entry.thing is now)[0]
                if chosen and entry.thing is not now:
                    self._workspace.do(SetValues(things, values(entry.thing)))
        imgui.end_combo()

    def _draw_material(self, material: Material) -> None:
        for name, row in PARAMETERS.items():
            if _counts(row, material):
                self._draw_parameter(material, name, row)

    def _draw_parameter(self, material: Material, name: str, row: Parameter) -> None:
        kind = row.kind
        if isinstance(row, TextureSlot):
            self._draw_slot(material, name, row.title)
        elif kind is FLAG:
            self._flag([material], name, row.title)
        elif kind.width > 1:
            self._color(material, name, row.title)
        elif kind.high == 1.0 and getattr(material, name) is not None:
            self._share(material, name, row.title)
        elif kind.width == 1 and kind.high > 1.0:
            speed = 0.01 * max(getattr(material, name), 1.0)
            self._number(material, name, row.title, speed, max(kind.low, -1e9))

    def _draw_slot(self, material: Material, slot: str, label: str) -> None:
        texture = textures_of(material).get(slot)
        imgui.push_id(slot)
        self._choose(label, "texture", texture, lambda chosen: {slot: chosen}, [material])
        if imgui.button("Load ..."):
            self._files.load_texture(material, slot)
        if texture is not None:
            imgui.same_line()
            if imgui.button("Remove"):
                self._workspace.do(SetValues([material], {slot: None}))
            height, width = texture.pixels.shape[:2]
            imgui.same_line()
            imgui.text_disabled(f"{width} x {height}")
        imgui.pop_id()

    def _draw_collider(self, node: Node, mesh: Mesh) -> None:
        if not imgui.collapsing_header("Collider"):
            return
        now = _KINDS.get(type(node.collider), "none")
        if imgui.begin_combo("Kind", translated_choice("collider", now)):
            for name, make in _COLLIDERS.items():
                if (
                    imgui.selectable(translated_choice("collider", name), name == now)[0]
                    and name != now
                ):
                    self._workspace.do(SetValues([node], {"collider": make(mesh)}))
            imgui.end_combo()
        if isinstance(node.collider, SphereCollider):
            self._draw_radius(node, node.collider)

    def _draw_radius(self, node: Node, ball: SphereCollider) -> None:
        speed = max(0.01 * ball.radius, 1e-6)
        changed, radius = imgui.drag_float("Radius", ball.radius, speed, 1e-6, 1e9, "%.4g")
        self._follow_drag()
        if changed and radius > 0.0:
            self._set([node], {"collider": SphereCollider(radius, ball.center)})

    def _draw_light(self, light: Light) -> None:
        if not imgui.collapsing_header("Light", imgui.TreeNodeFlags_.default_open):
            return
        for name, label in _LIGHT_COLORS.items():
            if hasattr(light, name):
                self._color(light, name, label)
        if hasattr(light, "intensity"):  # by a hundredth of it
            self._number(light, "intensity", "Intensity", 0.01 * max(light.intensity, 1.0), 0.0)
        for name, label in _LIGHT_ANGLES.items():
            if hasattr(light, name):
                self._number(light, name, label, 0.01, 0.0)
        if hasattr(light, "shadow"):
            self._draw_shadow(light)
        if hasattr(light, "range"):
            self._draw_range(light)
        if hasattr(light, "direction"):
            direction = self._numbers("Direction", light.direction, 0.01)
            if direction is not None:
                self._set([light], {"direction": direction})

    def _draw_shadow(self, light: Light) -> None:
        if not imgui.begin_combo("Shadow", translated_choice("shadow", light.shadow)):
            return
        for shadow in get_args(LightShadow):
            chosen = imgui.selectable(translated_choice("shadow", shadow), shadow == light.shadow)[
                0
            ]
            if chosen and shadow != light.shadow:
                self._workspace.do(SetValues([light], {"shadow": shadow}))
        imgui.end_combo()

    def _draw_range(self, light: Light) -> None:
        """Lay out the range of a light; an infinite one gets the scene's size."""
        if math.isfinite(light.range):
            self._number(light, "range", "Range", 0.1, 0.001)
        # A window falloff ends at the range, so it needs one.
        imgui.begin_disabled(getattr(light, "falloff", None) == "window")
        changed, endless = imgui.checkbox("Infinite range", not math.isfinite(light.range))
        imgui.end_disabled()
        if changed:
            reach = math.inf if endless else max(2.0 * self._workspace.bounds.radius, 0.001)
            self._workspace.do(SetValues([light], {"range": reach}))

    def _draw_camera(self, node: Node, camera: Camera) -> None:
        if not imgui.collapsing_header("Camera", imgui.TreeNodeFlags_.default_open):
            return
        if isinstance(camera, PerspectiveCamera):
            self._number(camera, "yfov", "Field of view", 0.5, 1.0, math.degrees(1.0))
        elif isinstance(camera, OrthographicCamera):
            self._number(camera, "ymag", "Half height", 0.05, 1e-3)
        if camera.znear is not None:
            self._number(camera, "znear", "Near", 0.01, 1e-4)
            self._number(camera, "zfar", "Far", 1.0, 1e-3)
        if imgui.button("Place it where the view is"):
            pose = self._workspace.view.pose()
            self._workspace.do(SetValues([node], {"pose": pose}, translated("Place the camera")))


def _told(environment: Environment | None) -> str:
    """Return the name of an environment, as it is shown."""
    if environment is None or environment.built_in:
        built_in = "none" if environment is None else environment.built_in
        return translated_choice("environment", built_in)
    return environment.name or translated("from a file")


def _ball(mesh: Mesh) -> tuple[float, np.ndarray]:
    """Return radius and centre of a sphere as wide as a mesh."""
    low, high = mesh.bounds
    return max(float(np.max(high - low)) / 2, 1e-6), (low + high) / 2


def _counts(row: Parameter, material: Material) -> bool:
    """Return whether a parameter affects a material: most of glTF's need a physical one."""
    if material.is_physical:
        return bool(row.gltf) or not row.kind.width
    return not row.part.startswith("KHR")


def _in_place(mesh: Mesh, number: int):
    """Return a command that replaces one of a mesh's materials."""

    def values(chosen: Material) -> dict[str, Any]:
        materials = list(mesh.materials)
        materials[number] = chosen
        return {"materials": materials}

    return values
