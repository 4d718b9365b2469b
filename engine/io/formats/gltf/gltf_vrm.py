"""VRM 0 avatars, which face backwards.

In: a tree whose file has the extension VRM. Out: the same below a node that rotates it by half a
turn, so that it faces +Z as glTF models do. VRM 1 avatars (VRMC_vrm) already face +Z. Source: VRM
Consortium, "VRM 0.0 Specification".
"""

from __future__ import annotations

from dataclasses import replace

from ...scenes.document_trees import NodeRecord, TreeRecord
from .gltf_file import GltfFile

_OLD, _NEW = "VRM", "VRMC_vrm"
#: The extension handled here.
READ = (_OLD,)
_HALF_TURN = (0.0, 1.0, 0.0, 0.0)


def facing_forward(file: GltfFile, tree: TreeRecord) -> TreeRecord:
    """Return a tree that faces +Z, rotated if its file is VRM 0."""
    extensions = file.spare_part(file.tree, "extensions", "the file")
    if _OLD not in extensions or _NEW in extensions or not tree.roots:
        return tree
    file.warnings.add("of the extension 'VRM' nothing is read but that it faces the other way")
    turned = NodeRecord(_OLD, tree.roots, rotation=_HALF_TURN)
    return replace(tree, nodes=(*tree.nodes, turned), roots=(len(tree.nodes),))
