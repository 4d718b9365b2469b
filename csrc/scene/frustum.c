/* frustum: finds the boxes of a tree that may show. Out: a bit an item, and how many boxes were tested.
 * Method: planes by Gribb and Hartmann (2001), and the positive vertex of each box, four boxes at a time. A plane is not
 * tested again below a box that lies wholly inside it. The arithmetic is f32, with a slack proportional to the coordinates
 * that made the box; it is far greater than the rounding of the pictures' own f32 transform, so that nothing that shows is
 * lost. Every sum grows with the box, so that no parent's rounding loses a box. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/fpenv.h"
#include "scene/tree.h"

#define SLACK 4e-6
enum { ALL_PLANES = 63 };

typedef struct plane {
    e3d_v4 p[4];
    e3d_v4 slack[2];  /* a factor of the reach, and a constant */
    int positive[3];
} plane;

typedef struct entry {
    int32_t block;
    int level, planes; /* planes: a bit for each plane that is still tested */
} entry;

static void set_plane(plane *out, const double m[16], int axis, double sign, double widen)
{
    double p[4], scale = 0, alone = fabs(m[15]) + fabs(m[4 * axis + 3]);
    for (int k = 0; k < 4; k++)
        p[k] = widen * m[12 + k] + sign * m[4 * axis + k];
    for (int k = 0; k < 3; k++)
        scale += fabs(m[12 + k]) + fabs(m[4 * axis + k]);
    double by = scale > 0 && isfinite(scale) ? 1 / scale : 1;
    for (int k = 0; k < 4; k++)
        out->p[k] = e3d_v4_all((float)(p[k] * by));
    for (int k = 0; k < 3; k++)
        out->positive[k] = out->p[k][0] >= 0;
    out->slack[0] = e3d_v4_all((float)(SLACK * widen * scale * by));
    out->slack[1] = e3d_v4_all((float)(SLACK * widen * alone * by));
}

static void set_planes(plane planes[6], const double m[16], double widen)
{
    for (int axis = 0; axis < 3; axis++) {
        set_plane(&planes[2 * axis], m, axis, 1, axis < 2 ? widen : 1);
        set_plane(&planes[2 * axis + 1], m, axis, -1, axis < 2 ? widen : 1);
    }
}

/* Returns the plane's value at the boxes' corners that lie farthest inside it, or at those that lie least inside. */
static inline e3d_v4 value_at(const plane *p, const e3d_block *b, int farthest)
{
    e3d_v4 m[3];
    for (int k = 0; k < 3; k++)
        m[k] = p->p[k] * (p->positive[k] == farthest ? b->high[k] : b->low[k]);
    return ((m[0] + m[1]) + m[2]) + p->p[3];
}

/* Return the lanes that are outside the plane, and those that are wholly inside. */
static inline int outside(const plane *p, const e3d_block *b)
{
    return lanes_of(value_at(p, b, 1) < -(p->slack[0] * b->reach + p->slack[1])); /* false for NaN: the box is kept */
}
static inline int inside(const plane *p, const e3d_block *b) { return lanes_of(value_at(p, b, 0) >= 0); }

static void select_item(int32_t item, uint64_t *bits) { bits[item >> 6] |= (uint64_t)1 << (item & 63); }

/* Marks everything below a box: a run of leaves, without those that have no box now. */
static void select_run(const e3d_tree *t, int32_t block, int level, uint64_t *bits)
{
    enum { AHEAD = 8 };
    int64_t first = (int64_t)block << 2 * level, end = first + ((int64_t)1 << 2 * level);
    const e3d_block *leaves = e3d_tree_level(t, 0);
    const int32_t *items = t->items.data;
    for (int64_t b = first; b < end && b < t->blocks_in[0]; b++) {
        __builtin_prefetch((const void *)((uintptr_t)leaves + (uintptr_t)(b + AHEAD) * sizeof *leaves));
        int there = lanes_of(leaves[b].low[0] <= leaves[b].high[0]);
        for (int lane = 0; lane < 4; lane++)
            if (there >> lane & 1)
                select_item(items[4 * b + lane], bits);
    }
}

/* Return how many boxes they test. */
static int visit_leaf(const e3d_tree *t, const plane planes[6], entry at, uint64_t *bits)
{
    const e3d_block *b = e3d_tree_level(t, 0) + at.block;
    const int32_t *items = (const int32_t *)t->items.data + 4 * (size_t)at.block;
    int there = lanes_of(b->low[0] <= b->high[0]), tested = __builtin_popcount((unsigned)there);
    for (int left = at.planes; left; left &= left - 1)
        there &= ~outside(&planes[__builtin_ctz(left)], b);
    for (; there; there &= there - 1)
        select_item(items[__builtin_ctz(there)], bits);
    return tested;
}

/* Prefetches the blocks below one, which are neighbours; the last may not exist, which does no harm. */
static void fetch_below(const e3d_tree *t, entry at)
{
    enum { LINE = 64 };
    uintptr_t first = (uintptr_t)e3d_tree_level(t, at.level - 1) + 4 * (uintptr_t)at.block * sizeof(e3d_block);
    for (uintptr_t line = 0; line < 4 * sizeof(e3d_block); line += LINE)
        __builtin_prefetch((const void *)(first + line));
}

static int visit(const e3d_tree *t, const plane planes[6], entry at, uint64_t *bits, entry *stack, int *top)
{
    const e3d_block *b = e3d_tree_level(t, at.level) + at.block;
    fetch_below(t, at);
    int there = lanes_of(b->low[0] <= b->high[0]), out = ~there, within[4] = {0};
    for (int i = 0; i < 6; i++)
        if (at.planes >> i & 1) {
            int whole = inside(&planes[i], b);
            out |= outside(&planes[i], b);
            for (int lane = 0; lane < 4; lane++)
                within[lane] |= (whole >> lane & 1) << i;
        }
    for (int lane = 0; lane < 4; lane++) {
        int left = at.planes & ~within[lane];
        if (out >> lane & 1)
            continue;
        if (left == 0)
            select_run(t, 4 * at.block + lane, at.level - 1, bits);
        else
            stack[(*top)++] = (entry){4 * at.block + lane, at.level - 1, left};
    }
    return __builtin_popcount((unsigned)there);
}

static int select_loose(const e3d_tree *t, const plane planes[6], const double *boxes, uint64_t *bits)
{
    const int32_t *loose = t->loose.data;
    int tested = 0;
    for (size_t i = 0; i < t->loose.count; i++) {
        e3d_block b;
        int out = 0;
        for (int lane = 0; lane < 4; lane++)
            e3d_block_set(&b, lane, boxes + E3D_BOX * (size_t)loose[i]);
        for (int k = 0; k < 6; k++)
            out |= outside(&planes[k], &b);
        int there = b.low[0][0] <= b.high[0][0];
        if (!(out & 1) && there)
            select_item(loose[i], bits);
        tested += there;
    }
    return tested;
}

/* Walks down the tree; a branch ends at a box that is outside or wholly inside. */
static int64_t select_by_branches(const e3d_tree *t, const plane planes[6], uint64_t *bits)
{
    entry stack[E3D_TREE_STACK];
    int64_t tested = 0;
    int top = 0;
    if (t->levels)
        stack[top++] = (entry){0, t->levels - 1, ALL_PLANES};
    while (top) {
        entry at = stack[--top];
        if (at.level == 0)
            tested += visit_leaf(t, planes, at, bits);
        else
            tested += visit(t, planes, at, bits, stack, &top);
    }
    return tested;
}

static int64_t select_one_by_one(const e3d_tree *t, const plane planes[6], uint64_t *bits)
{
    int64_t tested = 0;
    for (int32_t b = 0; t->levels && b < t->blocks_in[0]; b++)
        tested += visit_leaf(t, planes, (entry){b, 0, ALL_PLANES}, bits);
    return tested;
}

int64_t e3d_tree_select(const e3d_tree *t, const double *boxes, const e3d_view_volume *view, uint64_t *bits)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    plane planes[6];
    set_planes(planes, view->clip_from_world, view->widen);
    int64_t tested = view->flat ? select_one_by_one(t, planes, bits) : select_by_branches(t, planes, bits);
    tested += select_loose(t, planes, boxes, bits);
    e3d_fpenv_leave(saved);
    return tested;
}
