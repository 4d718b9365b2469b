/* levels: the boxes of a tree, level by level, for programs that show them. */
#include "scene/tree.h"

int e3d_tree_levels(const e3d_tree *t) { return t->levels; }

int32_t e3d_tree_level_boxes(const e3d_tree *t, int level, float *boxes)
{
    const e3d_block *blocks = e3d_tree_level(t, level);
    int32_t count = 0;
    for (int32_t b = 0; b < t->blocks_in[level]; b++)
        for (int lane = 0; lane < 4; lane++) {
            if (!(blocks[b].low[0][lane] <= blocks[b].high[0][lane]))
                continue; /* there is none */
            for (int k = 0; boxes && k < 3; k++) {
                boxes[6 * (size_t)count + k] = blocks[b].low[k][lane];
                boxes[6 * (size_t)count + 3 + k] = blocks[b].high[k][lane];
            }
            count++;
        }
    return count;
}
