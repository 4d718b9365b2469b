# Mirrors csrc/include/e3d_posing.h, which explains every name.

from libc.stdint cimport int32_t, uint16_t

from e3d cimport e3d_mesh, e3d_mesh_desc, e3d_status


cdef extern from "e3d_posing.h" nogil:
    enum:
        E3D_JOINT_MATRIX
        E3D_POSED_BOX

    ctypedef struct e3d_pose_desc:
        const float *normals
        const float *tangents
        int32_t influences
        const uint16_t *joints
        const float *weights
        int32_t targets
        const float *target_positions
        const float *target_normals
        const float *target_tangents

    ctypedef struct e3d_rest:
        pass

    e3d_status e3d_rest_create(const e3d_mesh *mesh, const e3d_pose_desc *desc, e3d_rest **out)
    void e3d_rest_destroy(e3d_rest *rest)
    int32_t e3d_rest_joints(const e3d_rest *rest)
    e3d_status e3d_posed_create(const e3d_rest *rest, int face_normals, e3d_mesh **out)
    const float *e3d_posed_positions(const e3d_mesh *posed)
    const float *e3d_posed_normals(const e3d_mesh *posed)
    const float *e3d_posed_tangents(const e3d_mesh *posed)

    ctypedef struct e3d_pose_job:
        const e3d_rest *rest
        const float *matrices
        const float *weights
        e3d_mesh *out
        double box[9]

    void e3d_pose_meshes(e3d_pose_job *jobs, int32_t count, int threads)
    void e3d_reference_pose(
        const e3d_mesh_desc *mesh, const e3d_pose_desc *desc, const float *matrices,
        const float *weights, float *positions, float *normals, float *tangents,
    )

    ctypedef struct e3d_skeleton:
        int32_t links
        const int32_t *slots
        const int32_t *above
        int32_t joints
        const int32_t *ends
        const double *inverse_binds

    void e3d_skeleton_matrices(
        const e3d_skeleton *skeleton, const double *poses, double *ways, float *matrices
    )
