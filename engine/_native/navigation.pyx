# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to navigation grids in C: checks shapes, releases the GIL, makes one call.

In:  arrays of meshes with a matrix each. Out: the layers of a grid, as arrays of their own.
What is walkable, and where the meshes are, is engine/model/navigation's affair.
"""

import numpy as np

from e3d cimport E3D_OK, E3D_OUT_OF_MEMORY, e3d_status
from e3d_navigation cimport *
from libc.stdint cimport int32_t, uint8_t

from ..errors import InvalidArgumentError, OutOfMemoryError

WALKABLE = E3D_SURFACE_WALKABLE
SOLID = E3D_SURFACE_SOLID


cdef int check(e3d_status status) except -1:
    if status == E3D_OUT_OF_MEMORY:
        raise OutOfMemoryError("no memory for a navigation grid")
    if status != E3D_OK:
        raise InvalidArgumentError("a navigation grid needs cells of a size, at least one")
    return 0


cdef class NativeGrid:
    """A grid being built: all meshes as ground, `sort`, all meshes as obstacles, `layers`."""

    cdef e3d_navigation *handle
    cdef Py_ssize_t cells

    def __cinit__(self, double x, double z, double cell, int32_t columns, int32_t rows,
                  double min_normal_y, double step, double headroom, double radius):
        cdef e3d_navigation_desc desc = e3d_navigation_desc(
            x, z, cell, columns, rows, min_normal_y, step, headroom, radius)
        check(e3d_navigation_create(&desc, &self.handle))
        self.cells = <Py_ssize_t>columns * rows

    def __dealloc__(self):
        e3d_navigation_destroy(self.handle)

    def add(self, bint ground, const float[:, ::1] positions not None,
            const int32_t[:, ::1] faces not None, const int32_t[::1] material_ids not None,
            const uint8_t[::1] kinds not None, const double[:, ::1] world_from_mesh not None):
        """Add a mesh as ground or as obstacles; indices must be in range."""
        cdef e3d_navigation_mesh mesh
        cdef e3d_status status = E3D_OK
        cdef int k
        if faces.shape[0] == 0:
            return
        if (positions.shape[1] != 3 or faces.shape[1] != 3 or kinds.shape[0] == 0
                or material_ids.shape[0] != faces.shape[0]
                or world_from_mesh.shape[0] != 4 or world_from_mesh.shape[1] != 4):
            raise InvalidArgumentError("a mesh's arrays do not fit each other")
        mesh.positions, mesh.faces = &positions[0, 0], &faces[0, 0]
        mesh.faces_count = faces.shape[0]
        mesh.material_ids, mesh.kinds = &material_ids[0], &kinds[0]
        for k in range(16):
            mesh.world_from_mesh[k] = world_from_mesh[k // 4, k % 4]
        with nogil:
            if ground:
                status = e3d_navigation_add_ground(self.handle, &mesh)
            else:
                e3d_navigation_add_obstacles(self.handle, &mesh)
        check(status)

    def sort(self):
        """Make the layers of what was added as ground."""
        cdef e3d_status status
        with nogil:
            status = e3d_navigation_sort(self.handle)
        check(status)

    def layers(self) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Return starts, heights, slopes along x and z, and what is walkable, as new arrays."""
        cdef e3d_navigation_view view
        e3d_navigation_get_view(self.handle, &view)
        starts = np.array(<int32_t[:self.cells + 1]><int32_t *>view.starts)
        if view.layers == 0:
            return starts, *(np.zeros(0, np.float32) for _ in range(3)), np.zeros(0, np.bool_)
        return (
            starts,
            np.array(<float[:view.layers]><float *>view.height),
            np.array(<float[:view.layers]><float *>view.slope_x),
            np.array(<float[:view.layers]><float *>view.slope_z),
            np.array(<uint8_t[:view.layers]><uint8_t *>view.walkable).view(np.bool_),
        )
