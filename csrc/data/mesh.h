/* A mesh as the core keeps it: the caller's arrays, and the clusters made from them. */
#ifndef E3D_MESH_H
#define E3D_MESH_H

#include "base/limits.h"
#include "e3d.h"

/* Up to 64 triangles over up to 128 vertices, with their own copy of the positions; the struct is one cache line. */
typedef struct e3d_cluster {
    const float *positions; /* x[stride], y[stride], z[stride] (, w[stride]), then three planes of E3D_CLUSTER_TRIANGLES local
                             * indices, uint8_t */
    int32_t first; /* its first triangle in the mesh's `faces` */
    uint8_t triangles, vertices;
    uint8_t stride;       /* vertices rounded up to 16: how far apart the planes of positions are */
    uint8_t any_finite;
    float lo[3], hi[3];   /* AABB, object space; finite vertices only */
    float axis[3];        /* of the cone that holds the unit normals of all its triangles, object space */
    float cosine;         /* of half the cone's opening */
    float altitude;       /* the least altitude of its triangles; 0: there is no cone */
    float radius;         /* of a sphere around the box, where there is a cone */
} e3d_cluster;

_Static_assert(sizeof(e3d_cluster) == 64, "a cluster is a line of the cache");

static inline const uint8_t *e3d_cluster_indices(const e3d_cluster *c, int32_t components)
{
    return (const uint8_t *)(c->positions + components * c->stride);
}

/* A group: neighbouring clusters that are culled together first. */
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
    const e3d_mesh *like; /* itself, or of a posed mesh the one at rest: what has the same clusters, wherever they are */
    int32_t borrows_faces; /* a posed mesh: they are those of the mesh at rest, which outlives it */
    float lo[3], hi[3]; /* of the whole mesh: faces, lines and points */
    int32_t any_finite;
    int32_t material_most; /* the greatest material ID; 0 without faces */
};

/* Finds the mesh's box from those of its clusters, and from its lines and points. */
void e3d_mesh_bound(e3d_mesh *mesh);

#endif
