/* What may hide lights: triangles, and for each light grids that tell which of them may be over a sample (docs/exactness, section
 * 17). */
#ifndef E3D_KERNELS_CASTERS_H
#define E3D_KERNELS_CASTERS_H

#include <stdint.h>

#include "base/limits.h"
#include "e3d.h"

enum {
    E3D_CASTER_LEVELS = 11, /* so at most 1024 cells a side */
    E3D_CASTER_FACES = 6    /* of a cube around a point light */
};

/* Where a caster is in the plane of a light: it may be over samples in this box that are farther away than `near`. */
typedef struct e3d_caster_box {
    float near, low[2], high[2];
    uint32_t caster;
} e3d_caster_box;

/* Casters by where they are: level l has 2^(levels - 1 - l) cells a side. Each caster is in the finest level where it touches at most two
 * cells along each axis; large ones, which are few, are two levels below that, in the cells alone that they touch. */
typedef struct e3d_caster_grid {
    float low[2], high[2];
    float scale[2]; /* cells of level 0 in a unit */
    float near;     /* of all boxes */
    int32_t levels; /* 0: there are no casters */
    uint32_t filled; /* a bit for each level that has some */
    const uint32_t *starts[E3D_CASTER_LEVELS]; /* of the cells of each level, row by row, and the end of the last */
    const e3d_caster_box *boxes;               /* of each cell the near ones first */
} e3d_caster_grid;

/* A light that casts exact shadows. */
typedef struct e3d_caster_light {
    int32_t number;         /* of the frame's lights */
    int32_t axis;           /* directional: k of R98 */
    float slope[2];         /* likewise */
    const float (*corners)[9]; /* of each caster x, y and z of R98: three of each; of a point light v - L, not turned to a face */
    e3d_caster_grid grids[E3D_CASTER_FACES]; /* directional: the first; else by 2 * axis, + 1 where that is negative */
} e3d_caster_light;

typedef struct e3d_caster_index {
    const e3d_caster_light *lights;
    int32_t light_count;
    const float (*world)[9];    /* of each caster the corners' x, y, z */
    const uint8_t *may_be_open; /* of each caster: whether its material has holes */
    /* Whether a caster that may be open is open at a hit with these weights (R101). */
    int (*is_open)(const struct e3d_caster_index *index, uint32_t caster, const float weight[3]);
    const void *source; /* for is_open */
} e3d_caster_index;

#endif
