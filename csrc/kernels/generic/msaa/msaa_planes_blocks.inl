/* raster with multisampling: a tile has a plane for each sample of its pixels (R103, R104), and blocks of pixels are noted and bounded for
 * all planes at once.
 *
 * In a plane all samples are as far apart as pixels are, so what draws records into a tile draws them into a plane, with edge functions
 * and depths that are moved by the sample's offset. A block that a record covers whole in all planes, nearer than all that is there, is
 * noted and written in none of them. Bounds and notes of blocks stand in the first plane.
 */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"

/* ---- a record in a plane ---- */

/* R104: z0 at a sample. */
static ALWAYS_INLINE float msaa_z0(const e3d_record *r, const e3d_sample_pattern *pattern, int s)
{
    float u = (float)pattern->x[s] * (1.0f / E3D_SUBPIXEL), v = (float)pattern->y[s] * (1.0f / E3D_SUBPIXEL);
    return (r->z0 + u * r->gx) + v * r->gy;
}

/* The first column or row of the box (R104). */
static inline int32_t msaa_first(const int32_t v[3], int32_t reach)
{
    int32_t first = (visible_min3(v) + (127 - reach)) >> 8;
    return first > 0 ? first : 0;
}

static inline raster_constants msaa_constants(const e3d_record *r, const e3d_sample_pattern *pattern, int s, int32_t id)
{
    return (raster_constants){v_setf(msaa_z0(r, pattern, s)), v_setf(r->gx), v_setf(r->gy), v_setf(r->zmin), v_setf(r->zmax),
                              v_seti(id)};
}

/* ---- blocks ---- */

/* Makes a block show nothing. */
static inline void msaa_clear_block(e3d_visible_tile *plane, int block)
{
    int at = block / VISIBLE_BLOCKS * RASTER_BLOCK * E3D_TILE + block % VISIBLE_BLOCKS * RASTER_BLOCK;
    for (int y = 0; y < RASTER_BLOCK; y += ROWS)
        for (int x = 0; x < RASTER_BLOCK; x += ROW_LANES) {
            rows_storef(plane->z + at + y * E3D_TILE + x, v_setf(E3D_BEYOND_FAR));
            rows_storei(plane->id + at + y * E3D_TILE + x, v_seti(E3D_NO_SLOT));
        }
}

/* Writes depths and IDs of a noted block. */
static void msaa_unfold(e3d_visible_tile *planes, const e3d_sample_pattern *pattern, const e3d_record_table *table, int block)
{
    int left = block % VISIBLE_BLOCKS * RASTER_BLOCK, top = block / VISIBLE_BLOCKS * RASTER_BLOCK;
    int32_t id = planes->noted_id[block];
    planes->noted &= ~(1ull << block);
    if (id < 0) {
        for (int s = 0; s < pattern->count; s++)
            msaa_clear_block(&planes[s], block);
        return;
    }
    const e3d_record *r = e3d_record_at(table, (uint32_t)id);
    int32_t base_x = msaa_first(r->x, pattern->reach) - planes->x, base_y = msaa_first(r->y, pattern->reach) - planes->y;
    for (int s = 0; s < pattern->count; s++) {
        raster_constants c = msaa_constants(r, pattern, s, id);
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

/* The farthest depth of each column of a block, over all planes. */
static inline void msaa_columns(const e3d_visible_tile *planes, int count, int block, float columns[RASTER_BLOCK])
{
    float more[RASTER_BLOCK];
    visible_columns(planes, block, columns);
    for (int s = 1; s < count; s++) {
        visible_columns(&planes[s], block, more);
        for (int x = 0; x < RASTER_BLOCK; x++)
            columns[x] = visible_farther(columns[x], more[x]);
    }
}

static inline void msaa_measure_block(e3d_visible_tile *planes, int count, int block)
{
    float columns[RASTER_BLOCK];
    msaa_columns(planes, count, block, columns);
    visible_bound(planes, block, columns);
}

static inline int msaa_hide(const e3d_visible_tile *planes, int count, int block, float near)
{
    for (int s = 0; s < count; s++)
        if (!visible_hides(&planes[s], block, near))
            return 0;
    return 1;
}

/* Measures stale blocks; returns the blocks that hide the record. */
static inline uint32_t msaa_behind(uint32_t blocks, int first, const float near[V_LANES], e3d_visible_tile *planes, int count)
{
    uint32_t behind = 0;
    for (; blocks; blocks &= blocks - 1) {
        int lane = __builtin_ctz(blocks);
        if (!msaa_hide(planes, count, first + lane, near[lane]))
            continue;
        msaa_measure_block(planes, count, first + lane);
        behind |= blocks & -blocks;
    }
    return behind;
}

/* ---- a vector of samples in each plane ---- */

/* What the planes share: bounds of depth, and the steps of edge functions from row to row. */
typedef struct msaa_strip {
    vf32 zmin, zmax;
    vi32 down[3];
} msaa_strip;

/* One vector of one plane: its depths, and the lanes that are covered and not hidden. Its edge functions step to the next row. */
typedef struct msaa_vector {
    vf32 z, old;
    vmask near;
} msaa_vector;

static ALWAYS_INLINE msaa_vector msaa_test(const msaa_strip *strip, vi32 e[3], vf32 z, const float *depth)
{
    msaa_vector v = {.z = v_min(v_max(z, strip->zmin), strip->zmax), .old = rows_loadf(depth)};
    v.near = v_mand(visible_inside(e), v_ge(v.old, v.z));
    for (int k = 0; k < 3; k++)
        e[k] = v_addi(e[k], strip->down[k]);
    return v;
}

/* visible_write, for what is tested. */
static ALWAYS_INLINE void msaa_write(const msaa_vector *v, size_t at, const e3d_record *r, int32_t id, e3d_visible_tile *plane,
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

/* Does two planes, or four, and tests once for all of them whether anything is in front. */
static ALWAYS_INLINE void msaa_some(const msaa_strip *strip, vi32 (*e)[3], const vf32 *column, vf32 below, size_t at,
                                    const e3d_record *r,
                                    int32_t id, e3d_visible_tile *planes, const e3d_record_table *table, int some)
{
    msaa_vector v[4];
    v[0] = msaa_test(strip, e[0], v_add(column[0], below), planes[0].z + at);
    v[1] = msaa_test(strip, e[1], v_add(column[1], below), planes[1].z + at);
    vmask near = v_mor(v[0].near, v[1].near);
    if (some == 4) {
        v[2] = msaa_test(strip, e[2], v_add(column[2], below), planes[2].z + at);
        v[3] = msaa_test(strip, e[3], v_add(column[3], below), planes[3].z + at);
        near = v_mor(near, v_mor(v[2].near, v[3].near));
    }
    if (!v_any(near))
        return;
    msaa_write(&v[0], at, r, id, &planes[0], table);
    msaa_write(&v[1], at, r, id, &planes[1], table);
    if (some == 4) {
        msaa_write(&v[2], at, r, id, &planes[2], table);
        msaa_write(&v[3], at, r, id, &planes[3], table);
    }
}

/* Does all planes; `count` is a constant if it is 4, so that no loop remains. */
static ALWAYS_INLINE void msaa_all(const msaa_strip *strip, vi32 (*e)[3], const vf32 *column, vf32 below, size_t at,
                                   const e3d_record *r,
                                   int32_t id, e3d_visible_tile *planes, const e3d_record_table *table, int count)
{
    if (count == 4)
        msaa_some(strip, e, column, below, at, r, id, planes, table, 4);
    for (int s = 0; s < count && count != 4; s += 2)
        msaa_some(strip, e + s, column + s, below, at, r, id, planes + s, table, 2);
}
