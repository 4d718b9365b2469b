"""The visual shapes of Bullet's bodies, and the nodes that show them.

In: rows of pybullet's visual shape data. Out: a node for each shape, with a mesh and a material of
its own, so that colours and textures change at once. Meshes share their arrays.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ...base import linalg
from ...errors import Engine3DError, warn
from ...model.geometry.mesh import Mesh
from ...model.geometry.twins import twin_of
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ._files import FileMesh, found_file, read_mesh, scaled_mesh
from ._forms import MADE, MESH, PLANE, checks, made_form

_KINDS = {9: "heightfield"}


class ShapeForm(NamedTuple):
    """What does not change about a shape.

    Attributes
    ----------
    link : int
        -1 for the base.
    kind : int
        A number of pybullet, such as ``GEOM_BOX``.
    sizes : tuple of float
    file : str
    position, orientation : tuple of float
        link-from-shape.
    """

    link: int
    kind: int
    sizes: tuple[float, ...]
    file: str
    position: tuple[float, ...]
    orientation: tuple[float, ...]

    @property
    def frame(self) -> np.ndarray:
        """link-from-shape, (4, 4) float64."""
        turned = linalg.quaternion_to_matrix(self.orientation)
        return linalg.multiply(linalg.translation(self.position), turned)


def form_of(row: tuple[Any, ...]) -> ShapeForm:
    """Return the form of a row of `getVisualShapeData`."""
    name = row[4].decode("utf-8", "surrogateescape") if isinstance(row[4], bytes) else row[4]
    return ShapeForm(row[1], row[2], row[3], name, row[5], row[6])


class Shape:
    """A visual shape.

    Attributes
    ----------
    form : ShapeForm
    color : tuple of 4 float
        As in pybullet; 0 alpha hides it.
    node : Node or None
        None until it is drawn, and if it cannot be.
    """

    def __init__(
        self, form: ShapeForm, color: tuple[float, ...], given: Mesh | None, folder: str
    ) -> None:
        self.form, self.color = form, color
        self.node: Node | None = None
        self._given, self._folder = given, folder
        self._material = Material()
        self._own: Texture | None = None  # the texture of the file
        self._other: Texture | None = None  # one that a program gave it
        self._is_dressed = True  # whether it shows its own one

    def show(self, scene: Scene) -> None:
        """Add a node; leave the shape out, with a warning, if there is no mesh for it."""
        found = self._found()
        if found is None:
            return
        self._own = found.texture
        mesh = found.mesh
        if self.form.kind == MESH and self.form.sizes != (1.0, 1.0, 1.0):
            mesh = scaled_mesh(mesh, self.form.sizes)
        self.node = scene.add(twin_of(mesh, [self._material], mesh.name))
        self._renew()

    def paint(self, color: tuple[float, ...]) -> None:
        """Give the shape another colour."""
        self.color = color
        self._renew()

    def dress(self, texture: Texture | None) -> None:
        """Give the shape another texture, or none."""
        self._other, self._is_dressed = texture, False
        self._renew()

    def _renew(self) -> None:
        rgb = [min(max(float(part), 0.0), 1.0) for part in self.color[:3]]
        self._material.texture = self._own if self._is_dressed else self._other
        if self._material.texture is None:  # TinyRenderer cuts colours to whole codes
            rgb = [math.floor(255.0 * part + 1e-4) / 255.0 for part in rgb]
        self._material.color = linear(*rgb)
        if self.node is not None:
            self.node.visible = self.color[3] != 0.0

    def _found(self) -> FileMesh | None:
        form = self.form
        if self._given is not None:
            return FileMesh(self._given, None)
        if form.kind in MADE:
            texture = checks() if form.kind == PLANE else None
            return FileMesh(made_form(form.kind, form.sizes), texture)
        if form.kind != MESH or not form.file:
            what = _KINDS.get(form.kind, f"shape of kind {form.kind}")
            what = "mesh of vertices from before install()" if form.kind == MESH else what
            warn(f"a {what} of PyBullet is not drawn")
            return None
        try:
            return read_mesh(found_file(form.file, self._folder))
        except Engine3DError as error:
            warn(f"a mesh of PyBullet is not drawn: {error}")
            return None
