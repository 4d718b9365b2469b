# Mirrors csrc/include/e3d_occlusion.h.

from libc.stdint cimport int32_t

from e3d cimport e3d_backend, e3d_status


cdef extern from "e3d_occlusion.h" nogil:
    ctypedef struct e3d_depth_picture:
        int32_t width
        int32_t height
        const float *depth
        float across[2]
        float down[2]
        int32_t is_perspective

    e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads,
                                  const e3d_depth_picture *picture, float radius, float *scratch,
                                  float *visibility)
