/* A mesh as the core keeps it: the caller's arrays, and the clusters made from them. */
#ifndef E3D_MESH_H
#define E3D_MESH_H

#include "core/limits.h"
#include "e3d.h"

/* Up to 64 triangles over up to 128 vertices, with their own copy of the positions. */
typedef struct e3d_cluster {
    int32_t first; /* of its triangles in the mesh's `faces` */
    int32_t triangles, vertices;
    int32_t stride;       /* vertices rounded up to 16: planes of positions are this far apart */
    size_t positions;     /* offset of x[stride], y[stride], z[stride] (, w[stride]) */
    size_t indices;       /* offset of three planes of E3D_CLUSTER_TRIANGLES local indices */
    float lo[3], hi[3];   /* AABB, object space; finite vertices only */
    int32_t any_finite;
    float axis[3];        /* of a cone that holds the unit normals of all its triangles, object space */
    float cosine;         /* of half the cone's opening */
    float altitude;       /* the least one of a triangle; 0: there is no cone */
} e3d_cluster;

/* Neighbouring clusters, which are culled together first. */
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
    float *positions;  /* of all clusters */
    uint8_t *indices;
    int32_t *faces;    /* of the clusters' triangles, one cluster after the other */
    float lo[3], hi[3]; /* of the whole mesh: faces, lines and points */
    int32_t any_finite;
    int32_t material_most; /* the greatest material ID; 0 without faces */
};

#endif
