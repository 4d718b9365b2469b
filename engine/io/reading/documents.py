"""Documents, the result of readers: objects with meshes, lights, cameras and counts.

Documents are plain records in the file's own coordinates, without any link to scenes: the code that
builds a scene interprets lights and cameras. Only readers of other packages give a ready scene.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...model.geometry.mesh import Mesh

if TYPE_CHECKING:
    from ...model.scene.scene import Scene
    from ..scenes.document_trees import SceneRecord, TreeRecord

# Formats with trees that do not say which sides of their faces are visible.
_WITHOUT_SIDES = ("dae", "urdf")


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
        1 shows white: a light shows as much at the scene's centre, as these files say no distance.
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
    """A camera of a file with its own position.

    Attributes
    ----------
    position, target : tuple of 3 float
    yfov : float
        Vertical field of view, radians.
    up : tuple of 3 float
    roll : float
        Rotation about the view axis, radians.
    name : str
    """

    position: tuple[float, float, float]
    target: tuple[float, float, float]
    yfov: float
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    roll: float = 0.0
    name: str = ""


@dataclass
class Document:
    """The content of a file.

    Attributes
    ----------
    format : str
        Name of the format, such as ``"obj"``.
    objects : list of DocumentObject
        ``(name, mesh, pose)``, in file order.
    lights : list of LightRecord
    cameras : list of CameraRecord
    counts : dict
        The sizes of the file's lists, before any splitting or joining: numbers (``vertices``,
        ``uvs``, ``normals``, ``faces``, ``triangles``, ``lines``, ``points``) and lists of names
        (``objects``, ``groups``, ``materials``).
    warnings : list of str
        The loader's warnings: what it omitted or replaced, one line each.
    scene : SceneRecord or None
        The node tree of an engine3d scene file; the objects are its visible meshes.
    tree : TreeRecord or None
        The node tree of any other file; the objects are its visible meshes.
    unit : str
        The symbol of the coordinates' unit, such as ``"mm"``; empty if the format has none.
    arrays : dict of str to list of str
        Names of the custom numbers of ``"vertices"`` and of ``"faces"``, also if they are not read
        into ``Mesh.values``.
    up : str
        The format's usual up axis: ``"+Y"`` or ``"+Z"``.
    made : Scene or None
        The scene of a plug-in's reader; the objects are its visible meshes. It is copied for each
        caller.
    model_edges : bool
        Whether visible edges of the meshes are those of a model of CAD, and no others.
    """

    format: str
    objects: list[DocumentObject] = field(default_factory=list)
    lights: list[LightRecord] = field(default_factory=list)
    cameras: list[CameraRecord] = field(default_factory=list)
    counts: dict[str, Any] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    scene: SceneRecord | None = None
    tree: TreeRecord | None = None
    unit: str = ""
    arrays: dict[str, list[str]] = field(default_factory=dict)
    up: str = "+Y"
    made: Scene | None = None
    model_edges: bool = False

    @property
    def has_joints(self) -> bool:
        """Whether the file holds a robot."""
        return self.tree is not None and self.tree.robot is not None

    @property
    def states_sides(self) -> bool:
        """Whether the format defines which sides of its faces are visible."""
        return self.tree is not None and self.format not in _WITHOUT_SIDES

    @property
    def is_scene(self) -> bool:
        """Whether the file holds a scene as a program makes it, with its own background."""
        return self.scene is not None or self.made is not None
