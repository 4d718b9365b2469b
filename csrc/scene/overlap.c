/* overlap: finds the boxes of a tree that meet a box. Out: a bit an item; touching counts. */
#include "base/fpenv.h"
#include "scene/tree.h"

typedef struct entry {
    int32_t block;
    int level;
} entry;

void e3d_tree_overlaps(const e3d_tree *t, const double low[3], const double high[3], uint64_t *bits)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    const double box[E3D_BOX] = {low[0], low[1], low[2], high[0], high[1], high[2], 0};
    const int32_t *items = t->items.data;
    entry stack[E3D_TREE_STACK];
    int top = 0;
    e3d_block q;
    for (int lane = 0; lane < 4; lane++)
        e3d_block_set(&q, lane, box);
    if (t->levels)
        stack[top++] = (entry){0, t->levels - 1};
    while (top) {
        entry at = stack[--top];
        const e3d_block *b = e3d_tree_level(t, at.level) + at.block;
        int lanes = lanes_of(b->low[0] <= b->high[0]); /* an endless box meets every box, but not an empty one */
        for (int k = 0; k < 3; k++)
            lanes &= lanes_of((b->low[k] <= q.high[k]) & (b->high[k] >= q.low[k]));
        for (int lane = 0; lane < 4; lane++) {
            int32_t below = 4 * at.block + lane;
            if (!(lanes >> lane & 1))
                continue;
            if (at.level)
                stack[top++] = (entry){below, at.level - 1};
            else
                bits[items[below] >> 6] |= (uint64_t)1 << (items[below] & 63);
        }
    }
    e3d_fpenv_leave(saved);
}
