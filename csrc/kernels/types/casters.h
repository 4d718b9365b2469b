/* The casters of exact shadows: triangles, and for each light grids that find which of them may lie over a sample
 * (docs/exactness, section 17). */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "e3d.h"

enum {
    E3D_CASTER_LEVELS = 11, /* so there are at most 1024 cells a side */
    E3D_CASTER_FACES = 6    /* of a cube around a point light */
};

/* The box of a caster in the plane of a light: it may lie over samples in this box that are farther away than `near`. */
typedef struct e3d_caster_box {
    float near, low[2], high[2];
    uint32_t caster;
} e3d_caster_box;

/* Casters by their place: level l has 2^(levels - 1 - l) cells a side. A caster is in the finest level in which it touches at
 * most two cells along each axis. Large casters, which are few, are two levels finer, in just the cells that they touch. */
typedef struct e3d_caster_grid {
    float low[2], high[2];
    float scale[2]; /* cells of level 0 in a unit */
    float near;     /* of all boxes */
    int32_t levels; /* 0: there are no casters */
    uint32_t filled; /* a bit for each level that has casters */
    /* For each level the starts of its cells, row by row, and the end of the last cell */
    const uint32_t *starts[E3D_CASTER_LEVELS];
    const e3d_caster_box *boxes;               /* the boxes of each cell, the near ones first */
} e3d_caster_grid;

/* A light that casts exact shadows. */
typedef struct e3d_caster_light {
    int32_t number;         /* the number among the frame's lights */
    int32_t axis;           /* directional: k of R98 */
    float slope[2];         /* likewise */
    const float (*corners)[9]; /* for each caster x, y and z of R98, three of each; point light: v - L, not turned to a face */
    e3d_caster_grid grids[E3D_CASTER_FACES]; /* directional: the first one; else by 2 * axis, and + 1 where that is negative */
} e3d_caster_light;

/* A node of the tree of casters, whose nodes lie in the order of a walk: a node's first child follows it. A leaf has `count`
 * casters, from `first` on in the list of the tree. */
typedef struct e3d_caster_node {
    float low[3], high[3];
    uint32_t next;  /* the node behind all that is below this one */
    uint32_t first; /* of a leaf: first << E3D_CASTER_COUNT_BITS | count; else 0 */
} e3d_caster_node;

enum { E3D_CASTER_COUNT_BITS = 3 };

/* The casters by their place in the world, for soft lights. */
typedef struct e3d_caster_tree {
    const e3d_caster_node *nodes;
    uint32_t node_count;
    const uint32_t *casters;
} e3d_caster_tree;

typedef struct e3d_caster_index {
    const e3d_caster_light *lights;
    int32_t light_count;
    int32_t soft_lights; /* how many of them are soft: these have no grids, but the tree */
    e3d_caster_tree tree;
    const float (*world)[9];    /* for each caster the corners' x, y, z */
    const uint8_t *may_be_open; /* for each caster whether its material has holes */
    const uint8_t *is_mirrored; /* for each caster whether its instance's matrix mirrors */
    /* Whether a caster with holes is open at a hit with these weights (R101). */
    int (*is_open)(const struct e3d_caster_index *index, uint32_t caster, const float weight[3]);
    int any_spared; /* not 0: some casters do not shadow some lights */
    int (*is_spared)(const struct e3d_caster_index *index, uint32_t caster, int32_t exact);
    /* The mesh that a caster belongs to. */
    const void *(*mesh_of)(const struct e3d_caster_index *index, uint32_t caster);
    const void *source; /* for these functions */
} e3d_caster_index;
