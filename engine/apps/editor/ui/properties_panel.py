"""The panel of the selected nodes' editable properties, or the scene's if none is selected.

In: the selection. Out: commands. Several nodes are edited together as far as they hold things of
one kind.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....base.language import translated, translated_choice
from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material
from ....model.scene.cameras import Camera
from ....model.scene.instances import InstancedMesh
from ....model.scene.lights import LIGHTS
from ....model.scene.nodes import Node
from .files import Files
from .motion.motion_fields import MotionFields
from .panel_layout import begin_panel
from .properties.camera_fields import draw_cameras
from .properties.collider_fields import draw_colliders
from .properties.fields import Fields
from .properties.light_fields import draw_lights
from .properties.material_fields import MaterialFields
from .properties.scene_fields import draw_scene
from .properties.shape_fields import ShapeFields
from .properties.transform_fields import TransformFields
from .translated_imgui import imgui
from .workspace import Workspace

_KINDS = {Mesh: "mesh", InstancedMesh: "mesh", type(None): "empty"}


class PropertiesPanel:
    """Shows the selected nodes, or the scene if none is selected.

    Parameters
    ----------
    workspace : Workspace
    files : Files
        Asks for those that are to be loaded.
    """

    def __init__(self, workspace: Workspace, files: Files) -> None:
        self._workspace = workspace
        self._fields = Fields(workspace)
        self._shapes = ShapeFields(workspace, files, self._fields)
        self._materials = MaterialFields(workspace, files, self._fields)
        self._seen: Node | None = None
        self._kinds: tuple[tuple, set[str]] = ((), set())
        self._motion = MotionFields(workspace, self._fields)
        self._transform = TransformFields(workspace, self._fields)

    def draw(self) -> None:
        """Lay the panel out."""
        shown = begin_panel("Properties")
        if shown:
            nodes = self._workspace.document.selection.nodes
            active = nodes[-1] if nodes else None
            if active is not self._seen:
                imgui.set_scroll_y(0.0)
                self._seen = active
            if active is None:
                draw_scene(self._workspace, self._fields)
            else:
                imgui.push_id(active.id)
                self._draw_nodes(nodes)
                imgui.pop_id()
        imgui.end()

    def _draw_nodes(self, nodes: Sequence[Node]) -> None:
        self._draw_head(nodes)
        self._transform.draw(nodes)
        kinds = self._kinds_of(nodes)
        if kinds == {"light"}:
            draw_lights(self._workspace, self._fields, [node.object for node in nodes])
        elif kinds == {"camera"}:
            draw_cameras(self._workspace, self._fields, nodes)
        elif kinds <= {"mesh", "empty"}:
            self._shapes.draw(nodes)
        else:
            told = ", ".join(translated_choice("holds", kind) for kind in sorted(kinds))
            self._fields.note(
                translated("Selected: {kinds}. Select one kind to edit more.", kinds=told)
            )
        if self._kinds_of(nodes) == {"mesh"}:  # it may have gone meanwhile
            self._materials.draw(nodes)
            draw_colliders(self._fields, nodes)
        self._motion.draw(nodes[-1], is_one_of_several=len(nodes) > 1)
        self._draw_switches(nodes)

    def _draw_head(self, nodes: Sequence[Node]) -> None:
        """Lay out what the nodes are called, and whether they show."""
        fields = self._fields
        if len(nodes) > 1:
            fields.note(
                translated("{count:,} selected nodes; — where they differ", count=len(nodes))
            )
        else:
            fields.label("Name")
            name = fields.text(nodes[0].name)
            if name is not None and name != nodes[0].name:
                fields.set(nodes, {"name": name}, "Rename")
        fields.flag(nodes, "visible", "Visible")

    def draw_material_values(self, material: Material) -> None:
        """Lay out what a material is made of, also for other panels."""
        self._materials.draw_values([material])

    def _draw_switches(self, nodes: Sequence[Node]) -> None:
        """Lay out how nodes take part in shadows, and whether they rest."""
        if self._fields.folder("Drawing", is_open=False):
            self._fields.flag(nodes, "cast_shadows", "Cast shadows")
            self._fields.flag(nodes, "receive_shadows", "Receive shadows")
            self._fields.flag(nodes, "static", "Static")

    def _kinds_of(self, nodes: Sequence[Node]) -> set[str]:
        """Return what nodes hold, by a name each; found anew only after a change."""
        workspace = self._workspace
        key = workspace.document, workspace.document.selection.version, workspace.changes
        if self._kinds[0] != key:
            self._kinds = key, {_kind(node) for node in nodes}
        return self._kinds[1]


def _kind(node: Node) -> str:
    held = node.object
    if isinstance(held, LIGHTS):
        return "light"
    return "camera" if isinstance(held, Camera) else _KINDS.get(type(held), type(held).__name__)
