"""The scene that Open3D's function `draw` shows.

In: geometries of Open3D, and dictionaries of them with their names and materials. Out: a `Scene`,
and drawing options: the viewer has one size for all points, and one width for all lines.
"""

from __future__ import annotations

from typing import Any

from ...errors import InvalidArgumentError, warn
from ...io.scenes.open3d_materials import record_of_tensor
from ...io.scenes.open3d_scenes import legacy_of, mesh_of_triangles
from ...model.geometry.mesh import Mesh
from ...model.scene.scene import Scene
from ...rendering.options import MAX_LINE
from ._loading import load
from .rendering._things import thing_of

#: What is taken of dictionaries.
_KEYS = "geometry", "name", "material", "is_visible"
#: The planes of a camera, of which only shaders of depths know.
_PLANES = 0.1, 1000.0


class DrawnScene:
    """The scene, as it grows.

    Parameters
    ----------
    background : (3,) or (4,) float
    point_size, line_width : float or None
        Of geometries without a material; None leaves them to the viewer.
    """

    def __init__(self, background: Any, point_size: float | None, line_width: float | None) -> None:
        self.scene = Scene(background=tuple(float(part) for part in background[:3]))
        self._usual = {"point_size": point_size, "line_width": line_width}
        self._sizes: dict[str, set[float]] = {name: set() for name in self._usual}

    @property
    def options(self) -> dict[str, float]:
        """The drawing options of all: sizes that geometries or `draw` were given."""
        for name, sizes in self._sizes.items():
            if len(sizes) > 1:
                warn(f"draw shows everything with one {name}, the largest: {max(sizes):g}")
        return {name: min(max(sizes), MAX_LINE) for name, sizes in self._sizes.items() if sizes}

    def add(self, item: Any, name: str) -> None:
        """Add a geometry, a model, or a dictionary that holds one.

        Raises
        ------
        InvalidArgumentError
            It is none, or a dictionary without one.
        """
        row = item if isinstance(item, dict) else {"geometry": item}
        if "geometry" not in row:
            raise InvalidArgumentError(f"a dictionary for draw needs a geometry: {sorted(row)}")
        if left_out := sorted(key for key in row if key not in _KEYS and row[key]):
            warn(f"draw does not support {', '.join(left_out)} of a geometry")
        if not row.get("is_visible", True):
            return
        geometry, name = row["geometry"], str(row.get("name", name))
        if hasattr(geometry, "meshes") and hasattr(geometry, "materials"):
            for part in geometry.meshes:
                record = geometry.materials[part.material_idx]
                self._add(part.mesh, record, f"{name}:{part.mesh_name}")
        else:
            record = row.get("material")
            self._add(geometry, record_of_tensor(geometry) if record is None else record, name)

    def _add(self, geometry: Any, record: Any, name: str) -> None:
        mesh = _textured(legacy_of(geometry)) if record is None else None
        if mesh is None:
            mesh = self._mesh(geometry, record)
        if mesh is None:
            warn(f"draw shows no {type(geometry).__name__}")
        else:
            self.scene.add(mesh, name=name)

    def _mesh(self, geometry: Any, record: Any) -> Mesh | None:
        """Return the mesh of a geometry in a material, and note its size; None if none is drawn."""
        is_usual = record is None
        record = _usual_record(geometry) if is_usual else record
        thing = thing_of(geometry, record, _PLANES)
        if thing is None:
            return None
        kind = {"points": "point_size", "lines": "line_width"}.get(thing.arrays.kind)
        if kind is not None:
            own = dict(zip(self._usual, thing.size, strict=True))
            size = self._usual[kind] if is_usual else own[kind]
            self._sizes[kind] |= {float(size)} if size else set()
        return thing.mesh


def _usual_record(geometry: Any) -> Any:
    """Return the material of a geometry that has none."""
    record = load().visualization.rendering.MaterialRecord()
    record.shader = "defaultLit" if _has_normals(legacy_of(geometry)) else "defaultUnlit"
    return record


def _textured(geometry: Any) -> Mesh | None:
    """Return the mesh of a geometry with textures of its own; None for others."""
    if all(image.is_empty() for image in getattr(geometry, "textures", ())):
        return None
    if not geometry.has_triangle_uvs():
        return None
    mesh = mesh_of_triangles(geometry)
    for material in mesh.materials:
        material.unlit = not _has_normals(geometry)
    return mesh


def _has_normals(geometry: Any) -> bool:
    for name in ("has_vertex_normals", "has_normals"):
        if hasattr(geometry, name):
            return bool(getattr(geometry, name)())
    return False
