# Part of kernels_testing.pyx: what a mesh is cut into, as Python objects.

def clusters_of(const float[:, ::1] positions, const int32_t[:, ::1] faces, int threads):
    """What a mesh is cut into: the order of its faces, clusters and groups.

    Each cluster is (first, triangles, vertices, positions, indices, box, cone): first of its triangles
    in the order, their number and the vertices', plane after plane the positions' bytes, (3, 64) local indices as bytes, the
    box as six numbers or None, the cone as axis, cosine and least altitude or None. Each group is
    (first cluster, clusters, triangles, box).
    """
    cdef e3d_mesh_desc desc
    cdef e3d_mesh *handle
    memset(&desc, 0, sizeof(desc))
    desc.components = <int32_t>positions.shape[1]
    desc.vertices = <int32_t>positions.shape[0]
    desc.faces_count = <int32_t>faces.shape[0]
    desc.positions = &positions[0, 0] if desc.vertices else NULL
    desc.faces = &faces[0, 0] if desc.faces_count else NULL
    if e3d_mesh_create(&desc, threads, &handle) != E3D_OK:
        raise ValueError("the mesh is not valid, or too large")
    try:
        return mesh_parts(<const e3d_mesh_parts *>handle, desc.faces_count, desc.components)
    finally:
        e3d_mesh_destroy(handle)


cdef tuple triple(const float *v):
    return v[0], v[1], v[2]


cdef mesh_parts(const e3d_mesh_parts *mesh, int32_t faces_count, int components):
    cdef const e3d_cluster *c
    cdef const e3d_group_box *g
    clusters, groups = [], []
    for i in range(mesh.cluster_count):
        c = &mesh.clusters[i]
        planes = (<const char *>c.positions)[:4 * components * c.stride]
        indices = (<const char *>e3d_cluster_indices(c, components))[:3 * E3D_CLUSTER_TRIANGLES]
        box = triple(c.lo) + triple(c.hi) if c.any_finite else None
        cone = (triple(c.axis), c.cosine, c.altitude) if c.altitude > 0 else None
        clusters.append((c.first, c.triangles, c.vertices, planes, indices, box, cone))
    for i in range(mesh.group_count):
        g = &mesh.groups[i]
        groups.append((g.first_cluster, g.clusters, g.triangles, triple(g.lo) + triple(g.hi) if g.any_finite else None))
    return [mesh.faces[i] for i in range(faces_count)], clusters, groups
