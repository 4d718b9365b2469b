/* The light of a cube as a tree: each cell sums up four cells of the next level. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "light/cube.h"
#include "kernels/types/lobe.h"

enum { E3D_TREE_LEVELS = 8,
       E3D_TREE_ROOT = 4 }; /* the root's groups are 4 x 4 on a face */

typedef struct e3d_tree_level {
    e3d_cell_group *groups; /* (6, size, size) */
    int32_t size;           /* groups along a face; the next level has twice as many */
} e3d_tree_level;

typedef struct e3d_light_tree {
    e3d_tree_level levels[E3D_TREE_LEVELS];
    int count;
} e3d_light_tree;

static inline const e3d_cell_group *e3d_group_at(const e3d_tree_level *level, int face, int32_t column, int32_t row)
{
    return &level->groups[((size_t)face * (size_t)level->size + (size_t)row) * (size_t)level->size + (size_t)column];
}

/* Returns 0 when memory is out; the tree must be freed in either case. */
int e3d_light_tree_create(const e3d_cube *cube, int threads, e3d_light_tree *out);
void e3d_light_tree_free(e3d_light_tree *tree);
