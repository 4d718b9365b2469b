/* Divides a mesh into clusters. */
#pragma once

#include "data/mesh/mesh.h"

/* Fills the mesh's clusters, groups, slabs and faces, on up to `threads` threads; their number doesn't change the result.
 * Returns 0 when memory is out; what is there belongs to the mesh, which frees it. */
int e3d_clusters_build(e3d_mesh *mesh, int threads);

/* Writes the mesh's faces in the order in which clusters take them; 0 when memory is out. lo and hi bound the finite vertices. */
int e3d_order_faces(const e3d_mesh_desc *desc, const float lo[3], const float hi[3], int threads, int32_t *faces);

/* Finds a cluster's cone of normals from its positions and indices. */
void e3d_find_cone(e3d_cluster *cluster);
