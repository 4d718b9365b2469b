/* shadow place: finds where samples lie in the shadow maps of a light (R91, R92), and the codes of depths (shadow_ranges.h). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/shadow_maps/shadow_ranges.h"
#include "e3d.h"

/* Samples in the light's axes: right, down and ahead; and what one step along the normal adds to these. */
typedef struct shadow_lanes {
    vf32 at[3], along[3], sine; /* sine: of the angle between the normal and the direction to the light */
} shadow_lanes;

/* Places in the shadow maps: column and row in texels, the depth to compare, the number of the map, and which samples are in
 * one. For soft lights also the map's spread, and the distance ahead of the light, 1 without a position (R225). */
typedef struct shadow_place {
    vf32 x, y, depth, spread, ahead;
    vi32 map;
    vmask inside;
} shadow_place;

/* R91: the sine of an angle with the normal, from its cosine. */
static ALWAYS_INLINE vf32 shadow_sine(vf32 c)
{
    return v_sqrt(v_max(v_sub(v_setf(1.0f), v_mul(c, c)), v_setf(0.0f)));
}

/* R91: how far a sample moves along its normal; `texel` is the width of a texel there. */
static ALWAYS_INLINE vf32 shadow_shift(const e3d_light_maps *shadow, vf32 texel, vf32 sine)
{
    float reach = ((float)(shadow->step * (shadow->taps - 1)) * (1.0f / 512.0f) + 1.0f) * E3D_SHADOW_CORNER;
    return v_add(v_setf(shadow->normal_bias), v_mul(v_mul(v_setf(reach), texel), v_add(sine, v_setf(E3D_SHADOW_SLACK))));
}

static ALWAYS_INLINE vmask shadow_is_inside(const e3d_light_maps *shadow, vf32 x, vf32 y)
{
    vf32 low = v_setf(shadow->margin), high = v_setf((float)shadow->size - shadow->margin);
    vmask right = v_mand(v_ge(x, low), v_ge(high, x)), down = v_mand(v_ge(y, low), v_ge(high, y));
    return v_mand(right, down);
}

/* ---- where (R92) ---- */

static ALWAYS_INLINE shadow_place shadow_place_cascades(const e3d_light_maps *shadow, const e3d_shadow_map *maps, const shadow_lanes *s)
{
    shadow_place place;
    vf32 zero = v_setf(0.0f), scale = zero, texel = zero, x0 = zero, y0 = zero;
    place.map = v_seti(0);
    place.inside = v_gt(zero, zero);
    place.spread = zero;
    place.ahead = v_setf(1.0f);
    for (int32_t k = shadow->count - 1; k >= 0; k--) {
        vf32 size = v_setf(maps[k].scale);
        vf32 x = v_add(v_mul(s->at[0], size), v_setf(maps[k].x)), y = v_add(v_mul(s->at[1], size), v_setf(maps[k].y));
        vmask in = shadow_is_inside(shadow, x, y);
        scale = v_self(in, size, scale);
        texel = v_self(in, v_setf(maps[k].texel), texel);
        x0 = v_self(in, x, x0);
        y0 = v_self(in, y, y0);
        place.map = v_seli(in, v_seti(k), place.map);
        place.spread = v_self(in, v_setf(maps[k].spread), place.spread);
        place.inside = v_mor(in, place.inside);
    }
    vf32 shift = shadow_shift(shadow, texel, s->sine);
    place.x = v_add(x0, v_mul(v_mul(s->along[0], shift), scale));
    place.y = v_add(y0, v_mul(v_mul(s->along[1], shift), scale));
    vf32 ahead = v_add(s->at[2], v_mul(s->along[2], shift));
    place.depth = v_add(v_add(v_mul(ahead, v_setf(shadow->depth[0])), v_setf(shadow->depth[1])), v_setf(shadow->bias));
    return place;
}

/* Projects points, by their distances to the right, down and ahead, for a light that shines from a point. */
static ALWAYS_INLINE void shadow_project(const e3d_light_maps *shadow, const e3d_shadow_map *map, const vf32 at[3], shadow_place *place)
{
    vf32 scale = v_setf(map->scale), near = v_div(v_setf(1.0f), v_max(at[2], v_setf(0x1p-100f)));
    place->x = v_add(v_mul(v_mul(at[0], near), scale), v_setf(map->x));
    place->y = v_add(v_mul(v_mul(at[1], near), scale), v_setf(map->y));
    place->depth = v_add(v_add(v_setf(shadow->depth[0]), v_mul(v_setf(shadow->depth[1]), near)), v_setf(shadow->bias));
    place->inside = v_mand(v_gt(at[2], v_setf(0.0f)), shadow_is_inside(shadow, place->x, place->y));
    place->spread = v_setf(map->spread);
    place->ahead = at[2];
}

static ALWAYS_INLINE shadow_place shadow_place_ahead(const e3d_light_maps *shadow, const e3d_shadow_map *map, const shadow_lanes *s)
{
    shadow_place place;
    vf32 at[3], sine = v_max(s->sine, shadow_sine(s->along[2]));
    vf32 shift = shadow_shift(shadow, v_mul(s->at[2], v_setf(map->texel)), sine);
    for (int k = 0; k < 3; k++)
        at[k] = v_add(s->at[k], v_mul(s->along[k], shift));
    place.map = v_seti(0);
    shadow_project(shadow, map, at, &place);
    return place;
}

static ALWAYS_INLINE vf32 shadow_abs(vf32 a) { return v_asf(v_andi(v_asi(a), v_seti(0x7FFFFFFF))); }

/* Which axis has the greatest distance, x before y before z: two masks, of x and of y. */
typedef struct shadow_axis {
    vmask by_x, by_y;
} shadow_axis;

static ALWAYS_INLINE shadow_axis shadow_axis_of(const vf32 p[3])
{
    vf32 a = shadow_abs(p[0]), b = shadow_abs(p[1]), c = shadow_abs(p[2]);
    vmask by_x = v_mand(v_ge(a, b), v_ge(a, c));
    return (shadow_axis){by_x, v_mandnot(v_ge(b, c), by_x)};
}

static ALWAYS_INLINE vf32 shadow_along(shadow_axis axis, const vf32 v[3]) { return v_self(axis.by_x, v[0], v_self(axis.by_y, v[1], v[2])); }

/* The face of the cube, and the distances to the right, down and ahead in it; `at` and `along` are in the world's axes. */
static ALWAYS_INLINE shadow_place shadow_place_cube(const e3d_light_maps *shadow, const e3d_shadow_map *map, const shadow_lanes *s)
{
    shadow_place place;
    vf32 zero = v_setf(0.0f), p[3], face[3];
    vf32 most = v_max(v_max(shadow_abs(s->at[0]), shadow_abs(s->at[1])), shadow_abs(s->at[2]));
    vf32 sine = v_max(s->sine, shadow_sine(shadow_along(shadow_axis_of(s->at), s->along)));
    vf32 shift = shadow_shift(shadow, v_mul(most, v_setf(map->texel)), sine);
    for (int k = 0; k < 3; k++)
        p[k] = v_add(s->at[k], v_mul(s->along[k], shift));
    shadow_axis of = shadow_axis_of(p);
    vmask by_x = of.by_x, by_y = of.by_y;
    vf32 major = shadow_along(of, p);
    vmask back = v_lt(major, zero);
    vf32 minus[3] = {v_sub(zero, p[0]), v_sub(zero, p[1]), v_sub(zero, p[2])};
    vf32 right_x = v_self(back, minus[2], p[2]), right_z = v_self(back, p[0], minus[0]);
    face[0] = v_self(by_x, right_x, v_self(by_y, p[0], right_z));
    face[1] = v_self(by_y, v_self(back, p[2], minus[2]), minus[1]);
    face[2] = shadow_abs(major);
    vi32 axis = v_seli(by_x, v_seti(0), v_seli(by_y, v_seti(2), v_seti(4)));
    shadow_project(shadow, map, face, &place);
    place.map = v_addi(axis, v_seli(back, v_seti(1), v_seti(0)));
    return place;
}

/* The code of a depth; NaN, which is lit by nothing, has the greatest code. */
static ALWAYS_INLINE vi32 shadow_code(vf32 depth)
{
    vf32 limit = v_setf((float)E3D_SHADOW_CODE_LIMIT);
    vf32 scaled = v_min(v_mul(depth, v_setf(E3D_SHADOW_CODE_SCALE)), limit);
    return v_trunc(v_max(scaled, v_sub(v_setf(0.0f), limit)));
}
