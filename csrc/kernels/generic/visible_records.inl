/* raster: draws the records of a tile into its visible surface. It finds the boxes and edges of a vector of records at a time
 * (R10, R12), and then draws record after record (R14-R16). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/record.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"

/* ---- a vector of records in a tile ---- */

enum { RECORDS_DOWN = 16 }; /* the bit position of the row (or its step) in a word of row << 16 | column */
/* Of records with at most so many samples, drawn in strips, show_records looks at all samples, which is cheaper than choosing
 * blocks */
enum { RECORDS_FEW = 1024 };
enum { RECORDS_WIDER = 3 }; /* rows are bounded if more than one record in so many is as wide as a block */
enum { RECORDS_SIDE = 127 }; /* the longest side of records drawn in strips: steps of edges fit 16 bits, twice the area 31 */
enum { RECORDS_STRIPS = E3D_TILE / ROW_LANES };

/* A vector of records, one a lane, relative to the tile: the box of samples; the edge functions at the tile's first sample;
 * their steps from sample to sample (down << 16 | along) and from vector to vector (down); the first vector of the strips,
 * and how many strips follow the first. */
typedef struct records_lanes {
    uint32_t x0[V_LANES], y0[V_LANES], x1[V_LANES], y1[V_LANES];
    int32_t e[3][V_LANES], steps[3][V_LANES], down[3][V_LANES];
    uint32_t start[V_LANES];
    int32_t strips[V_LANES];
    float dx[V_LANES], dy[V_LANES]; /* from the plane's base to `start` */
    /* For each strip the rows that may be covered: the first vector, its row from the plane's base, and how many vectors. */
    uint32_t from[RECORDS_STRIPS][V_LANES];
    float row[RECORDS_STRIPS][V_LANES];
    int32_t vectors[RECORDS_STRIPS][V_LANES];
    /* A bit a lane: no side is longer than RECORDS_SIDE; of these, at most RECORDS_FEW samples; of these, narrower than a
     * block. */
    uint32_t small, few, narrow;
} records_lanes;

static inline vi32 records_in_tile(vi32 sample) { return v_maxi(v_mini(sample, v_seti(E3D_TILE - 1)), v_seti(0)); }

/* R12: an edge function at the tile's first sample. It is found at the box's first sample, where 32 bits hold it, and moved
 * from there. */
static inline record_edge records_edge_of(const vi32 x[3], const vi32 y[3], int k, vi32 x0, vi32 y0, vi32 tile_x, vi32 tile_y)
{
    vi32 half = v_seti(128);
    vi32 px = v_addi(v_shl(v_addi(x0, tile_x), 8), half), py = v_addi(v_shl(v_addi(y0, tile_y), 8), half);
    record_edge e = record_edge_of(x, y, k, v_seti(0), px, py);
    e.c = v_subi(v_sra(e.c, 8), v_addi(v_muli(e.a, x0), v_muli(e.b, y0)));
    return e;
}

static inline void records_keep_edge(const record_edge *e, int k, records_lanes *out)
{
    v_storei(out->e[k], e->c);
    v_storei(out->down[k], v_muli(e->b, v_seti(ROWS)));
    v_storei(out->steps[k], v_ori(v_andi(e->a, v_seti(0xFFFF)), v_shl(e->b, RECORDS_DOWN)));
}

/* R10, R104: finds boxes. Strips start at the box's first column, or where the tile still holds a vector. */
static ALWAYS_INLINE void records_boxes(const vi32 x[3], const vi32 y[3], const e3d_visible_tile *tile, int32_t reach, vi32 first[2],
                                        records_lanes *out)
{
    vi32 zero = v_seti(0), up = v_seti(127 - reach), down = v_seti(128 - reach), side = v_seti(256 * RECORDS_SIDE);
    vi32 left = setup_least(x), right = setup_most(x), top = setup_least(y), bottom = setup_most(y);
    vi32 base_x = v_subi(v_maxi(v_sra(v_addi(left, up), 8), zero), v_seti(tile->x));
    vi32 base_y = v_subi(v_maxi(v_sra(v_addi(top, up), 8), zero), v_seti(tile->y));
    vi32 x0 = records_in_tile(base_x), x1 = records_in_tile(v_subi(v_sra(v_subi(right, down), 8), v_seti(tile->x)));
    vi32 y0 = records_in_tile(base_y), y1 = records_in_tile(v_subi(v_sra(v_subi(bottom, down), 8), v_seti(tile->y)));
    vi32 wide = v_subi(x1, x0), across = v_andi(wide, v_seti(-ROW_LANES));
    vi32 start_x = v_mini(x0, v_subi(v_seti(E3D_TILE - ROW_LANES), across)), start_y = v_andi(y0, v_seti(-ROWS));
    out->small = ~v_bits(v_mor(v_gti(v_subi(right, left), side), v_gti(v_subi(bottom, top), side)));
    vi32 area = v_muli(v_addi(across, v_seti(ROW_LANES)), v_addi(v_subi(y1, start_y), v_seti(ROWS)));
    out->few = out->small & ~v_bits(v_gti(area, v_seti(RECORDS_FEW)));
    out->narrow = out->few & ~v_bits(v_gti(wide, v_seti(RASTER_BLOCK - 1)));
    v_storei(out->x0, first[0] = x0);
    v_storei(out->y0, first[1] = y0);
    v_storei(out->x1, x1);
    v_storei(out->y1, y1);
    v_storei(out->start, v_ori(start_x, v_shl(start_y, RECORDS_DOWN)));
    v_storef(out->dx, v_float(v_subi(start_x, base_x)));
    v_storef(out->dy, v_float(v_subi(start_y, base_y)));
}

/* An edge in a strip: `most` is its greatest value in row 0, and most * rows the row in which that becomes 0 (rows = -1 / b).
 * If b > 0, the rows from there on may be covered (`from`); if b < 0, those up to there (`to`). */
typedef struct records_bound {
    vi32 most, step; /* step: from a strip to the next */
    vf32 rows;
    vmask from, to;
} records_bound;

static inline records_bound records_bound_of(const record_edge *e, vi32 start_x)
{
    vi32 zero = v_seti(0), most = v_muli(v_maxi(e->a, zero), v_seti(ROW_LANES - 1));
    return (records_bound){v_addi(v_addi(e->c, v_muli(e->a, start_x)), most), v_muli(e->a, v_seti(ROW_LANES)),
                           v_div(v_setf(-1), v_float(e->b)), v_gti(e->b, zero), v_gti(zero, e->b)};
}

/* Narrows the rows first .. last of a strip by an edge. In a tile four roundings move its zero by less than 2^-15 of a row;
 * `room` is more. */
static inline void records_clip(const records_bound *b, vf32 *first, vf32 *last)
{
    const float room = 1.0f / 64;
    vf32 row = v_mul(v_float(b->most), b->rows);
    *first = v_self(b->from, v_max(v_add(row, v_setf(1 - room)), *first), *first);
    *last = v_self(b->to, v_min(v_add(row, v_setf(room)), *last), *last);
}

/* Finds the rows that each strip may cover. If few records are wider than a block, these are all rows of the box, since
 * finding bounds would take longer than it saves. */
static inline void records_rows(const record_edge e[3], records_lanes *out)
{
    records_bound bounds[3];
    uint32_t wider = out->small;
    int edges = RECORDS_WIDER * __builtin_popcount(wider & ~out->narrow) > V_LANES ? 3 : 0;
    vi32 start = v_loadi(out->start), start_y = v_shr(start, RECORDS_DOWN);
    vi32 strips = v_sra(v_subi(v_loadi(out->x1), v_loadi(out->x0)), ROW_SHIFT);
    for (int k = 0; k < edges; k++)
        bounds[k] = records_bound_of(&e[k], v_andi(start, v_seti(0xFFFF)));
    v_storei(out->strips, strips);
    for (int s = 0; s < RECORDS_STRIPS && wider; s++) {
        vf32 first = v_float(start_y), last = v_float(v_loadi(out->y1));
        for (int k = 0; k < edges; k++) {
            records_clip(&bounds[k], &first, &last);
            bounds[k].most = v_addi(bounds[k].most, bounds[k].step);
        }
        vi32 left_out = v_andi(v_subi(v_trunc(v_min(first, v_setf(E3D_TILE))), start_y), v_seti(-ROWS));
        vi32 below = v_subi(v_trunc(v_max(last, v_setf(-1))), v_addi(start_y, left_out));
        v_storei(out->from[s], v_addi(v_addi(start, v_seti(s * ROW_LANES)), v_shl(left_out, RECORDS_DOWN)));
        v_storef(out->row[s], v_add(v_loadf(out->dy), v_float(left_out)));
        v_storei(out->vectors[s], v_addi(v_sra(below, ROWS - 1), v_seti(1)));
        wider = out->small & v_bits(v_gti(strips, v_seti(s)));
    }
}

static inline void records_find(const e3d_record *const r[V_LANES], const e3d_visible_tile *tile, records_lanes *out)
{
    vi32 corners[8], first[2];
    record_edge e[3];
    v_load_rows((const void *const *)r, corners);
    records_boxes(corners, corners + 3, tile, 0, first, out);
    for (int k = 0; k < 3; k++) {
        e[k] = records_edge_of(corners, corners + 3, k, first[0], first[1], v_seti(tile->x), v_seti(tile->y));
        records_keep_edge(&e[k], k, out);
    }
    records_rows(e, out);
}

/* Takes the first vector of `count` records, and prefetches the next; returns how many there are. Lanes beyond the last one
 * repeat the first. */
static inline int records_take(const e3d_record_table *table, const uint32_t *ids, int count, const e3d_record *r[V_LANES])
{
    int some = count < V_LANES ? count : V_LANES;
    for (int l = 0; l < V_LANES; l++)
        r[l] = e3d_record_at(table, ids[l < some ? l : 0]);
    for (int l = some; l < 2 * some && l < count; l++)
        __builtin_prefetch(e3d_record_at(table, ids[l]));
    return some;
}

/* ---- what is touched ---- */

/* The blocks that a box of samples touches. */
static inline uint64_t records_met(const records_lanes *in, int lane)
{
    const uint64_t left_column = 0x0101010101010101;
    uint32_t columns = (2u << in->x1[lane] / RASTER_BLOCK) - (1u << in->x0[lane] / RASTER_BLOCK);
    uint32_t above = in->y0[lane] / RASTER_BLOCK, rows = in->y1[lane] / RASTER_BLOCK - above;
    return columns * (left_column >> (VISIBLE_BLOCKS * (VISIBLE_BLOCKS - 1 - rows)) << (VISIBLE_BLOCKS * above));
}

/* The blocks all of whose samples are nearer than `near`. */
static inline uint64_t records_behind(float near, const e3d_visible_tile *tile)
{
    uint64_t behind = 0;
    for (int first = 0; first < E3D_TILE_BLOCKS; first += V_LANES)
        behind |= (uint64_t)v_bits(v_gt(v_setf(near), v_loadf(tile->zmax + first))) << first;
    return behind;
}

static inline size_t records_sample(uint32_t from) { return (from >> RECORDS_DOWN) * E3D_TILE + (from & 0xFFFF); }

/* Blocks in which samples were written, none nearer than `near`, and whose bounds are not updated yet. */
typedef struct records_touched {
    uint64_t met;
    float near;
} records_touched;

static inline void records_tell(records_touched *touched, e3d_visible_tile *tile)
{
    if (touched->met)
        visible_touch(touched->met, touched->near, tile);
    *touched = (records_touched){0, E3D_BEYOND_FAR};
}

/* ---- record by record ---- */

/* Draws a record in strips: columns of vectors, side by side. */
static inline void records_strips(const records_lanes *in, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *tile,
                                  const e3d_record_table *table)
{
    raster_constants c = {v_setf(r->z0), v_setf(r->gx), v_setf(r->gy), v_setf(r->zmin), v_setf(r->zmax), v_seti(id)};
    vf32 along = v_add(v_float(rows_x()), v_setf(in->dx[lane])); /* whole numbers, so sums are exact */
    for (int s = 0; s <= in->strips[lane]; s++) {
        size_t i = records_sample(in->from[s][lane]);
        vi32 at = v_addi(v_seti((int32_t)in->from[s][lane]), v_ori(rows_x(), v_shl(rows_y(), RECORDS_DOWN)));
        vf32 row = v_add(v_float(rows_y()), v_setf(in->row[s][lane])), column = v_add(c.z0, v_mul(along, c.gx));
        vi32 e[3], down[3];
        for (int k = 0; k < 3; k++) {
            e[k] = v_addi(v_seti(in->e[k][lane]), v_madd16(v_seti(in->steps[k][lane]), at));
            down[k] = v_seti(in->down[k][lane]);
        }
        for (int32_t left = in->vectors[s][lane]; left > 0; left--, i += ROWS * E3D_TILE) {
            vmask inside = visible_inside(e);
            vf32 z = v_min(v_max(v_add(column, v_mul(row, c.gy)), c.zmin), c.zmax);
            visible_write(inside, z, i, r, id, tile, table);
            for (int k = 0; k < 3; k++)
                e[k] = v_addi(e[k], down[k]);
            row = v_add(row, v_setf(ROWS));
        }
        along = v_add(along, v_setf(ROW_LANES));
    }
}

/* Draws a record of at most 2 x 2 samples, whose cover setup has found. */
static inline void records_tiny(const e3d_record *r, int32_t id, e3d_visible_tile *tile, const e3d_record_table *table)
{
    visible_plane p = visible_plane_of(r, tile->x, tile->y);
    for (uint32_t cover = r->meta >> E3D_RECORD_SHIFT; cover; cover &= cover - 1) {
        int bit = __builtin_ctz(cover), x = p.base_x + (bit & 1), y = p.base_y + (bit >> 1);
        if ((x | y) & ~(E3D_TILE - 1)) /* in another tile */
            continue;
        float z = visible_depth(&p, x, y);
        int block = y / RASTER_BLOCK * VISIBLE_BLOCKS + x / RASTER_BLOCK, at = y * E3D_TILE + x;
        if (z > tile->zmax[block])
            continue;
        if (tile->noted >> block & 1)
            visible_unfold(tile, table, block);
        if (z < tile->z[at]) {
            tile->z[at] = z;
            tile->id[at] = id;
            tile->zmin[block] = tile->zmin[block] < z ? tile->zmin[block] : z;
            tile->stale |= 1ull << block;
        } else if (z == tile->z[at] && visible_comes_first(r, id, tile->id[at], table)) {
            tile->z[at] = z;
            tile->id[at] = id;
        }
    }
}

/* Draws a record of any size block by block. */
static inline void records_wide(const records_lanes *in, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *tile,
                                const e3d_record_table *table)
{
    e3d_piece p = {.x0 = (int32_t)in->x0[lane],
                   .y0 = (int32_t)in->y0[lane],
                   .x1 = (int32_t)in->x1[lane],
                   .y1 = (int32_t)in->y1[lane],
                   .slot = (uint32_t)id};
    for (int k = 0; k < 3; k++)
        if (!e3d_piece_edge(r, k, tile->x, tile->y, &p))
            return;
    p.base_x = visible_first(r->x) - tile->x;
    p.base_y = visible_first(r->y) - tile->y;
    p.gx = r->gx;
    p.gy = r->gy;
    p.z0 = r->z0;
    raster_constants c = {v_setf(r->z0), v_setf(r->gx), v_setf(r->gy), v_setf(r->zmin), v_setf(r->zmax), v_seti(id)};
    visible_wide(&p, &c, r, tile, table);
}

/* Draws a record, unless the visible surface hides it: by the zmax of the blocks that it touches, or by the samples of its
 * strips. */
static inline void records_draw(const records_lanes *in, int lane, const e3d_record *r, int32_t id, uint64_t open,
                                records_touched *touched, e3d_visible_tile *tile, const e3d_record_table *table)
{
    uint64_t met = records_met(in, lane);
    int strips = in->small >> lane & 1;
    if (!(strips && met & open) && !(met & ~records_behind(r->zmin, tile)))
        return;
    if (!strips) {
        records_tell(touched, tile);
        records_wide(in, lane, r, id, tile, table);
        return;
    }
    for (uint64_t left = met & tile->noted; left; left &= left - 1)
        visible_unfold(tile, table, __builtin_ctzll(left));
    touched->met |= met;
    touched->near = r->zmin < touched->near ? r->zmin : touched->near;
    records_strips(in, lane, r, id, tile, table);
}

/* Whether records seem to come from far to near, and to be large: the last one is nearer than the first, and reaches farther
 * than a tile from its first corner. */
static inline int records_approach(const e3d_record *first, const e3d_record *last)
{
    /* A power of two, so that the OR of sums reaches 2 * side exactly if one of them does */
    const uint32_t side = 256 * E3D_TILE;
    uint32_t reach = 0;
    for (int k = 1; k < 3; k++)
        reach |= ((uint32_t)(last->x[k] - last->x[0]) + side) | ((uint32_t)(last->y[k] - last->y[0]) + side);
    return (last->zmin < first->zmin) & (reach >= 2 * side);
}

static void __attribute__((noinline, cold)) records_turn(const uint32_t *ids, int count, uint32_t *out)
{
    for (int i = 0; i < count; i++)
        out[i] = ids[count - 1 - i];
}

/* The next vector of records, r, of the `count` that are left. Returns their IDs, in reverse order if records come from far
 * to near. */
static ALWAYS_INLINE const uint32_t *records_next(const e3d_record_table *table, const uint32_t *ids, int count, uint32_t turned[V_LANES],
                                                  const e3d_record *r[V_LANES])
{
    int some = count < V_LANES ? count : V_LANES;
    if (records_approach(e3d_record_at(table, ids[0]), e3d_record_at(table, ids[some - 1]))) {
        records_turn(ids, some, turned); /* the near ones hide the others */
        ids = turned;
        count = some;
    }
    records_take(table, ids, count, r);
    return ids;
}

static void kernel_raster_visible(e3d_visible_tile *tile, const e3d_record_table *table, const uint32_t *ids, int count)
{
    const e3d_record *r[V_LANES];
    uint32_t turned[V_LANES];
    records_lanes in;
    records_touched touched = {0, E3D_BEYOND_FAR};
    /* Where little is hidden, that is most blocks, and their zmax isn't read again */
    uint64_t open = ~records_behind(1.0f, tile);
    for (int i = 0; i < count; i += V_LANES) {
        int some = count - i < V_LANES ? count - i : V_LANES;
        const uint32_t *id = records_next(table, ids + i, count - i, turned, r);
        records_find(r, tile, &in);
        for (int l = 0; l < some; l++)
            if (r[l]->meta & E3D_RECORD_TINY)
                records_tiny(r[l], (int32_t)id[l], tile, table);
            else
                records_draw(&in, l, r[l], (int32_t)id[l], open, &touched, tile, table);
    }
    records_tell(&touched, tile);
}
