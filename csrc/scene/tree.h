/* A tree of boxes: what culling, rays and overlaps walk; the same for nodes, instances and triangles.
 *
 * Items stand in the order of a Hilbert curve. Four neighbours are a block; the boxes of four blocks are a
 * block of the level above, up to one block. A child's number follows from its parent's, so there are no
 * pointers, and everything below a box is one run of items.
 */
#pragma once

#include "base/grow.h"
#include "base/vectors.h"
#include "e3d_scene.h"

enum { E3D_TREE_LEVELS = 16,
       E3D_TREE_STACK = 3 * E3D_TREE_LEVELS + 1 };

typedef float e3d_v4 __attribute__((vector_size(16)));
typedef int32_t e3d_v4i __attribute__((vector_size(16)));

/* Four boxes, rounded outwards; lowest > highest where there is none. */
typedef struct e3d_block {
    e3d_v4 low[3], high[3];
    e3d_v4 reach; /* the largest coordinate that made the box: what rounding is measured by */
} e3d_block;

struct e3d_tree {
    e3d_array blocks;                     /* e3d_block, level after level, the leaves first */
    e3d_array items;                      /* int32_t: which item stands at a position */
    e3d_array places;                     /* int32_t: at which position an item stands; -1: nowhere */
    e3d_array loose;                      /* int32_t: items that came after the tree was built */
    e3d_array keys, keys_too;             /* uint64_t and below: scratch of building */
    e3d_array dirty;                      /* int32_t: scratch of refitting */
    e3d_array marks;                      /* uint8_t: a mark per block, 0 between calls */
    int32_t count;                        /* positions that hold items */
    int32_t levels;
    int32_t first[E3D_TREE_LEVELS], blocks_in[E3D_TREE_LEVELS]; /* of each level */
    int32_t refits;                       /* since it was built */
    double cost, built_cost;              /* the sum of the boxes' half areas, above the leaves */
};

static inline e3d_block *e3d_tree_level(const e3d_tree *tree, int level)
{
    return (e3d_block *)tree->blocks.data + tree->first[level];
}

/* Writes one box into a lane of a block. */
void e3d_block_set(e3d_block *block, int lane, const double box[E3D_BOX]);

static inline e3d_v4 e3d_v4_all(float value) { return (e3d_v4){value, value, value, value}; }
