/* raster with multisampling: a tile has a plane for each sample of its pixels (R103, R104), and blocks of pixels are noted and bounded for
 * all planes at once.
 *
 * In a plane all samples are as far apart as pixels are, so what draws records into a tile draws them into a plane, with edge functions
 * and depths that are moved by the sample's offset. A block that a record covers whole in all planes, nearer than all that is there, is
 * noted and written in none of them. Bounds and notes of blocks stand in the first plane.
 */
#ifndef E3D_KERNELS_PLANES_INL
#define E3D_KERNELS_PLANES_INL

#include "core/always_inline.h"
#include "core/limits.h"
#include "core/sample_patterns.h"
#include "kernels/coverage.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/record.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/visible_records.inl"

/* ---- a record in a plane ---- */

/* R104: z0 at a sample. */
static ALWAYS_INLINE float planes_z0(const e3d_record *r, const e3d_sample_pattern *pattern, int s)
{
    float u = (float)pattern->x[s] * (1.0f / E3D_SUBPIXEL), v = (float)pattern->y[s] * (1.0f / E3D_SUBPIXEL);
    return (r->z0 + u * r->gx) + v * r->gy;
}

/* First column or row of the box (R104). */
static inline int32_t planes_first(const int32_t v[3], int32_t reach)
{
    int32_t first = (visible_min3(v) + (127 - reach)) >> 8;
    return first > 0 ? first : 0;
}

static inline raster_constants planes_constants(const e3d_record *r, const e3d_sample_pattern *pattern, int s, int32_t id)
{
    return (raster_constants){v_setf(planes_z0(r, pattern, s)), v_setf(r->gx), v_setf(r->gy), v_setf(r->zmin), v_setf(r->zmax), v_seti(id)};
}

/* ---- blocks ---- */

/* A block shows nothing. */
static inline void planes_clear_block(e3d_visible_tile *plane, int block)
{
    int at = block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    for (int y = 0; y < RASTER_BLOCK; y += ROWS)
        for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
            rows_storef(plane->z + at + y * E3D_TILE + x, v_setf(E3D_BEYOND_FAR));
            rows_storei(plane->id + at + y * E3D_TILE + x, v_seti(E3D_NO_SLOT));
        }
}

/* Writes depths and IDs of a noted block. */
static void planes_unfold(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table, int block)
{
    int left = block % VISIBLE_BLOCKS * RASTER_BLOCK, top = block / VISIBLE_BLOCKS * RASTER_BLOCK;
    int32_t id = planes->noted_id[block];
    planes->noted &= ~(1ull << block);
    if (id < 0) {
        for (int s = 0; s < pattern->count; s++)
            planes_clear_block(&planes[s], block);
        return;
    }
    const e3d_record *r = e3d_record_at(table, (uint32_t)id);
    int32_t base_x = planes_first(r->x, pattern->reach) - planes->x, base_y = planes_first(r->y, pattern->reach) - planes->y;
    for (int s = 0; s < pattern->count; s++) {
        raster_constants c = planes_constants(r, pattern, s, id);
        for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
            vf32 column = visible_column(&c, left + x - base_x);
            for (int y = 0; y < RASTER_BLOCK; y += ROWS) {
                int at = (top + y) * E3D_TILE + left + x;
                rows_storef(planes[s].z + at, visible_z(&c, column, top + y - base_y));
                rows_storei(planes[s].id + at, c.slot);
            }
        }
    }
}

/* The farthest depth of each column of a block in all planes. */
static inline void planes_columns(const e3d_visible_tile *planes, int count, int block, float columns[RASTER_BLOCK])
{
    float more[RASTER_BLOCK];
    visible_columns(planes, block, columns);
    for (int s = 1; s < count; s++) {
        visible_columns(&planes[s], block, more);
        for (int x = 0; x < RASTER_BLOCK; x++)
            columns[x] = visible_farther(columns[x], more[x]);
    }
}

static inline void planes_measure_block(e3d_visible_tile *planes, int count, int block)
{
    float columns[RASTER_BLOCK];
    planes_columns(planes, count, block, columns);
    visible_bound(planes, block, columns);
}

static inline int planes_hide(const e3d_visible_tile *planes, int count, int block, float near)
{
    for (int s = 0; s < count; s++)
        if (!visible_hides(&planes[s], block, near))
            return 0;
    return 1;
}

/* Measures stale blocks; returns those that hide the record. */
static inline uint32_t planes_behind(uint32_t blocks, int first, const float near[V_LANES], e3d_visible_tile *planes, int count)
{
    uint32_t behind = 0;
    for (; blocks; blocks &= blocks - 1) {
        int lane = __builtin_ctz(blocks);
        if (!planes_hide(planes, count, first + lane, near[lane]))
            continue;
        planes_measure_block(planes, count, first + lane);
        behind |= blocks & -blocks;
    }
    return behind;
}

/* ---- a vector of samples in each plane ---- */

/* What the planes share: bounds of depth, and how edge functions change from row to row. */
typedef struct planes_strip {
    vf32 zmin, zmax;
    vi32 down[3];
} planes_strip;

/* One vector of one plane: its depths, and the lanes that are covered and not behind what is there. Its edge functions go on to the
 * next row. */
typedef struct planes_vector {
    vf32 z, old;
    vmask near;
} planes_vector;

static ALWAYS_INLINE planes_vector planes_test(const planes_strip *strip, vi32 e[3], vf32 z, const float *depth)
{
    planes_vector v = {.z = v_min(v_max(z, strip->zmin), strip->zmax), .old = rows_loadf(depth)};
    v.near = v_mand(visible_inside(e), v_ge(v.old, v.z));
    for (int k = 0; k < 3; k++)
        e[k] = v_addi(e[k], strip->down[k]);
    return v;
}

/* visible_write, of what is tested. */
static ALWAYS_INLINE void planes_write(const planes_vector *v, size_t at, const e3d_record *r, int32_t id, e3d_visible_tile *plane,
                                       const e3d_record_table *table)
{
    float *depth = plane->z + at;
    int32_t *kept = plane->id + at;
    vmask pass = v_mand(v->near, v_lt(v->z, v->old));
    uint32_t equal = v_bits(v_mandnot(v->near, pass));
    rows_storef(depth, v_self(pass, v->z, v->old));
    rows_storei(kept, v_seli(pass, v_seti(id), rows_loadi(kept)));
    if (equal)
        visible_ties(equal, v->z, depth, kept, r, id, table);
}

/* Two planes, or four: whether anything is in front is asked once for all of them. */
static ALWAYS_INLINE void planes_some(const planes_strip *strip, vi32 (*e)[3], const vf32 *column, vf32 below, size_t at, const e3d_record *r,
                                      int32_t id, e3d_visible_tile *planes, const e3d_record_table *table, int some)
{
    planes_vector v[4];
    v[0] = planes_test(strip, e[0], v_add(column[0], below), planes[0].z + at);
    v[1] = planes_test(strip, e[1], v_add(column[1], below), planes[1].z + at);
    vmask near = v_mor(v[0].near, v[1].near);
    if (some == 4) {
        v[2] = planes_test(strip, e[2], v_add(column[2], below), planes[2].z + at);
        v[3] = planes_test(strip, e[3], v_add(column[3], below), planes[3].z + at);
        near = v_mor(near, v_mor(v[2].near, v[3].near));
    }
    if (!v_any(near))
        return;
    planes_write(&v[0], at, r, id, &planes[0], table);
    planes_write(&v[1], at, r, id, &planes[1], table);
    if (some == 4) {
        planes_write(&v[2], at, r, id, &planes[2], table);
        planes_write(&v[3], at, r, id, &planes[3], table);
    }
}

/* All planes; `count` is a constant where it is 4, so that no loop is left. */
static ALWAYS_INLINE void planes_all(const planes_strip *strip, vi32 (*e)[3], const vf32 *column, vf32 below, size_t at, const e3d_record *r,
                                     int32_t id, e3d_visible_tile *planes, const e3d_record_table *table, int count)
{
    if (count == 4)
        planes_some(strip, e, column, below, at, r, id, planes, table, 4);
    for (int s = 0; s < count && count != 4; s += 2)
        planes_some(strip, e + s, column + s, below, at, r, id, planes + s, table, 2);
}

/* ---- large records, block by block ---- */

/* A record in the planes: its edge functions in each, and those of them that it may show in (a bit each). */
typedef struct planes_piece {
    e3d_piece piece[E3D_MOST_MSAA_SAMPLES];
    raster_constants constants[E3D_MOST_MSAA_SAMPLES];
    uint32_t live;
    int tame;
} planes_piece;

/* What it covers of a vector of blocks in each plane, and at which depths in all of them. */
typedef struct planes_cover {
    visible_corners corners[E3D_MOST_MSAA_SAMPLES];
    uint32_t some[E3D_MOST_MSAA_SAMPLES];
    visible_cover all; /* some: in any plane; whole: in all */
    visible_range range;
} planes_cover;

static inline void planes_find_cover(const planes_piece *p, int count, int first, planes_cover *out)
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

/* Draws a record into a block of each plane, which shows nothing yet. */
static inline void planes_fresh_block(const planes_piece *p, const planes_cover *cover, int count, int block, const e3d_record *r,
                                      e3d_visible_tile *planes, const e3d_record_table *table)
{
    for (int s = 0; s < count; s++) {
        if (cover->some[s] >> block % V_LANES & 1)
            visible_block(&p->piece[s], &p->constants[s], block, 1, &cover->corners[s], r, &planes[s], table);
        else
            planes_clear_block(&planes[s], block);
    }
}

/* The edge functions of a plane in a block's first vector, from column x on: negative everywhere if the record misses the plane. */
static ALWAYS_INLINE void planes_corner(const planes_piece *p, const planes_cover *cover, int s, int lane, int x, vi32 e[3])
{
    const e3d_piece *piece = &p->piece[s];
    for (int k = 0; k < 3; k++)
        e[k] = p->live >> s & 1 ? v_addi(v_seti(cover->corners[s].e[k][lane] + piece->a[k] * x), rows_step(piece->a[k], piece->b[k]))
                                : v_seti(INT32_MIN / 2);
}

/* Draws a record into a block of all planes, whose samples are written, side by side. */
static ALWAYS_INLINE void planes_block_of(const planes_piece *p, const planes_cover *cover, int block, const e3d_record *r,
                                          e3d_visible_tile *planes, const e3d_record_table *table, int count)
{
    const e3d_piece *piece = &p->piece[__builtin_ctz(p->live)]; /* what isn't of a sample is the same in all */
    int left = block % VISIBLE_BLOCKS * RASTER_BLOCK, top = block / VISIBLE_BLOCKS * RASTER_BLOCK;
    planes_strip shared = {.zmin = p->constants[0].zmin, .zmax = p->constants[0].zmax};
    for (int k = 0; k < 3; k++)
        shared.down[k] = v_seti(ROWS * piece->b[k]);
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
        vi32 e[E3D_MOST_MSAA_SAMPLES][3];
        vf32 column[E3D_MOST_MSAA_SAMPLES];
        for (int s = 0; s < count; s++) {
            planes_corner(p, cover, s, block % V_LANES, x, e[s]);
            column[s] = visible_column(&p->constants[s], left + x - piece->base_x);
        }
        for (int y = 0; y < RASTER_BLOCK; y += ROWS) {
            vf32 below = v_mul(v_float(v_addi(rows_y(), v_seti(top + y - piece->base_y))), p->constants[0].gy);
            planes_all(&shared, e, column, below, (size_t)((top + y) * E3D_TILE + left + x), r, (int32_t)piece->slot, planes, table, count);
        }
    }
}

static void planes_block(const planes_piece *p, const planes_cover *cover, int count, int block, const e3d_record *r, e3d_visible_tile *planes,
                         const e3d_record_table *table)
{
    if (count == 4) /* a constant for the compiler */
        planes_block_of(p, cover, block, r, planes, table, 4);
    else
        planes_block_of(p, cover, block, r, planes, table, count);
}

/* Draws a record into one vector of blocks. */
static inline void planes_blocks(const planes_piece *p, int first, const e3d_record *r, e3d_visible_tile *planes,
                                 const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    const int count = pattern->count;
    planes_cover cover;
    planes_find_cover(p, count, first, &cover);
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
    uint32_t unsure = rest & (uint32_t)(planes->stale >> first) & v_bits(v_gt(range.near, zmin)); /* others can't be behind zmax */
    rest &= ~planes_behind(unsure, first, near, planes, count);
    zmin = v_loadf(planes->zmin + first);
    v_storef(planes->zmin + first, v_self(visible_lanes(rest), v_min(range.near, zmin), zmin));
    planes->stale |= (uint64_t)rest << first;
    planes->noted &= ~((uint64_t)fresh << first);
    for (uint32_t some = fresh; some; some &= some - 1)
        planes_fresh_block(p, &cover, count, first + __builtin_ctz(some), r, planes, table);
    for (uint32_t some = noted & ~fresh; some; some &= some - 1)
        planes_unfold(planes, pattern, table, first + __builtin_ctz(some));
    for (uint32_t some = rest & ~fresh; some; some &= some - 1)
        planes_block(p, &cover, count, first + __builtin_ctz(some), r, planes, table);
}

/* Finds an edge function in all planes: one that leaves no sample of a plane out there, but of another, is kept in both, so that all
 * change alike from sample to sample. Planes that it leaves no sample of are no longer live. */
static inline void planes_find_edge(const e3d_record *r, int k, const e3d_visible_tile *planes, const e3d_sample_pattern *pattern,
                                    planes_piece *out)
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

/* Finds a record in the planes of a tile; 0 if it misses all. */
static inline int planes_find_piece(const records_lanes *in, int lane, const e3d_record *r, int32_t id, const e3d_visible_tile *planes,
                                    const e3d_sample_pattern *pattern, planes_piece *out)
{
    out->live = (1u << pattern->count) - 1;
    out->tame = 1;
    for (int s = 0; s < pattern->count; s++) {
        e3d_piece *p = &out->piece[s];
        *p = (e3d_piece){.x0 = (int32_t)in->x0[lane], .y0 = (int32_t)in->y0[lane], .x1 = (int32_t)in->x1[lane], .y1 = (int32_t)in->y1[lane],
                         .z0 = planes_z0(r, pattern, s), .gx = r->gx, .gy = r->gy, .slot = (uint32_t)id};
        p->base_x = planes_first(r->x, pattern->reach) - planes->x;
        p->base_y = planes_first(r->y, pattern->reach) - planes->y;
        out->constants[s] = planes_constants(r, pattern, s, id);
        out->tame &= visible_is_tame(p);
    }
    for (int k = 0; k < 3 && out->live; k++)
        planes_find_edge(r, k, planes, pattern, out);
    return out->live != 0;
}

/* Draws a record of any size block by block. */
static void planes_wide(const records_lanes *in, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *planes,
                        const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    planes_piece p;
    if (!planes_find_piece(in, lane, r, id, planes, pattern, &p))
        return;
    for (int row = p.piece[0].y0 / RASTER_BLOCK & -ROWS; row <= p.piece[0].y1 / RASTER_BLOCK; row += ROWS)
        for (int block = 0; block < VISIBLE_BLOCKS; block += ROW_LANES)
            planes_blocks(&p, row * VISIBLE_BLOCKS + block, r, planes, pattern, table);
}

/* ---- small records, in strips ---- */

/* A vector of records, whose edge functions stand here for each plane. */
typedef struct planes_lanes {
    records_lanes in;
    int32_t e[E3D_MOST_MSAA_SAMPLES][3][V_LANES];
} planes_lanes;

/* Finds an edge function in each plane; returns where it is greatest. */
static inline record_edge planes_edge(const vi32 corners[6], int k, const vi32 first[2], const e3d_visible_tile *planes,
                                      const e3d_sample_pattern *pattern, planes_lanes *out)
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

static inline void planes_find(const e3d_record *const r[V_LANES], const e3d_visible_tile *planes, const e3d_sample_pattern *pattern,
                               planes_lanes *out)
{
    vi32 corners[8], first[2];
    record_edge e[3];
    v_load_rows((const void *const *)r, corners);
    records_boxes(corners, corners + 3, planes, pattern->reach, first, &out->in);
    for (int k = 0; k < 3; k++) {
        e[k] = planes_edge(corners, k, first, planes, pattern, out);
        records_keep_edge(&e[k], k, &out->in);
    }
    records_rows(e, &out->in);
}

/* Draws a record in strips, as records_strips does, in all planes side by side. */
static ALWAYS_INLINE void planes_strips_of(const planes_lanes *lanes, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *planes,
                                           const e3d_sample_pattern *pattern, const e3d_record_table *table, int count)
{
    const records_lanes *in = &lanes->in;
    planes_strip shared = {.zmin = v_setf(r->zmin), .zmax = v_setf(r->zmax)};
    vf32 gx = v_setf(r->gx), gy = v_setf(r->gy);
    vf32 along = v_add(v_float(rows_x()), v_setf(in->dx[lane])), z0[E3D_MOST_MSAA_SAMPLES];
    for (int s = 0; s < count; s++)
        z0[s] = v_setf(planes_z0(r, pattern, s));
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
            planes_all(&shared, e, column, below, i, r, id, planes, table, count);
            row = v_add(row, v_setf(ROWS));
        }
        along = v_add(along, v_setf(ROW_LANES));
    }
}

/* Four samples are the common number: a constant for the compiler. */
static void planes_strips(const planes_lanes *lanes, int lane, const e3d_record *r, int32_t id, e3d_visible_tile *planes,
                          const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    if (pattern->count == 4)
        planes_strips_of(lanes, lane, r, id, planes, pattern, table, 4);
    else
        planes_strips_of(lanes, lane, r, id, planes, pattern, table, pattern->count);
}

/* Draws a record, unless what is there hides it (see records_draw). */
static inline void planes_draw(planes_lanes *lanes, int lane, const e3d_record *r, int32_t id, uint64_t open, records_touched *touched,
                               e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    const records_lanes *in = &lanes->in;
    uint64_t met = records_met(in, lane);
    int strips = in->few >> lane & 1; /* of what is larger, whole blocks need not be written in each plane */
    if (!(strips && met & open) && !(met & ~records_behind(r->zmin, planes)))
        return;
    if (!strips) {
        records_tell(touched, planes);
        planes_wide(in, lane, r, id, planes, pattern, table);
        return;
    }
    for (uint64_t left = met & planes->noted; left; left &= left - 1)
        planes_unfold(planes, pattern, table, __builtin_ctzll(left));
    touched->met |= met;
    touched->near = r->zmin < touched->near ? r->zmin : touched->near;
    planes_strips(lanes, lane, r, id, planes, pattern, table);
}

static void kernel_raster_planes(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table,
                                 const uint32_t *ids, int count)
{
    const e3d_record *r[V_LANES];
    uint32_t turned[V_LANES];
    planes_lanes lanes;
    records_touched touched = {0, E3D_BEYOND_FAR};
    uint64_t open = ~records_behind(1.0f, planes);
    for (int i = 0; i < count; i += V_LANES) {
        int some = count - i < V_LANES ? count - i : V_LANES;
        const uint32_t *id = records_next(table, ids + i, count - i, turned, r);
        planes_find(r, planes, pattern, &lanes);
        for (int l = 0; l < some; l++)
            planes_draw(&lanes, l, r[l], (int32_t)id[l], open, &touched, planes, pattern, table);
    }
    records_tell(&touched, planes);
}

/* ---- all planes of a tile ---- */

static void kernel_planes_settle(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table)
{
    for (uint64_t left = planes->noted; left; left &= left - 1)
        planes_unfold(planes, pattern, table, __builtin_ctzll(left));
}

static void kernel_planes_measure(e3d_visible_tile *planes, int count, float columns[][E3D_BLOCK])
{
    for (uint64_t left = ~planes->noted; left; left &= left - 1) {
        int block = __builtin_ctzll(left);
        planes_columns(planes, count, block, columns[block]);
        visible_bound(planes, block, columns[block]);
    }
}

/* The pixels of a row that don't show the same in all planes, a bit each, and the IDs of those that do. */
static inline uint64_t planes_row(const e3d_visible_tile *planes, int count, int row, int32_t *shared)
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

/* Bits of a row of blocks, spread over the pixels of a row. */
static inline uint64_t planes_spread(uint64_t blocks)
{
    uint64_t pixels = 0;
    for (int b = 0; b < VISIBLE_BLOCKS; b++)
        pixels |= (blocks >> b & 1) * (0xFFull << b * RASTER_BLOCK);
    return pixels;
}

/* A bit for each pixel of a row that shows nothing in all planes. */
static inline uint64_t planes_gaps(const int32_t *shared)
{
    uint64_t gaps = 0;
    for (int x = 0; x < E3D_TILE; x += V_LANES)
        gaps |= (uint64_t)(v_bits(v_negi(v_loadi(shared + x))) & setup_tail(V_LANES)) << x;
    return gaps;
}

static int kernel_planes_split(const e3d_visible_tile *planes, int count, int width, int height, uint64_t mixed[E3D_TILE],
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
        uint64_t noted = planes_spread(planes->noted >> first & 0xFF);
        gaps |= planes_spread(empty >> first & 0xFF) & inside;
        mixed[row] = 0;
        if (noted == ~(uint64_t)0)
            continue;
        mixed[row] = planes_row(planes, count, row, shared->id + row * E3D_TILE) & ~noted & inside;
        gaps |= planes_gaps(shared->id + row * E3D_TILE) & ~noted & ~mixed[row] & inside;
    }
    return gaps != 0;
}

#endif
