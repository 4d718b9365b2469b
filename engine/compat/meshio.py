"""Gives meshio engine3d's formats: after ``import engine3d.compat.meshio`` it reads glTF.

In: files of formats that meshio lacks, such as glTF and 3MF. Out: meshes of meshio, with triangles,
lines and points, and the numbers of vertices and faces. Formats that meshio has stay its own.
"""

from __future__ import annotations

from typing import Any

from ..base.optional_packages import require

require("meshio", __name__)

import meshio  # noqa: E402
import numpy as np  # noqa: E402
from meshio._helpers import extension_to_filetypes  # noqa: E402

from ..io.reading.loading import load_mesh  # noqa: E402
from ..io.reading.reader_registry import formats  # noqa: E402
from ..model.geometry.mesh import Mesh  # noqa: E402

__all__ = ["mesh_of", "read", "register"]


def register() -> list[str]:
    """Register the formats that meshio lacks; return their extensions.

    Importing this module does it; call it again after plug-ins have added formats.
    """
    found = []
    for row in formats("mesh"):
        extensions = [one for one in row.extensions if one not in extension_to_filetypes]
        if extensions:
            meshio.register_format(f"engine3d-{row.name}", extensions, read, {})
            found += extensions
    return found


def read(path: Any) -> meshio.Mesh:
    """Return a mesh of meshio from a file that engine3d reads.

    Raises
    ------
    FileFormatError, FileAccessError
        As of `engine3d.load_mesh`: meshio ends the program at errors of its own.
    """
    return mesh_of(load_mesh(path))


def mesh_of(mesh: Mesh) -> meshio.Mesh:
    """Return a mesh of the engine as one of meshio."""
    cells = [
        (kind, rows)
        for kind, rows in (
            ("triangle", mesh.faces),
            ("line", mesh.lines),
            ("vertex", mesh.points.reshape(-1, 1)),
        )
        if len(rows)
    ]
    data: dict[str, dict[str, Any]] = {"vertices": {}, "faces": {}, "points": {}}
    for name, array in mesh.values.items():
        data[mesh.values.on(name)][name] = array
    owners = {"triangle": "faces", "vertex": "points"}
    of_cells = {
        name: [
            array if owners.get(kind) == on else np.full((len(rows), *array.shape[1:]), np.nan)
            for kind, rows in cells
        ]
        for on in ("faces", "points")
        for name, array in data[on].items()
    }
    points = np.asarray(mesh.positions, np.float64)
    return meshio.Mesh(points, cells, point_data=data["vertices"], cell_data=of_cells)


register()
