/* shadow: finds how much of a light reaches samples, by the shadow maps that were drawn from it (R91-R94). Sources: Williams
 * 1978 (maps); Reeves, Salesin and Cook 1987 (the mean of comparisons). Soft lights: soft_shadow.inl. */
#pragma once

#include <stddef.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/shadow_maps/shadow_ranges.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/shade/shadow_place.inl"
#include "kernels/generic/shade/soft_shadow.inl"

/* ---- comparisons (R93) ---- */

/* The part of a weight that a comparison leaves: 0 if the map shows something nearer. */
static ALWAYS_INLINE vi32 shadow_compare(const float *depths, vi32 at, vf32 depth, vi32 weight)
{
    return v_seli(v_ge(v_asf(v_gatheri(depths, at)), depth), weight, v_seti(0));
}

/* Blends four comparisons around a place, in 1/256 texel. */
static ALWAYS_INLINE vi32 shadow_tap(const e3d_light_maps *shadow, vi32 base, vi32 x, vi32 y, vf32 depth)
{
    vi32 all = v_seti(256), fx = v_andi(x, v_seti(255)), fy = v_andi(y, v_seti(255)), gx = v_subi(all, fx), one = v_seti(1);
    vi32 upper = v_addi(v_addi(base, v_muli(v_sra(y, 8), v_seti(shadow->size))), v_sra(x, 8)), lower = v_addi(upper, v_seti(shadow->size));
    vi32 top = v_addi(shadow_compare(shadow->depths, upper, depth, gx), shadow_compare(shadow->depths, v_addi(upper, one), depth, fx));
    vi32 bottom = v_addi(shadow_compare(shadow->depths, lower, depth, gx), shadow_compare(shadow->depths, v_addi(lower, one), depth, fx));
    return v_addi(v_muli(top, v_subi(all, fy)), v_muli(bottom, fy));
}

/* The weights of four columns or rows of comparisons: all of a block's, or those on one side of a larger block. */
typedef struct shadow_weights {
    vi32 of[4];
} shadow_weights;

/* The first and the last one share a tap's weight; those between have a whole one. */
static ALWAYS_INLINE shadow_weights shadow_block_weights(vi32 fraction)
{
    vi32 all = v_seti(256);
    return (shadow_weights){{v_subi(all, fraction), all, all, fraction}};
}

/* Of six columns or rows: the first three, without the fourth, or the last three, without the one before them. */
static ALWAYS_INLINE shadow_weights shadow_half_weights(vi32 fraction, int last)
{
    vi32 all = v_seti(256), none = v_seti(0);
    return last ? (shadow_weights){{none, all, all, fraction}} : (shadow_weights){{v_subi(all, fraction), all, all, none}};
}

/* The sum of weights of those of sixteen comparisons whose bits are set. */
static ALWAYS_INLINE vi32 shadow_weigh(vi32 bits, const shadow_weights *x, const shadow_weights *y)
{
    vi32 sum = v_seti(0), one = v_seti(1);
    for (int r = 0; r < 4; r++) {
        vi32 row = v_seti(0);
        for (int c = 0; c < 4; c++, bits = v_shr(bits, 1))
            row = v_addi(row, v_andi(v_subi(v_seti(0), v_andi(bits, one)), x->of[c]));
        sum = v_addi(sum, v_muli(row, y->of[r]));
    }
    return sum;
}

/* The share of the light that a sum of weights stands for. */
static ALWAYS_INLINE vf32 shadow_share(const e3d_light_maps *shadow, vi32 sum)
{
    return v_div(v_float(sum), v_setf((float)(65536 * shadow->taps * shadow->taps)));
}

/* Taps a texel apart share the comparisons between them: 3 x 3 taps are sixteen comparisons. */
static ALWAYS_INLINE vf32 shadow_block(const e3d_light_maps *shadow, vi32 at, vi32 x, vi32 y, vf32 depth)
{
    vi32 bits = v_ge16(shadow->depths, shadow->size, at, depth), all = v_seti(0xFFFF), low = v_seti(255);
    vmask none = v_eqi(bits, v_seti(0)), whole = v_eqi(bits, all);
    if (!v_any(v_mnot(v_mor(none, whole)))) /* as mostly */
        return v_self(whole, v_setf(1.0f), v_setf(0.0f));
    shadow_weights across = shadow_block_weights(v_andi(x, low)), down = shadow_block_weights(v_andi(y, low));
    return shadow_share(shadow, shadow_weigh(bits, &across, &down));
}

/* 5 x 5 taps: four such blocks, which overlap. */
static ALWAYS_INLINE vf32 shadow_large_block(const e3d_light_maps *shadow, vi32 at, vi32 x, vi32 y, vf32 depth)
{
    vi32 bits[4], every = v_seti(0xFFFF), some = v_seti(0), low = v_seti(255), sum = v_seti(0);
    for (int k = 0; k < 4; k++) {
        bits[k] = v_ge16(shadow->depths, shadow->size, v_addi(at, v_seti(2 * (k & 1) + 2 * (k >> 1) * shadow->size)), depth);
        every = v_andi(every, bits[k]);
        some = v_ori(some, bits[k]);
    }
    vmask none = v_eqi(some, v_seti(0)), whole = v_eqi(every, v_seti(0xFFFF));
    if (!v_any(v_mnot(v_mor(none, whole))))
        return v_self(whole, v_setf(1.0f), v_setf(0.0f));
    for (int k = 0; k < 4; k++) {
        shadow_weights across = shadow_half_weights(v_andi(x, low), k & 1), down = shadow_half_weights(v_andi(y, low), k >> 1);
        sum = v_addi(sum, shadow_weigh(bits[k], &across, &down));
    }
    return shadow_share(shadow, sum);
}

/* R93: the column or row of the first tap in 1/256 texel; lanes outside the maps get one inside. Limiting before rounding is
 * enough, since both limits are integers between 0 and the size. */
static ALWAYS_INLINE vi32 shadow_first(const e3d_light_maps *shadow, vf32 at, int32_t across)
{
    int32_t least = 128 + across / 2, most = least + 256 * shadow->size - 257 - across;
    vf32 within = v_min(v_max(v_mul(at, v_setf(256.0f)), v_setf((float)least)), v_setf((float)most));
    return v_subi(v_rint(within), v_seti(least));
}

/* The first comparisons of samples: column and row in 1/256 texel, the first texel of the map, the depth to compare. */
typedef struct shadow_taps {
    vi32 x, y, map;
    vf32 depth;
} shadow_taps;

static ALWAYS_INLINE shadow_taps shadow_taps_of(const e3d_light_maps *shadow, const shadow_place *place)
{
    int32_t across = shadow->step * (shadow->taps - 1);
    return (shadow_taps){shadow_first(shadow, place->x, across), shadow_first(shadow, place->y, across),
                         v_muli(place->map, v_seti(shadow->size * shadow->size)), place->depth};
}

static ALWAYS_INLINE vf32 shadow_blend(const e3d_light_maps *shadow, const shadow_taps *taps)
{
    int32_t step = shadow->step;
    vi32 x = taps->x, y = taps->y, sum = v_seti(0);
    vi32 at = v_addi(v_addi(taps->map, v_muli(v_sra(y, 8), v_seti(shadow->size))), v_sra(x, 8));
    if (step == 256 && shadow->taps == 3)
        return shadow_block(shadow, at, x, y, taps->depth);
    if (step == 256 && shadow->taps == 5)
        return shadow_large_block(shadow, at, x, y, taps->depth);
    for (int32_t t = 0; t < shadow->taps * shadow->taps; t++) {
        vi32 right = v_seti(step * (t % shadow->taps)), down = v_seti(step * (t / shadow->taps));
        sum = v_addi(sum, shadow_tap(shadow, taps->map, v_addi(x, right), v_addi(y, down), taps->depth));
    }
    return shadow_share(shadow, sum);
}

/* ---- ranges (shadow_ranges.h) ---- */

/* Samples that are before all depths that they would be compared with, and samples that are behind all of them. */
typedef struct shadow_sides {
    vmask before, behind;
} shadow_sides;

/* The block in which comparisons begin; `map` is the number of the map. */
static ALWAYS_INLINE vi32 shadow_block_of(const e3d_light_maps *shadow, vi32 map, vi32 x, vi32 y)
{
    enum { TO_BLOCK = 8 + E3D_SHADOW_BLOCK_SHIFT };
    int32_t side = (shadow->size + (1 << E3D_SHADOW_BLOCK_SHIFT) - 1) >> E3D_SHADOW_BLOCK_SHIFT;
    vi32 row = v_sra(y, TO_BLOCK);
    if (shadow->count > 1)
        row = v_addi(row, v_muli(map, v_seti(side)));
    return v_addi(v_muli(row, v_seti(side)), v_sra(x, TO_BLOCK));
}

static ALWAYS_INLINE shadow_sides shadow_sides_of(const e3d_light_maps *shadow, vi32 block, vi32 code)
{
    vi32 range = v_gatheri(shadow->ranges, block);
    return (shadow_sides){v_gti(v_sra(v_shl(range, 16), 16), code), v_gti(code, v_sra(range, 16))};
}

/* ---- lights ---- */

static ALWAYS_INLINE void shadow_turn(const e3d_light *light, const vf32 v[3], vf32 out[3])
{
    int turns = e3d_light_traits_of(light->kind).maps != E3D_MAPS_CUBE;
    for (int k = 0; k < 3; k++) {
        const float *a = light->shadow.maps.axes[k];
        const vf32 axis[3] = {v_setf(a[0]), v_setf(a[1]), v_setf(a[2])};
        out[k] = turns ? dot_three(v, axis) : v[k];
    }
}

/* Samples in the axes of a light that has maps; `l` is the direction to it. */
static ALWAYS_INLINE shadow_lanes shadow_lanes_of(const e3d_light *light, const vf32 position[3], const vf32 normal[3], const vf32 l[3])
{
    shadow_lanes s; /* not cleared first: bytes that were just written so cannot be loaded at once */
    vf32 p[3];
    int has_position = e3d_light_traits_of(light->kind).has_position;
    s.sine = shadow_sine(dot_three(normal, l));
    for (int k = 0; k < 3; k++) /* subtracting 0 gives the position itself; a copy would take longer */
        p[k] = v_sub(position[k], v_setf(has_position ? light->position[k] : 0.0f));
    shadow_turn(light, p, s.at);
    shadow_turn(light, normal, s.along);
    return s;
}

static ALWAYS_INLINE shadow_place shadow_place_of(const e3d_light *light, const e3d_shadow_map *maps, const shadow_lanes *s)
{
    const e3d_light_maps *shadow = &light->shadow.maps;
    switch (e3d_light_traits_of(light->kind).maps) {
    case E3D_MAPS_CASCADES: return shadow_place_cascades(shadow, maps, s);
    case E3D_MAPS_CUBE: return shadow_place_cube(shadow, maps, s);
    case E3D_MAPS_AHEAD: break;
    }
    return shadow_place_ahead(shadow, maps, s);
}

/* R93 for the samples that are in a map; the results of others mean nothing. */
static ALWAYS_INLINE vf32 shadow_share_of(const e3d_light_maps *shadow, const shadow_place *place)
{
    shadow_taps taps = shadow_taps_of(shadow, place);
    if (shadow->ranges) {
        shadow_sides sides = shadow_sides_of(shadow, shadow_block_of(shadow, place->map, taps.x, taps.y), shadow_code(taps.depth));
        if (!v_any(v_mandnot(place->inside, v_mor(sides.before, sides.behind))))
            return v_self(sides.before, v_setf(1.0f), v_setf(0.0f));
    }
    return shadow_blend(shadow, &taps);
}

/* R225, R229; c: the cosine of R91. */
static ALWAYS_INLINE soft_slopes shadow_slopes(const e3d_light_maps *shadow, const shadow_place *place, vf32 c)
{
    vf32 zero = v_setf(0.0f), size = v_min(v_setf(shadow->soft), v_mul(v_mul(v_setf(0.5f), c), place->ahead));
    vf32 rise = v_mul(v_mul(v_mul(v_setf(0.75f), c), place->ahead), place->spread);
    return (soft_slopes){v_max(v_mul(size, place->spread), zero), v_max(rise, zero)};
}

/* R225-R229 for a soft light; `l` is the direction to it. */
static __attribute__((noinline)) vf32 shadow_soft_reached(const e3d_lighting *lighting, int n, const vf32 position[3],
                                                          const vf32 normal[3], const vf32 l[3])
{
    const e3d_light *light = &lighting->lights[n];
    const e3d_light_maps *shadow = &light->shadow.maps;
    shadow_lanes s = shadow_lanes_of(light, position, normal, l);
    shadow_place place = shadow_place_of(light, lighting->shadows + shadow->first, &s);
    if (!v_any(place.inside))
        return v_setf(1.0f);
    soft_slopes slopes = shadow_slopes(shadow, &place, dot_three(normal, l));
    return v_self(place.inside, soft_share(shadow, &place, &slopes), v_setf(1.0f));
}

/* R91-R94 for a point or spot light that has maps; `l` is the direction to it. */
static __attribute__((noinline)) vf32 shadow_map_reached(const e3d_lighting *lighting, int n, const vf32 position[3], const vf32 normal[3],
                                                         const vf32 l[3])
{
    const e3d_light *light = &lighting->lights[n];
    const e3d_light_maps *shadow = &light->shadow.maps;
    const e3d_shadow_map *maps = lighting->shadows + shadow->first;
    shadow_lanes s = shadow_lanes_of(light, position, normal, l);
    shadow_place place = shadow_place_of(light, maps, &s);
    return v_any(place.inside) ? v_self(place.inside, shadow_share_of(shadow, &place), v_setf(1.0f)) : v_setf(1.0f);
}

/* ---- directional lights: a whole batch at a time, so that no vector waits for the one before ---- */

/* The places of vectors of samples in the maps. */
typedef struct shadow_batch {
    int32_t x[E3D_BATCH + E3D_PAD], y[E3D_BATCH + E3D_PAD], map[E3D_BATCH + E3D_PAD];
    float depth[E3D_BATCH + E3D_PAD];
    int32_t block[E3D_BATCH + E3D_PAD], code[E3D_BATCH + E3D_PAD]; /* used if there are ranges */
    int32_t at[E3D_BATCH + E3D_PAD];    /* for each vector the place of its first sample in the batch */
    uint32_t bits[E3D_BATCH + E3D_PAD]; /* for each vector a bit for each sample that is in a map and faces the light */
    int count;                          /* of vectors */
} shadow_batch;

/* Samples that are to be compared with texels, packed; `at` is their place in the batch. */
typedef struct shadow_open {
    int32_t x[E3D_BATCH + 2 * E3D_PAD], y[E3D_BATCH + 2 * E3D_PAD], map[E3D_BATCH + 2 * E3D_PAD], at[E3D_BATCH + 2 * E3D_PAD];
    float depth[E3D_BATCH + 2 * E3D_PAD];
    int count;
} shadow_open;

static ALWAYS_INLINE void shadow_load(const e3d_lane_array *from, int i, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_loadf(from[k] + i);
}

/* Numbers that depend on samples' normals alone. Mostly a whole batch shares them, since it has few faces. */
typedef struct shadow_normals {
    vf32 normal[3], along[3], sine, cosine;
    vf32 moved[3]; /* for the first map: by how many columns and rows, and how far ahead R91 moves samples */
} shadow_normals;

/* Finds these numbers, unless the normals equal those of the vector before, to the bit. */
static ALWAYS_INLINE void shadow_normals_at(const e3d_light *light, const e3d_shadow_map *map, const e3d_lane_array *from, int i,
                                            const vf32 l[3], shadow_normals *out)
{
    vf32 normal[3];
    shadow_load(from, i, normal);
    vmask same = v_eqi(v_asi(normal[0]), v_asi(out->normal[0]));
    for (int k = 1; k < 3; k++)
        same = v_mand(same, v_eqi(v_asi(normal[k]), v_asi(out->normal[k])));
    if (i > 0 && !v_any(v_mnot(same)))
        return;
    for (int k = 0; k < 3; k++)
        out->normal[k] = normal[k];
    out->cosine = dot_three(normal, l);
    out->sine = shadow_sine(out->cosine);
    shadow_turn(light, normal, out->along);
    vf32 shift = shadow_shift(&light->shadow.maps, v_setf(map->texel), out->sine), scale = v_setf(map->scale);
    for (int k = 0; k < 3; k++)
        out->moved[k] = v_mul(out->along[k], shift);
    for (int k = 0; k < 2; k++)
        out->moved[k] = v_mul(out->moved[k], scale);
}

/* Finds places for a light that has one map. */
static ALWAYS_INLINE shadow_place shadow_place_single(const e3d_light_maps *shadow, const e3d_shadow_map *map, const vf32 at[3],
                                                      const vf32 moved[3])
{
    vf32 scale = v_setf(map->scale), x = v_add(v_mul(at[0], scale), v_setf(map->x)), y = v_add(v_mul(at[1], scale), v_setf(map->y));
    vf32 ahead = v_mul(v_add(at[2], moved[2]), v_setf(shadow->depth[0]));
    return (shadow_place){.x = v_add(x, moved[0]),
                          .y = v_add(y, moved[1]),
                          .depth = v_add(v_add(ahead, v_setf(shadow->depth[1])), v_setf(shadow->bias)),
                          .map = v_seti(0),
                          .inside = shadow_is_inside(shadow, x, y)};
}

static ALWAYS_INLINE void shadow_add_places(const e3d_light_maps *shadow, const shadow_place *place, vmask faces, int i, shadow_batch *out)
{
    shadow_taps taps = shadow_taps_of(shadow, place);
    vmask counts = v_mand(place->inside, faces);
    int to = out->count * V_LANES;
    v_storei(out->x + to, taps.x);
    v_storei(out->y + to, taps.y);
    v_storei(out->map + to, taps.map);
    v_storef(out->depth + to, taps.depth);
    out->at[out->count] = i;
    out->bits[out->count++] = v_bits(counts);
    if (!shadow->ranges)
        return;
    v_storei(out->block + to, shadow_block_of(shadow, place->map, taps.x, taps.y));
    /* Any other depth counts as before all texels */
    v_storei(out->code + to, v_seli(counts, shadow_code(taps.depth), v_seti(E3D_SHADOW_CODE_NONE - 1)));
    __builtin_prefetch(shadow->ranges + out->block[to]);
    __builtin_prefetch(shadow->ranges + out->block[to + V_LANES - 1]);
}

/* Finds the places of a batch's samples in the maps. Vectors that face away from the light are left out, since they get no
 * light anyway. */
static ALWAYS_INLINE void shadow_find_batch(const e3d_light *light, const e3d_shadow_map *maps, const e3d_batch *batch, int mapped,
                                            shadow_batch *out)
{
    const e3d_lane_array *normals = mapped ? batch->unmapped_normal : batch->normal;
    const vf32 l[3] = {v_setf(light->to_light[0]), v_setf(light->to_light[1]), v_setf(light->to_light[2])};
    shadow_normals of = {.cosine = v_setf(0.0f)};
    out->count = 0;
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 position[3], lit[3];
        shadow_normals_at(light, maps, normals, i, l, &of);
        if (mapped)
            shadow_load(batch->normal, i, lit);
        vmask faces = v_gt(mapped ? dot_three(lit, l) : of.cosine, v_setf(0.0f));
        if (!v_any(faces))
            continue;
        shadow_lanes s = {.along = {of.along[0], of.along[1], of.along[2]}, .sine = of.sine};
        shadow_load(batch->position, i, position);
        shadow_turn(light, position, s.at);
        shadow_place place = light->shadow.maps.count == 1 ? shadow_place_single(&light->shadow.maps, maps, s.at, of.moved)
                                                           : shadow_place_cascades(&light->shadow.maps, maps, &s);
        shadow_add_places(&light->shadow.maps, &place, faces, i, out);
    }
}

static ALWAYS_INLINE void shadow_add_open(const shadow_batch *places, int from, int i, uint32_t bits, shadow_open *out)
{
    int to = out->count;
    out->count += v_pack(out->x + to, v_loadi(places->x + from), bits);
    v_pack(out->y + to, v_loadi(places->y + from), bits);
    v_pack(out->map + to, v_loadi(places->map + from), bits);
    v_pack(out->depth + to, v_asi(v_loadf(places->depth + from)), bits);
    v_pack(out->at + to, v_addi(v_iota(), v_seti(i)), bits);
}

/* Decides by ranges: 1 or 0. Samples for which they don't decide are open. */
static ALWAYS_INLINE void shadow_find_sides(const e3d_light_maps *shadow, const shadow_batch *places, float *reached, shadow_open *open)
{
    open->count = 0;
    for (int k = 0; k < places->count; k++) {
        int from = k * V_LANES, i = places->at[k];
        uint32_t left = places->bits[k];
        if (shadow->ranges) {
            shadow_sides sides = shadow_sides_of(shadow, v_loadi(places->block + from), v_loadi(places->code + from));
            v_storef(reached + i, v_self(sides.behind, v_setf(0.0f), v_setf(1.0f)));
            left = v_bits(v_mnot(v_mor(sides.before, sides.behind)));
        }
        if (left)
            shadow_add_open(places, from, i, left, open);
    }
}

/* Compares the open samples with texels. */
static ALWAYS_INLINE void shadow_compare_open(const e3d_light_maps *shadow, shadow_open *open, float *reached)
{
    v_storei(open->x + open->count, v_seti(0)); /* zeros for the rest of the last vector */
    v_storei(open->y + open->count, v_seti(0));
    v_storei(open->map + open->count, v_seti(0));
    v_storef(open->depth + open->count, v_setf(0.0f));
    for (int k = 0; k < open->count; k += V_LANES) {
        shadow_taps taps = {v_loadi(open->x + k), v_loadi(open->y + k), v_loadi(open->map + k), v_loadf(open->depth + k)};
        float share[V_LANES];
        v_storef(share, shadow_blend(shadow, &taps));
        int lanes = open->count - k < V_LANES ? open->count - k : V_LANES;
        for (int lane = 0; lane < lanes; lane++)
            reached[open->at[k + lane]] = share[lane];
    }
}

/* R91-R94 for a directional light that has maps. */
static __attribute__((noinline)) void shadow_find_reached(const e3d_light *light, const e3d_shadow_map *maps, const e3d_batch *batch,
                                                          float *reached)
{
    const e3d_light of = *light; /* a copy, which no store can change, so that its numbers stay in registers */
    shadow_batch places;
    shadow_open open;
    if (batch->unmapped_normal)
        shadow_find_batch(&of, maps, batch, 1, &places);
    else
        shadow_find_batch(&of, maps, batch, 0, &places);
    for (int i = 0; i < batch->count; i += V_LANES)
        v_storef(reached + i, v_setf(1.0f));
    shadow_find_sides(&of.shadow.maps, &places, reached, &open);
    shadow_compare_open(&of.shadow.maps, &open, reached);
}

/* Finds the shares of the first directional lights with maps, which are not soft, that reach the samples of a batch. */
static inline void shadow_suns(const e3d_lighting *lighting, e3d_batch *batch)
{
    int found = 0;
    for (int n = 0; n < lighting->light_count && found < E3D_SUNS && lighting->shadows; n++) {
        const e3d_light *light = &lighting->lights[n];
        if (e3d_light_traits_of(light->kind).maps != E3D_MAPS_CASCADES || light->shadow.kind != E3D_SHADOW_MAP)
            continue;
        if (light->shadow.maps.soft > 0.0f)
            continue;
        shadow_find_reached(light, lighting->shadows + light->shadow.maps.first, batch, batch->reached[found]);
        batch->sun[found++] = n;
    }
    for (; found < E3D_SUNS; found++)
        batch->sun[found] = -1;
}

/* Says that no light's shares are found yet. */
static inline void shadow_no_suns(e3d_batch *batch)
{
    for (int k = 0; k < E3D_SUNS; k++)
        batch->sun[k] = -1;
}

/* Returns the shares of light n that reach the samples of a batch, if they are found already; else NULL. */
static ALWAYS_INLINE const float *shadow_found(const e3d_batch *batch, int n)
{
    for (int k = 0; k < E3D_SUNS; k++)
        if (batch->sun[k] == n)
            return batch->reached[k];
    return NULL;
}

/* The share of light n, which has a shadow, that reaches a vector of samples, from 0 to 1: the batch's samples from i on, at
 * these positions. */
static ALWAYS_INLINE vf32 light_reached(const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, const vf32 position[3],
                                        const vf32 l[3])
{
    const e3d_light_shadow *shadow = &lighting->lights[n].shadow;
    if (shadow->kind == E3D_SHADOW_EXACT && shadow->soft > 0.0f)
        return v_loadf(batch->soft_reached[shadow->exact] + i);
    if (shadow->kind == E3D_SHADOW_EXACT) {
        vi32 hidden = v_andi(v_loadi(batch->shadowed_lights + i), v_seti((int32_t)(UINT32_C(1) << shadow->exact)));
        return v_self(v_eqi(hidden, v_seti(0)), v_setf(1.0f), v_setf(0.0f));
    }
    const float *found = shadow_found(batch, n);
    if (found)
        return v_loadf(found + i);
    const e3d_lane_array *normals = batch->unmapped_normal ? batch->unmapped_normal : batch->normal;
    vf32 normal[3];
    shadow_load(normals, i, normal);
    if (shadow->maps.soft > 0.0f)
        return shadow_soft_reached(lighting, n, position, normal, l);
    return shadow_map_reached(lighting, n, position, normal, l);
}
