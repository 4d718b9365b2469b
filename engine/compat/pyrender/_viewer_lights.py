"""Lights that move with the viewer's camera."""

from __future__ import annotations

import numpy as np

from .light import DirectionalLight
from .node import Node

_TILT = np.pi / 6.0  # of each light from the line of sight
_TURNS = (0.0, 2.0 * np.pi / 3.0, 4.0 * np.pi / 3.0)


def raymond_lights() -> list[Node]:
    """Return three lights above the camera, a third of a turn apart, in its space."""
    nodes = []
    for turn in _TURNS:
        z = np.array([np.sin(_TILT) * np.cos(turn), np.sin(_TILT) * np.sin(turn), np.cos(_TILT)])
        x = np.array([-np.sin(turn), np.cos(turn), 0.0])
        pose = np.eye(4)
        pose[:3, 0], pose[:3, 1], pose[:3, 2] = x, np.cross(z, x), z
        nodes.append(Node(light=DirectionalLight(), matrix=pose))
    return nodes


def direct_light() -> Node:
    """Return a light along the camera's view direction."""
    return Node(light=DirectionalLight(), matrix=np.eye(4))
