/* occlusion: finds for each site how much ambient light near surfaces block, and from sites for each pixel (R125-R128, R180, R216). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/occlusion_pattern.h"
#include "e3d_occlusion.h"
#include "kernels/types/ambient_occlusion.h"

enum { OCCLUSION_MIDDLE = E3D_OCCLUSION_FILTER };

/* The surface in a site (R126). */
typedef struct occlusion_lanes {
    vf32 x, y, depth, near, ray[2];
    vf32 normal[3], facing;
    vmask shows; /* something with a normal */
} occlusion_lanes;

/* The plane through the line of sight in which a site looks (R126). */
typedef struct occlusion_slice {
    vf32 step[2], facing, leaning, along[3], scale;
} occlusion_slice;

static ALWAYS_INLINE vf32 occlusion_abs(vf32 v) { return v_asf(v_andi(v_asi(v), v_seti(0x7FFFFFFF))); }

static ALWAYS_INLINE vf32 occlusion_minus(vf32 v) { return v_sub(v_setf(0.0f), v); }

static ALWAYS_INLINE vf32 occlusion_dot(const vf32 a[3], const vf32 b[3])
{
    return v_add(v_add(v_mul(a[0], b[0]), v_mul(a[1], b[1])), v_mul(a[2], b[2]));
}

/* 2^n of 0 to 30, as an integer. */
static ALWAYS_INLINE vi32 occlusion_power(vi32 n) { return v_trunc(v_asf(v_shl(v_addi(n, v_seti(127)), 23))); }

/* The sectors below one. */
static ALWAYS_INLINE vi32 occlusion_below(vi32 sector) { return v_subi(occlusion_power(sector), v_seti(1)); }

/* R125: nearness, which is affine over a plane on the screen. */
static ALWAYS_INLINE vf32 occlusion_nearness(vf32 depth, int is_perspective)
{
    vf32 zero = v_setf(0.0f);
    return is_perspective ? v_self(v_eq(depth, zero), zero, v_div(v_setf(1.0f), depth)) : depth;
}

static void kernel_occlusion_sites(const float *depth, int width, int is_perspective, const e3d_occlusion_sites *out)
{
    for (int x = 0; x < width; x += V_LANES) {
        vf32 at_sites, between;
        v_split(v_loadf(depth + 2 * x), v_loadf(depth + 2 * x + V_LANES), &at_sites, &between);
        v_storef(out->depth + x, at_sites);
        v_storef(out->near + x, occlusion_nearness(at_sites, is_perspective));
    }
}

/* ---- surfaces (R126) ---- */

/* The normals of sites, which towards the row's end are those of its last pixel. They are read for the first time: what the
 * next sites need is fetched ahead. */
static ALWAYS_INLINE void occlusion_normals(const e3d_depth_picture *p, int row, int x, vf32 out[3])
{
    enum { SITE = 3 * E3D_OCCLUSION_STEP,
           LINE = 16,
           AHEAD = 64 };
    const float *first = p->normal + SITE * ((size_t)row * (size_t)p->width);
    vi32 column = v_mini(v_shl(v_addi(v_seti(x), v_iota()), 1), v_seti(p->width - 1));
    vi32 place = v_addi(v_addi(column, column), column);
    if (2 * (x + AHEAD) < p->width)
        for (int k = 0; k < SITE * V_LANES; k += LINE)
            __builtin_prefetch(first + SITE * (x + AHEAD) + k);
    int32_t index[V_LANES];
    v_storei(index, place);
    for (int c = 0; c < 3; c++)
        out[c] = v_asf(v_fetch(first + c, index));
    out[2] = occlusion_minus(out[2]);
}

static ALWAYS_INLINE occlusion_lanes occlusion_surface(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *here, int row, int x, int is_perspective)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), normal[3];
    occlusion_lanes at = {.x = v_float(v_addi(v_seti(x), v_iota())), .y = v_setf((float)row), .ray = {zero, zero}};
    at.depth = v_loadf(here->depth + x);
    at.near = v_loadf(here->near + x);
    occlusion_normals(plan->picture, row, x, normal);
    if (is_perspective) {
        at.ray[0] = v_add(v_mul(v_setf(plan->across[0]), at.x), v_setf(plan->across[1]));
        at.ray[1] = v_add(v_mul(v_setf(plan->down[0]), at.y), v_setf(plan->down[1]));
    }
    vf32 length2 = occlusion_dot(normal, normal), scale = v_div(one, v_sqrt(length2));
    for (int c = 0; c < 3; c++)
        at.normal[c] = v_mul(normal[c], scale);
    vf32 ray[3] = {at.ray[0], at.ray[1], one};
    at.facing = occlusion_minus(occlusion_dot(at.normal, ray));
    at.shows = v_mand(v_mnot(v_eq(at.depth, zero)), v_gt(length2, zero));
    return at;
}

/* The change of nearness towards the neighbour that lies best on the plane of the normal. */
static ALWAYS_INLINE vf32 occlusion_change(const occlusion_lanes *at, vf32 before, vf32 behind, vf32 ideal, vf32 firm)
{
    vf32 zero = v_setf(0.0f), none = v_setf(E3D_OCCLUSION_NO_CHANGE), back = v_sub(at->near, before), on = v_sub(behind, at->near);
    vf32 off_back = v_self(v_eq(before, zero), none, occlusion_abs(v_sub(back, ideal)));
    vf32 off_on = v_self(v_eq(behind, zero), none, occlusion_abs(v_sub(on, ideal)));
    vf32 change = v_self(v_gt(off_back, off_on), on, back);
    return v_self(v_lt(v_mul(v_min(off_back, off_on), firm), v_setf(1.0f)), change, ideal);
}

/* Finds the plane of the face, as changes of nearness, and stores it. */
static ALWAYS_INLINE void occlusion_face(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, int x, const occlusion_lanes *at,
                                         int is_perspective, vf32 change[2])
{
    const e3d_occlusion_sites *above = &rows[0], *here = &rows[1], *below = &rows[2];
    vf32 zero = v_setf(0.0f), least = v_setf(E3D_OCCLUSION_LEAST_FACING), scale = v_setf(1.0f);
    if (is_perspective)
        scale = occlusion_minus(at->near);
    vf32 facing = v_self(v_lt(occlusion_abs(at->facing), least), least, at->facing);
    vf32 firm = v_div(occlusion_abs(facing), v_mul(v_setf(plan->side), occlusion_abs(scale)));
    vf32 along_row = v_div(v_mul(scale, v_mul(at->normal[0], v_setf(plan->across[0]))), facing);
    vf32 along_column = v_div(v_mul(scale, v_mul(at->normal[1], v_setf(plan->down[0]))), facing);
    change[0] = occlusion_change(at, v_loadf(here->near + x - 1), v_loadf(here->near + x + 1), along_row, firm);
    change[1] = occlusion_change(at, v_loadf(above->near + x), v_loadf(below->near + x), along_column, firm);
    for (int axis = 0; axis < 2; axis++) {
        change[axis] = v_self(at->shows, change[axis], zero);
        v_storef(here->change[axis] + x, change[axis]);
    }
    v_storef(here->firm + x, v_self(at->shows, firm, zero));
}

/* ---- slices (R126) ---- */

static ALWAYS_INLINE occlusion_slice occlusion_slice_of(const e3d_occlusion_pattern *pattern, int lane, const occlusion_lanes *at)
{
    vf32 one = v_setf(1.0f), side_x = v_loadf(pattern->side[0] + lane), side_y = v_loadf(pattern->side[1] + lane);
    occlusion_slice in = {.step = {v_loadf(pattern->step[0] + lane), v_loadf(pattern->step[1] + lane)}};
    vf32 ray2 = v_add(v_add(v_mul(at->ray[0], at->ray[0]), v_mul(at->ray[1], at->ray[1])), one), length = v_sqrt(ray2), over = v_div(one, length);
    vf32 q = v_add(v_mul(at->ray[0], side_x), v_mul(at->ray[1], side_y)), rest = v_sub(ray2, v_mul(q, q));
    vf32 scale = v_div(one, v_sqrt(v_mul(ray2, rest))), ray[3] = {at->ray[0], at->ray[1], one};
    vf32 away[3] = {v_mul(v_sub(v_mul(side_x, ray2), v_mul(at->ray[0], q)), scale),
                    v_mul(v_sub(v_mul(side_y, ray2), v_mul(at->ray[1], q)), scale), v_mul(occlusion_minus(q), scale)};
    in.facing = v_mul(at->facing, over);
    in.leaning = occlusion_dot(at->normal, away);
    for (int c = 0; c < 3; c++)
        in.along[c] = v_add(v_mul(in.facing, away[c]), v_mul(in.leaning, v_mul(ray[c], over)));
    in.scale = v_mul(v_div(length, rest), v_setf(E3D_OCCLUSION_UNIT));
    return in;
}

/* ---- sectors (R127) ---- */

/* What a site sees at one place: the offset to the right and down at a depth of 1, and the depth. */
typedef struct occlusion_place {
    vf32 right, down, depth;
} occlusion_place;

static ALWAYS_INLINE occlusion_place occlusion_look(const e3d_occlusion_plan *plan, const occlusion_lanes *at, vf32 step_x, vf32 step_y)
{
    vf32 zero = v_setf(0.0f);
    vf32 x = v_min(v_max(v_add(at->x, step_x), zero), v_setf((float)(plan->width - 1)));
    vf32 y = v_min(v_max(v_add(at->y, step_y), zero), v_setf((float)(plan->height - 1)));
    vi32 column = v_rint(x), row = v_rint(y);
    int32_t index[V_LANES];
    v_storei(index, v_addi(v_muli(row, v_seti(plan->pitch)), column));
    return (occlusion_place){v_mul(v_setf(plan->across[0]), v_sub(v_float(column), at->x)), v_mul(v_setf(plan->down[0]), v_sub(v_float(row), at->y)),
                             v_asf(v_fetch(plan->depth, index))};
}

/* The distance in sites within which things count, at most E3D_OCCLUSION_REACH. */
static ALWAYS_INLINE vf32 occlusion_reach(const e3d_occlusion_plan *plan, vf32 near, int is_perspective)
{
    vf32 reach = v_setf(plan->reach);
    if (is_perspective)
        reach = v_mul(reach, near);
    return v_min(v_max(reach, v_setf(0.0f)), v_setf((float)E3D_OCCLUSION_REACH));
}

/* Looks at all places to one side, before anything is found of them: lookups take long, and don't wait for each other. */
static ALWAYS_INLINE void occlusion_look_around(const e3d_occlusion_plan *plan, const e3d_occlusion_pattern *pattern, int lane, const occlusion_lanes *at,
                                                int side, int is_perspective, occlusion_place out[E3D_OCCLUSION_TAPS])
{
    vf32 reach = occlusion_reach(plan, at->near, is_perspective);
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
        vf32 away = v_add(v_mul(reach, v_loadf(pattern->share[side][tap] + lane)), v_setf(E3D_OCCLUSION_START));
        vf32 step_x = v_mul(away, v_loadf(pattern->step[0] + lane)), step_y = v_mul(away, v_loadf(pattern->step[1] + lane));
        out[tap] = side ? occlusion_look(plan, at, occlusion_minus(step_x), occlusion_minus(step_y)) : occlusion_look(plan, at, step_x, step_y);
    }
}

/* What is like the angle of a direction above the surface, 1 for a right angle and 2 for two. */
static ALWAYS_INLINE vf32 occlusion_angle(vf32 up, vf32 along)
{
    vf32 zero = v_setf(0.0f), part = v_max(v_div(up, v_max(v_add(up, occlusion_abs(along)), v_setf(E3D_OCCLUSION_LEAST))), zero);
    return v_self(v_ge(along, zero), part, v_sub(v_setf(2.0f), part));
}

static ALWAYS_INLINE vi32 occlusion_sector(vf32 angle) { return v_rint(v_mul(angle, v_setf((float)E3D_OCCLUSION_QUADRANT))); }

/* What stands above the surface near enough to hide light: its offset, and how far up it is. */
typedef struct occlusion_thing {
    vf32 offset[3], up;
    vmask counts;
} occlusion_thing;

static ALWAYS_INLINE occlusion_thing occlusion_thing_at(const occlusion_lanes *at, const occlusion_place *place, vf32 range2, int is_perspective)
{
    vf32 zero = v_setf(0.0f), change = v_sub(place->depth, at->depth), right = place->right, down = place->down;
    if (is_perspective) {
        right = v_add(v_mul(right, place->depth), v_mul(at->ray[0], change));
        down = v_add(v_mul(down, place->depth), v_mul(at->ray[1], change));
    }
    occlusion_thing out = {.offset = {right, down, change}};
    vf32 square = occlusion_dot(out.offset, out.offset);
    out.up = occlusion_dot(at->normal, out.offset);
    vmask rises = v_mand(v_gt(out.up, zero), v_gt(v_mul(out.up, out.up), v_mul(square, v_setf(E3D_OCCLUSION_SLACK))));
    out.counts = v_mandnot(v_mand(rises, v_ge(range2, square)), v_eq(place->depth, zero));
    return out;
}

/* The sectors that a thing hides; top is the angle of the highest thing before it. */
static ALWAYS_INLINE vi32 occlusion_hidden(const e3d_occlusion_plan *plan, const occlusion_slice *in, const occlusion_thing *thing, int side, vf32 *top)
{
    vf32 zero = v_setf(0.0f), thickness = v_setf(plan->radius), along = occlusion_dot(in->along, thing->offset), leaning = v_mul(thickness, in->leaning);
    if (side) {
        along = occlusion_minus(along);
        leaning = occlusion_minus(leaning);
    }
    vf32 front = occlusion_angle(thing->up, along);
    vf32 back = occlusion_angle(v_max(v_sub(thing->up, v_mul(thickness, in->facing)), zero), v_add(along, leaning));
    vf32 low = v_min(front, back), rise = v_max(v_sub(front, v_max(low, *top)), zero);
    vf32 high = v_min(v_add(front, v_mul(rise, v_setf(E3D_OCCLUSION_GAP))), v_setf(2.0f));
    *top = v_self(thing->counts, v_max(*top, front), *top);
    vi32 from = occlusion_sector(low), to = occlusion_sector(high), all = v_seti(E3D_OCCLUSION_SECTORS);
    vi32 sectors = side ? v_subi(occlusion_power(v_subi(all, from)), occlusion_power(v_subi(all, to)))
                        : v_subi(occlusion_power(to), occlusion_power(from));
    return v_seli(thing->counts, sectors, v_seti(0));
}

/* Leaves out the sectors that the face itself hides. */
static ALWAYS_INLINE vi32 occlusion_above_face(const e3d_occlusion_plan *plan, const e3d_occlusion_pattern *pattern, int lane,
                                               const occlusion_lanes *at, const occlusion_slice *in, const vf32 changes[2], vi32 hidden, int is_perspective)
{
    vf32 zero = v_setf(0.0f), change = v_add(v_mul(changes[0], in->step[0]), v_mul(changes[1], in->step[1])), scale = v_setf(plan->side);
    if (is_perspective) {
        scale = v_mul(scale, at->near);
        change = occlusion_minus(change);
    }
    vf32 face[3] = {v_add(v_mul(v_loadf(pattern->side[0] + lane), scale), v_mul(at->ray[0], change)),
                    v_add(v_mul(v_loadf(pattern->side[1] + lane), scale), v_mul(at->ray[1], change)), change};
    vf32 up = occlusion_dot(at->normal, face), size = occlusion_abs(up), along = occlusion_abs(occlusion_dot(in->along, face));
    vf32 part = v_max(v_div(size, v_max(v_add(size, along), v_setf(E3D_OCCLUSION_LEAST))), zero);
    vi32 count = v_rint(v_add(v_mul(part, v_setf((float)E3D_OCCLUSION_QUADRANT)), v_setf(E3D_OCCLUSION_ROUNDING)));
    vi32 above = v_subi(v_seti(0), occlusion_power(count)), below = occlusion_below(v_subi(v_seti(E3D_OCCLUSION_SECTORS), count));
    return v_andi(hidden, v_seli(v_gt(up, zero), above, below));
}

/* The light of sectors, as the table has it. */
static ALWAYS_INLINE vi32 occlusion_light_sum(const e3d_occlusion_plan *plan, vi32 sectors)
{
    int32_t index[2][V_LANES];
    v_storei(index[0], v_andi(sectors, v_seti(E3D_OCCLUSION_HALF - 1)));
    v_storei(index[1], v_shr(sectors, E3D_OCCLUSION_QUADRANT));
    return v_addi(v_fetch(plan->light[0], index[0]), v_fetch(plan->light[1], index[1]));
}

/* The light of sectors, which lie beyond the line of sight from a sector on. */
static ALWAYS_INLINE vf32 occlusion_light(const e3d_occlusion_plan *plan, const occlusion_slice *in, vi32 sectors)
{
    vf32 zero = v_setf(0.0f);
    vi32 beyond = occlusion_sector(occlusion_angle(v_max(in->facing, zero), occlusion_minus(in->leaning)));
    vi32 near = v_andi(sectors, occlusion_below(beyond)), far = v_subi(sectors, near);
    vi32 sum = v_subi(occlusion_light_sum(plan, near), occlusion_light_sum(plan, far));
    vi32 facing = v_sra(v_shl(sum, 16), 16), leaning = v_sra(v_subi(sum, facing), 16);
    vf32 light = v_mul(v_add(v_mul(in->facing, v_float(facing)), v_mul(in->leaning, v_float(leaning))), in->scale);
    return v_min(v_max(light, zero), v_setf(E3D_OCCLUSION_MOST));
}

/* Stores that sites x and so on have no surface. */
static ALWAYS_INLINE void occlusion_nothing(const e3d_occlusion_sites *here, int x)
{
    vf32 zero = v_setf(0.0f);
    v_storef(here->change[0] + x, zero);
    v_storef(here->change[1] + x, zero);
    v_storef(here->firm + x, zero);
    v_storef(here->share + x, zero);
}

/* The sectors that are hidden to one side. */
static ALWAYS_INLINE vi32 occlusion_hidden_on(const e3d_occlusion_plan *plan, const e3d_occlusion_pattern *pattern, int lane, const occlusion_lanes *at,
                                              const occlusion_slice *in, int side, int is_perspective)
{
    occlusion_place places[E3D_OCCLUSION_TAPS];
    vf32 top = v_setf(0.0f), range2 = v_loadf(pattern->range2 + lane);
    vi32 hidden = v_seti(0);
    occlusion_look_around(plan, pattern, lane, at, side, is_perspective, places);
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
        occlusion_thing thing = occlusion_thing_at(at, &places[tap], range2, is_perspective);
        if (v_any(thing.counts))
            hidden = v_ori(hidden, occlusion_hidden(plan, in, &thing, side, &top));
    }
    return hidden;
}

/* Finds the sites x and so on of the middle one of three rows. */
static ALWAYS_INLINE void occlusion_some(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, int row, int x, int is_perspective)
{
    const e3d_occlusion_pattern *pattern = &plan->rows[row & (E3D_OCCLUSION_CELL - 1)];
    int lane = x & (E3D_OCCLUSION_CELL - 1);
    vf32 zero = v_setf(0.0f), change[2];
    occlusion_nothing(&rows[1], x);
    if (!v_any(v_mnot(v_eq(v_loadf(rows[1].near + x), zero))))
        return;
    occlusion_lanes at = occlusion_surface(plan, &rows[1], row, x, is_perspective);
    occlusion_face(plan, rows, x, &at, is_perspective, change);
    occlusion_slice in = occlusion_slice_of(pattern, lane, &at);
    vi32 none = v_seti(0), hidden = occlusion_hidden_on(plan, pattern, lane, &at, &in, 0, is_perspective);
    hidden = v_ori(hidden, occlusion_hidden_on(plan, pattern, lane, &at, &in, 1, is_perspective));
    hidden = v_seli(at.shows, hidden, none);
    if (!v_any(v_gti(hidden, none)))
        return;
    hidden = occlusion_above_face(plan, pattern, lane, &at, &in, change, hidden, is_perspective);
    v_storef(rows[1].share + x, v_self(v_gti(hidden, none), occlusion_light(plan, &in, hidden), zero));
}

static ALWAYS_INLINE void occlusion_row(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, int row, int is_perspective)
{
    for (int x = 0; x < plan->width; x += V_LANES)
        occlusion_some(plan, rows, row, x, is_perspective);
}

static void kernel_occlusion(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, int row)
{
    if (plan->picture->is_perspective)
        occlusion_row(plan, rows, row, 1);
    else
        occlusion_row(plan, rows, row, 0);
}

/* ---- the filter (R128) ---- */

/* The site at a place of a row, as the filter sees it. */
typedef struct occlusion_site {
    vf32 near, change, firm, share;
} occlusion_site;

static ALWAYS_INLINE occlusion_site occlusion_site_at(const e3d_occlusion_sites *row, int axis, int x)
{
    return (occlusion_site){v_loadf(row->near + x), v_loadf(row->change[axis] + x), v_loadf(row->firm + x), v_loadf(row->share + x)};
}

/* How far, in sites, a site some steps away and this one lie off each other's faces, at most. */
static ALWAYS_INLINE vf32 occlusion_off(const occlusion_site *here, const occlusion_site *other, vf32 steps)
{
    vf32 rise = v_sub(other->near, here->near);
    vf32 off = v_mul(occlusion_abs(v_sub(rise, v_mul(here->change, steps))), here->firm);
    vf32 off_other = v_mul(occlusion_abs(v_sub(rise, v_mul(other->change, steps))), other->firm);
    return v_max(off, off_other);
}

/* Whether the mean is needed: it is never used if nothing shows in the middle, and is 0 if no site has anything hidden. */
static ALWAYS_INLINE int occlusion_has_some(const occlusion_site sites[E3D_OCCLUSION_SPAN])
{
    vf32 most = sites[0].share;
    if (!v_any(v_mnot(v_eq(sites[OCCLUSION_MIDDLE].near, v_setf(0.0f)))))
        return 0;
    for (int k = 1; k < E3D_OCCLUSION_SPAN; k++)
        most = v_max(most, sites[k].share);
    return v_any(v_gt(most, v_setf(0.0f)));
}

/* The mean over nine sites, each weighted by how well it and the middle one lie on each other's faces. */
static ALWAYS_INLINE vf32 occlusion_mean(const occlusion_site sites[E3D_OCCLUSION_SPAN])
{
    const occlusion_site *here = &sites[OCCLUSION_MIDDLE];
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), sum = here->share, weights = one;
    if (!occlusion_has_some(sites))
        return zero;
    for (int k = 0; k < E3D_OCCLUSION_SPAN; k++) {
        const occlusion_site *other = &sites[k];
        vf32 steps = v_setf((float)(k - OCCLUSION_MIDDLE));
        if (k == OCCLUSION_MIDDLE)
            continue;
        vf32 farther = occlusion_off(here, other, steps);
        vf32 rest = v_sub(v_setf(E3D_OCCLUSION_LOOSE), v_mul(farther, v_setf(E3D_OCCLUSION_FALL)));
        vf32 weight = v_max(v_max(v_sub(one, farther), rest), zero);
        if (k == 0 || k == E3D_OCCLUSION_SPAN - 1)
            weight = v_mul(weight, v_setf(0.5f));
        weight = v_self(v_eq(other->near, zero), zero, weight);
        sum = v_add(sum, v_mul(weight, other->share));
        weights = v_add(weights, weight);
    }
    return v_div(sum, weights);
}

static void kernel_occlusion_across(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *row, float *out)
{
    occlusion_site sites[E3D_OCCLUSION_SPAN];
    for (int x = 0; x < plan->width; x += V_LANES) {
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            sites[k] = occlusion_site_at(row, 0, x + k - OCCLUSION_MIDDLE);
        v_storef(out + x, occlusion_mean(sites));
    }
}

static void kernel_occlusion_down(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, float *out)
{
    occlusion_site sites[E3D_OCCLUSION_SPAN];
    for (int x = 0; x < plan->width; x += V_LANES) {
        for (int k = 0; k < E3D_OCCLUSION_SPAN; k++)
            sites[k] = occlusion_site_at(&rows[k], 1, x);
        v_storef(out + x, occlusion_mean(sites));
    }
}

/* ---- the wide filter (R216) ---- */

/* The mean of three means, of sites a cell apart. */
static ALWAYS_INLINE vf32 occlusion_wide_mean(const e3d_occlusion_plan *plan, const occlusion_site sites[3])
{
    const occlusion_site *here = &sites[1];
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f), sum = here->share, weights = one;
    vf32 reach = occlusion_reach(plan, here->near, plan->picture->is_perspective);
    vf32 share = v_mul(v_min(v_max(v_sub(v_mul(reach, v_setf(E3D_OCCLUSION_WIDEN)), v_setf(0.5f)), zero), one), v_setf(0.5f));
    if (!v_any(v_gt(share, zero)))
        return sum;
    for (int k = 0; k < 3; k += 2) {
        vf32 off = occlusion_off(here, &sites[k], v_setf((float)((k - 1) * E3D_OCCLUSION_CELL)));
        vf32 weight = v_mul(v_max(v_sub(one, off), zero), share);
        weight = v_self(v_eq(sites[k].near, zero), zero, weight);
        sum = v_add(sum, v_mul(weight, sites[k].share));
        weights = v_add(weights, weight);
    }
    return v_div(sum, weights);
}

static void kernel_occlusion_wide_across(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *row, float *out)
{
    occlusion_site sites[3];
    for (int x = 0; x < plan->width; x += V_LANES) {
        for (int k = 0; k < 3; k++)
            sites[k] = occlusion_site_at(row, 0, x + (k - 1) * E3D_OCCLUSION_CELL);
        v_storef(out + x, occlusion_wide_mean(plan, sites));
    }
}

static void kernel_occlusion_wide_down(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, float *out)
{
    occlusion_site sites[3];
    for (int x = 0; x < plan->width; x += V_LANES) {
        for (int k = 0; k < 3; k++)
            sites[k] = occlusion_site_at(&rows[k], 1, x);
        v_storef(out + x, occlusion_wide_mean(plan, sites));
    }
}

/* ---- pixels between sites (R180) ---- */

/* The sums over the sites around a pixel. */
typedef struct occlusion_sums {
    vf32 shares, weights;
} occlusion_sums;

/* Adds sites to the sums of pixels that lie `right` and `down` of them, in sites. */
static ALWAYS_INLINE void occlusion_add(const e3d_occlusion_sites *row, int x, float right, float down, vf32 near, occlusion_sums *sums)
{
    vf32 zero = v_setf(0.0f), there = v_loadf(row->near + x);
    vf32 expected = v_add(v_add(there, v_mul(v_loadf(row->change[0] + x), v_setf(right))), v_mul(v_loadf(row->change[1] + x), v_setf(down)));
    vf32 off = v_mul(occlusion_abs(v_sub(near, expected)), v_loadf(row->firm + x));
    vf32 weight = v_add(v_max(v_sub(v_setf(1.0f), v_mul(off, v_setf(2.0f))), zero), v_setf(E3D_OCCLUSION_REST));
    weight = v_self(v_eq(there, zero), zero, weight);
    sums->shares = v_add(sums->shares, v_mul(weight, v_loadf(row->share + x)));
    sums->weights = v_add(sums->weights, weight);
}

/* The visibility of every second pixel of a row: of sites themselves, or of pixels to the right of, or below, sites. */
static ALWAYS_INLINE vf32 occlusion_pixels(const e3d_occlusion_sites *rows, int x, int is_between, int is_below, vf32 near)
{
    vf32 zero = v_setf(0.0f), one = v_setf(1.0f);
    occlusion_sums sums = {zero, zero};
    if (!is_between && !is_below)
        return v_self(v_eq(near, zero), one, v_max(v_sub(one, v_loadf(rows[0].share + x)), zero));
    for (int down = 0; down <= is_below; down++)
        for (int right = 0; right <= is_between; right++)
            occlusion_add(&rows[down], x + right, 0.5f * (float)(is_between - 2 * right), 0.5f * (float)(is_below - 2 * down), near, &sums);
    vmask shows = v_mand(v_mnot(v_eq(near, zero)), v_gt(sums.weights, zero));
    return v_self(shows, v_max(v_sub(one, v_div(sums.shares, sums.weights)), zero), one);
}

static ALWAYS_INLINE void occlusion_spread_row(const e3d_occlusion_sites *rows, const float *depth, int width, int is_below, int is_perspective, float *out)
{
    for (int x = 0; x < width; x += V_LANES) {
        vf32 even, odd;
        v_split(v_loadf(depth + 2 * x), v_loadf(depth + 2 * x + V_LANES), &even, &odd);
        vf32 at_sites = occlusion_pixels(rows, x, 0, is_below, occlusion_nearness(even, is_perspective));
        vf32 between = occlusion_pixels(rows, x, 1, is_below, occlusion_nearness(odd, is_perspective));
        v_store_pairs(out + 2 * x, v_asi(at_sites), v_asi(between));
    }
}

static void kernel_occlusion_spread(const e3d_occlusion_plan *plan, const e3d_occlusion_sites *rows, const float *depth, int is_below, float *out)
{
    if (plan->picture->is_perspective)
        occlusion_spread_row(rows, depth, plan->width, is_below, 1, out);
    else
        occlusion_spread_row(rows, depth, plan->width, is_below, 0, out);
}
