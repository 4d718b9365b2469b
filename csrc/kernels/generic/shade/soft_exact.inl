/* exact shadows of soft lights: how many of the points of a light's disc are hidden from samples (R196-R198, R194). A lane is a ray to
 * one point; all rays of a sample walk the tree of casters together. A box is left out only if no corner in it can give a hit:
 * every step of R198 is monotone, rounding included, so that bounds are found by the same steps from the ends of ranges. */
#pragma once

#include <math.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/light_points.h"
#include "e3d.h"
#include "kernels/types/casters.h"
#include "kernels/types/shading.h"
#include "kernels/generic/setup.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/exact_shadow.inl"

_Static_assert(E3D_LIGHT_POINTS == 32, "a bit of a word for each ray");

/* A range of a number. */
typedef struct disc_range {
    float low, high;
} disc_range;

/* The rays of a sample. */
typedef struct disc_rays {
    const exact_lanes *at;
    const e3d_light *light;
    int axis, is_negative, has_position;
    float position[3], towards[3], e[3], f[3]; /* towards: from the position to the light's middle */
    float normal[3], slack[3], limit;          /* the plane of R100, turned to the points of the open rays */
    float x, y, z;                             /* of R198 */
    const void *mesh;                          /* R194: whose faces that look to a ray's point don't count for it, or NULL */
    disc_range slope[2];
    float nearest;                             /* hits are surely no less than that along z */
    int has_rays;
    float slopes[2][E3D_LIGHT_POINTS], ends[E3D_LIGHT_POINTS], ways[3][E3D_LIGHT_POINTS]; /* ways: from the position to the points */
    /* A bit for each ray: those that are tested, and those that are hidden */
    uint32_t open, hidden;
} disc_rays;

static inline float disc_height(float along, int is_negative) { return is_negative ? 0.0f - along : along; }
static inline float disc_less(float a, float b) { return a < b ? a : b; }
static inline float disc_more(float a, float b) { return a > b ? a : b; }

static inline int disc_longest(const float v[3])
{
    float a = fabsf(v[0]), b = fabsf(v[1]), c = fabsf(v[2]);
    return a >= b && a >= c ? 0 : b >= c ? 1
                                         : 2;
}

static inline float disc_dot(const float a[3], const float b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

/* ---- the disc and its rays ---- */

/* R196 and R197 */
static void disc_find_disc(disc_rays *r, float cosine)
{
    const float *t = r->towards;
    int k = r->axis = disc_longest(t), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    float length = sqrtf(disc_dot(t, t));
    float size = disc_more(disc_less(r->light->shadow.soft, (0.5f * cosine) * length), 0.0f);
    float square = t[k] * t[k] + t[k1] * t[k1], s = size / sqrtf(square);
    r->is_negative = t[k] > 0.0f;
    r->e[k] = (0.0f - t[k1]) * s;
    r->e[k1] = t[k] * s;
    r->e[k2] = 0.0f;
    s = s / length;
    r->f[k] = (0.0f - t[k2] * t[k]) * s;
    r->f[k1] = (0.0f - t[k2] * t[k1]) * s;
    r->f[k2] = square * s;
}

/* How far points of the disc are from its middle along an axis, at most: more than roundings add. */
static inline float disc_extent(const disc_rays *r, int axis)
{
    return sqrtf(r->e[axis] * r->e[axis] + r->f[axis] * r->f[axis]) * (1.0f + 0x1p-18f) + 0x1p-60f;
}

/* Finds the range of the rays' slopes, and where hits end. */
static void disc_bound(disc_rays *r)
{
    int k = r->axis;
    float extent = disc_extent(r, k), along = fabsf(r->towards[k]);
    disc_range ahead = {disc_more(along - extent, 0.0f), along + extent};
    for (int c = 0; c < 2; c++) {
        int axis = (k + 1 + c) % 3;
        float low = r->towards[axis] - disc_extent(r, axis), high = r->towards[axis] + disc_extent(r, axis);
        r->slope[c] = (disc_range){low / (low < 0.0f ? ahead.low : ahead.high), high / (high > 0.0f ? ahead.low : ahead.high)};
    }
    float middle = disc_height(r->light->position[k], r->is_negative);
    r->nearest = r->has_position ? (middle - extent) - (fabsf(middle) + extent) * 0x1p-18f : -INFINITY;
}

/* Begins some of the rays from a position, as the disc is seen from the sample. */
static void disc_begin(disc_rays *r, const float position[3], uint32_t rays)
{
    int k = r->axis;
    for (int c = 0; c < 3; c++) {
        r->position[c] = position[c];
        r->towards[c] = r->has_position ? r->light->position[c] - position[c] : r->light->to_light[c];
    }
    r->x = position[(k + 1) % 3];
    r->y = position[(k + 2) % 3];
    r->z = disc_height(position[k], r->is_negative);
    r->has_rays = 0;
    r->open = rays & ~r->hidden;
    disc_bound(r);
}

/* R198: finds the rays themselves, which many samples never need, and closes those that are none. */
static void disc_find_rays(disc_rays *r)
{
    int k = r->axis, axes[3] = {k, (k + 1) % 3, (k + 2) % 3};
    uint32_t closed = 0;
    vf32 zero = v_setf(0.0f);
    float place = r->x - r->x + (r->y - r->y) + (r->z - r->z); /* 0, or a NaN */
    for (int i = 0; i < E3D_LIGHT_POINTS; i += V_LANES) {
        vf32 px = v_mul(v_loadf(E3D_LIGHT_POINT_X + i), v_setf(0x1p-10f)), py = v_mul(v_loadf(E3D_LIGHT_POINT_Y + i), v_setf(0x1p-10f));
        vf32 o[3], t[3], odd = v_setf(place);
        for (int c = 0; c < 3; c++) {
            o[c] = v_add(v_mul(px, v_setf(r->e[axes[c]])), v_mul(py, v_setf(r->f[axes[c]])));
            t[c] = v_add(v_setf(r->towards[axes[c]]), o[c]);
            v_storef(r->ways[axes[c]] + i, t[c]);
        }
        for (int c = 0; c < 2; c++) {
            vf32 slope = v_div(t[1 + c], exact_abs(t[0]));
            odd = v_add(odd, v_sub(slope, slope));
            v_storef(r->slopes[c] + i, slope);
        }
        vf32 end = v_add(v_setf(r->light->position[k]), o[0]);
        v_storef(r->ends + i, r->is_negative ? v_sub(zero, end) : end);
        closed |= v_bits(v_mnot(v_eq(odd, zero))) << i;
    }
    r->open &= ~closed;
    r->has_rays = 1;
}

/* How far the rays of one vector go along a direction. */
static ALWAYS_INLINE vf32 disc_along(const disc_rays *r, const float direction[3], int i)
{
    vf32 way[3], along[3];
    for (int c = 0; c < 3; c++) {
        way[c] = v_loadf(r->ways[c] + i);
        along[c] = v_setf(direction[c]);
    }
    return dot_three(along, way);
}

/* R198: of the rays from the sample, those that go to the other side of its face than the ray to the light's middle. */
static uint32_t disc_find_behind(disc_rays *r)
{
    float size = 0.0f, extent = 0.0f;
    for (int c = 0; c < 3; c++) {
        size = size + fabsf(r->normal[c] * r->towards[c]);
        extent = extent + fabsf(r->normal[c]) * disc_extent(r, c);
    }
    if (disc_dot(r->normal, r->towards) > extent + size * 0x1p-18f)
        return 0;
    uint32_t behind = 0;
    disc_find_rays(r);
    for (int i = 0; i < E3D_LIGHT_POINTS; i += V_LANES)
        behind |= v_bits(v_lt(disc_along(r, r->normal, i), v_setf(0.0f))) << i;
    return behind;
}

/* ---- boxes ---- */

/* The range of a product of two numbers of ranges; mostly the first is not negative. */
static ALWAYS_INLINE disc_range disc_product(disc_range a, disc_range b)
{
    if (a.low >= 0.0f)
        return (disc_range){b.low * (b.low < 0.0f ? a.high : a.low), b.high * (b.high > 0.0f ? a.high : a.low)};
    float p = a.low * b.low, q = a.low * b.high, s = a.high * b.low, t = a.high * b.high;
    return (disc_range){disc_less(disc_less(p, q), disc_less(s, t)), disc_more(disc_more(p, q), disc_more(s, t))};
}

/* Whether no corner in a box gives rays a hit: all are behind the sample, behind the light, or beside the rays. */
static ALWAYS_INLINE int disc_is_beside(const disc_rays *r, const float low[3], const float high[3])
{
    int k = r->axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    disc_range z = r->is_negative ? (disc_range){0.0f - high[k], 0.0f - low[k]} : (disc_range){low[k], high[k]};
    if (!(z.low < r->z) || z.high + disc_more(fabsf(z.low), fabsf(z.high)) * 0x1p-18f < r->nearest)
        return 1;
    const disc_range far = {r->z - z.high, r->z - z.low};
    disc_range x = disc_product(far, r->slope[0]), y = disc_product(far, r->slope[1]);
    return low[k1] > r->x + x.high || high[k1] < r->x + x.low || low[k2] > r->y + y.high || high[k2] < r->y + y.low;
}

/* Whether all of a box is surely below the plane of R100, by more than roundings add. */
static ALWAYS_INLINE int disc_is_below(const disc_rays *r, const float low[3], const float high[3])
{
    float height = 0.0f, sum = 0.0f;
    for (int c = 0; c < 3; c++) {
        float n = r->normal[c], a = n * (low[c] - r->position[c]), b = n * (high[c] - r->position[c]);
        height = height + disc_more(a, b);
        sum = sum + disc_more(fabsf(a), fabsf(b));
    }
    return height < sum * -0x1p-18f;
}

/* ---- casters ---- */

/* R194: the way out of the sample's own body through a caster, which hides no point that lies there; 0 for casters of others. */
static int disc_find_outward(const disc_rays *r, uint32_t number, float out[3])
{
    const e3d_caster_index *index = r->at->index;
    const float *v = index->world[number];
    if (!r->mesh || index->mesh_of(index, number) != r->mesh)
        return 0;
    for (int c = 0; c < 3; c++) {
        int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        float own = (v[3 + c1] - v[c1]) * (v[6 + c2] - v[c2]) - (v[3 + c2] - v[c2]) * (v[6 + c1] - v[c1]);
        out[c] = index->is_mirrored[number] ? 0.0f - own : own;
    }
    return 1;
}

/* R101: the heights of a caster's corners above the sample's plane; 0 if it hides nothing. */
static ALWAYS_INLINE int disc_heights(const disc_rays *r, const float *world, float height[3])
{
    int rises = 0;
    for (int v = 0; v < 3; v++) {
        float g[3], size[3];
        for (int c = 0; c < 3; c++) {
            g[c] = world[3 * v + c] - r->position[c];
            size[c] = fabsf(g[c]);
        }
        height[v] = disc_dot(r->normal, g) - disc_dot(r->slack, size);
        rises |= !(height[v] <= 0.0f); /* shares are no less than 0 */
    }
    return rises;
}

/* Of the rays of one vector, those that a caster hides; `outward` is NULL or its way out. */
static ALWAYS_INLINE uint32_t disc_hits(const disc_rays *r, uint32_t number, int i, const float height[3], const float *outward)
{
    const float *world = r->at->index->world[number];
    int k = r->axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    vf32 a[3], b[3], z[3], w[3], h[3], zero = v_setf(0.0f), s1 = v_loadf(r->slopes[0] + i), s2 = v_loadf(r->slopes[1] + i);
    for (int v = 0; v < 3; v++) {
        float along = disc_height(world[3 * v + k], r->is_negative);
        vf32 far = v_setf(r->z - along);
        z[v] = v_setf(along);
        h[v] = v_setf(height[v]);
        a[v] = v_sub(v_setf(world[3 * v + k1]), v_add(v_setf(r->x), v_mul(far, s1)));
        b[v] = v_sub(v_setf(world[3 * v + k2]), v_add(v_setf(r->y), v_mul(far, s2)));
    }
    for (int v = 0; v < 3; v++) {
        int from = (v + 2) % 3, to = (v + 1) % 3;
        w[v] = v_sub(v_mul(a[from], b[to]), v_mul(b[from], a[to]));
    }
    vmask above = v_mand(v_mand(v_ge(w[0], zero), v_ge(w[1], zero)), v_ge(w[2], zero));
    vmask below = v_mand(v_mand(v_ge(zero, w[0]), v_ge(zero, w[1])), v_ge(zero, w[2]));
    vmask lanes = v_mor(above, below);
    if (!v_any(lanes))
        return 0;
    lanes = v_mand(lanes, v_mand(exact_spans(a), exact_spans(b)));
    vf32 det = v_add(v_add(w[0], w[1]), w[2]), share = v_div(v_setf(1.0f), det);
    for (int v = 0; v < 3; v++)
        w[v] = v_mul(w[v], share);
    lanes = v_mandnot(lanes, v_eq(det, zero));
    lanes = v_mand(lanes, v_gt(dot_three(w, h), v_setf(r->limit)));
    if (r->has_position)
        lanes = v_mand(lanes, v_gt(dot_three(w, z), v_loadf(r->ends + i)));
    if (outward)
        lanes = v_mandnot(lanes, v_gt(disc_along(r, outward, i), zero));
    if (r->at->index->may_be_open[number] && v_any(lanes))
        lanes = exact_solid(r->at, number, lanes, w);
    return v_bits(lanes);
}

/* Narrows the ranges of slopes to the open rays. */
static void disc_narrow(disc_rays *r)
{
    for (int c = 0; c < 2; c++) {
        float low[V_LANES], high[V_LANES];
        vf32 least = v_setf(INFINITY), most = v_setf(-INFINITY);
        for (int i = 0; i < E3D_LIGHT_POINTS; i += V_LANES) {
            vmask open = visible_lanes(r->open >> i & setup_tail(V_LANES));
            vf32 slope = v_loadf(r->slopes[c] + i);
            least = v_min(least, v_self(open, slope, least));
            most = v_max(most, v_self(open, slope, most));
        }
        v_storef(low, least);
        v_storef(high, most);
        r->slope[c] = (disc_range){low[0], high[0]};
        for (int lane = 1; lane < V_LANES; lane++)
            r->slope[c] = (disc_range){disc_less(r->slope[c].low, low[lane]), disc_more(r->slope[c].high, high[lane])};
    }
}

/* Finds the rays that a caster hides. */
static void disc_test(disc_rays *r, uint32_t number)
{
    const e3d_caster_index *index = r->at->index;
    const float *world = index->world[number];
    float height[3], low[3], high[3], outward[3];
    for (int c = 0; c < 3; c++) {
        low[c] = disc_less(disc_less(world[c], world[3 + c]), world[6 + c]);
        high[c] = disc_more(disc_more(world[c], world[3 + c]), world[6 + c]);
    }
    if (disc_is_beside(r, low, high) || !disc_heights(r, world, height))
        return;
    if (index->any_spared && index->is_spared(index, number, r->light->shadow.exact))
        return;
    int is_own = disc_find_outward(r, number, outward);
    if (!r->has_rays)
        disc_find_rays(r);
    for (int i = 0; i < E3D_LIGHT_POINTS; i += V_LANES)
        if (r->open >> i & setup_tail(V_LANES))
            r->hidden |= disc_hits(r, number, i, height, is_own ? outward : NULL) << i & r->open;
    if (r->open & r->hidden) {
        r->open &= ~r->hidden;
        disc_narrow(r);
    }
}

/* Finds the rays that any caster hides. */
static void disc_walk(disc_rays *r)
{
    const e3d_caster_tree *tree = &r->at->index->tree;
    for (uint32_t n = 0; n < tree->node_count && r->open;) {
        const e3d_caster_node *node = &tree->nodes[n];
        if (disc_is_beside(r, node->low, node->high) || disc_is_below(r, node->low, node->high)) {
            n = node->next;
            continue;
        }
        const uint32_t *casters = tree->casters + (node->first >> E3D_CASTER_COUNT_BITS);
        int count = (int)(node->first & ((1u << E3D_CASTER_COUNT_BITS) - 1));
        for (int c = 0; c < count; c++)
            disc_test(r, casters[c]);
        n++;
    }
}

/* ---- samples ---- */

/* What a sample's rays begin with, for a vector of samples. */
typedef struct disc_vector {
    float position[3][V_LANES], body[3][V_LANES], cosine[V_LANES];
    float lean[V_LANES]; /* R194: the product of the face's normal and that of its vertices; 0 where these do not count */
} disc_vector;

/* Finds which of some rays are hidden; `mesh` is that of the sample if its face turns away from their points, else NULL. */
static void disc_cast(disc_rays *r, const float position[3], const float body[3], const void *mesh, uint32_t rays)
{
    r->mesh = mesh;
    disc_begin(r, position, rays);
    disc_walk(r);
    if (!mesh)
        return;
    r->mesh = NULL;
    disc_begin(r, body, rays);
    disc_walk(r);
}

/* R196: the share of the light's points that nothing hides from one sample of a vector. */
static float disc_share(const exact_lanes *at, const e3d_light *light, const disc_vector *from, int lane, int32_t surface)
{
    disc_rays r = {.at = at, .light = light, .has_position = e3d_light_traits_of(light->kind).has_position};
    const e3d_receivers *receivers = at->receivers;
    float towards[3], position[3], body[3];
    for (int c = 0; c < 3; c++) {
        position[c] = from->position[c][lane];
        body[c] = from->body[c][lane];
        r.towards[c] = towards[c] = r.has_position ? light->position[c] - position[c] : light->to_light[c];
        r.normal[c] = receivers->normal[c][surface];
        r.slack[c] = receivers->slack[c][surface];
    }
    r.limit = receivers->limit[surface];
    int away = disc_dot(r.normal, towards) < 0.0f;
    for (int c = 0; c < 3 && away; c++)
        r.normal[c] = 0.0f - r.normal[c];
    disc_find_disc(&r, from->cosine[lane]);
    disc_begin(&r, position, ~0u);
    const void *mesh = receivers->is_smooth ? receivers->mesh[surface] : NULL;
    uint32_t behind = disc_find_behind(&r);
    disc_cast(&r, position, body, from->lean[lane] < 0.0f ? mesh : NULL, ~behind);
    if (behind) {
        for (int c = 0; c < 3; c++)
            r.normal[c] = 0.0f - r.normal[c];
        disc_cast(&r, position, body, from->lean[lane] > 0.0f ? mesh : NULL, behind);
    }
    return (float)(E3D_LIGHT_POINTS - __builtin_popcount(r.hidden)) * (1.0f / E3D_LIGHT_POINTS);
}

/* R194: how far faces lean from their vertices' normals, where these look to the light. */
static vf32 disc_lean(exact_lanes *at, const vf32 normal[3])
{
    vf32 zero = v_setf(0.0f);
    exact_fetch_planes(at);
    return v_self(v_gt(dot_three(normal, at->towards), zero), dot_three(at->normal, normal), zero);
}

/* Finds the shares of a light for a vector of samples; where the light adds nothing they are 1. */
static void disc_find_shares(exact_lanes *at, const e3d_lighting *lighting, const e3d_caster_light *caster_light, const e3d_batch *batch,
                             int i, float *out)
{
    const e3d_light *light = &lighting->lights[caster_light->number];
    disc_vector from;
    int32_t surface[V_LANES];
    vf32 l[3], unmapped[3];
    v_storef(out, v_setf(1.0f));
    vmask lanes = exact_lit(at, lighting, caster_light->number, batch, i, l, unmapped);
    if (!v_any(lanes))
        return;
    exact_lanes moved = *at;
    vf32 lean = v_setf(0.0f);
    if (at->receivers->is_smooth) {
        lean = disc_lean(at, unmapped);
        exact_move(&moved, batch, i);
    }
    for (int c = 0; c < 3; c++) {
        v_storef(from.position[c], at->position[c]);
        v_storef(from.body[c], moved.position[c]);
    }
    v_storef(from.cosine, dot_three(unmapped, l));
    v_storef(from.lean, lean);
    v_storei(surface, at->surface);
    for (uint32_t left = v_bits(lanes); left; left &= left - 1) {
        int lane = __builtin_ctz(left);
        out[lane] = disc_share(at, light, &from, lane, surface[lane]);
    }
}

static void kernel_soft_exact_shadows(e3d_batch *batch, const e3d_lighting *lighting, const e3d_caster_index *index,
                                      const e3d_receivers *receivers)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        exact_lanes at = {.index = index, .receivers = receivers, .surface = v_loadi(batch->surface + i)};
        for (int c = 0; c < 3; c++)
            at.position[c] = v_loadf(batch->position[c] + i);
        for (int n = 0; n < index->light_count; n++)
            if (lighting->lights[index->lights[n].number].shadow.soft > 0.0f)
                disc_find_shares(&at, lighting, &index->lights[n], batch, i, batch->soft_reached[n] + i);
    }
}
