"""The meshes of a robot's shapes: boxes, cylinders, spheres, capsules, and those of files.

In: a `Shape`. Out: meshes with the robot's materials, each with its pose. Shapes that are alike
share their arrays, and files are read once. Axes of cylinders and capsules are along +Z.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....errors import Engine3DError, FileFormatError
from ....model.geometry.mesh import Mesh
from ....model.geometry.posing import posed_mesh
from ....model.geometry.twins import twin_of
from ....model.materials.material import Material, copy_of, textures_of
from ....model.materials.textures import Texture
from ....model.primitives import box, cylinder, uv_sphere
from ....model.primitives.faces import grid_points, grid_quads, split_quads
from ...reading.linked_files import LinkedFileError
from ...reading.loading import document_of, texture_of
from ...reading.reader_registry import find_reader
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ..threemf.threemf_model import METRES
from .urdf_files import RobotFiles
from .urdf_model import Look, Shape

# Of capsules: segments around, and from the rim of an end to its pole.
_AROUND, _TO_POLE = 32, 8
# What formats of scenes name their shapes in: glTF's +Y is up, a robot's +Z.
_UPRIGHT = {"+Y": linalg.rotation_x(np.pi / 2)}
_TURNED = ("gltf", "glb")


class ShapePart(NamedTuple):
    """A mesh of a shape, and its pose in it; None: the same coordinates."""

    mesh: Mesh
    pose: NDArray[np.float64] | None


class ShapeMeshes:
    """The meshes of all shapes of a robot.

    Attributes
    ----------
    size : int
        Bytes of the files read.
    missing : str
        Why the first file that is left out was; empty if none was.
    """

    def __init__(self, files: RobotFiles, warnings: WarningList) -> None:
        self._files, self._warnings = files, warnings
        self._plain: dict[object, list[ShapePart] | None] = {}
        self._dressed: dict[object, list[ShapePart]] = {}
        self._materials: dict[object, Material] = {}
        self._textures: dict[str, Texture | None] = {}
        self.size, self.missing = 0, ""

    def parts(self, shape: Shape) -> list[ShapePart]:
        """Return the meshes of a shape: none, with a warning, if its file cannot be read."""
        sizes = () if shape.kind == "mesh" else shape.sizes
        form = shape.kind, sizes, shape.file
        if form not in self._plain:
            self._plain[form] = self._made(shape)
        plain = self._plain[form]
        look = shape.look
        key = form, None if look is None else (look.name, look.color, look.texture)
        if plain is None or look is None:
            return plain or []
        if key not in self._dressed:
            self._dressed[key] = [self._in_look(part, look) for part in plain]
        return self._dressed[key]

    def _made(self, shape: Shape) -> list[ShapePart] | None:
        if shape.kind != "mesh":
            return [ShapePart(_FORMS[shape.kind](*shape.sizes), None)]
        try:
            with self._files.open(shape.file) as source:
                return self._read(source)
        except (LinkedFileError, Engine3DError) as error:
            told = f"mesh {shown(shape.file)} is left out: {error}"
            self.missing = self.missing or told
            self._warnings.add(told, shape.line)
            return None

    def _read(self, source: Source) -> list[ShapePart]:
        if find_reader(source, "mesh").name in ("urdf", "e3d"):
            raise FileFormatError("a robot within a robot is not read", source.path)
        self.size += source.size
        document = document_of(source, None, split=True)
        for message in document.warnings:
            self._warnings.add_once(message)
        metres = METRES.get(document.unit, 1.0)
        pose = None if metres == 1.0 else linalg.scaling(metres)
        if document.format in _TURNED:
            pose = _UPRIGHT[document.up]
        return [ShapePart(o.mesh, _product(pose, o.pose)) for o in document.objects]

    def _in_look(self, part: ShapePart, look: Look) -> ShapePart:
        """Return a mesh in a robot's material; a mesh's own texture stays, and is tinted."""
        key = look.name, look.color, look.texture
        if key not in self._materials:
            self._materials[key] = self._material(look)
        own = self._materials[key]
        materials = [
            _tinted(material, look) if look.texture is None and textures_of(material) else own
            for material in part.mesh.materials
        ]
        return part._replace(mesh=twin_of(part.mesh, materials, part.mesh.name))

    def _material(self, look: Look) -> Material:
        color = look.color or (1.0, 1.0, 1.0, 1.0)
        return Material(
            name=look.name,
            color=color,
            alpha_mode="blend" if color[3] < 1.0 else "opaque",
            texture=None if look.texture is None else self._texture(look),
        )

    def _texture(self, look: Look) -> Texture | None:
        name = look.texture or ""
        if name not in self._textures:
            self._textures[name] = None
            try:
                with self._files.open(name) as source:
                    self._textures[name] = texture_of(source)
            except (LinkedFileError, Engine3DError) as error:
                self._warnings.add(f"texture {shown(name)} is left out: {error}", look.line)
        return self._textures[name]

    @property
    def materials(self) -> tuple[Material, ...]:
        """The robot's own materials, as far as shapes show them."""
        return tuple(self._materials.values())


def _tinted(material: Material, look: Look) -> Material:
    """Return a textured material of a mesh in a robot's colour."""
    tinted = copy_of(material)
    if look.color is not None:
        tinted.color = look.color
        if look.color[3] < 1.0:
            tinted.alpha_mode = "blend"
    return tinted


def _product(first: np.ndarray | None, second: np.ndarray | None) -> np.ndarray | None:
    if first is None or second is None:
        return second if first is None else first
    return linalg.multiply(first, second)


def capsule(radius: float, length: float) -> Mesh:
    """Return a cylinder of this length about +Z with a half sphere at each end."""
    along, across = (values[: 2 * _TO_POLE + 1] for values in linalg.unit_circle(4 * _TO_POLE))
    # Rings from the lower pole to the upper one; the middle one is there twice.
    rings = np.r_[np.arange(_TO_POLE + 1), np.arange(_TO_POLE, 2 * _TO_POLE + 1)]
    x, y = (np.append(values, values[0]) for values in linalg.unit_circle(_AROUND))
    normals = np.empty((len(rings), len(x), 3))
    normals[..., 0], normals[..., 1] = (np.multiply.outer(across[rings], v) for v in (x, y))
    normals[..., 2] = -along[rings][:, np.newaxis]
    positions = radius * normals
    positions[: _TO_POLE + 1, :, 2] -= 0.5 * length
    positions[_TO_POLE + 1 :, :, 2] += 0.5 * length
    faces, visible = split_quads(grid_quads(len(rings) - 1, _AROUND))
    is_face = np.ones(len(faces), np.bool_)  # at the poles, every other triangle is none
    is_face[: 2 * _AROUND : 2] = is_face[1 - 2 * _AROUND :: 2] = False
    return Mesh(
        positions.reshape(-1, 3),
        faces[is_face],
        normals=normals.reshape(-1, 3),
        edge_visible=visible[is_face],
        position_ids=grid_points(len(rings) - 1, _AROUND),
        name="capsule",
    )


_Z_UP = _UPRIGHT["+Y"]
_FORMS: dict[str, Callable[..., Mesh]] = {
    "box": lambda *size: box(size),
    "cylinder": lambda radius, length: posed_mesh(cylinder(radius, length), _Z_UP),
    "sphere": lambda radius: posed_mesh(uv_sphere(radius), _Z_UP),
    "capsule": capsule,
}
