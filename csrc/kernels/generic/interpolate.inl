/* interpolate: attributes of a batch of samples (R19-R26). Samples come in the order of their surfaces, so that the surfaces
 * of one vector are neighbours: each of their numbers is one load and one permutation (or one broadcast, if all samples are
 * of one surface) rather than a gather. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"

/* R19: each sample's distance from the base of its surface, the weights of the corners, and 1 over their sum. */
typedef struct weight_lanes {
    vf32 dx, dy, w[3], r;
} weight_lanes;

static ALWAYS_INLINE void interpolate_base(const e3d_surfaces *s, const element_lanes *lanes, int same, vi32 sample, weight_lanes *out)
{
    vf32 x = v_float(v_andi(sample, v_seti(E3D_TILE - 1))), y = v_float(v_shr(sample, E3D_TILE_SHIFT));
    out->dx = v_sub(x, take(s->base_x, lanes, same));
    out->dy = v_sub(y, take(s->base_y, lanes, same));
}

static ALWAYS_INLINE void interpolate_weights(const e3d_surfaces *s, const element_lanes *lanes, int same, vi32 sample, weight_lanes *out)
{
    vf32 px[3], py[3];
    interpolate_base(s, lanes, same, sample, out);
    take_three(s->p, lanes, same, out->w);
    take_three(s->px, lanes, same, px);
    take_three(s->py, lanes, same, py);
    for (int k = 0; k < 3; k++) {
        vf32 weight = v_add(v_add(out->w[k], v_mul(out->dx, px[k])), v_mul(out->dy, py[k]));
        out->w[k] = v_max(weight, v_setf(k ? 0.0f : E3D_LEAST_WEIGHT));
    }
}

/* The offset along one axis of each lane's sample, in samples. */
static ALWAYS_INLINE vf32 interpolate_offset(const int32_t *offsets, vi32 number)
{
    return v_mul(v_float(v_gatheri(offsets, number)), v_setf(1.0f / E3D_SUBPIXEL));
}

/* R105: interpolates at the pixel's centre if no weight is negative there, else at the given sample (R195: always); or beside that
 * (R190), where weights may be negative. */
static ALWAYS_INLINE void interpolate_placed(e3d_batch *batch, int i, const e3d_surfaces *s, const element_lanes *lanes, int same,
                                             weight_lanes *out)
{
    vf32 p[3], px[3], py[3], zero = v_setf(0.0f), u = zero, v = zero;
    int is_beside = batch->beside[0] != 0.0f || batch->beside[1] != 0.0f;
    interpolate_base(s, lanes, same, v_loadi(batch->sample + i), out);
    take_three(s->p, lanes, same, p);
    take_three(s->px, lanes, same, px);
    take_three(s->py, lanes, same, py);
    vmask inside = v_eqi(v_seti(0), v_seti(batch->at_samples));
    for (int k = 0; k < 3; k++) {
        out->w[k] = v_add(v_add(p[k], v_mul(out->dx, px[k])), v_mul(out->dy, py[k]));
        inside = v_mand(inside, v_ge(out->w[k], zero));
    }
    if (is_beside || v_any(v_mnot(inside))) {
        vi32 number = v_loadi(batch->number + i);
        u = v_add(v_self(inside, zero, interpolate_offset(batch->pattern->x, number)), v_setf(batch->beside[0]));
        v = v_add(v_self(inside, zero, interpolate_offset(batch->pattern->y, number)), v_setf(batch->beside[1]));
        out->dx = v_add(out->dx, u);
        out->dy = v_add(out->dy, v);
        for (int k = 0; k < 3; k++)
            out->w[k] = v_add(v_add(p[k], v_mul(out->dx, px[k])), v_mul(out->dy, py[k]));
    }
    v_storef(batch->shift[0] + i, u);
    v_storef(batch->shift[1] + i, v);
    for (int k = 0; k < 3 && !is_beside; k++)
        out->w[k] = v_max(out->w[k], v_setf(k ? 0.0f : E3D_LEAST_WEIGHT));
}

/* The weighted sum of one component; `rows` holds its values at the three corners. */
static ALWAYS_INLINE vf32 weighted_sum(const e3d_surface_floats rows[3], const element_lanes *lanes, int same, const vf32 w[3])
{
    vf32 corner[3];
    take_three(rows, lanes, same, corner);
    return dot_three(w, corner);
}

/* R22: normalises v; without a usable length it becomes 0 or NaN. Returns 1 / length. */
static inline vf32 unit_length(vf32 v[3])
{
    vf32 length2 = v_max(v_setf(E3D_LEAST_LENGTH2), dot_three(v, v)); /* a NaN stays one */
    vf32 inverse = v_div(v_setf(1.0f), v_sqrt(length2));
    for (int k = 0; k < 3; k++)
        v[k] = v_mul(v[k], inverse);
    return inverse;
}

/* ---- stages: each over all vectors of a batch ---- */

/* One vector of samples: its first sample, the surfaces that it picks from, and whether all samples are of one surface. */
typedef struct sample_vector {
    int i, same;
    element_lanes elements;
    const e3d_surfaces *s;
} sample_vector;

/* Runs `stage` with the argument `how` over a batch. It is inlined twice, so that `same` is a constant in one of the copies. */
static ALWAYS_INLINE void each_vector(e3d_batch *batch, const e3d_surfaces *surfaces,
                                      void (*stage)(e3d_batch *, const sample_vector *, const void *), const void *how)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        sample_vector v = {.i = i, .elements = elements_of(batch->surface + i)};
        v.s = surfaces_from(surfaces, &v.elements);
        v.same = v.elements.same;
        if (v.same) {
            v.same = 1; /* a constant for the compiler */
            stage(batch, &v, how);
        } else {
            stage(batch, &v, how);
        }
    }
}

/* R20 */
static ALWAYS_INLINE void interpolate_into(e3d_lane_array *out, int count, const e3d_surface_floats rows[][3],
                                           const weight_lanes *weights, const sample_vector *v)
{
    for (int c = 0; c < count; c++)
        v_storef(out[c] + v->i, v_mul(weighted_sum(rows[c], &v->elements, v->same, weights->w), weights->r));
}

static ALWAYS_INLINE void keep_weights(e3d_batch *batch, int i, const weight_lanes *weights)
{
    for (int k = 0; k < 3; k++)
        v_storef(batch->weight[k] + i, weights->w[k]);
    v_storef(batch->r + i, weights->r);
}

/* R26: the bits of a float are its logarithm, linear between powers of two. */
static ALWAYS_INLINE vi32 level_of(const e3d_surface_floats slopes[2][3], const weight_lanes *weights, const sample_vector *v)
{
    vf32 along[2], down[2], r2 = v_mul(weights->r, weights->r);
    for (int k = 0; k < 2; k++) {
        vf32 slope[3];
        take_three(slopes[k], &v->elements, v->same, slope);
        along[k] = v_add(slope[0], v_mul(weights->dy, slope[2]));
        down[k] = v_sub(slope[1], v_mul(weights->dx, slope[2]));
    }
    vf32 longest = v_max(v_add(v_mul(along[0], along[0]), v_mul(along[1], along[1])),
                         v_add(v_mul(down[0], down[0]), v_mul(down[1], down[1])));
    vf32 one = v_setf(1.0f), q = v_max(v_mul(v_mul(longest, r2), r2), one);
    return v_shr(v_subi(v_asi(q), v_asi(one)), 16);
}

/* R191: the square of how far a unit normal turns along an axis of the picture, over that of 1 / length. */
static ALWAYS_INLINE vf32 turned_square(const e3d_surface_floats planes[3], const vf32 n[3], const sample_vector *v)
{
    vf32 plane[3], change[3];
    take_three(planes, &v->elements, v->same, plane);
    for (int c = 0; c < 3; c++)
        change[c] = weighted_sum(v->s->normal[c], &v->elements, v->same, plane);
    vf32 along = dot_three(n, change);
    for (int c = 0; c < 3; c++)
        change[c] = v_sub(change[c], v_mul(n[c], along));
    return dot_three(change, change);
}

/* R191 */
static ALWAYS_INLINE vf32 curvature_of(const vf32 n[3], vf32 inverse, const sample_vector *v)
{
    vf32 sum = v_add(turned_square(v->s->px, n, v), turned_square(v->s->py, n, v));
    return v_min(v_mul(v_mul(sum, v_setf(E3D_OVER_2PI)), v_mul(inverse, inverse)), v_setf(E3D_MOST_CURVATURE));
}

/* R22 */
static ALWAYS_INLINE void interpolate_normal(e3d_batch *batch, const vf32 w[3], int wanted, const sample_vector *v)
{
    vf32 n[3];
    for (int c = 0; c < 3; c++)
        n[c] = wanted & E3D_WANT_FLAT ? take(v->s->normal[c][0], &v->elements, v->same)
                                      : weighted_sum(v->s->normal[c], &v->elements, v->same, w);
    vf32 inverse = unit_length(n);
    for (int c = 0; c < 3; c++)
        v_storef(batch->normal[c] + v->i, n[c]);
    if (wanted & E3D_WANT_CURVATURE)
        v_storef(batch->curvature + v->i, wanted & E3D_WANT_FLAT ? v_setf(0.0f) : curvature_of(n, inverse, v));
}

/* R153 */
static ALWAYS_INLINE void find_middle(e3d_batch *batch, const sample_vector *v)
{
    vf32 corner[3], third = v_setf(1.0f / 3.0f);
    for (int c = 0; c < 3; c++) {
        take_three(v->s->position[c], &v->elements, v->same, corner);
        v_storef(batch->position[c] + v->i, v_mul(v_add(v_add(corner[0], corner[1]), corner[2]), third));
    }
}

/* Interpolates a vector. r is found only if something needs it, since divisions and roots have a long latency. */
static ALWAYS_INLINE void interpolate_vector(e3d_batch *batch, const sample_vector *v, int wanted, int placed)
{
    weight_lanes weights = {.r = v_setf(0.0f)};
    const vf32 *w = weights.w;
    if (placed)
        interpolate_placed(batch, v->i, v->s, &v->elements, v->same, &weights);
    else
        interpolate_weights(v->s, &v->elements, v->same, v_loadi(batch->sample + v->i), &weights);
    if (wanted & (E3D_WANT_WEIGHTS | E3D_WANT_UV | E3D_WANT_LEVEL | E3D_WANT_POSITION))
        weights.r = v_div(v_setf(1.0f), v_add(v_add(w[0], w[1]), w[2]));
    if (wanted & E3D_WANT_WEIGHTS)
        keep_weights(batch, v->i, &weights);
    if (wanted & E3D_WANT_UV)
        interpolate_into(batch->uv, 2, v->s->uv, &weights, v);
    if (wanted & E3D_WANT_LEVEL)
        v_storei(batch->lod + v->i, batch->finest ? v_seti(0) : level_of(v->s->slope, &weights, v));
    if (wanted & E3D_WANT_POSITION)
        interpolate_into(wanted & E3D_WANT_FACET ? batch->place : batch->position, 3, v->s->position, &weights, v);
    if (wanted & E3D_WANT_FACET)
        find_middle(batch, v);
    if (wanted & E3D_WANT_NORMAL)
        interpolate_normal(batch, w, wanted, v);
}

static ALWAYS_INLINE void stage_interpolate(e3d_batch *batch, const sample_vector *v, const void *how)
{
    interpolate_vector(batch, v, *(const int *)how, 0);
}

static ALWAYS_INLINE void stage_interpolate_placed(e3d_batch *batch, const sample_vector *v, const void *how)
{
    interpolate_vector(batch, v, *(const int *)how, 1);
}

static void kernel_interpolate(e3d_batch *batch, const e3d_surfaces *surfaces, int wanted)
{
    batch->facets = (wanted & E3D_WANT_FACET) != 0;
    if (!(wanted & (E3D_WANT_WEIGHTS | E3D_WANT_UV | E3D_WANT_LEVEL | E3D_WANT_POSITION | E3D_WANT_NORMAL)))
        return;
    if (batch->pattern)
        each_vector(batch, surfaces, stage_interpolate_placed, &wanted);
    else
        each_vector(batch, surfaces, stage_interpolate, &wanted);
}

/* R24: color *= tint, or base * tint if a base is given. */
static ALWAYS_INLINE void tint_vector(e3d_batch *batch, const sample_vector *v, int c, const float *base, vf32 tint)
{
    vf32 color = base ? v_setf(base[c]) : v_loadf(batch->color[c] + v->i);
    v_storef(batch->color[c] + v->i, v_mul(color, tint));
}

static ALWAYS_INLINE void stage_vertex_color(e3d_batch *batch, const sample_vector *v, const void *base)
{
    vf32 r = v_loadf(batch->r + v->i), w[3];
    for (int k = 0; k < 3; k++)
        w[k] = v_loadf(batch->weight[k] + v->i);
    for (int c = 0; c < 3; c++)
        tint_vector(batch, v, c, base, v_mul(weighted_sum(v->s->color[c], &v->elements, v->same, w), r));
}

static ALWAYS_INLINE void stage_instance_color(e3d_batch *batch, const sample_vector *v, const void *base)
{
    for (int c = 0; c < 3; c++)
        tint_vector(batch, v, c, base, take(v->s->instance_color[c], &v->elements, v->same));
}

/* Tints the colours of a batch, or a constant base that isn't written yet. */
static inline void tint_all(e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance, const float *base)
{
    if (by_vertex)
        each_vector(batch, surfaces, stage_vertex_color, base);
    if (by_instance)
        each_vector(batch, surfaces, stage_instance_color, by_vertex ? NULL : base);
}

static void kernel_tint(e3d_batch *batch, const e3d_surfaces *surfaces, int by_vertex, int by_instance)
{
    tint_all(batch, surfaces, by_vertex, by_instance, NULL);
}

/* R27 */
static inline vf32 log2_poly(vf32 q)
{
    static const float c[7] = {0x1.c5507p-2f, -0x1.1d270ep-2f, 0x1.99e72p-3f, -0x1.2cc076p-3f,
                               0x1.823526p-4f, -0x1.5a65f6p-5f, 0x1.2b619ap-7f};
    vi32 bits = v_asi(q);
    vf32 exponent = v_float(v_subi(v_shr(bits, 23), v_seti(127)));
    vf32 one = v_setf(1.0f);
    vf32 t = v_sub(v_asf(v_ori(v_andi(bits, v_seti(0x7FFFFF)), v_seti(0x3F800000))), one);
    vf32 sum = v_setf(c[6]);
    for (int k = 5; k >= 0; k--)
        sum = v_add(v_mul(sum, t), v_setf(c[k]));
    return v_add(exponent, v_add(t, v_mul(v_mul(t, v_sub(one, t)), sum)));
}

static inline vf32 exp2_poly(vf32 y)
{
    static const float c[5] = {0x1.3a37acp-2f, 0x1.10e326p-4f, 0x1.6d1682p-7f, 0x1.7e244cp-10f,
                               0x1.cb1d4cp-13f};
    vf32 one = v_setf(1.0f);
    y = v_min(v_max(y, v_setf(-126.0f)), v_setf(126.0f));
    vi32 whole = v_floori(y);
    vf32 f = v_sub(y, v_float(whole)), sum = v_setf(c[4]);
    for (int k = 3; k >= 0; k--)
        sum = v_add(v_mul(sum, f), v_setf(c[k]));
    vf32 fraction = v_add(v_add(one, f), v_mul(v_mul(f, v_sub(f, one)), sum));
    return v_mul(fraction, v_asf(v_shl(v_addi(whole, v_seti(127)), 23)));
}
