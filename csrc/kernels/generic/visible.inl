/* raster, the visible surface of a tile: samples, and blocks of them with hierarchical depth (R12, R14-R16).
 *
 * A block of 8 x 8 samples that one record covers whole, nearer than all that is there, is only noted: its samples are
 * written when another record meets it halfway, or when the tile is settled. z is monotone along both axes (R14 has
 * three roundings, each monotone), so its values at a block's corners bound it exactly. Ties go to the first in order, so
 * the order in which records arrive changes nothing.
 */
#pragma once

#include "base/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/fragments.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"

enum { VISIBLE_BLOCKS = E3D_TILE / RASTER_BLOCK };

typedef struct visible_plane {
    float z0, gx, gy, zmin, zmax;
    int32_t base_x, base_y; /* relative to the tile */
} visible_plane;

static inline int32_t visible_min3(const int32_t v[3])
{
    int32_t least = v[0] < v[1] ? v[0] : v[1];
    return least < v[2] ? least : v[2];
}

/* The first column or row of the sample box, in the viewport (R10). */
static inline int32_t visible_first(const int32_t v[3])
{
    int32_t first = (visible_min3(v) + 127) >> 8;
    return first > 0 ? first : 0;
}

static inline visible_plane visible_plane_of(const e3d_record *r, int32_t tile_x, int32_t tile_y)
{
    return (visible_plane){r->z0, r->gx, r->gy, r->zmin, r->zmax, visible_first(r->x) - tile_x, visible_first(r->y) - tile_y};
}

/* R14 at a sample of the tile. */
static inline float visible_depth(const visible_plane *p, int32_t x, int32_t y)
{
    float z = (p->z0 + (float)(x - p->base_x) * p->gx) + (float)(y - p->base_y) * p->gy;
    z = z > p->zmin ? z : p->zmin;
    return z < p->zmax ? z : p->zmax;
}

/* ---- samples ---- */

/* Whether a record comes before the visible one by R16: by order, and then by ID, since one worker makes all pieces of a
 * primitive in sequence. */
static inline int visible_comes_first(const e3d_record *r, int32_t id, int32_t kept, const e3d_record_table *table)
{
    if (kept < 0)
        return 0;
    uint32_t order = e3d_order_at(table, (uint32_t)kept);
    return r->order < order || (r->order == order && id < kept);
}

/* Resolves lanes of equal depth. The depth is stored, too, since of 0 and -0 it takes the winner's sign. */
static inline void visible_ties(uint32_t equal, vf32 z, float *depth, int32_t *kept, const e3d_record *r, int32_t id,
                                const e3d_record_table *table)
{
    float lanes[V_LANES];
    v_storef(lanes, z);
    for (; equal; equal &= equal - 1) {
        int lane = __builtin_ctz(equal), at = rows_sample(lane);
        if (!visible_comes_first(r, id, kept[at], table))
            continue;
        depth[at] = lanes[lane];
        kept[at] = id;
    }
}

/* R12: no edge function is negative. (`> -1` is one comparison; `not < 0` would need an instruction more to invert the mask.) */
static inline vmask visible_inside(const vi32 e[3]) { return v_gti(v_ori(v_ori(e[0], e[1]), e[2]), v_seti(-1)); }

/* The part of R14 that a column of vectors shares. */
static inline vf32 visible_column(const raster_constants *c, int32_t from)
{
    return v_add(c->z0, v_mul(v_float(v_addi(rows_x(), v_seti(from))), c->gx));
}

static inline vf32 visible_z(const raster_constants *c, vf32 column, int32_t dy)
{
    vf32 z = v_add(column, v_mul(v_float(v_addi(rows_y(), v_seti(dy))), c->gy));
    return v_min(v_max(z, c->zmin), c->zmax);
}

/* Writes one vector of samples, `inside` of which are covered. It has no early outs: whether any lane is covered, or passes,
 * is mispredicted half of the time, and writing unchanged lanes back is cheaper (7 % of the bunny). */
static inline void visible_write(vmask inside, vf32 z, size_t at, const e3d_record *r, int32_t id,
                                 e3d_visible_tile *tile, const e3d_record_table *table)
{
    float *depth = tile->z + at;
    int32_t *kept = tile->id + at;
    vf32 old = rows_loadf(depth);
    vmask pass = v_lt_in(inside, z, old);
    vmask equal = v_eq_in(inside, z, old);
    rows_storef(depth, v_self(pass, z, old));
    rows_storei(kept, v_seli(pass, v_seti(id), rows_loadi(kept)));
    if (v_any(equal))
        visible_ties(v_bits(equal), z, depth, kept, r, id, table);
}

/* ---- blocks ---- */

/* Writes depths and IDs of a noted block. */
static void visible_unfold(e3d_visible_tile *tile, const e3d_record_table *table, int block)
{
    int at = block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    int32_t id = tile->noted_id[block];
    tile->noted &= ~(1ull << block);
    if (id < 0) {
        for (int y = 0; y < RASTER_BLOCK; y += ROWS)
            for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
                rows_storef(tile->z + at + y * E3D_TILE + x, v_setf(E3D_BEYOND_FAR));
                rows_storei(tile->id + at + y * E3D_TILE + x, v_seti(id));
            }
        return;
    }
    visible_plane p = visible_plane_of(e3d_record_at(table, (uint32_t)id), tile->x, tile->y);
    raster_constants c = {v_setf(p.z0), v_setf(p.gx), v_setf(p.gy), v_setf(p.zmin), v_setf(p.zmax), v_seti(id)};
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
        vf32 column = visible_column(&c, at % E3D_TILE + x - p.base_x);
        for (int y = 0; y < RASTER_BLOCK; y += ROWS) {
            rows_storef(tile->z + at + y * E3D_TILE + x, visible_z(&c, column, at / E3D_TILE + y - p.base_y));
            rows_storei(tile->id + at + y * E3D_TILE + x, c.slot);
        }
    }
}

/* Writes the IDs of a noted block, which stays noted. */
static inline void visible_unfold_ids(e3d_visible_tile *tile, int block)
{
    int at = block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    vi32 id = v_seti(tile->noted_id[block]);
    for (int y = 0; y < RASTER_BLOCK; y += ROWS)
        for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES)
            rows_storei(tile->id + at + y * E3D_TILE + x, id);
}

static inline float visible_farther(float a, float b) { return a > b ? a : b; }

/* The farthest depth of each column of a block whose samples are written. */
static inline void visible_columns(const e3d_visible_tile *tile, int block, float columns[RASTER_BLOCK])
{
    const float *z = tile->z + block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    float lanes[RASTER_BLOCK * ROWS];
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
        vf32 far = rows_loadf(z + x);
        for (int y = ROWS; y < RASTER_BLOCK; y += ROWS)
            far = v_max(far, rows_loadf(z + y * E3D_TILE + x));
        v_storef(lanes + x, far);
    }
    for (int x = 0; x < RASTER_BLOCK; x++) /* over one row of lanes, or two */
        columns[x] = visible_farther(lanes[x], lanes[x + RASTER_BLOCK * (ROWS - 1)]);
}

/* Sets the zmax of a block from its columns; it is no longer stale. */
static inline void visible_bound(e3d_visible_tile *tile, int block, const float columns[RASTER_BLOCK])
{
    float far[RASTER_BLOCK / 2];
    for (int x = 0; x < RASTER_BLOCK / 2; x++)
        far[x] = visible_farther(columns[x], columns[x + RASTER_BLOCK / 2]);
    tile->zmax[block] = visible_farther(visible_farther(far[0], far[2]), visible_farther(far[1], far[3]));
    tile->stale &= ~(1ull << block);
}

/* Measures the zmax of a block whose samples are written. */
static void visible_measure(e3d_visible_tile *tile, int block)
{
    float columns[RASTER_BLOCK];
    visible_columns(tile, block, columns);
    visible_bound(tile, block, columns);
}

/* Whether all samples of a block, which are written, are nearer than `near`. */
static inline int visible_hides(const e3d_visible_tile *tile, int block, float near)
{
    const float *z = tile->z + block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    vf32 far = rows_loadf(z);
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES)
        for (int y = 0; y < RASTER_BLOCK; y += ROWS)
            far = v_max(far, rows_loadf(z + y * E3D_TILE + x));
    return !v_any(v_mnot(v_gt(v_setf(near), far)));
}

/* A vector of blocks: the edge functions at each block's first sample, and the record's nearest depth in it. */
typedef struct visible_corners {
    int32_t e[3][V_LANES];
    float near[V_LANES];
} visible_corners;

/* Draws a record into a block that it covers in part, or whose depths overlap the record's. A fresh block shows nothing yet,
 * and is written without being read. */
static inline void visible_block(const e3d_piece *p, const raster_constants *c, int block, int fresh, const visible_corners *corners,
                                 const e3d_record *r, e3d_visible_tile *tile, const e3d_record_table *table)
{
    int left = block % VISIBLE_BLOCKS * RASTER_BLOCK, top = block / VISIBLE_BLOCKS * RASTER_BLOCK;
    vf32 beyond = v_setf(E3D_BEYOND_FAR);
    for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
        vf32 column = visible_column(c, left + x - p->base_x);
        vi32 e[3];
        for (int k = 0; k < 3; k++)
            e[k] = v_addi(v_seti(corners->e[k][block % V_LANES] + p->a[k] * x), rows_step(p->a[k], p->b[k]));
        for (int y = 0; y < RASTER_BLOCK; y += ROWS) {
            vf32 z = visible_z(c, column, top + y - p->base_y);
            size_t at = (size_t)((top + y) * E3D_TILE + left + x);
            if (fresh) {
                vmask pass = v_mand(visible_inside(e), v_lt(z, beyond));
                rows_storef(tile->z + at, v_self(pass, z, beyond));
                rows_storei(tile->id + at, v_seli(pass, c->slot, v_seti(E3D_NO_SLOT)));
            } else {
                visible_write(visible_inside(e), z, at, r, (int32_t)p->slot, tile, table);
            }
            for (int k = 0; k < 3; k++)
                e[k] = v_addi(e[k], v_seti(ROWS * p->b[k]));
        }
    }
}

/* The nearest and the farthest depth in each block of a vector. */
typedef struct visible_range {
    vf32 near, far;
} visible_range;

static inline vf32 visible_corner(const raster_constants *c, vi32 dx, vi32 dy)
{
    vf32 z = v_add(v_add(c->z0, v_mul(v_float(dx), c->gx)), v_mul(v_float(dy), c->gy));
    return v_min(v_max(z, c->zmin), c->zmax);
}

static inline visible_range visible_range_of(const e3d_piece *p, const raster_constants *c, vi32 x, vi32 y)
{
    const int32_t last = RASTER_BLOCK - 1;
    int32_t near_x = p->gx > 0 ? 0 : last, near_y = p->gy > 0 ? 0 : last;
    vi32 dx = v_subi(x, v_seti(p->base_x)), dy = v_subi(y, v_seti(p->base_y));
    return (visible_range){
        visible_corner(c, v_addi(dx, v_seti(near_x)), v_addi(dy, v_seti(near_y))),
        visible_corner(c, v_addi(dx, v_seti(last - near_x)), v_addi(dy, v_seti(last - near_y)))};
}

/* Whether no step of R14 can overflow; otherwise the depths at a block's corners bound nothing. */
static inline int visible_is_tame(const e3d_piece *p)
{
    const float most = 0x1p100f;
    return p->z0 < most && p->z0 > -most && p->gx < most && p->gx > -most && p->gy < most && p->gy > -most;
}

/* A bit for each block of a vector: it lies in the box and may be covered; it is covered whole. */
typedef struct visible_cover {
    uint32_t some, whole;
} visible_cover;

static inline visible_cover visible_cover_of(const e3d_piece *p, vi32 x, vi32 y, int32_t left, int32_t top, visible_corners *corners)
{
    const int32_t last = RASTER_BLOCK - 1;
    vi32 least = v_seti(0), most = v_seti(0);
    for (int k = 0; k < 3; k++) {
        int32_t a = p->a[k] * last, b = p->b[k] * last, first = p->e[k] + p->a[k] * left + p->b[k] * top;
        vi32 corner = v_addi(rows_step(p->a[k] * RASTER_BLOCK, p->b[k] * RASTER_BLOCK), v_seti(first));
        v_storei(corners->e[k], corner);
        most = v_ori(most, v_addi(corner, v_seti((a > 0 ? a : 0) + (b > 0 ? b : 0))));
        least = v_ori(least, v_addi(corner, v_seti((a < 0 ? a : 0) + (b < 0 ? b : 0))));
    }
    vmask across = v_mor(v_gti(v_seti(p->x0 - last), x), v_gti(x, v_seti(p->x1)));
    vmask down = v_mor(v_gti(v_seti(p->y0 - last), y), v_gti(y, v_seti(p->y1)));
    uint32_t out = v_bits(v_mor(ROWS > 1 ? v_mor(across, down) : across, v_negi(most)));
    uint32_t all = setup_tail(V_LANES);
    return (visible_cover){all & ~out, all & ~out & ~v_bits(v_negi(least))};
}

/* The mask of the lanes whose bits are set. */
static inline vmask visible_lanes(uint32_t bits)
{
    vi32 chosen = v_andi(v_seti((int32_t)bits), v_onebit());
    return v_mnot(v_eqi(chosen, v_seti(0)));
}

/* Notes blocks that the record covers whole, nearer than everything there. */
static inline void visible_note(uint32_t blocks, int first, const visible_range *range, vi32 id, e3d_visible_tile *tile)
{
    vmask lanes = visible_lanes(blocks);
    v_storef(tile->zmin + first, v_self(lanes, range->near, v_loadf(tile->zmin + first)));
    v_storef(tile->zmax + first, v_self(lanes, range->far, v_loadf(tile->zmax + first)));
    v_storei(tile->noted_id + first, v_seli(lanes, id, v_loadi(tile->noted_id + first)));
    tile->noted |= (uint64_t)blocks << first;
    tile->stale &= ~((uint64_t)blocks << first);
}

/* Measures stale blocks; returns the blocks that hide the record. */
static inline uint32_t visible_behind(uint32_t blocks, int first, const float near[V_LANES], e3d_visible_tile *tile)
{
    uint32_t behind = 0;
    for (; blocks; blocks &= blocks - 1) {
        int lane = __builtin_ctz(blocks);
        if (!visible_hides(tile, first + lane, near[lane]))
            continue;
        visible_measure(tile, first + lane);
        behind |= blocks & -blocks;
    }
    return behind;
}

/* Draws a record into one vector of blocks. */
static inline void visible_blocks(const e3d_piece *p, const raster_constants *c, int first, int tame,
                                  const e3d_record *r, e3d_visible_tile *tile, const e3d_record_table *table)
{
    int32_t top = first / VISIBLE_BLOCKS * RASTER_BLOCK, left = first % VISIBLE_BLOCKS * RASTER_BLOCK;
    vi32 x = v_addi(v_seti(left), v_shl(rows_x(), 3)), y = v_addi(v_seti(top), v_shl(rows_y(), 3));
    visible_corners corners;
    visible_cover cover = visible_cover_of(p, x, y, left, top, &corners);
    if (!cover.some)
        return;
    visible_range range = {c->zmin, c->zmax};
    if (tame)
        range = visible_range_of(p, c, x, y);
    vf32 zmin = v_loadf(tile->zmin + first), zmax = v_loadf(tile->zmax + first);
    uint32_t open = cover.some & ~v_bits(v_gt(range.near, zmax));
    uint32_t before = open & cover.whole & v_bits(v_lt(range.far, zmin)), rest = open & ~before;
    if (before)
        visible_note(before, first, &range, c->slot, tile);
    if (!rest)
        return;
    v_storef(corners.near, range.near);
    uint32_t noted = rest & (uint32_t)(tile->noted >> first), fresh = noted & v_bits(v_negi(v_loadi(tile->noted_id + first)));
    /* Blocks that aren't stale can't be behind zmax */
    uint32_t unsure = rest & (uint32_t)(tile->stale >> first) & v_bits(v_gt(range.near, zmin));
    rest &= ~visible_behind(unsure, first, corners.near, tile);
    zmin = v_loadf(tile->zmin + first);
    v_storef(tile->zmin + first, v_self(visible_lanes(rest), v_min(range.near, zmin), zmin));
    tile->stale |= (uint64_t)rest << first;
    tile->noted &= ~((uint64_t)fresh << first);
    for (uint32_t some = fresh; some; some &= some - 1)
        visible_block(p, c, first + __builtin_ctz(some), 1, &corners, r, tile, table);
    for (uint32_t some = noted & ~fresh; some; some &= some - 1)
        visible_unfold(tile, table, first + __builtin_ctz(some));
    for (uint32_t some = rest & ~fresh; some; some &= some - 1)
        visible_block(p, c, first + __builtin_ctz(some), 0, &corners, r, tile, table);
}

/* Draws a record block by block, over the rows of blocks that its box touches. */
static inline void visible_wide(const e3d_piece *p, const raster_constants *c, const e3d_record *r,
                                e3d_visible_tile *tile, const e3d_record_table *table)
{
    int tame = visible_is_tame(p);
    for (int row = p->y0 / RASTER_BLOCK & -ROWS; row <= p->y1 / RASTER_BLOCK; row += ROWS)
        for (int block = 0; block < VISIBLE_BLOCKS; block += ROW_LANES)
            visible_blocks(p, c, row * VISIBLE_BLOCKS + block, tame, r, tile, table);
}

/* ---- what is written sample by sample ---- */

/* Updates the bounds of blocks (at least one) in which samples were written, none nearer than `near`. */
static inline void visible_touch(uint64_t met, float near, e3d_visible_tile *tile)
{
    for (int first = 0; first < E3D_TILE_BLOCKS; first += V_LANES) {
        vf32 zmin = v_loadf(tile->zmin + first);
        v_storef(tile->zmin + first, v_self(visible_lanes((uint32_t)(met >> first)), v_min(v_setf(near), zmin), zmin));
    }
    tile->stale |= met;
}

static int __attribute__((noinline, cold)) fragment_comes_first(int32_t id, int32_t kept, const e3d_record_table *table)
{
    return kept >= 0 && e3d_order_at(table, (uint32_t)id) < e3d_order_at(table, (uint32_t)kept);
}

/* Keeps the nearer of each two depths without a branch, since which one it is is unpredictable. */
static void kernel_raster_fragments(e3d_visible_tile *tile, const e3d_record_table *table, const e3d_fragment_link *b)
{
    uint64_t met = 0;
    float near = E3D_BEYOND_FAR;
    for (uint32_t i = 0; i < b->count; i++) {
        int at = b->sample[i], block = at / (RASTER_BLOCK * E3D_TILE) * VISIBLE_BLOCKS + at % E3D_TILE / RASTER_BLOCK;
        float z = b->z[i];
        if (tile->noted >> block & 1) {
            if (z > tile->zmax[block])
                continue;
            visible_unfold(tile, table, block);
        }
        float old = tile->z[at];
        int32_t kept = tile->id[at], nearer = -(z < old);
        if (__builtin_expect(z == old, 0) && fragment_comes_first(b->id[i], kept, table)) {
            tile->z[at] = z;
            tile->id[at] = b->id[i];
            continue;
        }
        tile->z[at] = z < old ? z : old;
        tile->id[at] = kept ^ ((kept ^ b->id[i]) & nearer);
        near = z < near ? z : near;
        met |= 1ull << block;
    }
    if (met)
        visible_touch(met, near, tile);
}

static void kernel_raster_settle(e3d_visible_tile *tile, const e3d_record_table *table, int depths)
{
    for (uint64_t left = tile->noted; left; left &= left - 1) {
        int block = __builtin_ctzll(left);
        if (depths)
            visible_unfold(tile, table, block);
        else
            visible_unfold_ids(tile, block);
    }
}

static void kernel_raster_measure(e3d_visible_tile *tile, float columns[][E3D_BLOCK])
{
#ifdef E3D_NARROW_TABLE /* eight lanes are the columns of a block: inside the spheres, 59 instead of 117 us a frame */
    E3D_NARROW_TABLE.raster_measure(tile, columns);
#else
    for (uint64_t left = ~tile->noted; left; left &= left - 1) {
        int block = __builtin_ctzll(left);
        visible_columns(tile, block, columns[block]);
        visible_bound(tile, block, columns[block]);
    }
#endif
}
