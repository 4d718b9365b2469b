"""Copies of scenes: a tree of their own over the same meshes.

In: a scene. Out: another one that shows the same. Cameras and lights are copied, as programs change
them from picture to picture; meshes, materials, textures and environments are shared.
"""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, TypeVar

from ..motion.clips import AnimationClip, Channel
from ..motion.properties import PropertyChannel
from ..motion.skins import Skin
from .cameras import Camera
from .lights import LIGHTS
from .nodes import Node
from .surroundings import SCENE_VALUES

if TYPE_CHECKING:
    from .scene import Scene

Thing = TypeVar("Thing")


class _Copies:
    """What stands in a copy for the nodes, cameras, lights and skins of the original."""

    def __init__(self) -> None:
        self._made: dict[int, Any] = {}

    def put(self, thing: Thing, made: Thing) -> None:
        """Note the copy of a thing."""
        self._made[id(thing)] = made

    def of(self, thing: Thing) -> Thing:
        """Return the copy of a thing: itself, if it is shared."""
        if isinstance(thing, (Camera, *LIGHTS)) and id(thing) not in self._made:
            self.put(thing, copy.copy(thing))
        if isinstance(thing, Skin) and id(thing) not in self._made:
            joints = [self.of(joint) for joint in thing.joints]
            self.put(thing, Skin(joints, thing.inverse_binds, thing.name))
        return self._made.get(id(thing), thing)


def copied_scene(scene: Scene) -> Scene:
    """Return a copy of a scene; see `Scene.copy`."""
    made, copies = type(scene)(), _Copies()
    for name in SCENE_VALUES:
        setattr(made, name, getattr(scene, name))
    for node in scene.nodes:
        copies.put(node, _copied_node(made, node, copies))
    for node in scene.nodes:
        _complete(copies.of(node), node, copies)
    made.animations = {name: _copied_clip(c, copies) for name, c in scene.animations.items()}
    for name, robot in scene.robots.items():
        made.data.robots[name] = robot._copied_to(copies.of)
    if scene.animator is not None:
        made.animator = scene.animator._copied_to(made, copies.of)
    made.warnings = list(scene.warnings)
    return made


def _copied_node(made: Scene, node: Node, copies: _Copies) -> Node:
    copied = made.add(
        copies.of(node.object),
        name=node.name,
        pose=node.pose,
        static=node.static,
        cast_shadows=node.cast_shadows,
        receive_shadows=node.receive_shadows,
    )
    copied.visible = node.visible
    return copied


def _complete(copied: Node, node: Node, copies: _Copies) -> None:
    """Give a copied node what refers to other nodes, or belongs to its mesh."""
    for child in node.children:
        copies.of(child).parent = copied
    if node.skin is not None:
        copied.skin = copies.of(node.skin)
    if node.morph_weights is not None:
        copied.morph_weights = node.morph_weights
    if node.collider is not None:
        copied.collider = node.collider


def _copied_clip(clip: AnimationClip, copies: _Copies) -> AnimationClip:
    return AnimationClip([_copied_channel(one, copies) for one in clip.channels], clip.name)


def _copied_channel(
    channel: Channel | PropertyChannel, copies: _Copies
) -> Channel | PropertyChannel:
    keys = channel.times, channel.values, channel.interpolation
    if isinstance(channel, Channel):
        return Channel(copies.of(channel.node), channel.path, *keys)
    return PropertyChannel(copies.of(channel.target), channel.path, *keys)
