"""What a reader makes of a file: objects with their meshes, lights, cameras and counts.

These are plain records in the file's own coordinates. Nothing here knows about scenes: whoever
builds one decides what becomes of the lights and cameras.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..environments.environment import Environment
from ..geometry.mesh import Mesh
from ..materials.material import Material
from .json_values import JsonValue


class DocumentObject(NamedTuple):
    """A named mesh of a file.

    Attributes
    ----------
    name : str
    mesh : Mesh
    pose : (4, 4) float64 or None
        Places the mesh in the document; None if its coordinates are the document's.
    """

    name: str
    mesh: Mesh
    pose: np.ndarray | None = None


@dataclass
class LightRecord:
    """A light of a file.

    Attributes
    ----------
    kind : {"ambient", "point", "directional", "spot"}
    position : tuple of 3 float
    color : tuple of 3 float
        Linear light, 0..1.
    intensity : float
    name : str
    target : tuple of 3 float or None
        The point that a spot light shines at.
    angle : float or None
        Full angle of a spot light's cone, radians.
    """

    kind: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    name: str = ""
    target: tuple[float, float, float] | None = None
    angle: float | None = None


@dataclass
class CameraRecord:
    """A camera of a file.

    Attributes
    ----------
    position, target : tuple of 3 float
    fov : float
        Vertical field of view, radians.
    up : tuple of 3 float
    roll : float
        Turn about the view axis, radians.
    name : str
    """

    position: tuple[float, float, float]
    target: tuple[float, float, float]
    fov: float
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    roll: float = 0.0
    name: str = ""


@dataclass
class SceneRecord:
    """The tree of a scene's file; what nodes hold is checked by whoever builds a scene of it.

    Attributes
    ----------
    values : JsonValue
        Background and light.
    materials : list of Material
    meshes : dict of int to Mesh
        Those of the objects that are meshes, by number.
    objects, nodes : list of JsonValue
    places : list of dict
        The parts of each node's pose, as `Scene.add` takes them.
    parents : list of int
        Of each node; -1: none.
    children : dict of int to list of int
        Of each node that has some, in their order.
    environments : list of Environment or None
        None stands for one whose file cannot be read.
    """

    values: JsonValue
    materials: list[Material]
    meshes: dict[int, Mesh]
    objects: list[JsonValue]
    nodes: list[JsonValue]
    places: list[dict[str, list]]
    parents: list[int]
    children: dict[int, list[int]]
    environments: list[Environment | None] = field(default_factory=list)


@dataclass
class Document:
    """Everything that a file holds.

    Attributes
    ----------
    format : str
        Name of the format, such as ``"obj"``.
    objects : list of DocumentObject
        ``(name, mesh, pose)``, in the order of the file.
    lights : list of LightRecord
    cameras : list of CameraRecord
    counts : dict
        The lists that the file holds, before any splitting or joining: numbers (``vertices``,
        ``uvs``, ``normals``, ``faces``, ``triangles``, ``lines``, ``points``) and lists of names
        (``objects``, ``groups``, ``materials``).
    warnings : list of str
        What was left out or replaced, one line each.
    scene : SceneRecord or None
        The tree of nodes, of a file that holds one; its objects then are what of it shows.
    """

    format: str
    objects: list[DocumentObject] = field(default_factory=list)
    lights: list[LightRecord] = field(default_factory=list)
    cameras: list[CameraRecord] = field(default_factory=list)
    counts: dict = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    scene: SceneRecord | None = None
