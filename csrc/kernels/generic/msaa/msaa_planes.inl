/* raster with multisampling: draws small records in strips, and does what concerns all planes of a tile. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/record.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/visible_records.inl"
#include "kernels/generic/msaa/msaa_planes_blocks.inl"
#include "kernels/generic/msaa/msaa_planes_wide.inl"

/* ---- small records, in strips ---- */

/* A vector of records, with their edge functions in each plane. */
typedef struct msaa_lanes {
    records_lanes in;
    int32_t e[E3D_MOST_MSAA_SAMPLES][3][V_LANES];
} msaa_lanes;

/* Finds an edge function in each plane; returns where it is greatest. */
static inline record_edge msaa_edge(const vi32 corners[6], int k, const vi32 first[2], const e3d_visible_tile *planes,
                                    const e3d_sample_pattern *pattern, msaa_lanes *out)
{
    vi32 half = v_seti(128);
    vi32 px = v_addi(v_shl(v_addi(first[0], v_seti(planes->x)), 8), half), py = v_addi(v_shl(v_addi(first[1], v_seti(planes->y)), 8), half);
    record_edge e = record_edge_of(corners, corners + 3, k, v_seti(0), px, py);
    vi32 most = v_seti(INT32_MIN), back = v_addi(v_muli(e.a, first[0]), v_muli(e.b, first[1]));
    for (int s = 0; s < pattern->count; s++) {
        vi32 moved = v_addi(e.c, v_addi(v_muli(e.a, v_seti(pattern->x[s])), v_muli(e.b, v_seti(pattern->y[s]))));
        vi32 at = v_subi(v_sra(moved, 8), back);
        v_storei(out->e[s][k], at);
        most = v_maxi(most, at);
    }
    e.c = most;
    return e;
}

static inline void msaa_find(const e3d_record *const r[V_LANES], const e3d_visible_tile *planes,
                             const e3d_sample_pattern *pattern,
                             msaa_lanes *out)
{
    vi32 corners[8], first[2];
    record_edge e[3];
    v_load_rows((const void *const *)r, corners);
    records_boxes(corners, corners + 3, planes, pattern->reach, first, &out->in);
    for (int k = 0; k < 3; k++) {
        e[k] = msaa_edge(corners, k, first, planes, pattern, out);
        records_keep_edge(&e[k], k, &out->in);
    }
    records_rows(e, &out->in);
}

/* Draws a record in strips, as records_strips does, in all planes side by side. */
static ALWAYS_INLINE void msaa_strips_of(const msaa_lanes *lanes, int lane, const e3d_record *r, int32_t id,
                                         e3d_visible_tile *planes,
                                         const e3d_sample_pattern *pattern, const e3d_record_table *table, int count)
{
    const records_lanes *in = &lanes->in;
    msaa_strip shared = {.zmin = v_setf(r->zmin), .zmax = v_setf(r->zmax)};
    vf32 gx = v_setf(r->gx), gy = v_setf(r->gy);
    vf32 along = v_add(v_float(rows_x()), v_setf(in->dx[lane])), z0[E3D_MOST_MSAA_SAMPLES];
    for (int s = 0; s < count; s++)
        z0[s] = v_setf(msaa_z0(r, pattern, s));
    for (int strip = 0; strip <= in->strips[lane]; strip++) {
        size_t i = records_sample(in->from[strip][lane]);
        vi32 at = v_addi(v_seti((int32_t)in->from[strip][lane]), v_ori(rows_x(), v_shl(rows_y(), RECORDS_DOWN)));
        vf32 row = v_add(v_float(rows_y()), v_setf(in->row[strip][lane])), step = v_mul(along, gx), column[E3D_MOST_MSAA_SAMPLES];
        vi32 e[E3D_MOST_MSAA_SAMPLES][3], from[3];
        for (int k = 0; k < 3; k++) {
            from[k] = v_madd16(v_seti(in->steps[k][lane]), at);
            shared.down[k] = v_seti(in->down[k][lane]);
        }
        for (int s = 0; s < count; s++) {
            column[s] = v_add(z0[s], step);
            for (int k = 0; k < 3; k++)
                e[s][k] = v_addi(v_seti(lanes->e[s][k][lane]), from[k]);
        }
        for (int32_t left = in->vectors[strip][lane]; left > 0; left--, i += ROWS * E3D_TILE) {
            vf32 below = v_mul(row, gy);
            msaa_all(&shared, e, column, below, i, r, id, planes, table, count);
            row = v_add(row, v_setf(ROWS));
        }
        along = v_add(along, v_setf(ROW_LANES));
    }
}

/* Mostly there are four samples, which is then a constant for the compiler. */
static void msaa_strips(const msaa_lanes *lanes, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *planes,
                        const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    if (pattern->count == 4)
        msaa_strips_of(lanes, lane, r, id, planes, pattern, table, 4);
    else
        msaa_strips_of(lanes, lane, r, id, planes, pattern, table, pattern->count);
}

/* Draws a record, unless the visible surface hides it (see records_draw). */
static inline void msaa_draw(msaa_lanes *lanes, int lane, const e3d_record *r, int32_t id, uint64_t open,
                             records_touched *touched,
                             e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    const records_lanes *in = &lanes->in;
    uint64_t met = records_met(in, lane);
    int strips = in->few >> lane & 1; /* for larger ones, blocks need not be written in each plane */
    if (!(strips && met & open) && !(met & ~records_behind(r->zmin, planes)))
        return;
    if (!strips) {
        records_tell(touched, planes);
        msaa_wide(in, lane, r, id, planes, pattern, table);
        return;
    }
    for (uint64_t left = met & planes->noted; left; left &= left - 1)
        msaa_unfold(planes, pattern, table, __builtin_ctzll(left));
    touched->met |= met;
    touched->near = r->zmin < touched->near ? r->zmin : touched->near;
    msaa_strips(lanes, lane, r, id, planes, pattern, table);
}

static void kernel_raster_msaa(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table,
                               const uint32_t *ids, int count)
{
    const e3d_record *r[V_LANES];
    uint32_t turned[V_LANES];
    msaa_lanes lanes;
    records_touched touched = {0, E3D_BEYOND_FAR};
    uint64_t open = ~records_behind(1.0f, planes);
    for (int i = 0; i < count; i += V_LANES) {
        int some = count - i < V_LANES ? count - i : V_LANES;
        const uint32_t *id = records_next(table, ids + i, count - i, turned, r);
        msaa_find(r, planes, pattern, &lanes);
        for (int l = 0; l < some; l++)
            msaa_draw(&lanes, l, r[l], (int32_t)id[l], open, &touched, planes, pattern, table);
    }
    records_tell(&touched, planes);
}

/* ---- all planes of a tile ---- */

static void kernel_msaa_settle(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    for (uint64_t left = planes->noted; left; left &= left - 1)
        msaa_unfold(planes, pattern, table, __builtin_ctzll(left));
}

static void kernel_msaa_measure(e3d_visible_tile *planes, int count, float columns[][E3D_BLOCK])
{
    for (uint64_t left = ~planes->noted; left; left &= left - 1) {
        int block = __builtin_ctzll(left);
        msaa_columns(planes, count, block, columns[block]);
        visible_bound(planes, block, columns[block]);
    }
}

/* The mixed pixels of a row, a bit each; `shared` gets the IDs of the others. */
static inline uint64_t msaa_row(const e3d_visible_tile *planes, int count, int row, int32_t *shared)
{
    uint64_t mixed = 0;
    for (int x = 0; x < E3D_TILE; x += V_LANES) {
        vi32 id = v_loadi(planes->id + row * E3D_TILE + x), other = v_seti(0);
        for (int s = 1; s < count; s++)
            other = v_ori(other, v_xori(id, v_loadi(planes[s].id + row * E3D_TILE + x)));
        vmask same = v_eqi(other, v_seti(0));
        v_storei(shared + x, v_seli(same, id, v_seti(E3D_NO_SLOT)));
        mixed |= (uint64_t)(v_bits(v_mnot(same)) & setup_tail(V_LANES)) << x;
    }
    return mixed;
}

/* Spreads the bits of a row of blocks over the pixels of a row. */
static inline uint64_t msaa_spread(uint64_t blocks)
{
    uint64_t pixels = 0;
    for (int b = 0; b < VISIBLE_BLOCKS; b++)
        pixels |= (blocks >> b & 1) * (0xFFull << b * RASTER_BLOCK);
    return pixels;
}

/* The pixels of a row that show nothing in any plane, a bit each. */
static inline uint64_t msaa_gaps(const int32_t *shared)
{
    uint64_t gaps = 0;
    for (int x = 0; x < E3D_TILE; x += V_LANES)
        gaps |= (uint64_t)(v_bits(v_negi(v_loadi(shared + x))) & setup_tail(V_LANES)) << x;
    return gaps;
}

static int kernel_msaa_split(const e3d_visible_tile *planes, int count, int width, int height, uint64_t mixed[E3D_TILE],
                             e3d_visible_tile *shared)
{
    uint64_t gaps = 0, empty = 0, inside = ~(uint64_t)0 >> (E3D_TILE - width);
    shared->noted = planes->noted;
    for (int b = 0; b < E3D_TILE_BLOCKS; b += V_LANES) {
        vi32 id = v_loadi(planes->noted_id + b);
        v_storei(shared->noted_id + b, id);
        empty |= (uint64_t)(v_bits(v_negi(id)) & setup_tail(V_LANES)) << b;
    }
    empty &= planes->noted;
    for (int row = 0; row < height; row++) {
        int first = row / RASTER_BLOCK * VISIBLE_BLOCKS;
        uint64_t noted = msaa_spread(planes->noted >> first & 0xFF);
        gaps |= msaa_spread(empty >> first & 0xFF) & inside;
        mixed[row] = 0;
        if (noted == ~(uint64_t)0)
            continue;
        mixed[row] = msaa_row(planes, count, row, shared->id + row * E3D_TILE) & ~noted & inside;
        gaps |= msaa_gaps(shared->id + row * E3D_TILE) & ~noted & ~mixed[row] & inside;
    }
    return gaps != 0;
}
