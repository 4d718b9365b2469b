/* The tree of casters, for soft lights: rays to all points of their discs go through it together (R196-R198). */
#pragma once

#include "base/grow.h"
#include "kernels/types/casters.h"
#include "frame/cast/faces.h"

typedef struct e3d_tree_memory {
    e3d_array nodes;   /* e3d_caster_node */
    e3d_array casters; /* uint32_t: by leaf */
} e3d_tree_memory;

/* Makes the tree; 0 when memory is out. */
int e3d_find_caster_tree(const e3d_caster_faces *faces, e3d_tree_memory *memory, e3d_caster_tree *out);
