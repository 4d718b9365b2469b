/* shown: lists the samples of a tile that show its records and fragments, primitive after primitive; and makes batches of
 * them. A record's samples lie in its box, where those with its ID are packed; the fragments of a triangle follow each other.
 * So nothing has to be sorted. */
#pragma once

#include "base/limits.h"
#include "kernels/types/fragments.h"
#include "kernels/types/records.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/visible_records.inl"
#include "kernels/generic/runs.inl"

/* The end of the list: the places of the next sample and the next primitive. */
typedef struct shown_end {
    int32_t count, primitive;
} shown_end;

enum { SHOWN_FEW = 2 * E3D_PAD }; /* so many samples of a primitive are numbered without a loop, however many it has */

/* Makes a primitive of the samples from `end->count` up to `last`, which show an ID; without samples there is no primitive. */
static inline void shown_name(uint32_t id, int32_t last, shown_end *end, e3d_shown *out)
{
    int32_t first = end->count;
    vi32 primitive = v_seti(end->primitive);
    for (int i = 0; i < SHOWN_FEW; i += V_LANES)
        v_storei(out->of + first + i, primitive);
    for (int32_t i = first + SHOWN_FEW; i < last; i += V_LANES)
        v_storei(out->of + i, primitive);
    out->primitive[end->primitive] = (e3d_shown_primitive){id, first};
    end->primitive += last > first;
    end->count = last;
}

/* Stores the samples `at` + lane for some lanes of one row, which mostly are neighbours or none; returns how many. */
static inline int shown_in_row(int32_t at, uint32_t lanes, int32_t *out)
{
    int first = __builtin_ctz(lanes | 1u << (V_LANES - 1));
    if (__builtin_expect(lanes & (lanes + (1u << first)), 0))
        return v_pack(out, v_addi(v_iota(), v_seti(at)), lanes);
    v_storei(out, v_addi(v_iota(), v_seti(at + first)));
    return v_count(lanes);
}

/* ---- boxes of few vectors ----
 *
 * How many vectors a box takes, and whether it shows anything, is unpredictable. So the vectors of all boxes of a vector of
 * records are listed first, then looked at in one loop.
 */

enum { SHOWN_VECTORS = RECORDS_FEW }; /* V_LANES boxes of RECORDS_FEW / V_LANES vectors each */
typedef struct shown_vectors {
    int32_t count;
    /* The vector's first sample, and the lane of its record */
    int32_t first[SHOWN_VECTORS + E3D_PAD], lane[SHOWN_VECTORS + E3D_PAD];
} shown_vectors;

static inline void shown_list(const records_lanes *in, int lane, shown_vectors *list)
{
    uint32_t start = in->start[lane], strips = (in->x1[lane] - in->x0[lane]) / ROW_LANES, y = start >> RECORDS_DOWN;
    int32_t rows = (int32_t)(in->y1[lane] - y) / ROWS + 1, first = (int32_t)(y * E3D_TILE + (start & 0xFFFF));
    for (;; first += ROW_LANES) {
        vi32 at = v_addi(v_seti(first), v_muli(v_iota(), v_seti(ROWS * E3D_TILE)));
        for (int32_t i = 0; i < rows; i += V_LANES) {
            v_storei(list->first + list->count + i, at);
            v_storei(list->lane + list->count + i, v_seti(lane));
            at = v_addi(at, v_seti(V_LANES * ROWS * E3D_TILE));
        }
        list->count += rows;
        if (!strips--)
            return;
    }
}

/* Lists the samples that show records with small boxes, for some lanes. */
static inline void shown_strips(const records_lanes *in, uint32_t lanes, const uint32_t *ids, const e3d_visible_tile *tile, shown_end *end,
                                e3d_shown *out)
{
    shown_vectors list;
    int32_t last[V_LANES] = {0}, count = end->count;
    vi32 step = v_addi(rows_x(), v_muli(rows_y(), v_seti(E3D_TILE)));
    list.count = 0;
    for (uint32_t left = lanes; left; left &= left - 1)
        shown_list(in, __builtin_ctz(left), &list);
    for (int32_t i = 0; i < list.count; i++) {
        int32_t first = list.first[i], lane = list.lane[i];
        uint32_t shown = v_bits(v_eqi(rows_loadi(tile->id + first), v_seti((int32_t)ids[lane])));
        count += ROWS > 1 ? v_pack(out->sample + count, v_addi(step, v_seti(first)), shown)
                          : shown_in_row(first, shown, out->sample + count);
        last[lane] = count;
    }
    for (uint32_t left = lanes; left; left &= left - 1) {
        int lane = __builtin_ctz(left);
        shown_name(ids[lane], last[lane], end, out);
    }
}

/* ---- larger boxes ---- */

/* The blocks of a record's box that may show it: neither noted for another record nor nearer everywhere. */
static inline uint64_t shown_blocks(const records_lanes *in, int lane, const e3d_record *r, int32_t id, const e3d_visible_tile *tile)
{
    uint64_t own = 0, blocks = records_met(in, lane) & ~records_behind(r->zmin, tile);
    for (int first = 0; first < E3D_TILE_BLOCKS; first += V_LANES)
        own |= (uint64_t)v_bits(v_eqi(v_loadi(tile->noted_id + first), v_seti(id))) << first;
    blocks &= own | ~tile->noted;
    for (uint64_t left = blocks & tile->stale; left; left &= left - 1)
        if (visible_hides(tile, __builtin_ctzll(left), r->zmin))
            blocks &= ~(left & -left);
    return blocks;
}

/* Lists the samples that show a record with a large box, row by row. */
static inline void shown_wide(const records_lanes *in, int lane, uint64_t blocks, int32_t id, const e3d_visible_tile *tile,
                              shown_end *end, e3d_shown *out)
{
    int32_t count = end->count, vectors = (int32_t)(in->x1[lane] - in->x0[lane]) / V_LANES + 1, most = E3D_TILE - V_LANES * vectors;
    int32_t x = (int32_t)in->x0[lane] < most ? (int32_t)in->x0[lane] : most;
    for (int32_t y = (int32_t)in->y0[lane]; y <= (int32_t)in->y1[lane]; y++)
        for (int32_t v = 0, i = y * E3D_TILE + x; v < vectors && blocks >> y / RASTER_BLOCK * VISIBLE_BLOCKS & 0xFF; v++, i += V_LANES) {
            uint32_t shown = v_bits(v_eqi(v_loadi(tile->id + i), v_seti(id)));
            count += shown_in_row(i, shown, out->sample + count);
        }
    shown_name((uint32_t)id, count, end, out);
}

/* ---- all ---- */

static inline void shown_boxes(const e3d_record *const r[V_LANES], const e3d_visible_tile *tile, records_lanes *out)
{
    vi32 corners[8], first[2];
    v_load_rows((const void *const *)r, corners);
    records_boxes(corners, corners + 3, tile, 0, first, out);
}

static void kernel_show_records(const e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count,
                                e3d_shown *out)
{
    const e3d_record *r[V_LANES];
    records_lanes in;
    shown_end end = {out->count, out->primitives};
    for (int i = 0; i < count; i += V_LANES) {
        uint32_t all = setup_tail(records_take(table, ids + i, count - i, r));
        shown_boxes(r, tile, &in);
        uint32_t few = all & (ROWS > 1 ? in.few : in.narrow);
        shown_strips(&in, few, ids + i, tile, &end, out);
        for (uint32_t left = all & ~few; left; left &= left - 1) {
            int lane = __builtin_ctz(left);
            int32_t id = (int32_t)ids[i + lane];
            uint64_t blocks = shown_blocks(&in, lane, r[lane], id, tile);
            if (blocks)
                shown_wide(&in, lane, blocks, id, tile, &end, out);
        }
    }
    out->count = end.count;
    out->primitives = end.primitive;
}

/* ---- fragments ---- */

/* First finds the fragments that show, since they may be few; without a branch, since which ones show is unpredictable. */
static void kernel_show_fragments(const e3d_visible_tile *tile, const e3d_fragment_link *b, e3d_shown *out)
{
    uint8_t shown[E3D_LINK_FRAGMENTS];
    int32_t n = out->count, primitives = out->primitives, last = primitives ? (int32_t)out->primitive[primitives - 1].id : E3D_NO_SLOT, count = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        shown[count] = (uint8_t)i;
        count += tile->id[b->sample[i]] == b->id[i];
    }
    for (int32_t k = 0; k < count; k++, n++) {
        int32_t id = b->id[shown[k]];
        out->primitive[primitives] = (e3d_shown_primitive){(uint32_t)id, n};
        primitives += id != last;
        last = id;
        out->sample[n] = b->sample[shown[k]];
        out->of[n] = primitives - 1;
    }
    out->count = n;
    out->primitives = primitives;
}

/* ---- to batches ---- */

static int kernel_take_shown(const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch)
{
    int n = batch->count, some = count < E3D_BATCH - n ? count : E3D_BATCH - n;
    for (int i = 0; i < some; i += V_LANES) {
        v_storei(batch->sample + n + i, v_loadi(shown->sample + first + i));
        v_storei(batch->surface + n + i, v_subi(v_loadi(shown->of + first + i), v_seti(primitive)));
    }
    batch_pad(batch, n + some);
    return some;
}

/* Takes pixels with the sample numbers of R105. */
static int kernel_take_placed(const e3d_shown *shown, int first, int count, int32_t primitive, e3d_batch *batch)
{
    int n = batch->count, some = count < E3D_BATCH - n ? count : E3D_BATCH - n;
    for (int i = 0; i < some; i += V_LANES) {
        vi32 sample = v_loadi(shown->sample + first + i);
        v_storei(batch->sample + n + i, v_andi(sample, v_seti(E3D_TILE_SAMPLES - 1)));
        v_storei(batch->number + n + i, v_shr(sample, E3D_SHOWN_NUMBER));
        v_storei(batch->surface + n + i, v_subi(v_loadi(shown->of + first + i), v_seti(primitive)));
    }
    batch_pad(batch, n + some);
    for (int pad = 0; pad < E3D_PAD; pad += V_LANES)
        v_storei(batch->number + n + some + pad, v_seti(batch->number[n + some - 1]));
    return some;
}
