/* What rough mirrors show of an environment (R68): light from l counts D(h) (n.l), GGX's D of the half vector h of n and l, as the
 * split sum takes it (Karis, Real Shading in Unreal Engine 4, 2013: the mirror is seen along its normal).
 *
 * The lobe is summed over cells of a tree of light, the smaller the nearer to its middle, where it changes faster: some hundred for
 * each texel. Four by four texels, which lie close together, take the same cells.
 */
#include <math.h>
#include <string.h>

#include "base/pool.h"
#include "light/prefilter.h"
#include "kernels/kernels.h"
#include "kernels/types/lobe.h"

enum {
    BLOCK = 4, /* texels along a side */
    TEXELS = E3D_LOBE_TEXELS,
    SMALL = 32, /* texels of a face */
    GROUPS_IN_A_ROW = 16 /* whose sums are f32 */
};
/* The greatest width of a cell, over the lobe's width there. Small levels, whose wide lobes show all of the light, use less. */
#define COARSE 0.5f
#define FINE 0.05f

/* GGX's lobe: D and the width of its middle. */
typedef struct lobe {
    float square, rest, width; /* alpha^2 and 1 - alpha^2 */
    float fineness;
    const e3d_kernels *kernels;
    const e3d_light_tree *tree;
    const e3d_cube *out;
} lobe;

typedef struct block {
    const lobe *lobe;
    float middle[3], radius;
    e3d_lobe_block texels;
    double totals[E3D_LOBE_SUMS][TEXELS];
    int groups;
} block;

static float distance(const float a[3], const float b[3])
{
    float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrtf((x * x + y * y) + z * z);
}

static void begin(const lobe *lobe, int face, int32_t column, int32_t row, block *out)
{
    int32_t size = lobe->out->size;
    double half = (double)BLOCK / size, p = e3d_cube_middle(size, column) - 1.0 / size, q = e3d_cube_middle(size, row) - 1.0 / size;
    memset(out, 0, sizeof *out);
    out->lobe = lobe;
    out->texels.square = lobe->square;
    out->texels.rest = lobe->rest;
    e3d_cube_unit(face, p + half, q + half, out->middle);
    for (int t = 0; t < TEXELS; t++) {
        float n[3], radius;
        e3d_cube_unit(face, e3d_cube_middle(size, column + t % BLOCK), e3d_cube_middle(size, row + t / BLOCK), n);
        for (int k = 0; k < 3; k++)
            out->texels.normal[k][t] = n[k];
        radius = distance(n, out->middle);
        out->radius = radius > out->radius ? radius : out->radius;
    }
}

/* Moves the sums into wider ones, so that they lose no bits. */
static void settle(block *b)
{
    for (int k = 0; k < E3D_LOBE_SUMS; k++)
        for (int t = 0; t < TEXELS; t++) {
            b->totals[k][t] += (double)b->texels.sums[k][t];
            b->texels.sums[k][t] = 0.0f;
        }
    b->groups = 0;
}

static void add_group(block *b, const e3d_cell_group *group)
{
    b->lobe->kernels->lobe(group, &b->texels);
    if (++b->groups == GROUPS_IN_A_ROW)
        settle(b);
}

/* Adds a group; cells that are too large for the lobe are replaced by their four finer cells. */
static void visit(block *b, int level, int face, int32_t column, int32_t row)
{
    const e3d_light_tree *tree = b->lobe->tree;
    const e3d_tree_level *here = &tree->levels[level];
    const e3d_cell_group *group = e3d_group_at(here, face, column, row);
    float cell = 1.0f / (float)here->size; /* the widest */
    float away = distance(group->middle, b->middle), near = away - (b->radius + 1.5f * cell);
    if (near > 1.4143f) /* below the horizon of all */
        return;
    near = near > 0.0f ? near : 0.0f;
    if (level == tree->count - 1 || cell <= b->lobe->fineness * (b->lobe->width + near)) {
        add_group(b, group);
        return;
    }
    for (int32_t part = 0; part < E3D_CELLS; part++)
        visit(b, level + 1, face, 2 * column + (part & 1), 2 * row + (part >> 1));
}

static void finish(block *b, int face, int32_t column, int32_t row)
{
    settle(b);
    for (int t = 0; t < TEXELS; t++) {
        float *out = e3d_cube_texel(b->lobe->out, face, column + t % BLOCK, row + t / BLOCK);
        for (int k = 0; k < 3; k++)
            out[k] = (float)(b->totals[k][t] / b->totals[3][t]);
        out[3] = 0.0f;
    }
}

static void filter_row(void *argument, int number)
{
    const lobe *lobe = argument;
    int32_t rows = lobe->out->size / BLOCK, face = number / rows, row = number % rows * BLOCK;
    for (int32_t column = 0; column < lobe->out->size; column += BLOCK) {
        block b;
        begin(lobe, face, column, row, &b);
        for (int from = 0; from < E3D_FACES; from++)
            for (int32_t root = 0; root < E3D_TREE_ROOT * E3D_TREE_ROOT; root++)
                visit(&b, 0, from, root % E3D_TREE_ROOT, root / E3D_TREE_ROOT);
        finish(&b, face, column, row);
    }
}

void e3d_prefilter(const e3d_light_tree *tree, double roughness, int threads, const e3d_cube *out)
{
    double alpha = roughness * roughness;
    lobe lobe = {.square = (float)(alpha * alpha),
                 .rest = (float)(1.0 - alpha * alpha),
                 .width = (float)(2.0 * alpha),
                 .fineness = out->size > SMALL ? COARSE : FINE,
                 .kernels = e3d_kernels_for(e3d_backend_best()),
                 .tree = tree,
                 .out = out};
    e3d_pool_share(threads, E3D_FACES * out->size / BLOCK, filter_row, &lobe);
    e3d_cube_fill_border(out);
}
