/* The data of culling and transform: the facing of an instance, the viewport, a cluster's vertices. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/sample_patterns.h"

/* What decides which way the clusters of an instance face (facing.inl). */
typedef struct e3d_facing {
    float eye[3];    /* in object space */
    int32_t sign;    /* the sign of the area on the screen where n.(p - eye) > 0; 0: unknown */
    float length[4]; /* the lengths of the rows x, y, w, z of the clip matrix, without translation */
    float scale;     /* |det(M)| over the first three lengths, times the viewport's scales */
} e3d_facing;

/* Outcodes (R5), and the bits of vertices that cannot be used (R4, R8). */
enum {
    E3D_NEAR = 1,
    E3D_FAR = 2,
    E3D_LEFT = 4,
    E3D_RIGHT = 8,
    E3D_BOTTOM = 16,
    E3D_TOP = 32,
    E3D_OUTSIDE = 63,
    E3D_BEHIND = 64, /* WMIN */
    E3D_BEYOND_GUARD = 128,
    E3D_CLIP = E3D_NEAR | E3D_BEHIND | E3D_BEYOND_GUARD,
    E3D_NONFINITE = 256,   /* a clip coordinate is not finite */
    E3D_BAD_SCREEN = 512   /* z/w is not finite */
};

/* The viewport in samples, and its guard factors (section 2 of the rules). */
typedef struct e3d_viewport {
    int32_t width, height;   /* samples */
    float scale_x, scale_y;  /* 128 * width, 128 * height */
    float guard_x, guard_y;
    int32_t reach;           /* how far samples lie from their pixel's centre, in 1/256 (R104); 0 without multisampling */
    const e3d_sample_pattern *pattern; /* the pattern of these samples, or NULL */
} e3d_viewport;

/* A cluster's vertices in clip space and on the screen, as structure of arrays. Every array fills whole cache lines, since a
 * vector that is split across two takes twice as long to load. */
typedef struct e3d_vertices {
    float x[E3D_CLUSTER_VERTICES], y[E3D_CLUSTER_VERTICES], z[E3D_CLUSTER_VERTICES],
        w[E3D_CLUSTER_VERTICES];
    float iw[E3D_CLUSTER_VERTICES], zn[E3D_CLUSTER_VERTICES];
    int32_t sx[E3D_CLUSTER_VERTICES], sy[E3D_CLUSTER_VERTICES]; /* snapped, in 1/256 sample */
    /* Outcodes, if `special`; else all vertices are in the frustum, and x, y, z, w are unset */
    int32_t code[E3D_CLUSTER_VERTICES];
    int32_t count, special;
    int32_t unused[14]; /* padding, so that the next struct of an array begins at a cache line, too */
} e3d_vertices;

_Static_assert(sizeof(e3d_vertices) % 64 == 0, "vertices are whole lines of the cache");
