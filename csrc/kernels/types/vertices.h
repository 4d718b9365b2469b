/* What culling and transform work on: the facing of an instance, the viewport, a cluster's vertices. */
#ifndef E3D_KERNELS_VERTICES_H
#define E3D_KERNELS_VERTICES_H

#include <stdint.h>

#include "core/limits.h"

/* What tells which way an instance's clusters face. */
typedef struct e3d_facing {
    float eye[3];    /* object space */
    int32_t sign;    /* of the screen's area where n.(p - eye) is positive; 0: cannot be told */
    float length[4]; /* of the clip matrix's rows x, y, w, z, without translation */
    float scale;     /* of areas, over the first three lengths */
} e3d_facing;

/* Outcodes (R5), and what only the screen tells (R4, R8). */
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
    E3D_NONFINITE = 256,   /* a clip coordinate is */
    E3D_BAD_SCREEN = 512   /* z/w is not finite */
};

/* The viewport in samples, and its guard factors (section 2 of the rules). */
typedef struct e3d_viewport {
    int32_t width, height;   /* samples */
    float scale_x, scale_y;  /* 128 * width, 128 * height */
    float guard_x, guard_y;
} e3d_viewport;

/* A cluster's vertices in clip space and on the screen. (All arrays are whole lines of the cache, where the struct is aligned to
 * one: vectors that lie across two take twice as long.) */
typedef struct e3d_vertices {
    float x[E3D_CLUSTER_VERTICES], y[E3D_CLUSTER_VERTICES], z[E3D_CLUSTER_VERTICES],
        w[E3D_CLUSTER_VERTICES];
    float iw[E3D_CLUSTER_VERTICES], zn[E3D_CLUSTER_VERTICES];
    int32_t sx[E3D_CLUSTER_VERTICES], sy[E3D_CLUSTER_VERTICES]; /* snapped, 1/256 sample */
    int32_t code[E3D_CLUSTER_VERTICES]; /* outcodes, where `special`; else all are in the frustum, and x, y, z, w may be missing */
    int32_t count, special;
    int32_t unused[14]; /* the next one begins with a line of the cache, too */
} e3d_vertices;

_Static_assert(sizeof(e3d_vertices) % 64 == 0, "vertices are whole lines of the cache");

#endif
