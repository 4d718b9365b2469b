/* A mesh as the core keeps it: the caller's arrays, and the clusters made from them. */
#pragma once

#include "base/limits.h"
#include "e3d.h"

/* Up to 64 triangles over up to 128 vertices, with a copy of their positions. The struct is one cache line. */
typedef struct e3d_cluster {
    /* X[stride], y[stride], z[stride] (, w[stride]), then three planes of E3D_CLUSTER_TRIANGLES local indices, uint8_t */
    const float *positions;
    _Alignas(8) int32_t first; /* its first triangle in the mesh's `faces`; in the same place after a pointer of 32 bits */
    uint8_t triangles, vertices;
    uint8_t stride;       /* the number of vertices, rounded up to 16: the distance of the planes of positions */
    uint8_t any_finite;
    float lo[3], hi[3];   /* the box in object space, of finite vertices only */
    float axis[3];        /* the axis of the cone that holds the unit normals of all its triangles, in object space */
    float cosine;         /* the cosine of half the cone's opening */
    float altitude;       /* the least altitude of its triangles; 0: there is no cone */
    float radius;         /* the radius of a sphere around the box, if there is a cone */
} e3d_cluster;

_Static_assert(sizeof(e3d_cluster) == 64, "a cluster is a line of the cache");

static inline const uint8_t *e3d_cluster_indices(const e3d_cluster *c, int32_t components)
{
    return (const uint8_t *)(c->positions + components * c->stride);
}

/* A group: neighbouring clusters that are first culled together. */
typedef struct e3d_group_box {
    float lo[3], hi[3];
    int32_t any_finite;
    int32_t first_cluster, clusters, triangles;
} e3d_group_box;

struct e3d_mesh {
    e3d_mesh_desc desc;
    e3d_cluster *clusters;
    int32_t cluster_count, group_count;
    e3d_group_box *groups;
    float **slabs;     /* one for each chunk of faces: positions and indices of its clusters */
    int32_t slab_count;
    int32_t *faces;    /* the faces of the clusters' triangles, cluster after cluster */
    const e3d_mesh *like; /* itself; for a posed mesh, the one at rest, which has the same clusters in other places */
    int32_t borrows_faces; /* for a posed mesh: the faces are those of the mesh at rest, which outlives it */
    float lo[3], hi[3]; /* the box of the whole mesh: faces, lines and points */
    int32_t any_finite;
    int32_t material_most; /* the greatest material ID; 0 without faces */
};

/* Finds the mesh's box from those of its clusters, and from its lines and points. */
void e3d_mesh_bound(e3d_mesh *mesh);
