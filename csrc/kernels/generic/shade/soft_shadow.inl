/* soft shadow: finds how much of a light that has a size reaches samples, by its shadow maps (R226-R229): the mean depth of
 * what is between, then the share of a disc that is as wide as the penumbra. Sources: Fernando 2005;
 * Guennebaud, Barthe and Paulin 2006. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/shadow_maps/shadow_ranges.h"
#include "data/shadow_maps/soft_ranges.h"
#include "e3d.h"
#include "kernels/generic/shade/shadow_place.inl"

enum { SOFT_LEVELS = 5,
       SOFT_SEARCH = 4, /* pitches in the radius of a level's disc */
       SOFT_SHARE = 8 };

/* The texels of radius for each unit of depth: of the parts of R227 (k), and of the cone of R229 (rise). */
typedef struct soft_slopes {
    vf32 k, rise;
} soft_slopes;

/* Samples: column and row in 1/256 texel, the map's first texel, the depth to compare, the slopes per 1/256 texel, and the
 * least radius. */
typedef struct soft_sample {
    vi32 x, y, map;
    vf32 depth, k, rise, least;
} soft_sample;

/* Lattices around samples. A vector visits `count` points a side, of which the first is at `column` and `row`, and `dx` and
 * `dy` in 1/256 texel from the sample. */
typedef struct soft_lattice {
    vi32 pitch, column, row, dx, dy;
    int count;
} soft_lattice;

/* The sums of parts, and of these times depths (R227). */
typedef struct soft_parts {
    vf32 sum, depths;
} soft_parts;

static ALWAYS_INLINE float soft_least(const e3d_light_maps *shadow)
{
    return (float)(shadow->step * (shadow->taps - 1)) * (1.0f / 512.0f) + 1.0f;
}

/* R226 */
static ALWAYS_INLINE vi32 soft_radius(const e3d_light_maps *shadow, vf32 v)
{
    return v_rint(v_mul(v_min(v_max(v, v_setf(soft_least(shadow))), v_setf(shadow->widest)), v_setf(256.0f)));
}

/* R226 */
static ALWAYS_INLINE vf32 soft_disc(vf32 d, vf32 fall)
{
    return v_min(v_max(v_sub(v_setf(2.0f), v_mul(d, fall)), v_setf(0.0f)), v_setf(1.0f));
}

static ALWAYS_INLINE vi32 soft_at_side(vi32 at, int32_t size) { return v_mini(v_maxi(at, v_seti(0)), v_seti(size - 1)); }

/* The first column or row that can have a weight, and its distance from the sample. */
static ALWAYS_INLINE vi32 soft_first(vi32 at, vi32 pitch, vf32 per_pitch, int before, vi32 *distance)
{
    vi32 middle = v_subi(at, v_seti(128));
    vi32 first = v_muli(v_subi(v_floori(v_mul(v_float(middle), per_pitch)), v_seti(before)), pitch);
    *distance = v_subi(v_shl(first, 8), middle);
    return first;
}

/* Points that can have a weight: those less than 1.16 radii away. */
static ALWAYS_INLINE soft_lattice soft_lattice_of(const soft_sample *at, vi32 pitch, int fineness)
{
    int before = fineness + fineness / 8;
    vf32 per_pitch = v_div(v_setf(1.0f / 256.0f), v_float(pitch));
    soft_lattice to = {.pitch = pitch, .count = 2 * before + 2};
    to.column = soft_first(at->x, pitch, per_pitch, before, &to.dx);
    to.row = soft_first(at->y, pitch, per_pitch, before, &to.dy);
    return to;
}

static ALWAYS_INLINE vi32 soft_row(const e3d_light_maps *shadow, const soft_sample *at, vi32 row)
{
    return v_addi(at->map, v_muli(soft_at_side(row, shadow->size), v_seti(shadow->size)));
}

static ALWAYS_INLINE vf32 soft_texel(const e3d_light_maps *shadow, vi32 base, vi32 column)
{
    return v_asf(v_gatheri(shadow->depths, v_addi(base, soft_at_side(column, shadow->size))));
}

/* ---- the search (R227) ---- */

static ALWAYS_INLINE vf32 soft_ring(vf32 d, int32_t level)
{
    float fall = 0x1.8p-20f / (float)(1 << (2 * level));
    vf32 disc = soft_disc(d, v_setf(fall));
    return level > 0 ? v_sub(disc, soft_disc(d, v_setf(4.0f * fall))) : disc;
}

static ALWAYS_INLINE void soft_add_part(const e3d_light_maps *shadow, const soft_sample *at, int32_t level, vmask counts, vf32 d,
                                        vf32 texel, soft_parts *to)
{
    vf32 zero = v_setf(0.0f), wide = v_add(v_mul(v_sub(at->depth, texel), at->k), v_mul(v_setf(0.75f), at->least));
    vf32 radius = v_min(wide, v_setf(shadow->widest * 256.0f)), e = v_div(v_setf(1.0f), v_mul(radius, radius));
    vf32 part = v_mul(v_mul(soft_ring(d, level), soft_disc(d, v_mul(v_setf(1.5f), e))), e);
    part = v_mul(part, v_setf((float)(1 << (2 * level))));
    vmask is_part = v_mand(v_mand(counts, v_lt(texel, at->depth)), v_gt(part, zero));
    to->sum = v_add(to->sum, v_self(is_part, part, zero));
    to->depths = v_add(to->depths, v_self(is_part, v_mul(part, texel), zero));
}

static __attribute__((noinline)) void soft_add_level(const e3d_light_maps *shadow, const soft_sample *at, int32_t level, vmask counts,
                                                     soft_parts *to)
{
    soft_lattice of = soft_lattice_of(at, v_seti(1 << level), SOFT_SEARCH);
    soft_parts parts = *to;
    vi32 step = v_shl(of.pitch, 8), row = of.row, dy = of.dy;
    for (int j = 0; j < of.count; j++, row = v_addi(row, of.pitch), dy = v_addi(dy, step)) {
        vi32 base = soft_row(shadow, at, row), far = v_muli(dy, dy), column = of.column, dx = of.dx;
        for (int i = 0; i < of.count; i++, column = v_addi(column, of.pitch), dx = v_addi(dx, step)) {
            vf32 d = v_float(v_addi(v_muli(dx, dx), far));
            if (v_any(v_gt(soft_ring(d, level), v_setf(0.0f))))
                soft_add_part(shadow, at, level, counts, d, soft_texel(shadow, base, column), &parts);
        }
    }
    *to = parts;
}

static ALWAYS_INLINE soft_parts soft_search(const e3d_light_maps *shadow, const soft_sample *at, const soft_slopes *slopes, vmask open)
{
    soft_parts parts = {v_setf(0.0f), v_setf(0.0f)};
    vf32 most = v_add(v_mul(v_sub(at->depth, v_setf(shadow->nearest)), slopes->k), v_setf(soft_least(shadow)));
    soft_add_level(shadow, at, 0, open, &parts);
    for (int32_t level = 1; level < SOFT_LEVELS; level++) {
        vmask counts = v_mand(open, v_ge(most, v_setf(0.7f * (float)(2 << level))));
        if (!v_any(counts))
            break;
        soft_add_level(shadow, at, level, counts, &parts);
    }
    return parts;
}

/* ---- the share (R228, R229) ---- */

/* Weights of R228, and their sums: of all points, and of those before the surface. */
typedef struct soft_weights {
    vi32 pitch, thin, all, before;
    vf32 fall;
} soft_weights;

static ALWAYS_INLINE soft_weights soft_weights_of(vi32 radius)
{
    soft_weights of = {.pitch = v_seti(1), .all = v_seti(0), .before = v_seti(0)};
    for (int32_t pitch = 1; pitch <= 4; pitch *= 2)
        of.pitch = v_seli(v_gti(radius, v_seti(256 * SOFT_SHARE * pitch)), v_seti(2 * pitch), of.pitch);
    vi32 most = v_muli(of.pitch, v_seti(256 * SOFT_SHARE));
    vf32 fading = v_mul(v_float(v_subi(most, radius)), v_div(v_setf(2.0f / SOFT_SHARE), v_float(of.pitch)));
    of.thin = v_mini(v_trunc(fading), v_seti(256));
    of.fall = v_div(v_setf(1.5f), v_float(v_muli(radius, radius)));
    return of;
}

/* `places`: the column or the row, an odd one in the bit of the pitch. */
static ALWAYS_INLINE vi32 soft_weight(const soft_weights *of, vf32 d, vi32 places)
{
    vi32 weight = v_trunc(v_mul(soft_disc(d, of->fall), v_setf(256.0f)));
    vmask whole = v_eqi(v_andi(places, of->pitch), v_seti(0));
    return v_seli(whole, weight, v_sra(v_muli(weight, of->thin), 8));
}

static ALWAYS_INLINE vmask soft_is_before(const soft_sample *at, vf32 texel, vf32 d)
{
    vf32 reach = v_add(v_mul(v_sub(at->depth, texel), at->rise), at->least);
    return v_mand(v_lt(texel, at->depth), v_ge(v_mul(reach, reach), d));
}

static __attribute__((noinline)) vf32 soft_share_within(const e3d_light_maps *shadow, const soft_sample *at, vi32 radius)
{
    soft_weights w = soft_weights_of(radius);
    soft_lattice of = soft_lattice_of(at, w.pitch, SOFT_SHARE);
    vi32 step = v_shl(of.pitch, 8), row = of.row, dy = of.dy, zero = v_seti(0);
    for (int j = 0; j < of.count; j++, row = v_addi(row, of.pitch), dy = v_addi(dy, step)) {
        vi32 base = soft_row(shadow, at, row), far = v_muli(dy, dy), column = of.column, dx = of.dx;
        if (!v_any(v_gti(soft_weight(&w, v_float(far), row), zero)))
            continue;
        for (int i = 0; i < of.count; i++, column = v_addi(column, of.pitch), dx = v_addi(dx, step)) {
            vf32 d = v_float(v_addi(v_muli(dx, dx), far));
            vi32 weight = soft_weight(&w, d, v_ori(column, row));
            if (!v_any(v_gti(weight, zero)))
                continue;
            vmask before = soft_is_before(at, soft_texel(shadow, base, column), d);
            w.all = v_addi(w.all, weight);
            w.before = v_addi(w.before, v_seli(before, weight, zero));
        }
    }
    return v_div(v_float(v_subi(w.all, w.before)), v_float(w.all));
}

static ALWAYS_INLINE soft_sample soft_sample_of(const e3d_light_maps *shadow, const shadow_place *place, const soft_slopes *slopes)
{
    vf32 zero = v_setf(0.0f), size = v_setf((float)shadow->size), whole = v_setf(256.0f);
    return (soft_sample){.x = v_rint(v_mul(v_min(v_max(place->x, zero), size), whole)),
                         .y = v_rint(v_mul(v_min(v_max(place->y, zero), size), whole)),
                         .map = v_muli(place->map, v_seti(shadow->size * shadow->size)),
                         .depth = place->depth,
                         .k = v_mul(slopes->k, whole),
                         .rise = v_mul(slopes->rise, whole),
                         .least = v_float(soft_radius(shadow, zero))};
}

/* ---- ranges (soft_ranges.h) ---- */

/* Where no texel of a window is before `depth`, by the codes in the low or the high half of a word. */
static ALWAYS_INLINE vmask soft_is_open(vi32 word, int high, vf32 depth)
{
    return v_gti(high ? v_sra(word, 16) : v_sra(v_shl(word, 16), 16), shadow_code(depth));
}

/* Where nothing near is before the samples: in window 0, or if that is of one block, among the sixteen texels that are less than
 * two columns and rows away. */
static ALWAYS_INLINE vmask soft_is_near_open(const e3d_light_maps *shadow, const soft_sample *at, vi32 word)
{
    if (e3d_soft_blocks(shadow->taps, shadow->step, shadow->widest, 0) > 1 || shadow->size < 4)
        return soft_is_open(word, 0, at->depth);
    vi32 most = v_seti(shadow->size - 4), none = v_seti(0), before = v_seti(384);
    vi32 column = v_mini(v_maxi(v_sra(v_subi(at->x, before), 8), none), most);
    vi32 row = v_mini(v_maxi(v_sra(v_subi(at->y, before), 8), none), most);
    vi32 first = v_addi(v_addi(at->map, v_muli(row, v_seti(shadow->size))), column);
    return v_eqi(v_ge16(shadow->depths, shadow->size, first, at->depth), v_seti(0xFFFF));
}

/* Samples of which ranges tell that the search finds nothing. What is as far away as window n reaches is a part only if D of
 * R227 is more than 0.866 of that; so much nearer than the sample is nothing in window n + 1. (With a k beyond the limit, single
 * steps of depths would be worth more texels than lie between 0.86 and 0.866.) */
static ALWAYS_INLINE vmask soft_is_lit(const e3d_light_maps *shadow, const soft_sample *at, vi32 map, vf32 k)
{
    enum { TO_BLOCK = 8 + E3D_SHADOW_BLOCK_SHIFT };
    int32_t side = (shadow->size + 1) >> E3D_SHADOW_BLOCK_SHIFT;
    vi32 column = v_mini(v_sra(at->x, TO_BLOCK), v_seti(side - 1)), row = v_mini(v_sra(at->y, TO_BLOCK), v_seti(side - 1));
    vi32 block = v_addi(v_addi(v_muli(map, v_seti(2 * side * side)), v_muli(row, v_seti(side))), column);
    vi32 words[2] = {v_gatheri(shadow->ranges, block), v_gatheri(shadow->ranges, v_addi(block, v_seti(side * side)))};
    vmask open = v_mand(soft_is_near_open(shadow, at, words[0]), v_gt(v_setf(65536.0f), k));
    for (int n = 1; n < E3D_SOFT_WINDOWS; n++) {
        float near = 2.0f * (float)e3d_soft_blocks(shadow->taps, shadow->step, shadow->widest, n - 1);
        vf32 ahead = v_div(v_setf(0.86f * near - 0.75f * soft_least(shadow)), k);
        open = v_mand(open, soft_is_open(words[n / 2], n & 1, v_sub(at->depth, ahead)));
    }
    return open;
}

/* The share of a soft light that reaches samples; the results of those that are in no map mean nothing. */
static ALWAYS_INLINE vf32 soft_share(const e3d_light_maps *shadow, const shadow_place *place, const soft_slopes *slopes)
{
    soft_sample at = soft_sample_of(shadow, place, slopes);
    vmask open = place->inside;
    if (shadow->ranges)
        open = v_mandnot(open, soft_is_lit(shadow, &at, place->map, slopes->k));
    if (!v_any(open))
        return v_setf(1.0f);
    soft_parts found = soft_search(shadow, &at, slopes, open);
    vmask some = v_gt(found.sum, v_setf(0.0f));
    if (!v_any(some))
        return v_setf(1.0f);
    vf32 mean = v_div(found.depths, v_self(some, found.sum, v_setf(1.0f)));
    vi32 radius = soft_radius(shadow, v_mul(v_sub(at.depth, mean), slopes->k));
    vf32 least = v_sub(v_setf(1.0f), v_mul(found.sum, v_setf(81920.0f)));
    return v_self(some, v_max(soft_share_within(shadow, &at, radius), least), v_setf(1.0f));
}
