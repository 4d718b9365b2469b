"""The axes that `Open3DScene.show_axes` shows: arrows from the origin."""

from __future__ import annotations

import numpy as np

from .._loading import load

#: The name of the axes among geometries.
AXES = "__axis__"
#: Poses that turn an arrow along z into one along x, y or z.
_TURNS = ((2, 0, 1), (1, 2, 0), (0, 1, 2))


def axes_mesh(box):
    """Return arrows as long as a box, or a quarter of its distance: a TriangleMesh."""
    make = load().geometry.TriangleMesh
    middle = np.asarray(box.get_center())
    length = box.get_max_extent()
    length = max(1.0 if length < 0.001 else length, 0.25 * float(np.sqrt((middle**2).sum())))
    mesh = make.create_sphere(0.005 * length)
    mesh.compute_vertex_normals()
    mesh.paint_uniform_color((0.5, 0.5, 0.5))
    for axis, order in enumerate(_TURNS):
        arrow = make.create_arrow(0.0025 * length, 0.0075 * length, 0.975 * length, 0.025 * length)
        arrow.compute_vertex_normals()
        arrow.paint_uniform_color(np.eye(3)[axis])
        pose = np.eye(4)
        pose[:3, :3] = np.eye(3)[list(order)]
        mesh += arrow.transform(pose)
    return mesh
