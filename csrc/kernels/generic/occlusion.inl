/* occlusion: how much of the light from all around something near is in the way of, pixel by pixel (R125-R128). */
#ifndef E3D_KERNELS_OCCLUSION_INL
#define E3D_KERNELS_OCCLUSION_INL

#include "core/always_inline.h"
#include "core/limits.h"
#include "core/occlusion_pattern.h"
#include "e3d_occlusion.h"
#include "kernels/types/occlusion.h"

enum { OCCLUSION_MIDDLE = E3D_OCCLUSION_FILTER };

/* What a pixel shows: its place, and the normal (g, h, -w), which isn't of unit length. */
typedef struct occlusion_lanes {
    vf32 x, y, depth, m, ray[2]; /* x, y: the pixel's; ray: X and Y of R125 */
    vf32 g, h, w, length2;       /* length2: of the normal */
    vf32 over_length2;
} occlusion_lanes;

static ALWAYS_INLINE vf32 occlusion_scale(vf32 depth, int is_perspective) { return is_perspective ? depth : v_setf(1.0f); }

static ALWAYS_INLINE vf32 occlusion_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

/* R125: where all that lies on a plane is affine. */
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

/* R126: how nearness changes from pixel to pixel, towards whichever neighbour it changes less to. */
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

/* R127: the square of the sine by which what shows at a place stands above the surface, and how much it counts at its distance. */
static ALWAYS_INLINE vf32 occlusion_rise(const e3d_occlusion_plan *plan, const occlusion_lanes *at, vf32 away, vf32 step_x, vf32 step_y,
                                         int is_perspective, vf32 *counts)
{
    const e3d_depth_picture *p = plan->picture;
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f);
    vf32 x = v_min(v_max(v_add(at->x, v_mul(away, step_x)), zero), v_setf((float)(p->width - 1)));
    vf32 y = v_min(v_max(v_add(at->y, v_mul(away, step_y)), zero), v_setf((float)(p->height - 1)));
    vi32 column = v_rint(x), row = v_rint(y);
    vf32 depth = v_asf(v_gatheri(p->depth, v_addi(v_muli(row, v_seti(p->width)), column)));
    vf32 m = occlusion_scale(depth, is_perspective), change = v_sub(depth, at->depth);
    vf32 right = v_mul(v_mul(v_setf(p->across[0]), v_sub(v_float(column), at->x)), m);
    vf32 down = v_mul(v_mul(v_setf(p->down[0]), v_sub(v_float(row), at->y)), m);
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

/* R127: how far the horizon rises from place to place, each as much as it counts. */
static ALWAYS_INLINE vf32 occlusion_horizon(const e3d_occlusion_plan *plan, const e3d_occlusion_pattern *pattern, int lane,
                                            const occlusion_lanes *at, vf32 near, int is_perspective)
{
    vf32 step_x = v_loadf(pattern->step[0] + lane), step_y = v_loadf(pattern->step[1] + lane), zero = v_setf(0.0f), horizon = zero, sum = zero;
    vf32 reach = v_setf(plan->reach);
    if (is_perspective)
        reach = v_max(v_mul(reach, near), zero);
    reach = v_min(reach, v_setf((float)E3D_OCCLUSION_REACH));
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
        vf32 away = v_add(v_mul(reach, v_loadf(pattern->share[tap] + lane)), v_setf(1.0f));
        vf32 counts, rise = occlusion_rise(plan, at, away, step_x, step_y, is_perspective, &counts);
        sum = v_add(sum, v_mul(v_max(v_sub(rise, horizon), zero), counts));
        horizon = v_max(v_self(v_gt(counts, zero), rise, zero), horizon); /* what is too far in front hides nothing behind it */
    }
    return sum;
}

/* R127: the share of light from the direction's side that is hidden below a horizon. */
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

static ALWAYS_INLINE void occlusion_row(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out, int is_perspective)
{
    const e3d_occlusion_pattern *pattern = &plan->rows[rows->y & (E3D_OCCLUSION_CELL - 1)];
    vf32 zero = v_setf(0.0f);
    for (int x = 0; x < plan->picture->width; x += V_LANES) {
        int lane = x & (E3D_OCCLUSION_CELL - 1);
        vf32 near = v_loadf(rows->nearness[OCCLUSION_MIDDLE] + x), share = zero;
        vmask shows = v_mnot(v_eq(near, zero));
        if (v_any(shows)) {
            occlusion_lanes at = occlusion_surface(plan, rows, x, is_perspective);
            vf32 horizon = occlusion_horizon(plan, pattern, lane, &at, near, is_perspective);
            vmask some = v_mand(shows, v_gt(horizon, zero));
            if (v_any(some))
                share = v_self(some, occlusion_share(pattern, lane, &at, horizon, is_perspective), zero);
        }
        v_storef(out + x, share);
    }
}

static void kernel_occlusion(const e3d_occlusion_plan *plan, const e3d_occlusion_rows *rows, float *out)
{
    if (plan->picture->is_perspective)
        occlusion_row(plan, rows, out, 1);
    else
        occlusion_row(plan, rows, out, 0);
}

/* ---- the filter (R128) ---- */

/* Where nothing is hidden of any of them, the mean is 0. */
static ALWAYS_INLINE int occlusion_has_some(const vf32 share[E3D_OCCLUSION_SPAN])
{
    vf32 most = share[0];
    for (int k = 1; k < E3D_OCCLUSION_SPAN; k++)
        most = v_max(most, share[k]);
    return v_any(v_gt(most, v_setf(0.0f)));
}

/* The mean of nine pixels in a row or column, as far as each lies on the middle one's surface. */
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
        if (occlusion_has_some(share))
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
        if (occlusion_has_some(share))
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

#endif
