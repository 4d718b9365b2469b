# Mirrors csrc/include/e3d_navigation.h.

from e3d cimport e3d_status
from libc.stdint cimport int32_t, int64_t, uint8_t


cdef extern from "e3d_navigation.h" nogil:
    enum: E3D_SURFACE_WALKABLE
    enum: E3D_SURFACE_SOLID

    ctypedef struct e3d_navigation:
        pass

    ctypedef struct e3d_navigation_desc:
        double x
        double z
        double cell
        int32_t columns
        int32_t rows
        double min_normal_y
        double step
        double headroom
        double radius

    ctypedef struct e3d_navigation_mesh:
        const float *positions
        const int32_t *faces
        int64_t faces_count
        const int32_t *material_ids
        const uint8_t *kinds
        double world_from_mesh[16]

    ctypedef struct e3d_navigation_view:
        const int32_t *starts
        const float *height
        const float *slope_x
        const float *slope_z
        const uint8_t *walkable
        int32_t layers

    e3d_status e3d_navigation_create(const e3d_navigation_desc *desc, e3d_navigation **out)
    void e3d_navigation_destroy(e3d_navigation *grid)
    e3d_status e3d_navigation_add_ground(e3d_navigation *grid, const e3d_navigation_mesh *mesh)
    e3d_status e3d_navigation_sort(e3d_navigation *grid)
    void e3d_navigation_add_obstacles(e3d_navigation *grid, const e3d_navigation_mesh *mesh)
    void e3d_navigation_get_view(const e3d_navigation *grid, e3d_navigation_view *view)
