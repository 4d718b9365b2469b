/* cast: the tree of casters. A box is split in the middle of its casters' middles, along its longest axis, until few casters are
 * left. What rays hit doesn't depend on the tree, since boxes hold their casters to the bit. */
#include "frame/cast/tree.h"

#include <math.h>

enum {
    MOST_OF_LEAF = 4,
    MOST_UNEVEN = 40 /* so many levels may be split in space; below, casters are split in halves */
};

typedef struct builder {
    const float (*world)[9];
    e3d_caster_node *nodes;
    uint32_t count, *casters;
} builder;

typedef struct box {
    float low[3], high[3];
} box;

static const box NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void hold(box *b, int axis, float v)
{
    b->low[axis] = v < b->low[axis] ? v : b->low[axis];
    b->high[axis] = v > b->high[axis] ? v : b->high[axis];
}

/* Where a caster is along an axis, for choosing only: 3/4 of its middle. */
static float middle_of(const builder *b, uint32_t caster, int axis)
{
    const float *w = b->world[caster];
    return w[axis] * 0.25f + w[3 + axis] * 0.25f + w[6 + axis] * 0.25f; /* cannot overflow */
}

static int is_finite(const float corners[9])
{
    float sum = 0.0f;
    for (int k = 0; k < 9; k++)
        sum += corners[k] - corners[k]; /* 0, or a NaN */
    return sum == 0.0f;
}

static int longest_axis(const box *b)
{
    int axis = 0;
    for (int c = 1; c < 3; c++)
        if (b->high[c] - b->low[c] > b->high[axis] - b->low[axis])
            axis = c;
    return axis;
}

/* Moves the casters below a middle to the front; returns how many. */
static uint32_t part(const builder *b, uint32_t first, uint32_t end, int axis, float middle)
{
    uint32_t at = first;
    for (uint32_t i = first; i < end; i++) {
        uint32_t caster = b->casters[i];
        if (!(middle_of(b, caster, axis) < middle))
            continue;
        b->casters[i] = b->casters[at];
        b->casters[at++] = caster;
    }
    return at - first;
}

static void build(builder *b, uint32_t first, uint32_t end, int level)
{
    box own = NOTHING, middles = NOTHING;
    e3d_caster_node *node = &b->nodes[b->count++];
    for (uint32_t i = first; i < end; i++)
        for (int c = 0; c < 3; c++) {
            for (int v = 0; v < 3; v++)
                hold(&own, c, b->world[b->casters[i]][3 * v + c]);
            hold(&middles, c, middle_of(b, b->casters[i], c));
        }
    for (int c = 0; c < 3; c++) {
        node->low[c] = own.low[c];
        node->high[c] = own.high[c];
    }
    if (end - first <= MOST_OF_LEAF) {
        node->first = first << E3D_CASTER_COUNT_BITS | (end - first);
    } else {
        int axis = longest_axis(&middles);
        uint32_t count = level < MOST_UNEVEN ? part(b, first, end, axis, 0.5f * middles.low[axis] + 0.5f * middles.high[axis]) : 0;
        if (count == 0 || count == end - first)
            count = (end - first) / 2;
        node->first = 0;
        build(b, first, first + count, level + 1);
        build(b, first + count, end, level + 1);
    }
    node->next = b->count;
}

int e3d_find_caster_tree(const e3d_caster_faces *faces, e3d_tree_memory *memory, e3d_caster_tree *out)
{
    size_t most = (size_t)faces->count;
    *out = (e3d_caster_tree){0};
    if (most >= (size_t)1 << (32 - E3D_CASTER_COUNT_BITS) || !e3d_array_reserve(&memory->casters, most + 1, sizeof(uint32_t)) ||
        !e3d_array_reserve(&memory->nodes, 2 * most + 1, sizeof(e3d_caster_node)))
        return 0;
    builder b = {faces->world.data, memory->nodes.data, 0, memory->casters.data};
    uint32_t count = 0;
    for (uint32_t n = 0; n < (uint32_t)most; n++)
        if (is_finite(b.world[n]))
            b.casters[count++] = n;
    if (count)
        build(&b, 0, count, 0);
    *out = (e3d_caster_tree){b.nodes, b.count, b.casters};
    return 1;
}
