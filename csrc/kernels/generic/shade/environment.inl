/* environment: light from directions (R60-R63). Lanes lie anywhere on the cube: each loads two neighbouring texels at a time,
 * which v_load_rows turns into channels. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/generic/encode.inl"

enum { ENVIRONMENT_LAST = E3D_ENVIRONMENT_LEVELS - 1 };

/* An environment's levels as tables, indexed by lane. */
typedef struct environment_plan {
    const e3d_environment_light *light;
    const float *texels;
    int32_t start[E3D_ENVIRONMENT_LEVELS + E3D_PAD], pitch[E3D_ENVIRONMENT_LEVELS + E3D_PAD]; /* in texels */
} environment_plan;

static inline void environment_begin(const e3d_environment_light *light, environment_plan *out)
{
    const e3d_environment_view *view = e3d_environment_get_view(light->environment);
    out->light = light;
    out->texels = view->levels[0].texels;
    for (int l = 0; l < E3D_ENVIRONMENT_LEVELS; l++) {
        out->start[l] = (int32_t)((view->levels[l].texels - out->texels) / 4);
        out->pitch[l] = view->levels[l].size + 2;
    }
}

/* A point on the cube: its face, and coordinates in [-1, 1]. */
typedef struct environment_place {
    vi32 face;
    vf32 p, q;
} environment_place;

static inline vf32 environment_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

/* 1 if the coordinate is negative, else 0. */
static inline vi32 environment_side(vmask negative) { return v_seli(negative, v_seti(1), v_seti(0)); }

static ALWAYS_INLINE environment_place environment_find(const environment_plan *plan, const vf32 d[3])
{
    vf32 cosine = v_setf(plan->light->cosine), sine = v_setf(plan->light->sine), zero = v_setf(0.0f);
    vf32 x = v_sub(v_mul(cosine, d[0]), v_mul(sine, d[2])), y = d[1], z = v_add(v_mul(sine, d[0]), v_mul(cosine, d[2]));
    vf32 a = environment_abs(x), b = environment_abs(y), c = environment_abs(z), back = v_sub(zero, z), down = v_sub(zero, y);
    vmask along_x = v_mand(v_ge(a, b), v_ge(a, c)), along_y = v_ge(b, c);
    vmask left = v_lt(x, zero), below = v_lt(y, zero), behind = v_lt(z, zero);
    environment_place at;
    at.face = v_seli(along_y, v_addi(v_seti(2), environment_side(below)), v_addi(v_seti(4), environment_side(behind)));
    at.face = v_seli(along_x, environment_side(left), at.face);
    at.p = v_self(along_y, x, v_self(behind, v_sub(zero, x), x));
    at.p = v_self(along_x, v_self(left, z, back), at.p);
    at.q = v_self(v_mandnot(along_y, along_x), v_self(below, back, z), down);
    vf32 inverse = v_div(v_setf(1.0f), v_max(v_self(along_x, a, v_self(along_y, b, c)), v_setf(0x1p-100f)));
    at.p = v_mul(at.p, inverse);
    at.q = v_mul(at.q, inverse);
    return at;
}

/* Finds the texel of a coordinate in a level, counted with the border, and the weight of the next texel. */
static ALWAYS_INLINE vi32 environment_texel(vf32 p, vf32 half, vf32 *weight)
{
    vf32 least = v_setf(0.5f), middle = v_add(half, least);
    vf32 u = v_min(v_max(v_add(v_mul(p, half), middle), least), v_add(v_add(half, half), least));
    vi32 texel = v_trunc(u);
    *weight = v_sub(u, v_float(texel));
    return texel;
}

static inline vf32 environment_mix(vf32 a, vf32 b, vf32 weight) { return v_add(a, v_mul(v_sub(b, a), weight)); }

/* R61: samples a level; start and pitch are those of each lane's level. */
static ALWAYS_INLINE void environment_level(const environment_plan *plan, const environment_place *at, vi32 start, vi32 pitch, vf32 out[3])
{
    vf32 half = v_mul(v_float(v_subi(pitch, v_seti(2))), v_setf(0.5f)), f, g;
    vi32 column = environment_texel(at->p, half, &f), row = environment_texel(at->q, half, &g);
    int32_t first[V_LANES], pitches[V_LANES];
    const void *upper[V_LANES], *lower[V_LANES];
    vi32 t[8], u[8];
    v_storei(first, v_addi(start, v_addi(v_muli(v_addi(v_muli(at->face, pitch), row), pitch), column)));
    v_storei(pitches, pitch);
    for (int lane = 0; lane < V_LANES; lane++) {
        upper[lane] = plan->texels + 4 * (intptr_t)first[lane];
        lower[lane] = plan->texels + 4 * ((intptr_t)first[lane] + pitches[lane]);
    }
    v_load_rows(upper, t);
    v_load_rows(lower, u);
    for (int k = 0; k < 3; k++) {
        vf32 top = environment_mix(v_asf(t[k]), v_asf(t[4 + k]), f), bottom = environment_mix(v_asf(u[k]), v_asf(u[4 + k]), f);
        out[k] = environment_mix(top, bottom, g);
    }
}

/* Finds the starts of one level for all lanes. */
static ALWAYS_INLINE void environment_at(const environment_plan *plan, const environment_place *at, int level, vf32 out[3])
{
    environment_level(plan, at, v_seti(plan->start[level]), v_seti(plan->pitch[level]), out);
}

static ALWAYS_INLINE void environment_scale(const environment_plan *plan, vf32 color[3])
{
    for (int k = 0; k < 3; k++)
        color[k] = v_mul(color[k], v_setf(plan->light->intensity));
}

/* R62 for directions of any length. */
static ALWAYS_INLINE void environment_radiance(const environment_plan *plan, const vf32 direction[3], vf32 level, vf32 out[3])
{
    environment_place at = environment_find(plan, direction);
    vf32 l = v_min(v_max(level, v_setf(0.0f)), v_setf((float)ENVIRONMENT_LAST)), coarser[3];
    vi32 fine = v_mini(v_trunc(l), v_seti(ENVIRONMENT_LAST - 1)), coarse = v_addi(fine, v_seti(1));
    environment_level(plan, &at, v_gatheri(plan->start, fine), v_gatheri(plan->pitch, fine), out);
    environment_level(plan, &at, v_gatheri(plan->start, coarse), v_gatheri(plan->pitch, coarse), coarser);
    for (int k = 0; k < 3; k++)
        out[k] = environment_mix(out[k], coarser[k], v_sub(l, v_float(fine)));
    environment_scale(plan, out);
}

/* The same if all lanes have one level, as for a material without a roughness texture. If the level is a whole number, one
 * lookup is left out. */
static ALWAYS_INLINE void environment_radiance_at(const environment_plan *plan, const vf32 direction[3], float level, vf32 out[3])
{
    float l = level > 0.0f ? level : 0.0f;
    l = l < (float)ENVIRONMENT_LAST ? l : (float)ENVIRONMENT_LAST;
    int fine = (int)l < ENVIRONMENT_LAST - 1 ? (int)l : ENVIRONMENT_LAST - 1;
    environment_place at = environment_find(plan, direction);
    environment_at(plan, &at, fine, out);
    if (l > (float)fine) { /* otherwise nothing would be added to numbers that are finite and not below 0 */
        vf32 weight = v_setf(l - (float)fine), coarser[3];
        environment_at(plan, &at, fine + 1, coarser);
        for (int k = 0; k < 3; k++)
            out[k] = environment_mix(out[k], coarser[k], weight);
    }
    environment_scale(plan, out);
}

/* The light that surfaces of that roughness mirror along these directions. */
static ALWAYS_INLINE void environment_specular(const environment_plan *plan, const vf32 direction[3], vf32 roughness, vf32 out[3])
{
    environment_radiance(plan, direction, v_mul(roughness, v_setf((float)ENVIRONMENT_LAST)), out);
}

/* Irradiance / pi at these normals: the light that white surfaces of roughness 1 show. */
static ALWAYS_INLINE void environment_irradiance(const environment_plan *plan, const vf32 normal[3], vf32 out[3])
{
    environment_place at = environment_find(plan, normal);
    environment_at(plan, &at, ENVIRONMENT_LAST, out);
    environment_scale(plan, out);
}

static void kernel_environment(const e3d_environment_light *light, const float *const direction[3], const float *level, int count,
                               float *const color[3])
{
    environment_plan plan;
    environment_begin(light, &plan);
    for (int i = 0; i < count; i += V_LANES) {
        const vf32 d[3] = {v_loadf(direction[0] + i), v_loadf(direction[1] + i), v_loadf(direction[2] + i)};
        vf32 out[3];
        environment_radiance(&plan, d, v_loadf(level + i), out);
        for (int k = 0; k < 3; k++)
            v_storef(color[k] + i, out[k]);
    }
}

static void kernel_irradiance(const e3d_environment_light *light, const float *const normal[3], int count, float *const color[3])
{
    environment_plan plan;
    environment_begin(light, &plan);
    for (int i = 0; i < count; i += V_LANES) {
        const vf32 n[3] = {v_loadf(normal[0] + i), v_loadf(normal[1] + i), v_loadf(normal[2] + i)};
        vf32 out[3];
        environment_irradiance(&plan, n, out);
        for (int k = 0; k < 3; k++)
            v_storef(color[k] + i, out[k]);
    }
}

/* R63: the colours of `count` pixels from (x, y) on. */
static void kernel_backdrop(const e3d_backdrop *backdrop, int x, int y, int count, float *const color[3])
{
    environment_plan plan;
    environment_begin(&backdrop->light, &plan);
    vf32 half = v_setf(0.5f), row = v_add(v_setf((float)y), half);
    for (int i = 0; i < count; i += V_LANES) {
        vf32 column = v_add(v_float(v_addi(v_seti(x + i), v_iota())), half), d[3], out[3];
        for (int k = 0; k < 3; k++)
            d[k] = v_add(v_add(v_setf(backdrop->ray[k]), v_mul(column, v_setf(backdrop->across[k]))),
                         v_mul(row, v_setf(backdrop->down[k])));
        environment_radiance_at(&plan, d, backdrop->level, out);
        for (int k = 0; k < 3; k++)
            v_storef(color[k] + i, out[k]);
    }
}
