/* setup: finds the triangles of a cluster that may show (R4-R7, R9, R10), a vector of triangles at a time. It is
 * conservative: a triangle whose area 32 bits don't hold stays, and record.inl or frame/geometry/setup.c decides. */
#pragma once

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"

static inline vi32 setup_fetch(const int32_t *table, const uint8_t *indices, int i)
{
    return v_gatheri(table, v_loadu8(indices + i));
}

/* The first and the last sample of each lane's box along one axis (R10, R104). */
typedef struct setup_span {
    vi32 first, last;
} setup_span;

static inline setup_span setup_samples(vi32 lo, vi32 hi, int32_t size, int32_t reach)
{
    return (setup_span){v_maxi(v_sra(v_addi(lo, v_seti(127 - reach)), 8), v_seti(0)),
                        v_mini(v_sra(v_subi(hi, v_seti(128 - reach)), 8), v_seti(size - 1))};
}

static inline vi32 setup_least(const vi32 v[3]) { return v_mini(v_mini(v[0], v[1]), v[2]); }
static inline vi32 setup_most(const vi32 v[3]) { return v_maxi(v_maxi(v[0], v[1]), v[2]); }

/* The span of three corners. */
static inline setup_span setup_box(const vi32 v[3], int32_t size, int32_t reach)
{
    return setup_samples(setup_least(v), setup_most(v), size, reach);
}

static inline vi32 setup_area(const vi32 x[3], const vi32 y[3])
{
    return v_subi(v_muli(v_subi(x[1], x[0]), v_subi(y[2], y[0])),
                  v_muli(v_subi(x[2], x[0]), v_subi(y[1], y[0])));
}

/* Lanes that face the wrong way or have no area. */
static inline vmask setup_culled(vi32 area, int cull)
{
    vmask drop = v_eqi(area, v_seti(0));
    if (cull < 0)
        drop = v_mor(drop, v_negi(area));
    if (cull > 0)
        drop = v_mor(drop, v_gti(area, v_seti(0)));
    return drop;
}

/* Lanes with at most so many samples along one axis. */
static inline vmask setup_narrow(setup_span s, int32_t samples)
{
    return v_mnot(v_gti(v_subi(s.last, s.first), v_seti(samples - 1)));
}

/* Lanes whose box lies between the samples of all pixels (R104), as the boxes of many micro-triangles do. */
static inline vmask setup_between(vi32 xlo, vi32 xhi, vi32 ylo, vi32 yhi, const e3d_sample_pattern *pattern)
{
    vi32 between = v_seti(-1);
    for (int s = 0; s < pattern->count; s++) {
        vi32 across = v_subi(v_sra(v_subi(xhi, v_seti(128 + pattern->x[s])), 8), v_sra(v_addi(xlo, v_seti(127 - pattern->x[s])), 8));
        vi32 down = v_subi(v_sra(v_subi(yhi, v_seti(128 + pattern->y[s])), 8), v_sra(v_addi(ylo, v_seti(127 - pattern->y[s])), 8));
        between = v_andi(between, v_ori(across, down));
    }
    return v_negi(between);
}

/* Lanes that miss: their box has no sample, or they face the wrong way and 32 bits hold the area. And lanes that are small. */
typedef struct setup_boxes {
    vmask miss, small;
} setup_boxes;

static inline setup_boxes setup_boxes_of(const vi32 x[3], const vi32 y[3], int cull, const e3d_viewport *viewport)
{
    vi32 xlo = setup_least(x), xhi = setup_most(x), ylo = setup_least(y), yhi = setup_most(y);
    setup_span across = setup_samples(xlo, xhi, viewport->width, viewport->reach);
    setup_span down = setup_samples(ylo, yhi, viewport->height, viewport->reach);
    vmask empty = v_mor(v_gti(across.first, across.last), v_gti(down.first, down.last));
    if (viewport->pattern)
        empty = v_mor(empty, setup_between(xlo, xhi, ylo, yhi, viewport->pattern));
    vi32 size = v_maxi(v_subi(xhi, xlo), v_subi(yhi, ylo));
    vmask wide = v_gti(size, v_seti(32767)), large = v_gti(size, v_seti(E3D_SMALL_REACH));
    vmask narrow = v_mand(setup_narrow(across, E3D_SMALL), setup_narrow(down, E3D_SMALL));
    return (setup_boxes){v_mor(empty, v_mandnot(setup_culled(setup_area(x, y), cull), wide)), v_mandnot(narrow, large)};
}

/* A bit for each lane that has an element left. */
static inline uint32_t setup_tail(int left)
{
    return (uint32_t)((1ull << (left < V_LANES ? left : V_LANES)) - 1);
}

/* Lanes that are drawn as they are, and lanes that are clipped, as far as outcodes decide (R4-R7). */
typedef struct setup_fate {
    vmask draw, clip;
} setup_fate;

static inline setup_fate setup_fate_of(const e3d_vertices *v, const uint8_t *indices, int i)
{
    vi32 any = v_seti(0), all = v_seti(-1), zero = v_seti(0);
    for (int k = 0; k < 3; k++) {
        vi32 code = setup_fetch(v->code, indices + k * E3D_CLUSTER_TRIANGLES, i);
        any = v_ori(any, code);
        all = v_andi(all, code);
    }
    vmask keep = v_mand(v_eqi(v_andi(all, v_seti(E3D_OUTSIDE)), zero),
                        v_eqi(v_andi(any, v_seti(E3D_NONFINITE)), zero));
    vmask whole = v_eqi(v_andi(any, v_seti(E3D_CLIP)), zero);
    vmask good = v_eqi(v_andi(any, v_seti(E3D_BAD_SCREEN)), zero);
    return (setup_fate){v_mand(v_mand(keep, whole), good), v_mandnot(keep, whole)};
}

/* ---- close together: both coordinates in one word ---- */

enum {
    SETUP_WINDOW = 32000,        /* the window's side in 1/256 sample: with the margin of R10, distances still fit 16 bits */
    /* From the window's corner to the first vertex, in whole samples, so that sample centres keep their places */
    SETUP_BACK = 16384 - 256
};

/* Packs the vertices, relative to the corner of a window, into words: x in the lower half, y in the upper one. Returns 0 if
 * the window doesn't hold all of them. */
static inline int setup_pack_vertices(const e3d_vertices *v, int32_t *out)
{
    vi32 left = v_seti((v->sx[0] & -256) - SETUP_BACK), top = v_seti((v->sy[0] & -256) - SETUP_BACK), outside = v_seti(0);
    for (int i = 0; i < v->count; i += V_LANES) {
        vi32 x = v_subi(v_loadi(v->sx + i), left), y = v_subi(v_loadi(v->sy + i), top), most = v_seti(SETUP_WINDOW);
        outside = v_ori(v_ori(outside, v_ori(x, y)), v_ori(v_subi(most, x), v_subi(most, y)));
        v_storei(out + i, v_ori(x, v_shl(y, 16)));
    }
    return !v_any(v_negi(outside));
}

/* Lanes in which one of the halves is negative. */
static inline vmask setup_negative(vi32 a)
{
    return v_mnot(v_eqi(v_andi(a, v_seti((int32_t)0x80008000)), v_seti(0)));
}

/* A number in both halves of each word. */
static inline vi32 setup_halves(int32_t n) { return v_seti((int32_t)(((uint32_t)n & 0xFFFF) * 0x10001u)); }

/* setup_between in 16-bit halves. */
static inline vmask setup_between_near(vi32 lo, vi32 hi, const e3d_sample_pattern *pattern)
{
    vi32 between = v_seti(-1);
    for (int s = 0; s < pattern->count; s++) {
        vi32 at = v_seti((int32_t)(((uint32_t)pattern->y[s] << 16) | ((uint32_t)pattern->x[s] & 0xFFFF)));
        vi32 first = v_sra16(v_add16(lo, v_sub16(setup_halves(127), at)), 8), last = v_sra16(v_sub16(hi, v_add16(setup_halves(128), at)), 8);
        vi32 more = v_sub16(last, first);
        between = v_andi(between, v_ori(more, v_shl(more, 16)));
    }
    return v_negi(between);
}

/* setup_boxes_of in 16-bit halves, for packed vertices that are all inside the viewport. */
static inline setup_boxes setup_boxes_near(const vi32 p[3], int cull, const e3d_viewport *viewport)
{
    const int32_t reach = viewport->reach;
    vi32 lo = v_min16(v_min16(p[0], p[1]), p[2]), hi = v_max16(v_max16(p[0], p[1]), p[2]);
    vi32 first = v_sra16(v_add16(lo, setup_halves(127 - reach)), 8), last = v_sra16(v_sub16(hi, setup_halves(128 - reach)), 8);
    vi32 more = v_sub16(last, first);
    vi32 spare = v_ori(v_sub16(v_seti((E3D_SMALL - 1) * 0x10001), more),
                       v_sub16(v_seti(E3D_SMALL_REACH * 0x10001), v_sub16(hi, lo)));
    vi32 c = v_sub16(p[2], p[0]), turned = v_ori(v_shr(c, 16), v_shl(v_sub16(p[0], p[2]), 16));
    vi32 area = v_madd16(v_sub16(p[1], p[0]), turned);
    vmask empty = setup_negative(more);
    if (viewport->pattern)
        empty = v_mor(empty, setup_between_near(lo, hi, viewport->pattern));
    return (setup_boxes){v_mor(empty, setup_culled(area, cull)), v_mnot(setup_negative(spare))};
}

/* Tests triangles with both coordinates in a word: half the lookups and half the arithmetic. Returns 0 if the vertices are
 * too far apart for that. */
static inline int setup_near(const e3d_vertices *v, const uint8_t *indices, int triangles, int cull, const e3d_viewport *viewport,
                             uint64_t *draw, uint64_t *small)
{
    int32_t packed[E3D_CLUSTER_VERTICES + E3D_PAD];
    uint64_t shown = 0, narrow = 0;
    if (!setup_pack_vertices(v, packed))
        return 0;
    vtable table;
    v_table(packed, v->count, &table);
    for (int i = 0; i < triangles; i += V_LANES) {
        vi32 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = v_lookup(&table, v_loadu8(indices + k * E3D_CLUSTER_TRIANGLES + i));
        setup_boxes boxes = setup_boxes_near(p, cull, viewport);
        shown |= (uint64_t)v_bits(v_mnot(boxes.miss)) << i;
        narrow |= (uint64_t)v_bits(boxes.small) << i;
    }
    *draw = shown;
    *small = narrow;
    return 1;
}

/* Tests triangles with coordinates of 32 bits; returns those to be clipped. */
static inline uint64_t setup_far(const e3d_vertices *v, const uint8_t *indices, int triangles, int cull,
                                 const e3d_viewport *viewport, uint64_t *draw, uint64_t *small)
{
    uint64_t clip = 0;
    vtable across, down;
    v_table(v->sx, v->count, &across);
    v_table(v->sy, v->count, &down);
    for (int i = 0; i < triangles; i += V_LANES) {
        vi32 x[3], y[3];
        for (int k = 0; k < 3; k++) {
            vi32 at = v_loadu8(indices + k * E3D_CLUSTER_TRIANGLES + i);
            x[k] = v_lookup(&across, at);
            y[k] = v_lookup(&down, at);
        }
        setup_boxes boxes = setup_boxes_of(x, y, cull, viewport);
        uint32_t shown = v_bits(v_mnot(boxes.miss));
        if (v->special) {
            setup_fate fate = setup_fate_of(v, indices, i);
            shown &= v_bits(fate.draw);
            clip |= (uint64_t)v_bits(fate.clip) << i;
        }
        *draw |= (uint64_t)shown << i;
        *small |= (uint64_t)v_bits(boxes.small) << i;
    }
    return clip;
}

static int kernel_setup(const e3d_vertices *v, const uint8_t *indices, int triangles, int cull, int fragments,
                        const e3d_viewport *viewport, e3d_survivors *out)
{
    uint64_t draw = 0, small = 0, clip = 0, asked = triangles ? ~(uint64_t)0 >> (E3D_CLUSTER_TRIANGLES - triangles) : 0;
    if (V_LANES == 1 || v->special || !setup_near(v, indices, triangles, cull, viewport, &draw, &small))
        clip = setup_far(v, indices, triangles, cull, viewport, &draw, &small);
    small &= fragments ? draw & asked : 0;
    *out = (e3d_survivors){draw & asked & ~small, small, clip & asked};
    return __builtin_popcountll((draw | clip) & asked); /* one instruction with this ISA, but not in the baseline */
}
