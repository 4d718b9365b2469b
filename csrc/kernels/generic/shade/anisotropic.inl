/* anisotropic: reads textures whose samples stretch over several texels at several places each (R110-R113).
 * In: a batch with its weights, the slopes of its surfaces, and coordinates. Out: texels, as those of texture.inl.
 * All lanes of a vector read as many probes as the lane that needs most. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/texture.inl"
#include "kernels/generic/shade/texel_alpha.inl"

_Static_assert(E3D_MAX_ANISOTROPY *V_LANES <= E3D_BATCH, "a plan has places for all probes of a vector");

/* The probes of one vector, by R111 and R112. */
typedef struct probe_lanes {
    vf32 step[2];
    vi32 number, lod; /* number: of probes */
    int most;         /* the greatest number of probes of any lane */
} probe_lanes;

static ALWAYS_INLINE vf32 probe_limit(vf32 texels)
{
    return v_min(v_max(texels, v_setf(-E3D_MOST_TEXELS)), v_setf(E3D_MOST_TEXELS));
}

static ALWAYS_INLINE vf32 probe_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

/* R111: the axes of the footprint; the minor one is at least a texel. */
typedef struct ellipse_lanes {
    vf32 longest2, longest, shortest; /* longest2: the square of longest */
    vf32 difference, across, root;    /* D, B and R */
} ellipse_lanes;

static ALWAYS_INLINE ellipse_lanes ellipse_of(const vf32 along[2], const vf32 down[2])
{
    ellipse_lanes out;
    vf32 one = v_setf(1.0f);
    vf32 a = v_add(v_mul(along[0], along[0]), v_mul(down[0], down[0])), c = v_add(v_mul(along[1], along[1]), v_mul(down[1], down[1]));
    vf32 b = v_add(v_mul(along[0], along[1]), v_mul(down[0], down[1])), d = v_sub(a, c);
    out.difference = d;
    out.across = b;
    out.root = v_sqrt(v_add(v_mul(d, d), v_mul(v_mul(b, b), v_setf(4.0f))));
    out.longest2 = v_max(v_mul(v_add(v_add(a, c), out.root), v_setf(0.5f)), one);
    out.longest = v_sqrt(out.longest2);
    vf32 area = probe_abs(v_sub(v_mul(along[0], down[1]), v_mul(along[1], down[0])));
    out.shortest = v_max(v_div(area, out.longest), one);
    return out;
}

/* R111: the unit vector along the major axis. */
static ALWAYS_INLINE void ellipse_direction(const ellipse_lanes *e, vf32 out[2])
{
    vf32 axis = v_add(probe_abs(e->difference), e->root), twice = v_add(e->across, e->across);
    vmask wide = v_ge(e->difference, v_setf(0.0f));
    vf32 x = v_self(wide, axis, twice), y = v_self(wide, twice, axis);
    vf32 inverse = v_div(v_setf(1.0f), v_max(v_sqrt(v_add(v_mul(x, x), v_mul(y, y))), v_setf(E3D_LEAST_AXIS)));
    out[0] = v_mul(x, inverse);
    out[1] = v_mul(y, inverse);
}

/* The input from which the probes of a batch are found. */
typedef struct probe_source {
    const e3d_batch *batch; /* its samples, and r */
    const e3d_surfaces *surfaces;
    const e3d_surface_floats (*slopes)[3]; /* [2][3], of these surfaces */
    const float *u, *v;
    float inverse_size[2];
} probe_source;

static inline probe_source probes_from(const e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_surface_floats (*slopes)[3],
                                       const float *u, const float *v, const e3d_texture_view *view)
{
    const float size[2] = {e3d_counted_size(view, view->levels[0].width), e3d_counted_size(view, view->levels[0].height)};
    return (probe_source){batch, surfaces, slopes, u, v, {1.0f / size[0], 1.0f / size[1]}};
}

/* R25: the changes of coordinates, times 1 / s^2. */
static ALWAYS_INLINE void changes_of(const probe_source *from, int i, vf32 along[2], vf32 down[2])
{
    element_lanes lanes = elements_of(from->batch->surface + i);
    const e3d_surfaces *s = surfaces_from(from->surfaces, &lanes);
    vi32 sample = v_loadi(from->batch->sample + i);
    vf32 x = v_float(v_andi(sample, v_seti(E3D_TILE - 1))), y = v_float(v_shr(sample, E3D_TILE_SHIFT));
    vf32 dx = v_sub(x, take(s->base_x, &lanes, lanes.same)), dy = v_sub(y, take(s->base_y, &lanes, lanes.same));
    if (from->batch->pattern) { /* R105 */
        dx = v_add(dx, v_loadf(from->batch->shift[0] + i));
        dy = v_add(dy, v_loadf(from->batch->shift[1] + i));
    }
    vf32 r = v_loadf(from->batch->r + i), r2 = v_mul(r, r);
    for (int k = 0; k < 2; k++) {
        const e3d_surface_floats *rows = (const e3d_surface_floats *)((const float *)from->slopes[k] + lanes.first);
        vf32 slope[3];
        take_three(rows, &lanes, lanes.same, slope);
        along[k] = probe_limit(v_mul(v_add(slope[0], v_mul(dy, slope[2])), r2));
        down[k] = probe_limit(v_mul(v_sub(slope[1], v_mul(dx, slope[2])), r2));
    }
}

/* Finds the probes of a vector. If no lane has more than one, the axis is not needed. */
static ALWAYS_INLINE probe_lanes probes_of(const texture_plan *plan, const probe_source *from, int i)
{
    vf32 along[2], down[2], one = v_setf(1.0f), share = one;
    changes_of(from, i, along, down);
    ellipse_lanes e = ellipse_of(along, down);
    probe_lanes out = {.step = {v_setf(0.0f), v_setf(0.0f)}, .most = 1};
    out.number = v_rint(v_min(v_div(e.longest, e.shortest), v_setf((float)plan->view->anisotropy)));
    while (v_any(v_gti(out.number, v_seti(out.most))))
        out.most++;
    if (out.most > 1) {
        vf32 direction[2];
        share = v_div(one, v_float(out.number));
        ellipse_direction(&e, direction);
        for (int c = 0; c < 2; c++)
            out.step[c] = v_mul(v_mul(direction[c], v_mul(e.longest, share)), v_setf(from->inverse_size[c]));
    }
    vf32 q = v_max(v_mul(e.longest2, v_mul(share, share)), v_mul(e.shortest, e.shortest));
    out.lod = v_mini(v_shr(v_subi(v_asi(q), v_asi(one)), 16), v_seti((plan->view->level_count - 1) * 256));
    return out;
}

/* Finds the texels of a vector's probes: V_LANES places of the plan each, from `place` on. */
static ALWAYS_INLINE void probes_find(texture_plan *plan, const probe_source *from, int i, const probe_lanes *probes, int place)
{
    vf32 u = v_loadf(from->u + i), v = v_loadf(from->v + i), middle = v_mul(v_sub(v_float(probes->number), v_setf(1.0f)), v_setf(0.5f));
    for (int k = 0; k < probes->most; k++) {
        vf32 at = v_sub(v_setf((float)k), middle);
        texture_find(plan, E3D_TRILINEAR, 16, place + k * V_LANES, v_add(u, v_mul(at, probes->step[0])),
                     v_add(v, v_mul(at, probes->step[1])), probes->lod);
    }
}

/* R113: the means of a vector's probes, whose places begin at `place`. */
static ALWAYS_INLINE texel_lanes probes_read(const texture_plan *plan, vi32 number, int most, int place)
{
    texel_lanes sum = texture_read(plan, E3D_TRILINEAR, 16, place);
    for (int k = 1; k < most; k++) {
        texel_lanes texel = texture_read(plan, E3D_TRILINEAR, 16, place + k * V_LANES);
        vmask has = v_gti(number, v_seti(k));
        for (int c = 0; c < 3; c++)
            sum.c[c] = v_self(has, v_add(sum.c[c], texel.c[c]), sum.c[c]);
    }
    for (int c = 0; c < 3 && most > 1; c++)
        sum.c[c] = v_div(sum.c[c], v_float(number));
    return sum;
}

static ALWAYS_INLINE vf32 probes_alpha(const texture_plan *plan, vi32 number, int most, int place)
{
    vf32 sum = alpha_read(plan, E3D_TRILINEAR, 16, place);
    for (int k = 1; k < most; k++)
        sum = v_self(v_gti(number, v_seti(k)), v_add(sum, alpha_read(plan, E3D_TRILINEAR, 16, place + k * V_LANES)), sum);
    return most > 1 ? v_div(sum, v_float(number)) : sum;
}

/* The arrays for texels, times `scale`: three channels, alpha, or all four. */
typedef struct probe_target {
    const float *scale;
    e3d_lane_array *colors; /* or NULL */
    float *alphas;          /* or NULL */
} probe_target;

/* Some vectors of a batch whose places are found: as many as a plan has room for, so that texels are fetched while later
 * places are found. */
typedef struct probe_stretch {
    int first, end, places;
    int32_t number[E3D_BATCH + E3D_PAD];
    int most[(E3D_BATCH + E3D_PAD) / V_LANES + 1];
} probe_stretch;

static ALWAYS_INLINE void stretch_read(texture_plan *plan, const probe_stretch *some, const probe_target *to)
{
    texture_ask_all(plan, E3D_TRILINEAR, 16, some->places);
    for (int i = some->first, place = 0; i < some->end; i += V_LANES) {
        vi32 number = v_loadi(some->number + i);
        int most = some->most[i / V_LANES];
        if (to->colors) {
            texel_lanes texel = probes_read(plan, number, most, place);
            for (int k = 0; k < 3; k++)
                v_storef(to->colors[k] + i, v_mul(texel.c[k], v_setf(to->scale[k])));
        }
        if (to->alphas)
            v_storef(to->alphas + i, v_mul(probes_alpha(plan, number, most, place), v_setf(to->scale[0])));
        place += most * V_LANES;
    }
}

static void __attribute__((noinline)) anisotropic_read(texture_plan *plan, const probe_source *from, const probe_target *to)
{
    probe_stretch some;
    some.first = some.end = some.places = 0;
    for (int i = 0; i < from->batch->count; i += V_LANES) {
        probe_lanes probes = probes_of(plan, from, i);
        if (some.places + probes.most * V_LANES > E3D_BATCH) {
            stretch_read(plan, &some, to);
            some.first = i;
            some.places = 0;
        }
        probes_find(plan, from, i, &probes, some.places);
        v_storei(some.number + i, probes.number);
        some.most[i / V_LANES] = probes.most;
        some.places += probes.most * V_LANES;
        some.end = i + V_LANES;
    }
    stretch_read(plan, &some, to);
}

static void kernel_texture(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *view, const float base[3])
{
    texture_plan plan;
    texture_begin(&plan, view, base);
    if (view->anisotropy > 1) {
        const probe_source from = probes_from(batch, surfaces, surfaces->slope, batch->uv[0], batch->uv[1], view);
        const probe_target to = {plan.scale, batch->color, NULL};
        anisotropic_read(&plan, &from, &to);
    } else {
        texture_color(&plan, batch);
    }
}
