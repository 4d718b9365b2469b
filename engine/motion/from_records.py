"""Skins, morph targets and clips of a file's tree, put into the scene that was made of it.

In: a `TreeRecord`, and the nodes that its records became. Out: meshes that know what moves them,
nodes with skins and weights, and the clips of the scene. What does not fit is a warning.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..geometry.morph_targets import MorphTarget
from ..loaders.documents import ChannelRecord, ClipRecord, MeshRecord, SkinRecord, TreeRecord
from ..scene.nodes import Node
from ..scene.scene import Scene
from .clips import AnimationClip, Channel
from .skins import Skin


def add_motion(scene: Scene, tree: TreeRecord, nodes: Mapping[int, Node]) -> None:
    """Give a scene's nodes what bends their meshes, and the scene its clips.

    Parameters
    ----------
    scene : Scene
        Its ``warnings`` tell what was left out.
    tree : TreeRecord
    nodes : mapping of int to Node
        By the number of the record; those that the scene does not show are missing.
    """
    for record in tree.meshes:
        _try(scene, f"mesh {record.name!r} stays as it is", lambda r=record: _move_mesh(r))
    skins: dict[int, Skin | None] = {}
    for number, node in nodes.items():
        record = tree.nodes[number]
        if record.mesh is None or not isinstance(node.object, Mesh):
            if record.skin is not None:
                scene.warnings.append(f"node {node.name!r} is not bent: it draws no single mesh")
            continue
        if record.skin is not None:
            if record.skin not in skins:
                skins[record.skin] = _skin(scene, tree.skins[record.skin], nodes)
            _try(scene, f"node {node.name!r} is not bent", lambda n=node, s=skins[record.skin]: _put(n, s))
        weights = record.weights or tree.meshes[record.mesh].morph_weights
        if node.object.morph_targets and any(weights):
            text = f"morph weights of node {node.name!r} are left out"
            _try(scene, text, lambda n=node, w=weights: setattr(n, "morph_weights", w))
    for number, clip in enumerate(tree.clips):
        _add_clip(scene, clip, number, nodes)


def _try(scene: Scene, what: str, do):
    try:
        return do()
    except InvalidArgumentError as error:
        scene.warnings.append(f"{what}: {error}")
        return None


def _put(node: Node, skin: Skin | None) -> None:
    node.skin = skin


def _move_mesh(record: MeshRecord) -> None:
    """Let a mesh know its joints and targets; vertices without weights follow their first joint."""
    mesh = record.mesh
    if record.joints is not None and record.weights is not None and mesh.joints is None:
        weights = np.array(record.weights, np.float32)
        weights[~weights.any(axis=1), 0] = 1.0
        mesh.set_influences(record.joints, weights)
    if record.morphs and not mesh.morph_targets:
        count = len(mesh.positions)
        mesh.morph_targets = [
            MorphTarget(
                np.zeros((count, 3), np.float32) if _is_bare(m) else m.positions,
                m.normals,
                m.tangents,
                m.name,
            )
            for m in record.morphs
        ]


def _is_bare(morph) -> bool:
    return all(part is None for part in (morph.positions, morph.normals, morph.tangents))


def _skin(scene: Scene, record: SkinRecord, nodes: Mapping[int, Node]) -> Skin | None:
    missing = [joint for joint in record.joints if joint not in nodes]
    if missing:
        scene.warnings.append(
            f"skin {record.name!r} is left out: its joint {missing[0]} is not in the shown scene"
        )
        return None
    joints = [nodes[joint] for joint in record.joints]
    binds = np.array(record.inverse_binds, np.float64)
    binds[:, 3] = (0.0, 0.0, 0.0, 1.0)
    what = f"skin {record.name!r} is left out"
    return _try(scene, what, lambda: Skin(joints, binds, record.name))


def _add_clip(scene: Scene, record: ClipRecord, number: int, nodes: Mapping[int, Node]) -> None:
    name = record.name or f"animation {number}"
    channels = []
    for channel in record.channels:
        if channel.node in nodes:
            node = nodes[channel.node]
            what = f"animation {name!r} leaves {channel.path} of node {node.name!r} as it is"
            made = _try(scene, what, lambda c=channel, n=node: _channel(c, n))
            channels += [] if made is None else [made]
    unique, repeat = name, 2
    while unique in scene.animations:
        unique, repeat = f"{name} ({repeat})", repeat + 1
    scene.animations[unique] = AnimationClip(channels, unique)


def _channel(record: ChannelRecord, node: Node) -> Channel:
    values = np.asarray(record.values)
    if record.path == "weights":
        count = len(getattr(node.object, "morph_targets", ()))
        if values.shape[-1] != count:
            raise InvalidArgumentError(f"{values.shape[-1]} weights for {count} morph targets")
    return Channel(node, record.path, record.times, values, record.interpolation)
