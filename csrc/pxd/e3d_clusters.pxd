# The Cython mirror of csrc/core/mesh.h, and nothing else: what the tests of clusters need.

from libc.stdint cimport int32_t, uint8_t

cdef extern from "core/mesh.h" nogil:
    ctypedef struct e3d_cluster:
        const float *positions
        int32_t first
        uint8_t triangles
        uint8_t vertices
        uint8_t stride
        uint8_t any_finite
        float lo[3]
        float hi[3]
        float axis[3]
        float cosine
        float altitude

    ctypedef struct e3d_group_box:
        float lo[3]
        float hi[3]
        int32_t any_finite
        int32_t first_cluster
        int32_t clusters
        int32_t triangles

    ctypedef struct e3d_mesh_parts "struct e3d_mesh":
        e3d_cluster *clusters
        e3d_group_box *groups
        int32_t cluster_count
        int32_t group_count
        int32_t *faces

    const uint8_t *e3d_cluster_indices(const e3d_cluster *cluster, int32_t components)
