# Part of kernels_testing.pyx: posing as the reference does it.

def pose_by_reference(
    const float[:, ::1] positions,
    const float[:, ::1] normals,
    const float[:, ::1] tangents,
    const uint16_t[:, ::1] joints,
    const float[:, ::1] weights,
    const float[:, :, ::1] target_positions,
    const float[:, :, ::1] target_normals,
    const float[:, :, ::1] target_tangents,
    const float[:, ::1] matrices,
    const float[::1] target_weights,
    float[:, ::1] out_positions,
    float[:, ::1] out_normals,
    float[:, ::1] out_tangents,
):
    """Fill posed positions, normals (V, 3) and tangents (V, 4); matrices (J, 16): columns of x y z 0. None: without."""
    cdef e3d_mesh_desc mesh
    cdef e3d_pose_desc desc
    memset(&mesh, 0, sizeof(mesh))
    memset(&desc, 0, sizeof(desc))
    mesh.vertices = <int32_t>positions.shape[0]
    mesh.positions = &positions[0, 0]
    desc.normals, desc.tangents = &normals[0, 0], &tangents[0, 0]
    if joints is not None:
        desc.influences = <int32_t>joints.shape[1]
        desc.joints, desc.weights = &joints[0, 0], &weights[0, 0]
    if target_positions is not None:
        desc.targets = <int32_t>target_positions.shape[0]
        desc.target_positions = &target_positions[0, 0, 0]
    if target_normals is not None:
        desc.targets = <int32_t>target_normals.shape[0]
        desc.target_normals = &target_normals[0, 0, 0]
    if target_tangents is not None:
        desc.targets = <int32_t>target_tangents.shape[0]
        desc.target_tangents = &target_tangents[0, 0, 0]
    e3d_reference_pose(
        &mesh, &desc, NULL if matrices is None else &matrices[0, 0],
        NULL if target_weights is None else &target_weights[0], &out_positions[0, 0], &out_normals[0, 0],
        &out_tangents[0, 0],
    )
