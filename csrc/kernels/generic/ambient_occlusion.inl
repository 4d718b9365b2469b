/* occlusion: finds for each pixel how much ambient light near surfaces block (R125-R128). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "e3d_occlusion.h"
#include "kernels/types/ambient_occlusion.h"

enum { OCCLUSION_MIDDLE = E3D_OCCLUSION_FILTER };

/* The surface in a pixel: its place, and its normal (g, h, -w), which isn't of unit length. */
typedef struct occlusion_lanes {
    vf32 x, y, depth, m, ray[2]; /* x, y: of the pixel; ray: X and Y of R125 */
    vf32 g, h, w, length2;       /* length2: the squared length of the normal */
    vf32 over_length2;
} occlusion_lanes;

static ALWAYS_INLINE vf32 occlusion_scale(vf32 depth, int is_perspective) { return is_perspective ? depth : v_setf(1.0f); }

static ALWAYS_INLINE vf32 occlusion_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

/* R125: nearness, which is affine over a plane on the screen. */
static void kernel_nearness(const float *depth, int count, int is_perspective, float *out)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f);
    for (int x = 0; x < count; x += V_LANES) {
        vf32 d = v_loadf(depth + x);
        if (is_perspective)
            d = v_self(v_eq(d, zero), zero, v_div(one, d));
        v_storef(out + x, d);
    }
}

/* R126: the change of nearness from pixel to pixel, towards the neighbour to which it changes less. */
static ALWAYS_INLINE vf32 occlusion_change(vf32 before, vf32 here, vf32 behind)
{
    vf32 zero = v_setf(0.0f), none = v_setf(E3D_OCCLUSION_NO_CHANGE), back = v_sub(here, before), on = v_sub(behind, here);
    vf32 back_size = v_self(v_eq(before, zero), none, occlusion_abs(back));
    vf32 on_size = v_self(v_eq(behind, zero), none, occlusion_abs(on));
    vf32 change = v_self(v_ge(back_size, on_size), on, back);
    return v_self(v_ge(v_min(back_size, on_size), none), zero, change);
}

static ALWAYS_INLINE occlusion_lanes occlusion_surface(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, int x,
                                                       int is_perspective)
{
    const e3d_depth_picture *p = plan->picture;
    const float *here = rows->nearness[OCCLUSION_MIDDLE] + x, *above = rows->nearness[OCCLUSION_MIDDLE - 1] + x,
                *below = rows->nearness[OCCLUSION_MIDDLE + 1] + x;
    occlusion_lanes at = {.x = v_float(v_addi(v_seti(x), v_iota())), .y = v_setf((float)rows->y), .depth = v_loadf(rows->depth + x)};
    vf32 near = v_loadf(here), one = v_setf(1.0f);
    at.m = occlusion_scale(at.depth, is_perspective);
    at.ray[0] = v_add(v_mul(v_setf(p->across[0]), at.x), v_setf(p->across[1]));
    at.ray[1] = v_add(v_mul(v_setf(p->down[0]), at.y), v_setf(p->down[1]));
    at.g = v_mul(occlusion_change(v_loadf(here - 1), near, v_loadf(here + 1)), v_setf(plan->over_across));
    at.h = v_mul(occlusion_change(v_loadf(above), near, v_loadf(below)), v_setf(plan->over_down));
    at.w = one;
    if (is_perspective) {
        at.g = v_mul(at.g, at.depth);
        at.h = v_mul(at.h, at.depth);
        at.w = v_add(v_add(one, v_mul(at.ray[0], at.g)), v_mul(at.ray[1], at.h));
    }
    at.length2 = v_add(v_add(v_mul(at.g, at.g), v_mul(at.h, at.h)), v_mul(at.w, at.w));
    at.over_length2 = v_div(one, at.length2);
    return at;
}

/* Vectors are interleaved in short steps, since within one vector most operations would wait for those before. */
enum { OCCLUSION_SIDE = 2 };

/* What a pixel sees at one place: the offset to the right and down at a depth of 1, and the depth. */
typedef struct occlusion_place {
    vf32 right, down, depth;
} occlusion_place;

static ALWAYS_INLINE occlusion_place occlusion_look(const e3d_depth_picture *p, const occlusion_lanes *at, vf32 away, vf32 step_x, vf32 step_y)
{
    vf32 zero = v_setf(0.0f);
    vf32 x = v_min(v_max(v_add(at->x, v_mul(away, step_x)), zero), v_setf((float)(p->width - 1)));
    vf32 y = v_min(v_max(v_add(at->y, v_mul(away, step_y)), zero), v_setf((float)(p->height - 1)));
    vi32 column = v_rint(x), row = v_rint(y);
    return (occlusion_place){v_mul(v_setf(p->across[0]), v_sub(v_float(column), at->x)), v_mul(v_setf(p->down[0]), v_sub(v_float(row), at->y)),
                             v_asf(v_gatheri(p->depth, v_addi(v_muli(row, v_seti(p->width)), column)))};
}

/* R127: the squared sine of the angle by which a place stands above the surface, and its weight, which falls with the
 * distance. */
static ALWAYS_INLINE vf32 occlusion_rise(const e3d_occlusion_plan *plan, const occlusion_lanes *at, const occlusion_place *place,
                                         int is_perspective, vf32 *counts)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), depth = place->depth;
    vf32 m = occlusion_scale(depth, is_perspective), change = v_sub(depth, at->depth);
    vf32 right = v_mul(place->right, m), down = v_mul(place->down, m);
    if (is_perspective) {
        right = v_add(right, v_mul(at->ray[0], change));
        down = v_add(down, v_mul(at->ray[1], change));
    }
    vf32 square = v_add(v_add(v_mul(right, right), v_mul(down, down)), v_mul(change, change));
    vf32 above = v_max(v_sub(v_add(v_mul(at->g, right), v_mul(at->h, down)), v_mul(at->w, change)), zero);
    vf32 rise = v_div(v_mul(v_mul(above, above), at->over_length2), v_max(square, v_setf(0x1p-126f)));
    *counts = v_min(v_max(v_sub(v_setf(E3D_OCCLUSION_FALL), v_mul(square, v_setf(plan->fall))), zero), one);
    return v_self(v_eq(depth, zero), zero, v_min(one, v_sub(rise, v_setf(E3D_OCCLUSION_SLACK))));
}

/* R127: the share of light on one side of the direction that a horizon hides. */
static ALWAYS_INLINE vf32 occlusion_share(const e3d_occlusion_pattern *pattern, int lane, const occlusion_lanes *at, vf32 horizon,
                                          int is_perspective)
{
    vf32 one = v_setf(1.0f), zero = v_setf(0.0f), side_x = v_loadf(pattern->side[0] + lane), side_y = v_loadf(pattern->side[1] + lane);
    vf32 along = v_add(v_mul(at->g, side_x), v_mul(at->h, side_y)), ray2 = one, rest = one;
    if (is_perspective) {
        ray2 = v_add(v_add(v_mul(at->ray[0], at->ray[0]), v_mul(at->ray[1], at->ray[1])), one);
        vf32 q = v_add(v_mul(at->ray[0], side_x), v_mul(at->ray[1], side_y));
        along = v_add(v_mul(along, ray2), q);
        rest = v_sub(ray2, v_mul(q, q));
    }
    vf32 scale2 = v_mul(v_mul(at->length2, ray2), rest), scale = v_div(one, v_sqrt(scale2)), facing = v_sqrt(rest);
    vf32 s2 = v_min(v_div(v_mul(horizon, scale2), v_add(rest, v_mul(along, along))), one), s = v_sqrt(s2);
    vf32 a = v_add(v_setf(E3D_ARC_A0), v_mul(v_setf(E3D_ARC_A1), s)), b = v_add(v_setf(E3D_ARC_B0), v_mul(v_setf(E3D_ARC_B1), s));
    vf32 arc = v_mul(v_mul(s2, s), v_add(a, v_mul(v_sqrt(v_sub(one, s)), b)));
    return v_min(v_max(v_mul(v_add(v_mul(facing, s2), v_mul(along, arc)), scale), zero), v_setf(E3D_OCCLUSION_MOST));
}

/* R127: finds what pixels see at their places. */
static ALWAYS_INLINE void occlusion_look_around(const e3d_occlusion_plan *plan, const e3d_occlusion_pattern *pattern, int x, int side,
                                                const occlusion_lanes *at, const vf32 *near, int is_perspective,
                                                occlusion_place out[][OCCLUSION_SIDE])
{
    vf32 reach[OCCLUSION_SIDE];
    for (int j = 0; j < side; j++) {
        reach[j] = v_setf(plan->reach);
        if (is_perspective)
            reach[j] = v_max(v_mul(reach[j], near[j]), v_setf(0.0f));
        reach[j] = v_min(reach[j], v_setf((float)E3D_OCCLUSION_REACH));
    }
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++)
        for (int j = 0; j < side; j++) {
            int lane = (x + j * V_LANES) & (E3D_OCCLUSION_CELL - 1);
            vf32 away = v_add(v_mul(reach[j], v_loadf(pattern->share[tap] + lane)), v_setf(1.0f));
            out[tap][j] = occlusion_look(plan->picture, &at[j], away, v_loadf(pattern->step[0] + lane), v_loadf(pattern->step[1] + lane));
        }
}

/* R127: raises the horizon from place to place, by the weight of each. */
static ALWAYS_INLINE void occlusion_horizon(const e3d_occlusion_plan *plan, int side, const occlusion_lanes *at,
                                            occlusion_place places[][OCCLUSION_SIDE], int is_perspective, vf32 *sum)
{
    vf32 zero = v_setf(0.0f), horizon[OCCLUSION_SIDE];
    for (int j = 0; j < side; j++)
        horizon[j] = sum[j] = zero;
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++)
        for (int j = 0; j < side; j++) {
            vf32 counts, rise = occlusion_rise(plan, &at[j], &places[tap][j], is_perspective, &counts);
            sum[j] = v_add(sum[j], v_mul(v_max(v_sub(rise, horizon[j]), zero), counts));
            /* What lies too far in front hides nothing behind it */
            horizon[j] = v_max(v_self(v_gt(counts, zero), rise, zero), horizon[j]);
        }
}

/* Finds the occlusion of pixels x and so on of a row. */
static ALWAYS_INLINE void occlusion_some(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, int x, int side, float *out,
                                         int is_perspective)
{
    const e3d_occlusion_pattern *pattern = &plan->rows[rows->y & (E3D_OCCLUSION_CELL - 1)];
    vf32 zero = v_setf(0.0f), near[OCCLUSION_SIDE], hidden[OCCLUSION_SIDE], any = zero;
    occlusion_lanes at[OCCLUSION_SIDE];
    occlusion_place places[E3D_OCCLUSION_TAPS][OCCLUSION_SIDE];
    vmask shows = v_mnot(v_eq(zero, zero));
    for (int j = 0; j < side; j++) {
        near[j] = v_loadf(rows->nearness[OCCLUSION_MIDDLE] + x + j * V_LANES);
        shows = v_mor(shows, v_mnot(v_eq(near[j], zero)));
        v_storef(out + x + j * V_LANES, zero);
    }
    if (!v_any(shows))
        return;
    for (int j = 0; j < side; j++)
        at[j] = occlusion_surface(plan, rows, x + j * V_LANES, is_perspective);
    occlusion_look_around(plan, pattern, x, side, at, near, is_perspective, places);
    occlusion_horizon(plan, side, at, places, is_perspective, hidden);
    for (int j = 0; j < side; j++)
        any = v_max(any, v_self(v_eq(near[j], zero), zero, hidden[j]));
    if (!v_any(v_gt(any, zero)))
        return;
    for (int j = 0; j < side; j++) {
        vf32 share = occlusion_share(pattern, (x + j * V_LANES) & (E3D_OCCLUSION_CELL - 1), &at[j], hidden[j], is_perspective);
        vmask some = v_mand(v_mnot(v_eq(near[j], zero)), v_gt(hidden[j], zero));
        v_storef(out + x + j * V_LANES, v_self(some, share, zero));
    }
}

static ALWAYS_INLINE void occlusion_row(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out, int is_perspective)
{
    int x = 0, width = plan->picture->width;
    for (; x + (OCCLUSION_SIDE - 1) * V_LANES < width; x += OCCLUSION_SIDE * V_LANES)
        occlusion_some(plan, rows, x, OCCLUSION_SIDE, out, is_perspective);
    for (; x < width; x += V_LANES)
        occlusion_some(plan, rows, x, 1, out, is_perspective);
}

static void kernel_occlusion(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out)
{
    if (plan->picture->is_perspective)
        occlusion_row(plan, rows, out, 1);
    else
        occlusion_row(plan, rows, out, 0);
}

/* ---- the filter (R128) ---- */

/* Whether the mean is needed: it is never used if nothing shows in the middle, and is 0 if no pixel has anything hidden. */
static ALWAYS_INLINE int occlusion_has_some(vf32 near, const vf32 share[E3D_OCCLUSION_SPAN])
{
    vf32 most = share[0];
    if (!v_any(v_mnot(v_eq(near, v_setf(0.0f)))))
        return 0;
    for (int k = 1; k < E3D_OCCLUSION_SPAN; k++)
        most = v_max(most, share[k]);
    return v_any(v_gt(most, v_setf(0.0f)));
}

/* The mean over nine pixels of a row or column, each weighted by how well it lies on the middle one's surface. */
static ALWAYS_INLINE vf32 occlusion_mean(const e3d_occlusion_plan *plan, const vf32 near[E3D_OCCLUSION_SPAN], const vf32 share[E3D_OCCLUSION_SPAN], int is_perspective)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), here = near[OCCLUSION_MIDDLE], over_step = v_setf(plan->over_step);
    vf32 change = occlusion_change(near[OCCLUSION_MIDDLE - 1], here, near[OCCLUSION_MIDDLE + 1]);
    vf32 sum = share[OCCLUSION_MIDDLE], weights = one;
    if (is_perspective)
        over_step = v_div(over_step, v_self(v_eq(here, zero), one, occlusion_abs(here)));
    for (int k = 0; k < E3D_OCCLUSION_SPAN; k++) {
        if (k == OCCLUSION_MIDDLE)
            continue;
        vf32 off = v_sub(v_sub(near[k], here), v_mul(change, v_setf((float)(k - OCCLUSION_MIDDLE))));
        vf32 weight = v_max(v_sub(one, v_mul(occlusion_abs(off), over_step)), zero);
        if (k == 0 || k == E3D_OCCLUSION_SPAN - 1)
            weight = v_mul(weight, v_setf(0.5f));
        weight = v_self(v_eq(near[k], zero), zero, weight);
        sum = v_add(sum, v_mul(weight, share[k]));
        weights = v_add(weights, weight);
    }
    return v_div(sum, weights);
}

static ALWAYS_INLINE void occlusion_means_across(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out, int is_perspective)
{
    for (int x = 0; x < plan->picture->width; x += V_LANES) {
        vf32 near[E3D_OCCLUSION_SPAN], share[E3D_OCCLUSION_SPAN], mean = v_setf(0.0f);
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            share[k] = v_loadf(rows->share[OCCLUSION_MIDDLE] + x + k - OCCLUSION_MIDDLE);
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            near[k] = v_loadf(rows->nearness[OCCLUSION_MIDDLE] + x + k - OCCLUSION_MIDDLE);
        if (occlusion_has_some(near[OCCLUSION_MIDDLE], share))
            mean = occlusion_mean(plan, near, share, is_perspective);
        v_storef(out + x, mean);
    }
}

static ALWAYS_INLINE void occlusion_means_down(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out, int is_perspective)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f);
    for (int x = 0; x < plan->picture->width; x += V_LANES) {
        vf32 near[E3D_OCCLUSION_SPAN], share[E3D_OCCLUSION_SPAN], hidden = zero;
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            share[k] = v_loadf(rows->share[k] + x);
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            near[k] = v_loadf(rows->nearness[k] + x);
        if (occlusion_has_some(near[OCCLUSION_MIDDLE], share))
            hidden = v_self(v_eq(near[OCCLUSION_MIDDLE], zero), zero, occlusion_mean(plan, near, share, is_perspective));
        v_storef(out + x, v_max(v_sub(one, hidden), zero));
    }
}

static void kernel_occlusion_across(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out)
{
    if (plan->picture->is_perspective)
        occlusion_means_across(plan, rows, out, 1);
    else
        occlusion_means_across(plan, rows, out, 0);
}

static void kernel_occlusion_down(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out)
{
    if (plan->picture->is_perspective)
        occlusion_means_down(plan, rows, out, 1);
    else
        occlusion_means_down(plan, rows, out, 0);
}
