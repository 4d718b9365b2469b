"""The clipboard of nodes: text that any editor's window can paste, a scene file in itself.

In: nodes. Out: text; from it, the command that adds the nodes to a scene. Files are named by their
full paths, all else is in the text. What was copied here is pasted without reading the text, so
that pasted nodes share the meshes and materials of the copied ones.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...base.language import translated
from ...errors import FileFormatError
from ...io.reading.loading import document_of
from ...io.reading.sources import Source
from ...io.scenes.scene_loading import scene_from_document
from ...io.writing.scene_saving import scene_text
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from .new_things.free_names import FreeNames
from .node_commands import AddNodes, copy_nodes, counted
from .recovery import ROOT
from .selection import topmost


class Clipboard:
    """Turns nodes into text and back."""

    def __init__(self) -> None:
        self._text = ""
        self._copied: Scene | None = None

    def copy(self, nodes: Sequence[Node]) -> tuple[str, list[str]]:
        """Return the text of nodes with all below them, and a line for each loss.

        Nodes keep their places in the world; those above them are not copied.
        """
        scene, originals = Scene(), topmost(nodes)
        copies = copy_nodes(scene, dict.fromkeys(originals))
        for original, copied in zip(originals, copies, strict=True):
            if original.parent is not None:
                copied.pose = original.world_pose
        content, told = scene_text(scene, ROOT)
        self._text, self._copied = content.decode("ascii"), scene
        return self._text, told

    def paste(self, scene: Scene, text: str, parent: Node | None = None) -> AddNodes:
        """Return the command that adds the nodes of a text to a scene, at the top or below a node.

        Raises
        ------
        FileFormatError
            The text holds no nodes.
        """
        copied = self._copied
        if copied is None or text != self._text:
            copied = _scene_of(text)
        roots = [node for node in copied.nodes if node.parent is None]
        if not roots:
            raise FileFormatError("the clipboard holds no nodes")

        def add(scene: Scene) -> None:
            names = FreeNames(scene.data.names())
            for node in copy_nodes(scene, dict.fromkeys(roots), names):
                if parent is not None:
                    node.reparent(parent, keep_world_pose=True)

        return AddNodes(scene, add, counted(translated("Paste"), roots))


def _scene_of(text: str) -> Scene:
    if not text.lstrip().startswith("{"):
        raise FileFormatError("the clipboard holds no nodes")
    data = text.encode("utf-8", "replace")
    with Source(os.path.join(ROOT, "clipboard"), data) as source:
        return scene_from_document(document_of(source, "e3d", split=True))
