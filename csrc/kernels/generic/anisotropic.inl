/* anisotropic: textures whose samples stretch over several texels, read at several places each (R110-R113).
 *
 * In:  a batch with its weights, the slopes of its surfaces, and coordinates. Out: texels, as those of texture.inl.
 * The probes of one vector of samples are found, prefetched and read together: all lanes read as many as the one that needs most.
 */
#ifndef E3D_KERNELS_ANISOTROPIC_INL
#define E3D_KERNELS_ANISOTROPIC_INL

#include "core/always_inline.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/texture.inl"
#include "kernels/generic/texel_alpha.inl"

_Static_assert(E3D_MAX_ANISOTROPY * V_LANES <= E3D_BATCH, "a plan has places for all probes of a vector");

/* R111 and R112 of one vector. */
typedef struct probe_lanes {
    vf32 count, step[2];
    vi32 number, lod; /* number: count, as an integer */
} probe_lanes;

static ALWAYS_INLINE vf32 probe_limit(vf32 texels)
{
    return v_min(v_max(texels, v_setf(-E3D_MOST_TEXELS)), v_setf(E3D_MOST_TEXELS));
}

static ALWAYS_INLINE vf32 probe_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

/* R111: the axes of the footprint, the minor one at least a texel. */
typedef struct ellipse_lanes {
    vf32 longest2, longest, shortest, direction[2];
} ellipse_lanes;

static ALWAYS_INLINE ellipse_lanes ellipse_of(const vf32 along[2], const vf32 down[2])
{
    ellipse_lanes out;
    vf32 one = v_setf(1.0f);
    vf32 a = v_add(v_mul(along[0], along[0]), v_mul(down[0], down[0])), c = v_add(v_mul(along[1], along[1]), v_mul(down[1], down[1]));
    vf32 b = v_add(v_mul(along[0], along[1]), v_mul(down[0], down[1])), d = v_sub(a, c);
    vf32 root = v_sqrt(v_add(v_mul(d, d), v_mul(v_mul(b, b), v_setf(4.0f)))), axis = v_add(probe_abs(d), root), twice = v_add(b, b);
    out.longest2 = v_max(v_mul(v_add(v_add(a, c), root), v_setf(0.5f)), one);
    out.longest = v_sqrt(out.longest2);
    vf32 area = probe_abs(v_sub(v_mul(along[0], down[1]), v_mul(along[1], down[0])));
    out.shortest = v_max(v_div(area, out.longest), one);
    vmask wide = v_ge(d, v_setf(0.0f));
    vf32 x = v_self(wide, axis, twice), y = v_self(wide, twice, axis);
    vf32 inverse = v_div(one, v_max(v_sqrt(v_add(v_mul(x, x), v_mul(y, y))), v_setf(E3D_LEAST_AXIS)));
    out.direction[0] = v_mul(x, inverse);
    out.direction[1] = v_mul(y, inverse);
    return out;
}

/* What the probes of a batch are found by. */
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

/* R25, times 1 / s^2. */
static ALWAYS_INLINE void changes_of(const probe_source *from, int i, vf32 along[2], vf32 down[2])
{
    element_lanes lanes = lanes_of(from->batch->surface + i);
    const e3d_surfaces *s = surfaces_from(from->surfaces, &lanes);
    vi32 sample = v_loadi(from->batch->sample + i);
    vf32 x = v_float(v_andi(sample, v_seti(E3D_TILE - 1))), y = v_float(v_shr(sample, E3D_TILE_SHIFT));
    vf32 dx = v_sub(x, take(s->base_x, &lanes, lanes.same)), dy = v_sub(y, take(s->base_y, &lanes, lanes.same));
    vf32 r = v_loadf(from->batch->r + i), r2 = v_mul(r, r);
    for (int k = 0; k < 2; k++) {
        const e3d_surface_floats *rows = (const e3d_surface_floats *)((const float *)from->slopes[k] + lanes.first);
        vf32 slope[3];
        take_three(rows, &lanes, lanes.same, slope);
        along[k] = probe_limit(v_mul(v_add(slope[0], v_mul(dy, slope[2])), r2));
        down[k] = probe_limit(v_mul(v_sub(slope[1], v_mul(dx, slope[2])), r2));
    }
}

static ALWAYS_INLINE probe_lanes probes_of(const texture_plan *plan, const probe_source *from, int i)
{
    probe_lanes out;
    vf32 along[2], down[2], one = v_setf(1.0f);
    changes_of(from, i, along, down);
    ellipse_lanes e = ellipse_of(along, down);
    out.number = v_rint(v_min(v_div(e.longest, e.shortest), v_setf((float)plan->view->anisotropy)));
    out.count = v_float(out.number);
    vf32 share = v_div(one, out.count), reach = v_mul(e.longest, share);
    for (int c = 0; c < 2; c++)
        out.step[c] = v_mul(v_mul(e.direction[c], reach), v_setf(from->inverse_size[c]));
    vf32 q = v_max(v_mul(e.longest2, v_mul(share, share)), v_mul(e.shortest, e.shortest));
    out.lod = v_mini(v_shr(v_subi(v_asi(q), v_asi(one)), 16), v_seti((plan->view->level_count - 1) * 256));
    return out;
}

/* Finds and asks for the texels of a vector's probes, V_LANES places each; returns how many probes that is. */
static ALWAYS_INLINE int probes_find(texture_plan *plan, const probe_source *from, int i, const probe_lanes *probes)
{
    vf32 u = v_loadf(from->u + i), v = v_loadf(from->v + i), middle = v_mul(v_sub(probes->count, v_setf(1.0f)), v_setf(0.5f));
    int count = 0;
    do {
        vf32 at = v_sub(v_setf((float)count), middle);
        texture_find(plan, E3D_TRILINEAR, 16, count * V_LANES, v_add(u, v_mul(at, probes->step[0])), v_add(v, v_mul(at, probes->step[1])),
                     probes->lod);
        count++;
    } while (v_any(v_gti(probes->number, v_seti(count))));
    texture_ask_all(plan, E3D_TRILINEAR, 16, count * V_LANES);
    return count;
}

/* R113: the means of the probes' texels, or of their alphas. */
static ALWAYS_INLINE texel_lanes probes_read(const texture_plan *plan, const probe_lanes *probes, int count)
{
    texel_lanes sum = texture_read(plan, E3D_TRILINEAR, 16, 0);
    for (int k = 1; k < count; k++) {
        texel_lanes texel = texture_read(plan, E3D_TRILINEAR, 16, k * V_LANES);
        vmask has = v_gti(probes->number, v_seti(k));
        for (int c = 0; c < 3; c++)
            sum.c[c] = v_self(has, v_add(sum.c[c], texel.c[c]), sum.c[c]);
    }
    for (int c = 0; c < 3; c++)
        sum.c[c] = v_div(sum.c[c], probes->count);
    return sum;
}

static ALWAYS_INLINE vf32 probes_alpha(const texture_plan *plan, const probe_lanes *probes, int count)
{
    vf32 sum = alpha_read(plan, E3D_TRILINEAR, 16, 0);
    for (int k = 1; k < count; k++)
        sum = v_self(v_gti(probes->number, v_seti(k)), v_add(sum, alpha_read(plan, E3D_TRILINEAR, 16, k * V_LANES)), sum);
    return v_div(sum, probes->count);
}

/* Texels of a batch, times `scale`: three channels, alpha, or all four. */
static void __attribute__((noinline)) anisotropic_read(texture_plan *plan, const probe_source *from, const float scale[3],
                                                       e3d_lane_array *colors, float *alphas)
{
    for (int i = 0; i < from->batch->count; i += V_LANES) {
        probe_lanes probes = probes_of(plan, from, i);
        int count = probes_find(plan, from, i, &probes);
        if (colors) {
            texel_lanes texel = probes_read(plan, &probes, count);
            for (int k = 0; k < 3; k++)
                v_storef(colors[k] + i, v_mul(texel.c[k], v_setf(scale[k])));
        }
        if (alphas)
            v_storef(alphas + i, v_mul(probes_alpha(plan, &probes, count), v_setf(scale[0])));
    }
}

static void kernel_texture(e3d_batch *batch, const e3d_surfaces *surfaces, const e3d_texture_view *view, const float base[3])
{
    texture_plan plan;
    texture_begin(&plan, view, base);
    if (view->anisotropy > 1) {
        const probe_source from = probes_from(batch, surfaces, surfaces->slope, batch->uv[0], batch->uv[1], view);
        anisotropic_read(&plan, &from, plan.scale, batch->color, NULL);
    } else {
        texture_color(&plan, batch);
    }
}

#endif
