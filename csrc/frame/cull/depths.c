/* cull, by depth: notes the farthest depth of each block of 8 x 8 samples of a tile. A box is hidden if it is strictly behind
 * all samples that it may touch: behind each block (Greene, Kass and Miller 1993), or else behind each column of a block. */
#include <string.h>

#include "base/vectors.h"
#include "kernels/coverage.h"
#include "frame/cull/depths.h"

enum { BLOCKS = E3D_TILE / E3D_BLOCK };
_Static_assert(BLOCKS == 8 && E3D_BLOCK == 8, "a row of blocks and the columns of a block are compared eight at a time");

#define NOTHING 4.0f /* greater than any depth: nothing else of the tile is noted */

/* ---- what is noted ---- */

static float farthest(const e3d_visible_tile *visible)
{
    float4 most = load4(visible->zmax);
    for (int block = 4; block < E3D_TILE_BLOCKS; block += 4)
        most = more_of(most, load4(visible->zmax + block));
    float a = most[0] > most[1] ? most[0] : most[1], b = most[2] > most[3] ? most[2] : most[3];
    return a > b ? a : b;
}

void e3d_note_depths(const e3d_kernels *kernels, int planes, e3d_visible_tile *visible, e3d_tile_depths *out)
{
    if (planes > 1)
        kernels->msaa_measure(visible, planes, out->columns);
    else
        kernels->raster_measure(visible, out->columns);
    memcpy(out->zmax, visible->zmax, sizeof out->zmax);
    out->noted = visible->noted;
    out->most = farthest(visible);
}

void e3d_depths_clear(e3d_tile_depths *depths) { depths->most = NOTHING; }

/* ---- a box against what is drawn ---- */

/* The bits of eight columns from the first to the last. */
static unsigned from_to(int first, int last) { return (2u << last) - (1u << first); }

/* Which of eight depths are nearer: a bit each. */
static unsigned nearer_than(const float depths[8], float near)
{
    return (unsigned)(lanes_of(load4(depths) < splat(near)) | lanes_of(load4(depths + 4) < splat(near)) << 4);
}

/* Whether all columns of a block that a box of samples touches are nearer than the box. */
static int block_is_nearer(const e3d_tile_depths *depths, int block, const e3d_box *samples, float near)
{
    int left = block % BLOCKS * E3D_BLOCK, right = left + E3D_BLOCK - 1;
    unsigned columns = from_to(samples->x0 > left ? samples->x0 - left : 0, (samples->x1 < right ? samples->x1 : right) - left);
    return !(columns & ~nearer_than(depths->columns[block], near));
}

/* Whether the column in the box's middle already shows that the box isn't hidden. */
static int is_open(const e3d_tile_depths *depths, const e3d_box *box, float near)
{
    int x = (box->x0 + box->x1) / 2, y = (box->y0 + box->y1) / 2, block = y / E3D_BLOCK * BLOCKS + x / E3D_BLOCK;
    return !(near > (depths->noted >> block & 1 ? depths->zmax[block] : depths->columns[block][x % E3D_BLOCK]));
}

/* Whether all samples of a box in a tile are nearer, by the columns of the tile's blocks. */
static int is_behind(const e3d_tile_depths *depths, const e3d_box *samples, float near)
{
    const e3d_box blocks = e3d_blocks_of(samples);
    uint64_t unsure = 0;
    if (near > depths->most)
        return 1;
    if (depths->most == NOTHING)
        return 0;
    for (int y = blocks.y0; y <= blocks.y1; y++)
        unsure |= (uint64_t)(from_to(blocks.x0, blocks.x1) & ~nearer_than(depths->zmax + y * BLOCKS, near)) << (y * BLOCKS);
    if (!unsure)
        return 1;
    if (unsure & depths->noted || is_open(depths, samples, near))
        return 0;
    for (; unsure; unsure &= unsure - 1)
        if (!block_is_nearer(depths, __builtin_ctzll(unsure), samples, near))
            return 0;
    return 1;
}

int e3d_is_hidden(const e3d_tile_depths *depths, int32_t tiles_x, const e3d_box_view *view)
{
    const e3d_box *s = &view->samples;
    for (int32_t ty = s->y0 / E3D_TILE; ty <= s->y1 / E3D_TILE; ty++)
        for (int32_t tx = s->x0 / E3D_TILE; tx <= s->x1 / E3D_TILE; tx++) {
            const e3d_box within = {e3d_in_tile(s->x0 - tx * E3D_TILE), e3d_in_tile(s->y0 - ty * E3D_TILE),
                                    e3d_in_tile(s->x1 - tx * E3D_TILE), e3d_in_tile(s->y1 - ty * E3D_TILE)};
            if (!is_behind(&depths[(int64_t)ty * tiles_x + tx], &within, view->near))
                return 0;
        }
    return 1;
}
