/* raster with multisampling: large records, block by block in all planes. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/visible_records.inl"
#include "kernels/generic/msaa/msaa_planes_blocks.inl"

/* A record in the planes: its edge functions in each plane, and the planes in which it may show (a bit each). */
typedef struct msaa_piece {
    e3d_piece piece[E3D_MOST_MSAA_SAMPLES];
    raster_constants constants[E3D_MOST_MSAA_SAMPLES];
    uint32_t live;
    int tame;
} msaa_piece;

/* The cover of a vector of blocks in each plane, and its range of depths over all planes. */
typedef struct msaa_cover {
    visible_corners corners[E3D_MOST_MSAA_SAMPLES];
    uint32_t some[E3D_MOST_MSAA_SAMPLES];
    visible_cover all; /* some: in any plane; whole: in all planes */
    visible_range range;
} msaa_cover;

static inline void msaa_find_cover(const msaa_piece *p, int count, int first, msaa_cover *out)
{
    int32_t top = first / VISIBLE_BLOCKS * RASTER_BLOCK, left = first % VISIBLE_BLOCKS * RASTER_BLOCK;
    vi32 x = v_addi(v_seti(left), v_shl(rows_x(), 3)), y = v_addi(v_seti(top), v_shl(rows_y(), 3));
    int begun = 0;
    out->all = (visible_cover){0, setup_tail(V_LANES)};
    out->range = (visible_range){p->constants[0].zmin, p->constants[0].zmax};
    for (int s = 0; s < count; s++) {
        visible_cover cover = {0, 0};
        if (p->live >> s & 1)
            cover = visible_cover_of(&p->piece[s], x, y, left, top, &out->corners[s]);
        out->some[s] = cover.some;
        out->all.some |= cover.some;
        out->all.whole &= cover.whole;
    }
    for (int s = 0; s < count && p->tame && out->all.some; s++) {
        if (!(p->live >> s & 1))
            continue;
        visible_range range = visible_range_of(&p->piece[s], &p->constants[s], x, y);
        out->range.near = begun ? v_min(out->range.near, range.near) : range.near;
        out->range.far = begun ? v_max(out->range.far, range.far) : range.far;
        begun = 1;
    }
}

/* Draws a record into a block, in each plane, that shows nothing yet. */
static inline void msaa_fresh_block(const msaa_piece *p, const msaa_cover *cover, int count, int block, const e3d_record *r,
                                    e3d_visible_tile *planes, const e3d_record_table *table)
{
    for (int s = 0; s < count; s++) {
        if (cover->some[s] >> block % V_LANES & 1)
            visible_block(&p->piece[s], &p->constants[s], block, 1, &cover->corners[s], r, &planes[s], table);
        else
            msaa_clear_block(&planes[s], block);
    }
}

/* The edge functions of a plane in a block's first vector, from column x on; they are negative everywhere if the record
 * misses the plane. */
static ALWAYS_INLINE void msaa_corner(const msaa_piece *p, const msaa_cover *cover, int s, int lane, int x, vi32 e[3])
{
    const e3d_piece *piece = &p->piece[s];
    for (int k = 0; k < 3; k++)
        e[k] = p->live >> s & 1 ? v_addi(v_seti(cover->corners[s].e[k][lane] + piece->a[k] * x), rows_step(piece->a[k], piece->b[k]))
                                : v_seti(INT32_MIN / 2);
}

/* Draws a record into a block, in all planes side by side; the block's samples are written already. */
static ALWAYS_INLINE void msaa_block_of(const msaa_piece *p, const msaa_cover *cover, int block, const e3d_record *r,
                                        e3d_visible_tile *planes, const e3d_record_table *table, int count)
{
    /* Everything except the samples' offsets is the same in all planes */
    const e3d_piece *piece = &p->piece[__builtin_ctz(p->live)];
    int left = block % VISIBLE_BLOCKS * RASTER_BLOCK, top = block / VISIBLE_BLOCKS * RASTER_BLOCK;
    msaa_strip shared = {.zmin = p->constants[0].zmin, .zmax = p->constants[0].zmax};
    for (int k = 0; k < 3; k++)
        shared.down[k] = v_seti(ROWS * piece->b[k]);
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
        vi32 e[E3D_MOST_MSAA_SAMPLES][3];
        vf32 column[E3D_MOST_MSAA_SAMPLES];
        for (int s = 0; s < count; s++) {
            msaa_corner(p, cover, s, block % V_LANES, x, e[s]);
            column[s] = visible_column(&p->constants[s], left + x - piece->base_x);
        }
        for (int y = 0; y < RASTER_BLOCK; y += ROWS) {
            vf32 below = v_mul(v_float(v_addi(rows_y(), v_seti(top + y - piece->base_y))), p->constants[0].gy);
            msaa_all(&shared, e, column, below, (size_t)((top + y) * E3D_TILE + left + x), r, (int32_t)piece->slot, planes,
                     table, count);
        }
    }
}

static void msaa_block(const msaa_piece *p, const msaa_cover *cover, int count, int block, const e3d_record *r,
                       e3d_visible_tile *planes,
                       const e3d_record_table *table)
{
    if (count == 4) /* a constant for the compiler */
        msaa_block_of(p, cover, block, r, planes, table, 4);
    else
        msaa_block_of(p, cover, block, r, planes, table, count);
}

/* Draws a record into one vector of blocks. */
static inline void msaa_blocks(const msaa_piece *p, int first, const e3d_record *r, e3d_visible_tile *planes,
                               const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    const int count = pattern->count;
    msaa_cover cover;
    msaa_find_cover(p, count, first, &cover);
    if (!cover.all.some)
        return;
    const visible_range range = cover.range;
    vf32 zmin = v_loadf(planes->zmin + first), zmax = v_loadf(planes->zmax + first);
    uint32_t open = cover.all.some & ~v_bits(v_gt(range.near, zmax));
    uint32_t before = open & cover.all.whole & v_bits(v_lt(range.far, zmin)), rest = open & ~before;
    if (before)
        visible_note(before, first, &range, p->constants[0].slot, planes);
    if (!rest)
        return;
    float near[V_LANES];
    v_storef(near, range.near);
    uint32_t noted = rest & (uint32_t)(planes->noted >> first), fresh = noted & v_bits(v_negi(v_loadi(planes->noted_id + first)));
    /* Blocks that aren't stale can't be behind zmax */
    uint32_t unsure = rest & (uint32_t)(planes->stale >> first) & v_bits(v_gt(range.near, zmin));
    rest &= ~msaa_behind(unsure, first, near, planes, count);
    zmin = v_loadf(planes->zmin + first);
    v_storef(planes->zmin + first, v_self(visible_lanes(rest), v_min(range.near, zmin), zmin));
    planes->stale |= (uint64_t)rest << first;
    planes->noted &= ~((uint64_t)fresh << first);
    for (uint32_t some = fresh; some; some &= some - 1)
        msaa_fresh_block(p, &cover, count, first + __builtin_ctz(some), r, planes, table);
    for (uint32_t some = noted & ~fresh; some; some &= some - 1)
        msaa_unfold(planes, pattern, table, first + __builtin_ctz(some));
    for (uint32_t some = rest & ~fresh; some; some &= some - 1)
        msaa_block(p, &cover, count, first + __builtin_ctz(some), r, planes, table);
}

/* Finds an edge function in all planes. If it leaves out no sample of one plane but some of another, it is kept in both, so
 * that all planes step alike. A plane of which it leaves no sample is no longer live. */
static inline void msaa_find_edge(const e3d_record *r, int k, const e3d_visible_tile *planes, const e3d_sample_pattern *pattern,
                                  msaa_piece *out)
{
    e3d_edge edge[E3D_MOST_MSAA_SAMPLES];
    int crosses = 0;
    for (int s = 0; s < pattern->count; s++) {
        edge[s] = e3d_edge_beside(r, k, planes->x, planes->y, pattern->x[s], pattern->y[s]);
        if (!e3d_keep_edge(edge[s], k, &out->piece[s]))
            out->live &= ~(1u << s);
        else
            crosses |= out->piece[s].a[k] | out->piece[s].b[k];
    }
    for (uint32_t left = crosses ? out->live : 0; left; left &= left - 1) {
        int s = __builtin_ctz(left);
        out->piece[s].e[k] = (int32_t)edge[s].e;
        out->piece[s].a[k] = edge[s].a;
        out->piece[s].b[k] = edge[s].b;
    }
}

/* Finds a record in the planes of a tile; 0 if it misses all of them. */
static inline int msaa_find_piece(const records_lanes *in, int lane, const e3d_record *r, int32_t id,
                                  const e3d_visible_tile *planes,
                                  const e3d_sample_pattern *pattern, msaa_piece *out)
{
    out->live = (1u << pattern->count) - 1;
    out->tame = 1;
    for (int s = 0; s < pattern->count; s++) {
        e3d_piece *p = &out->piece[s];
        *p = (e3d_piece){.x0 = (int32_t)in->x0[lane],
                         .y0 = (int32_t)in->y0[lane],
                         .x1 = (int32_t)in->x1[lane],
                         .y1 = (int32_t)in->y1[lane],
                         .z0 = msaa_z0(r, pattern, s),
                         .gx = r->gx,
                         .gy = r->gy,
                         .slot = (uint32_t)id};
        p->base_x = msaa_first(r->x, pattern->reach) - planes->x;
        p->base_y = msaa_first(r->y, pattern->reach) - planes->y;
        out->constants[s] = msaa_constants(r, pattern, s, id);
        out->tame &= visible_is_tame(p);
    }
    for (int k = 0; k < 3 && out->live; k++)
        msaa_find_edge(r, k, planes, pattern, out);
    return out->live != 0;
}

/* Draws a record of any size block by block. */
static void msaa_wide(const records_lanes *in, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *planes,
                      const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    msaa_piece p;
    if (!msaa_find_piece(in, lane, r, id, planes, pattern, &p))
        return;
    for (int row = p.piece[0].y0 / RASTER_BLOCK & -ROWS; row <= p.piece[0].y1 / RASTER_BLOCK; row += ROWS)
        for (int block = 0; block < VISIBLE_BLOCKS; block += ROW_LANES)
            msaa_blocks(&p, row * VISIBLE_BLOCKS + block, r, planes, pattern, table);
}
