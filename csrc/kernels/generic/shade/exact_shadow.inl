/* exact shadows: finds which lights are hidden from samples (R98-R102, R194). A sample's cell, in each level of a light's grid,
 * holds all casters that R99 may find: both sides compare the same rounded numbers, and cells are found by monotone steps. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/casters.h"
#include "kernels/types/shading.h"
#include "kernels/generic/surface.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/shade/light.inl"

/* ---- planes of surfaces (R100) ---- */

static ALWAYS_INLINE vf32 exact_abs(vf32 a) { return v_asf(v_andi(v_asi(a), v_seti(INT32_MAX))); }

static ALWAYS_INLINE void exact_edges(const e3d_surfaces *s, int n, vf32 e[3], vf32 f[3], vf32 most[3], vf32 sum[3])
{
    for (int c = 0; c < 3; c++) {
        vf32 corner[3];
        for (int v = 0; v < 3; v++)
            corner[v] = v_loadf(s->position[c][v] + n);
        e[c] = v_sub(corner[1], corner[0]);
        f[c] = v_sub(corner[2], corner[0]);
        most[c] = v_max(v_max(exact_abs(corner[0]), exact_abs(corner[1])), exact_abs(corner[2]));
        sum[c] = v_add(exact_abs(e[c]), exact_abs(f[c]));
    }
}

static ALWAYS_INLINE void exact_plane(const e3d_surfaces *s, int n, e3d_receivers *out)
{
    vf32 e[3], f[3], most[3], sum[3], m[3], limit[3], share = v_setf(E3D_PLANE_SLACK);
    exact_edges(s, n, e, f, most, sum);
    for (int c = 0; c < 3; c++)
        m[c] = v_sub(v_mul(e[(c + 1) % 3], f[(c + 2) % 3]), v_mul(e[(c + 2) % 3], f[(c + 1) % 3]));
    vf32 i = v_div(v_setf(1.0f), v_max(v_max(exact_abs(m[0]), exact_abs(m[1])), exact_abs(m[2])));
    for (int c = 0; c < 3; c++) {
        int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        vf32 normal = v_mul(m[c], i), slack = v_add(v_mul(most[c1], sum[c2]), v_mul(most[c2], sum[c1]));
        limit[c] = v_mul(exact_abs(normal), most[c]);
        v_storef(out->normal[c] + n, normal);
        v_storef(out->slack[c] + n, v_mul(v_mul(slack, i), share));
    }
    v_storef(out->limit + n, v_mul(v_add(v_add(limit[0], limit[1]), limit[2]), share));
}

/* R194: the unit normals of the corners. */
static ALWAYS_INLINE void exact_corner_normals(const e3d_surfaces *s, int n, e3d_receivers *out)
{
    for (int k = 0; k < 3; k++) {
        vf32 normal[3];
        for (int c = 0; c < 3; c++)
            normal[c] = v_loadf(s->normal[c][k] + n);
        unit_length(normal);
        for (int c = 0; c < 3; c++)
            v_storef(out->corner_normal[c][k] + n, normal[c]);
    }
}

static void kernel_receivers(const e3d_surfaces *surfaces, e3d_receivers *out)
{
    out->surfaces = surfaces;
    for (int n = 0; n < surfaces->count; n += V_LANES) {
        exact_plane(surfaces, n, out);
        if (out->is_smooth)
            exact_corner_normals(surfaces, n, out);
    }
}

/* ---- a vector of samples and one light ---- */

typedef struct exact_lanes {
    const e3d_caster_index *index;
    const float (*corners)[9]; /* of the light */
    int x, y, z;               /* where x, y and z of the face begin in a caster's corners */
    int is_point;
    float sign;            /* of z, for point lights */
    vf32 place[2], far;    /* x and y of R98, or slopes; and z */
    vf32 position[3], normal[3], slack[3], limit; /* the plane of R100, turned to the light */
    vi32 surface;
    vf32 towards[3]; /* the direction to the light, of any length */
    int has_plane;
    const e3d_receivers *receivers;
    int leaves;  /* R194: in the lanes of `turned`, rays may leave the samples' own bodies */
    vmask turned;
} exact_lanes;

static ALWAYS_INLINE vf32 exact_pick(const float *from, const int32_t *at)
{
    float lanes[V_LANES];
    for (int lane = 0; lane < V_LANES; lane++)
        lanes[lane] = from[at[lane]];
    return v_loadf(lanes);
}

/* Fetches the samples' planes, which many samples never need. */
static void exact_fetch_planes(exact_lanes *at)
{
    int32_t surface[V_LANES];
    v_storei(surface, at->surface);
    for (int c = 0; c < 3; c++) {
        at->normal[c] = exact_pick(at->receivers->normal[c], surface);
        at->slack[c] = exact_pick(at->receivers->slack[c], surface);
    }
    at->limit = exact_pick(at->receivers->limit, surface);
    vmask away = v_lt(dot_three(at->normal, at->towards), v_setf(0.0f));
    for (int c = 0; c < 3; c++)
        at->normal[c] = v_self(away, v_sub(v_setf(0.0f), at->normal[c]), at->normal[c]);
    at->has_plane = 1;
}

/* R99: A and B of the corners. */
static ALWAYS_INLINE void exact_corners(const exact_lanes *at, const float *caster, int is_point, vf32 a[3], vf32 b[3])
{
    for (int k = 0; k < 3; k++) {
        vf32 x = at->place[0], y = at->place[1];
        if (is_point) {
            vf32 z = v_setf(caster[at->z + k] * at->sign);
            x = v_mul(x, z);
            y = v_mul(y, z);
        }
        a[k] = v_sub(v_setf(caster[at->x + k]), x);
        b[k] = v_sub(v_setf(caster[at->y + k]), y);
    }
}

static ALWAYS_INLINE vmask exact_spans(const vf32 a[3])
{
    vf32 zero = v_setf(0.0f), low = v_min(v_min(a[0], a[1]), a[2]), high = v_max(v_max(a[0], a[1]), a[2]);
    return v_mand(v_ge(zero, low), v_ge(high, zero));
}

/* R99: the lanes whose ray goes through the caster, and the weights of its corners. */
static ALWAYS_INLINE vmask exact_inside(const exact_lanes *at, const float *caster, int is_point, vmask lanes, vf32 weight[3])
{
    vf32 a[3], b[3], zero = v_setf(0.0f);
    exact_corners(at, caster, is_point, a, b);
    for (int k = 0; k < 3; k++) {
        int i = (k + 2) % 3, j = (k + 1) % 3;
        weight[k] = v_sub(v_mul(a[i], b[j]), v_mul(b[i], a[j]));
    }
    vmask above = v_mand(v_mand(v_ge(weight[0], zero), v_ge(weight[1], zero)), v_ge(weight[2], zero));
    vmask below = v_mand(v_mand(v_ge(zero, weight[0]), v_ge(zero, weight[1])), v_ge(zero, weight[2]));
    lanes = v_mand(lanes, v_mor(above, below));
    if (!v_any(lanes))
        return lanes;
    return v_mand(lanes, v_mand(exact_spans(a), exact_spans(b)));
}

/* R194: the lanes whose mesh the caster belongs to. */
static ALWAYS_INLINE vmask exact_own(const exact_lanes *at, uint32_t number)
{
    const void *mesh = at->index->mesh_of(at->index, number);
    int32_t surface[V_LANES], own[V_LANES];
    v_storei(surface, at->surface);
    for (int lane = 0; lane < V_LANES; lane++)
        own[lane] = at->receivers->mesh[surface[lane]] == mesh;
    return v_gti(v_loadi(own), v_seti(0));
}

/* R194: the lanes whose rays leave their own bodies through the caster, which looks to the light. */
static vmask __attribute__((noinline)) exact_left(const exact_lanes *at, uint32_t number)
{
    const float *v = at->index->world[number];
    float e[3], f[3];
    vf32 m[3];
    for (int c = 0; c < 3; c++) {
        e[c] = v[3 + c] - v[c];
        f[c] = v[6 + c] - v[c];
    }
    for (int c = 0; c < 3; c++) {
        int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        float own = e[c1] * f[c2] - e[c2] * f[c1];
        m[c] = v_setf(at->index->is_mirrored[number] ? 0.0f - own : own);
    }
    return v_mand(v_gt(dot_three(m, at->towards), v_setf(0.0f)), exact_own(at, number));
}

/* R101: of these lanes, those where the hit is above the sample's plane and before the light. */
static vmask exact_above(exact_lanes *at, uint32_t number, vmask lanes, vf32 weight[3])
{
    const float *world = at->index->world[number], *caster = at->corners[number];
    vf32 zero = v_setf(0.0f), det = v_add(v_add(weight[0], weight[1]), weight[2]), height[3], z[3];
    if (!at->has_plane)
        exact_fetch_planes(at);
    vf32 r = v_div(v_setf(1.0f), det);
    for (int k = 0; k < 3; k++) {
        vf32 d[3], size[3];
        for (int c = 0; c < 3; c++) {
            d[c] = v_sub(v_setf(world[3 * k + c]), at->position[c]);
            size[c] = exact_abs(d[c]);
        }
        height[k] = v_sub(dot_three(at->normal, d), dot_three(at->slack, size));
        weight[k] = v_mul(weight[k], r);
        z[k] = v_setf(caster[at->z + k] * at->sign);
    }
    lanes = v_mandnot(lanes, v_eq(det, zero));
    lanes = v_mand(lanes, v_gt(dot_three(weight, height), at->limit));
    if (at->leaves && v_any(v_mand(lanes, at->turned)))
        lanes = v_mandnot(lanes, v_mand(at->turned, exact_left(at, number)));
    return at->is_point ? v_mand(lanes, v_gt(dot_three(weight, z), zero)) : lanes;
}

/* R101: of these lanes, those where the caster has no hole. */
static vmask __attribute__((noinline)) exact_solid(const exact_lanes *at, uint32_t number, vmask lanes, const vf32 weight[3])
{
    float weights[3][V_LANES];
    int32_t solid[V_LANES];
    for (int k = 0; k < 3; k++)
        v_storef(weights[k], weight[k]);
    uint32_t bits = v_bits(lanes);
    for (int lane = 0; lane < V_LANES; lane++) {
        const float own[3] = {weights[0][lane], weights[1][lane], weights[2][lane]};
        solid[lane] = bits >> lane & 1 && !at->index->is_open(at->index, number, own);
    }
    return v_gti(v_loadi(solid), v_seti(0));
}

/* ---- grids ---- */

/* Of these lanes, those that a caster of the cell hides. */
static ALWAYS_INLINE vmask exact_in_cell(exact_lanes *at, const e3d_caster_box *box, const e3d_caster_box *end, int is_point,
                                         vmask lanes)
{
    vmask open = lanes;
    for (; box < end; box++) {
        vmask under = v_mand(open, v_gt(at->far, v_setf(box->near)));
        if (!v_any(under))
            break;
        under = v_mand(under, v_mand(v_ge(at->place[0], v_setf(box->low[0])), v_ge(v_setf(box->high[0]), at->place[0])));
        under = v_mand(under, v_mand(v_ge(at->place[1], v_setf(box->low[1])), v_ge(v_setf(box->high[1]), at->place[1])));
        if (!v_any(under))
            continue;
        vf32 weight[3];
        under = exact_inside(at, at->corners[box->caster], is_point, under, weight);
        if (!v_any(under))
            continue;
        under = exact_above(at, box->caster, under, weight);
        if (at->index->may_be_open[box->caster] && v_any(under))
            under = exact_solid(at, box->caster, under, weight);
        open = v_mandnot(open, under);
        if (!v_any(open))
            break;
    }
    return v_mandnot(lanes, open);
}

static ALWAYS_INLINE vi32 exact_column(const e3d_caster_grid *grid, vf32 x, int axis)
{
    vf32 at = v_mul(v_sub(x, v_setf(grid->low[axis])), v_setf(grid->scale[axis]));
    float last = (float)((1 << (grid->levels - 1)) - 1);
    return v_trunc(v_min(v_max(at, v_setf(0.0f)), v_setf(last)));
}

/* A cell, and the lanes whose samples lie in it. */
typedef struct exact_cell {
    uint32_t first, end;
    vmask lanes;
} exact_cell;

static ALWAYS_INLINE const uint32_t *exact_start(const e3d_caster_grid *grid, int level, int32_t column, int32_t row)
{
    return grid->starts[level] + ((size_t)row << (grid->levels - 1 - level)) + column;
}

/* Finds the cells of a level in which lanes lie, and prefetches their boxes, which lie anywhere in memory. */
static ALWAYS_INLINE int exact_cells(const e3d_caster_grid *grid, int level, vf32 finest_column, vf32 finest_row, vmask lanes,
                                     exact_cell *out)
{
    int count = 0;
    int32_t columns[V_LANES], rows[V_LANES];
    vf32 scale = v_setf(1.0f / (float)(1 << level));
    vi32 column = v_trunc(v_mul(finest_column, scale)), row = v_trunc(v_mul(finest_row, scale));
    v_storei(columns, column);
    v_storei(rows, row);
    for (vmask left = lanes; v_any(left);) {
        int lane = __builtin_ctz(v_bits(left));
        vmask here = v_mand(left, v_mand(v_eqi(column, v_seti(columns[lane])), v_eqi(row, v_seti(rows[lane]))));
        const uint32_t *start = exact_start(grid, level, columns[lane], rows[lane]);
        out[count] = (exact_cell){start[0], start[1], here};
        count += start[0] < start[1];
        __builtin_prefetch(grid->boxes + start[0]);
        left = v_mandnot(left, here);
    }
    return count;
}

/* Prefetches the starts of the fine cells while casters of the coarse cells are tested. */
static ALWAYS_INLINE void exact_fetch_starts(const e3d_caster_grid *grid, vf32 column, vf32 row, uint32_t lanes)
{
    enum { FINE_LEVELS = 3 };
    int32_t columns[V_LANES], rows[V_LANES];
    v_storei(columns, v_trunc(column));
    v_storei(rows, v_trunc(row));
    for (; lanes; lanes &= lanes - 1) {
        int lane = __builtin_ctz(lanes);
        for (int level = 0; level < FINE_LEVELS && level < grid->levels; level++)
            __builtin_prefetch(exact_start(grid, level, columns[lane] >> level, rows[lane] >> level));
    }
}

/* Of these lanes, those that a caster of the grid hides. Levels are tested from the coarsest, since large casters hide most,
 * and in each level only cells with lanes in them. */
static ALWAYS_INLINE vmask exact_in_grid(exact_lanes *at, const e3d_caster_grid *grid, int is_point, vmask lanes)
{
    if (!grid->levels)
        return v_mandnot(lanes, lanes);
    vmask within = v_mand(lanes, v_gt(at->far, v_setf(grid->near)));
    for (int axis = 0; axis < 2; axis++)
        within = v_mand(within, v_mand(v_ge(at->place[axis], v_setf(grid->low[axis])), v_ge(v_setf(grid->high[axis]), at->place[axis])));
    vmask open = within;
    vf32 column = v_float(exact_column(grid, at->place[0], 0)), row = v_float(exact_column(grid, at->place[1], 1));
    exact_fetch_starts(grid, column, row, v_bits(open));
    for (int level = grid->levels - 1; level >= 0 && v_any(open); level--) {
        exact_cell cells[V_LANES];
        int count = grid->filled >> level & 1 ? exact_cells(grid, level, column, row, open, cells) : 0;
        for (int c = 0; c < count; c++)
            open = v_mandnot(open, exact_in_cell(at, grid->boxes + cells[c].first, grid->boxes + cells[c].end, is_point,
                                                 cells[c].lanes));
    }
    return v_mandnot(within, open);
}

/* ---- lights ---- */

static vmask exact_directional(exact_lanes *at, const e3d_caster_light *caster_light, const e3d_light *light, vmask lanes)
{
    int k = caster_light->axis;
    for (int c = 0; c < 2; c++)
        at->place[c] = v_sub(at->position[(k + 1 + c) % 3], v_mul(v_setf(caster_light->slope[c]), at->position[k]));
    at->far = light->to_light[k] > 0.0f ? v_sub(v_setf(0.0f), at->position[k]) : at->position[k];
    at->is_point = 0;
    at->sign = 1.0f;
    at->x = 0, at->y = 3, at->z = 6;
    return exact_in_grid(at, &caster_light->grids[0], 0, lanes);
}

/* Of these lanes, those that a caster hides through one face of the cube around the light. */
static ALWAYS_INLINE vmask exact_through_face(exact_lanes *at, const e3d_caster_light *caster_light, const vf32 d[3], int face,
                                              vmask lanes)
{
    int k = face / 2, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    vf32 z = face & 1 ? v_sub(v_setf(0.0f), d[k]) : d[k];
    at->place[0] = v_div(d[k1], z);
    at->place[1] = v_div(d[k2], z);
    at->far = z;
    at->is_point = 1;
    at->sign = face & 1 ? -1.0f : 1.0f;
    at->x = 3 * k1, at->y = 3 * k2, at->z = 3 * k;
    return exact_in_grid(at, &caster_light->grids[face], 1, lanes);
}

static vmask exact_point(exact_lanes *at, const e3d_caster_light *caster_light, vmask lanes)
{
    vf32 d[3], size[3], zero = v_setf(0.0f);
    for (int c = 0; c < 3; c++) {
        d[c] = v_sub(zero, at->towards[c]);
        size[c] = exact_abs(d[c]);
    }
    vmask along[3], hidden = v_mandnot(lanes, lanes);
    along[0] = v_mand(v_ge(size[0], size[1]), v_ge(size[0], size[2]));
    along[1] = v_mandnot(v_ge(size[1], size[2]), along[0]);
    along[2] = v_mnot(v_mor(along[0], along[1]));
    for (int face = 0; face < E3D_CASTER_FACES; face++) {
        vmask negative = v_lt(d[face / 2], zero), own = v_mand(lanes, along[face / 2]);
        own = face & 1 ? v_mand(own, negative) : v_mandnot(own, negative);
        if (v_any(own))
            hidden = v_mor(hidden, exact_through_face(at, caster_light, d, face, own));
    }
    return hidden;
}

/* Of these lanes, those from which casters hide a light. */
static ALWAYS_INLINE vmask exact_hidden(exact_lanes *at, const e3d_caster_light *caster_light, const e3d_light *light, vmask lanes)
{
    return e3d_light_traits_of(light->kind).has_position ? exact_point(at, caster_light, lanes)
                                                         : exact_directional(at, caster_light, light, lanes);
}

/* R194: finds the lanes whose faces turn away from a light that their normals look to. */
static void exact_find_turned(exact_lanes *at, const vf32 normal[3], vmask lanes)
{
    vf32 zero = v_setf(0.0f);
    lanes = v_mand(lanes, v_gt(dot_three(normal, at->towards), zero));
    exact_fetch_planes(at);
    at->turned = v_mand(lanes, v_lt(dot_three(at->normal, normal), zero));
    at->leaves = v_any(at->turned);
}

/* R194: moves samples onto the smooth bodies over them. */
static void exact_move(exact_lanes *at, const e3d_batch *batch, int i)
{
    int32_t surface[V_LANES];
    vf32 normal[3][3], rise[3], r = v_loadf(batch->r + i);
    v_storei(surface, at->surface);
    for (int k = 0; k < 3; k++) {
        vf32 d[3];
        for (int c = 0; c < 3; c++) {
            normal[k][c] = exact_pick(at->receivers->corner_normal[c][k], surface);
            d[c] = v_sub(exact_pick(at->receivers->surfaces->position[c][k], surface), at->position[c]);
        }
        vf32 share = v_min(v_mul(v_loadf(batch->weight[k] + i), r), v_setf(1.0f));
        rise[k] = v_mul(share, v_max(dot_three(normal[k], d), v_setf(0.0f)));
    }
    for (int c = 0; c < 3; c++) {
        const vf32 along[3] = {normal[0][c], normal[1][c], normal[2][c]};
        at->position[c] = v_add(at->position[c], dot_three(rise, along));
    }
}

/* R194: of these lanes, whose faces turn away, those from whose bodies casters hide a light. */
static vmask __attribute__((noinline)) exact_from_bodies(const exact_lanes *from, const e3d_caster_light *caster_light, const e3d_light *light,
                                                         const e3d_batch *batch, int i, vmask lanes)
{
    exact_lanes at = *from;
    exact_move(&at, batch, i);
    for (int c = 0; c < 3 && e3d_light_traits_of(light->kind).has_position; c++)
        at.towards[c] = v_sub(v_setf(light->position[c]), at.position[c]);
    at.leaves = 0;
    return exact_hidden(&at, caster_light, light, lanes);
}

/* Finds where light n is from a vector of samples, its direction, and their normals before they were mapped; the lanes where it would
 * add light. */
static ALWAYS_INLINE vmask exact_lit(exact_lanes *at, const e3d_lighting *lighting, int n, const e3d_batch *batch, int i, vf32 l[3],
                                     vf32 unmapped[3])
{
    vf32 normal[3], attenuation = v_setf(1.0f), zero = v_setf(0.0f);
    const e3d_light *light = &lighting->lights[n];
    vmask lanes = v_eqi(v_iota(), v_iota());
    at->has_plane = at->leaves = 0;
    for (int c = 0; c < 3; c++) {
        normal[c] = v_loadf(batch->normal[c] + i);
        unmapped[c] = batch->unmapped_normal ? v_loadf(batch->unmapped_normal[c] + i) : normal[c];
        l[c] = at->towards[c] = v_setf(light->to_light[c]);
    }
    if (e3d_light_traits_of(light->kind).has_position) {
        lanes = light_towards(lighting, n, at->position, 0, l, &attenuation);
        for (int c = 0; c < 3; c++)
            at->towards[c] = v_sub(v_setf(light->position[c]), at->position[c]);
    }
    return v_mand(lanes, v_mand(v_gt(dot_three(normal, l), zero), v_gt(attenuation, zero)));
}

/* The lanes from which casters hide a light, among those where it would add light. */
static ALWAYS_INLINE vmask exact_from(exact_lanes *at, const e3d_lighting *lighting, const e3d_caster_light *caster_light,
                                      const e3d_batch *batch, int i)
{
    vf32 l[3], unmapped[3];
    const e3d_light *light = &lighting->lights[caster_light->number];
    vmask lanes = exact_lit(at, lighting, caster_light->number, batch, i, l, unmapped);
    if (!v_any(lanes))
        return lanes;
    if (at->receivers->is_smooth)
        exact_find_turned(at, unmapped, lanes);
    vmask hidden = exact_hidden(at, caster_light, light, lanes);
    if (!at->leaves)
        return hidden;
    vmask left = v_mandnot(at->turned, hidden);
    return v_any(left) ? v_mor(hidden, exact_from_bodies(at, caster_light, light, batch, i, left)) : hidden;
}

static void kernel_exact_shadows(e3d_batch *batch, const e3d_lighting *lighting, const e3d_caster_index *index,
                                 const e3d_receivers *receivers)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        exact_lanes at = {.index = index, .receivers = receivers, .surface = v_loadi(batch->surface + i)};
        vi32 hidden = v_seti(0);
        for (int c = 0; c < 3; c++)
            at.position[c] = v_loadf(batch->position[c] + i);
        for (int n = 0; n < index->light_count; n++) {
            if (lighting->lights[index->lights[n].number].shadow.soft > 0.0f)
                continue;
            at.corners = index->lights[n].corners;
            vmask lanes = exact_from(&at, lighting, &index->lights[n], batch, i);
            hidden = v_seli(lanes, v_ori(hidden, v_seti((int32_t)(UINT32_C(1) << n))), hidden);
        }
        v_storei(batch->shadowed_lights + i, hidden);
    }
}
