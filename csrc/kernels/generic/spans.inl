/* spans: which samples each record covers, row by row and without depths (R12). Where none is covered twice, that is what shows.
 *
 * In a row, edge function k is n + |a| * x or n - |a| * x: it isn't negative from x = -floor(n / |a|) on, or up to floor(n / |a|).
 * Of records of at most RECORDS_SIDE samples a side, |a| is at most 127 * 256, and n and all that it is the sum of are whole
 * numbers below 2^24: exact in single precision. So is n + 1/2 below 2^23; where |n| is greater, the quotient is far outside of
 * the tile. (n + 1/2) / |a| is more than 2^-16 away from whole numbers, and within the tile two roundings move it by 2^-17 at
 * most: its floor is that of n / |a|.
 */
#pragma once

#include "base/limits.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/record.inl"
#include "kernels/generic/visible_records.inl"

enum { SPANS_LEVEL = 256 }; /* scales an edge function that is constant along a row: one below 0 leaves no sample */

/* A vector of records, one a lane. With n = first + y * down, edge function k (plus 1/2) at the first sample of row y,
 *     a > 0 bounds it on the left:  x >= -floor(n * left), left = 1 / a;
 *     a < 0 bounds it on the right: x <= floor(n * right), right = 1 / -a;
 *     a = 0 bounds all of it, or nothing: left = SPANS_LEVEL.
 * A bound that edge k doesn't give is neutral: left = 0, or right = 0 with past = E3D_TILE. Rows y0 to y1 are those of the box. */
typedef struct spans_lanes {
    float first[3][V_LANES], down[3][V_LANES], left[3][V_LANES], right[3][V_LANES], past[3][V_LANES];
    int32_t y0[V_LANES], y1[V_LANES];
} spans_lanes;

/* Lanes whose records are too large, or may reach beyond the far plane. */
static inline uint32_t spans_refused(const e3d_record *const r[V_LANES])
{
    vi32 corners[8];
    float far[V_LANES];
    v_load_rows((const void *const *)r, corners);
    const vi32 *x = corners, *y = corners + 3;
    vi32 side = v_seti(256 * RECORDS_SIDE);
    vi32 wide = v_subi(setup_most(x), setup_least(x)), tall = v_subi(setup_most(y), setup_least(y));
    for (int l = 0; l < V_LANES; l++)
        far[l] = r[l]->zmax;
    vmask within = v_gt(v_setf(E3D_BEYOND_FAR), v_loadf(far));
    return v_bits(v_mor(v_mor(v_gti(wide, side), v_gti(tall, side)), v_mnot(within)));
}

static inline void spans_edge(const record_edge *e, int k, spans_lanes *out)
{
    vf32 a = v_float(e->a), none = v_setf(0.0f);
    vf32 scale = v_div(v_setf(1.0f), v_max(a, v_sub(none, a)));
    vmask on_right = v_gti(v_seti(0), e->a), level = v_eqi(e->a, v_seti(0));
    v_storef(out->first[k], v_add(v_float(e->c), v_setf(0.5f)));
    v_storef(out->down[k], v_float(e->b));
    v_storef(out->left[k], v_self(level, v_setf(SPANS_LEVEL), v_self(on_right, none, scale)));
    v_storef(out->right[k], v_self(on_right, scale, none));
    v_storef(out->past[k], v_self(on_right, none, v_setf(E3D_TILE)));
}

static inline void spans_find(const e3d_record *const r[V_LANES], const e3d_cover *cover, spans_lanes *out)
{
    vi32 corners[8];
    v_load_rows((const void *const *)r, corners);
    const vi32 *x = corners, *y = corners + 3;
    vi32 up = v_seti(127), half = v_seti(128), tile_x = v_seti(cover->x), tile_y = v_seti(cover->y);
    vi32 x0 = records_in_tile(v_subi(v_sra(v_addi(setup_least(x), up), 8), tile_x));
    vi32 y0 = records_in_tile(v_subi(v_sra(v_addi(setup_least(y), up), 8), tile_y));
    vi32 y1 = v_subi(v_sra(v_subi(setup_most(y), half), 8), tile_y);
    v_storei(out->y0, y0);
    v_storei(out->y1, v_mini(y1, v_seti(cover->height - 1)));
    for (int k = 0; k < 3; k++) {
        record_edge e = records_edge_of(x, y, k, x0, y0, tile_x, tile_y);
        spans_edge(&e, k, out);
    }
}

/* The spans of a record in V_LANES rows from y on, as runs: first sample in the tile | length << E3D_RUN_LENGTH. */
static inline vi32 spans_of_rows(const spans_lanes *in, int lane, int32_t y, const e3d_cover *cover)
{
    vi32 row = v_addi(v_seti(y), v_iota());
    vf32 at = v_float(row), none = v_setf(0.0f), near = none, far = v_setf((float)(cover->width - 1));
    for (int k = 0; k < 3; k++) {
        vf32 n = v_add(v_setf(in->first[k][lane]), v_mul(v_setf(in->down[k][lane]), at));
        near = v_min(near, v_mul(n, v_setf(in->left[k][lane])));
        far = v_min(far, v_add(v_mul(n, v_setf(in->right[k][lane])), v_setf(in->past[k][lane])));
    }
    near = v_max(v_floor(near), v_setf(-E3D_TILE));
    vf32 length = v_max(v_add(v_add(v_floor(far), near), v_setf(1.0f)), none);
    vf32 place = v_add(v_sub(v_mul(at, v_setf(E3D_TILE)), near), v_mul(length, v_setf(1 << E3D_RUN_LENGTH)));
    return v_seli(v_gti(row, v_seti(in->y1[lane])), v_seti(0), v_trunc(place));
}

static inline vi32 spans_first(vi32 spans) { return v_andi(spans, v_seti(E3D_TILE - 1)); }
static inline vi32 spans_length(vi32 spans) { return v_shr(spans, E3D_RUN_LENGTH); }

/* Marks the samples of V_LANES spans: adds to `twice` those that are in `once` already, and then all to `once`. A row has a
 * bit a sample, so V_LANES rows are two vectors. */
static inline void spans_mark(vi32 spans, uint64_t *once_rows, uint64_t *twice_rows)
{
    int32_t *once = (int32_t *)once_rows, *twice = (int32_t *)twice_rows;
    for (int half = 0; half < 2; half++, once += V_LANES, twice += V_LANES) {
        vi32 bits = v_span(spans_first(spans), spans_length(spans), half), before = v_loadi(once);
        v_storei(twice, v_ori(v_loadi(twice), v_andi(before, bits)));
        v_storei(once, v_ori(before, bits));
    }
}

/* The marked samples that lie in the spans, as the OR of all rows; 0 if there is none. */
static inline vi32 spans_marked(vi32 spans, const uint64_t *rows)
{
    const int32_t *words = (const int32_t *)rows;
    vi32 low = v_andi(v_loadi(words), v_span(spans_first(spans), spans_length(spans), 0));
    return v_ori(low, v_andi(v_loadi(words + V_LANES), v_span(spans_first(spans), spans_length(spans), 1)));
}

/* Appends the spans that aren't empty, as runs of the next primitive. */
static inline void spans_add(vi32 spans, e3d_shown *out)
{
    v_storei(out->of + out->count, v_seti(out->primitives));
    out->count += v_pack(out->sample + out->count, spans, v_bits(v_gti(spans_length(spans), v_seti(0))));
}

/* Makes a primitive of the runs from `first` on, if there are any. */
static inline void spans_name(uint32_t id, int32_t first, e3d_shown *out)
{
    out->primitive[out->primitives] = (e3d_shown_primitive){id, first};
    out->primitives += out->count > first;
}

/* Adds a record: its spans, the samples that it covers, and its runs. */
static inline void spans_cover(const spans_lanes *in, int lane, const e3d_record *r, uint32_t id, e3d_cover *cover, e3d_shown *out)
{
    int32_t first = out->count;
    cover->record[cover->count++] = (e3d_covering){r, id, in->y0[lane], in->y1[lane], cover->used};
    for (int32_t y = in->y0[lane]; y <= in->y1[lane]; y += V_LANES) {
        vi32 spans = spans_of_rows(in, lane, y, cover);
        v_storei(cover->span + cover->used, spans);
        cover->used += V_LANES;
        spans_mark(spans, cover->once + y, cover->twice + y);
        spans_add(spans, out);
    }
    spans_name(id, first, out);
}

static inline int spans_full(const e3d_cover *cover, const e3d_shown *out)
{
    return out->count > E3D_TILE_SAMPLES - E3D_TILE || cover->used > E3D_COVER_ROWS - E3D_TILE || cover->count == E3D_MOST_COVERING;
}

static int kernel_cover_records(e3d_cover *cover, const e3d_record_table *table, const uint32_t *ids, int count, e3d_shown *out)
{
    const e3d_record *r[V_LANES];
    spans_lanes in;
    for (int i = 0; i < count; i += V_LANES) {
        int some = records_take(table, ids + i, count - i, r);
        if (spans_refused(r))
            return 0;
        spans_find(r, cover, &in);
        for (int lane = 0; lane < some; lane++) {
            if (spans_full(cover, out))
                return 0;
            spans_cover(&in, lane, r[lane], ids[i + lane], cover, out);
        }
    }
    return 1;
}

/* ---- from what is covered to what shows ---- */

static inline int spans_none(vi32 bits) { return !v_any(v_mnot(v_eqi(bits, v_seti(0)))); }

/* Lists all runs of a record. */
static inline void spans_show(const e3d_cover *cover, const e3d_covering *c, e3d_shown *out)
{
    int32_t first = out->count;
    const int32_t *span = cover->span + c->at;
    for (int32_t y = c->y0; y <= c->y1; y += V_LANES, span += V_LANES)
        spans_add(v_loadi(span), out);
    spans_name(c->id, first, out);
}

/* Whether a record covers samples that others cover, too. */
static inline int spans_met(const e3d_cover *cover, const e3d_covering *c)
{
    vi32 marked = v_seti(0);
    const int32_t *span = cover->span + c->at;
    for (int32_t y = c->y0; y <= c->y1; y += V_LANES, span += V_LANES)
        marked = v_ori(marked, spans_marked(v_loadi(span), cover->twice + y));
    return !spans_none(marked);
}

static int kernel_show_alone(const e3d_cover *cover, e3d_shown *out, uint16_t *rest)
{
    int left = 0;
    for (int32_t i = 0; i < cover->count; i++) {
        int met = spans_met(cover, &cover->record[i]);
        rest[left] = (uint16_t)i;
        left += met;
        if (!met)
            spans_show(cover, &cover->record[i], out);
    }
    return left;
}
