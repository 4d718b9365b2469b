/* The data that a mesh at rest keeps for posing. Private to csrc/scene/posing. */
#pragma once

#include "data/mesh/mesh.h"
#include "e3d_posing.h"

/* A joint that moves a vertex. */
typedef struct e3d_influence {
    float weight;
    int32_t matrix; /* the offset of the joint's matrix, in floats */
} e3d_influence;

struct e3d_rest {
    const e3d_mesh *mesh;
    e3d_pose_desc desc;
    int32_t joints;
    uint32_t *starts;          /* (vertices + 1,) where the influences of each vertex begin; NULL: no joints */
    e3d_influence *influences; /* those that are not 0, vertex after vertex */
    size_t *member_starts;     /* (clusters,) where the members of each cluster begin */
    int32_t *members;          /* the mesh's vertex for each vertex of a cluster */
    size_t cluster_floats;     /* the room for the clusters' positions and indices, in floats */
};

/* The arrays of all vertices that posing writes; normals and tangents may be NULL. */
typedef struct e3d_posed_arrays {
    float *positions, *normals, *tangents;
} e3d_posed_arrays;

/* Poses vertices first … first + count - 1. */
void e3d_pose_vertices(const e3d_pose_job *job, int32_t first, int32_t count, const e3d_posed_arrays *out);
/* Updates the positions and boxes of some clusters from the vertices' positions. */
void e3d_refit_clusters(const e3d_rest *rest, e3d_mesh *posed, int32_t first, int32_t count);
/* Then updates the boxes of groups and of the mesh, and the normals of faces if it has them. */
void e3d_refit_mesh(e3d_mesh *posed, double box[E3D_POSED_BOX]);
