/* Ambient occlusion: from a picture of depths and normals, the share of light from all around that reaches each pixel.
 * In: depths, 0 where nothing shows; normals; the radius within which things count. Out: visibility in [0, 1], one value a
 * pixel. Rules: R125 (places), R126 (surfaces and directions), R127 (shares), R128 and R216 (filters), R180 (pixels between sites).
 * Sources: Jimenez et al. 2016 (slices through the line of sight, and the integral over one), Therrien et al. 2023 (sectors of
 * a slice as bits, hidden by things of some thickness), Kopf et al. 2007 (pixels between sites). */
#include "reference/post/ambient_occlusion.h"

#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "data/occlusion_pattern.h"
#include "reference/arithmetic.h"

enum { SPAN = E3D_OCCLUSION_SPAN,
       MIDDLE = E3D_OCCLUSION_FILTER,
       SECTORS = E3D_OCCLUSION_SECTORS };

struct site;

/* A picture's sites, row by row; what changes with their places does so from site to site. */
typedef struct sites {
    const e3d_depth_picture *picture;
    int32_t width, height;
    float across[2], down[2];
    struct site *at;
    float *share, *means;
} sites;

/* The surface that a site shows. */
typedef struct site {
    int32_t column, row;
    float depth, near, ray[3], normal[3]; /* ray: to the pixel at a depth of 1; normal: towards the viewer */
    float facing;                         /* the cosine between normal and line of sight, times the length of the ray */
    float change[2], firm;                /* of nearness, along a row and down a column; what turns a change into a distance */
    int has_normal;
} site;

/* The plane through the line of sight in which a site looks. */
typedef struct slice {
    float step[2], side[2]; /* a direction, in sites and in view space */
    float facing, leaning;  /* of the normal: to the viewer, and to that direction */
    float along[3];         /* the surface's direction in this plane, as long as what it has of the normal */
    float scale;            /* of the light of this plane */
} slice;

/* R125 */
static float nearness_of(const e3d_depth_picture *p, float depth) { return p->is_perspective && depth != 0.0f ? 1.0f / depth : depth; }

static float depth_at(const sites *all, int32_t column, int32_t row)
{
    int is_inside = column >= 0 && column < all->width && row >= 0 && row < all->height;
    size_t x = (size_t)column * E3D_OCCLUSION_STEP, y = (size_t)row * E3D_OCCLUSION_STEP;
    return is_inside ? all->picture->depth[y * (size_t)all->picture->width + x] : 0.0f;
}

static float nearness_at(const sites *all, int32_t column, int32_t row) { return nearness_of(all->picture, depth_at(all, column, row)); }

/* ---- surfaces (R126) ---- */

/* The change of nearness towards the neighbour that lies best on the plane of the normal. */
static float change_of(const site *s, float before, float behind, float ideal)
{
    float back = s->near - before, on = behind - s->near;
    float off_back = before == 0.0f ? E3D_OCCLUSION_NO_CHANGE : fabsf(back - ideal);
    float off_on = behind == 0.0f ? E3D_OCCLUSION_NO_CHANGE : fabsf(on - ideal);
    float change = off_back > off_on ? on : back;
    return ref_min(off_back, off_on) * s->firm < 1.0f ? change : ideal;
}

static void find_face(const sites *all, site *s)
{
    float scale = all->picture->is_perspective ? 0.0f - s->near : 1.0f;
    float facing = fabsf(s->facing) < E3D_OCCLUSION_LEAST_FACING ? E3D_OCCLUSION_LEAST_FACING : s->facing;
    s->firm = fabsf(facing) / (fabsf(all->down[0]) * fabsf(scale));
    float ideal[2] = {(scale * (s->normal[0] * all->across[0])) / facing, (scale * (s->normal[1] * all->down[0])) / facing};
    s->change[0] = change_of(s, nearness_at(all, s->column - 1, s->row), nearness_at(all, s->column + 1, s->row), ideal[0]);
    s->change[1] = change_of(s, nearness_at(all, s->column, s->row - 1), nearness_at(all, s->column, s->row + 1), ideal[1]);
}

static site site_at(const sites *all, int32_t column, int32_t row)
{
    const e3d_depth_picture *p = all->picture;
    site s = {.column = column, .row = row, .depth = depth_at(all, column, row), .near = nearness_at(all, column, row)};
    const float *n = p->normal + 3 * E3D_OCCLUSION_STEP * ((size_t)row * (size_t)p->width + (size_t)column);
    float normal[3] = {n[0], n[1], 0.0f - n[2]}, length2 = ref_dot3(normal, normal), scale = 1.0f / sqrtf(length2);
    s.has_normal = s.depth != 0.0f && length2 > 0.0f;
    if (!s.has_normal)
        return s;
    s.ray[0] = p->is_perspective ? all->across[0] * (float)column + all->across[1] : 0.0f;
    s.ray[1] = p->is_perspective ? all->down[0] * (float)row + all->down[1] : 0.0f;
    s.ray[2] = 1.0f;
    for (int c = 0; c < 3; c++)
        s.normal[c] = normal[c] * scale;
    s.facing = 0.0f - ref_dot3(s.normal, s.ray);
    find_face(all, &s);
    return s;
}

/* ---- slices (R126) ---- */

static slice slice_of(const sites *all, const site *s, int number)
{
    slice out;
    float direction[2];
    e3d_occlusion_direction(number, direction);
    out.step[0] = direction[0] * (fabsf(all->down[0]) / fabsf(all->across[0]));
    out.step[1] = direction[1];
    out.side[0] = all->across[0] < 0.0f ? 0.0f - direction[0] : direction[0];
    out.side[1] = all->down[0] < 0.0f ? 0.0f - direction[1] : direction[1];
    float ray2 = (s->ray[0] * s->ray[0] + s->ray[1] * s->ray[1]) + 1.0f, length = sqrtf(ray2), over = 1.0f / length;
    float q = s->ray[0] * out.side[0] + s->ray[1] * out.side[1], rest = ray2 - q * q, scale = 1.0f / sqrtf(ray2 * rest);
    float away[3] = {(out.side[0] * ray2 - s->ray[0] * q) * scale, (out.side[1] * ray2 - s->ray[1] * q) * scale, (0.0f - q) * scale};
    out.facing = s->facing * over;
    out.leaning = ref_dot3(s->normal, away);
    for (int c = 0; c < 3; c++)
        out.along[c] = out.facing * away[c] + out.leaning * (s->ray[c] * over);
    out.scale = (length / rest) * E3D_OCCLUSION_UNIT;
    return out;
}

/* ---- sectors (R127) ---- */

/* What is like the angle of a direction above the surface, 1 for a right angle and 2 for two. */
static float angle_of(float up, float along)
{
    float part = ref_max(up / ref_max(up + fabsf(along), E3D_OCCLUSION_LEAST), 0.0f);
    return along >= 0.0f ? part : 2.0f - part;
}

static int32_t sector_of(float angle) { return ref_rint(angle * (float)E3D_OCCLUSION_QUADRANT); }

static uint32_t sectors_below(int32_t sector) { return (1u << sector) - 1u; }

/* The offset to a place some sites away, and the surface there; returns whether something shows. */
static int look(const sites *all, const site *s, float away, const float step[2], float offset[3])
{
    int32_t column = ref_rint(ref_min(ref_max((float)s->column + away * step[0], 0.0f), (float)(all->width - 1)));
    int32_t row = ref_rint(ref_min(ref_max((float)s->row + away * step[1], 0.0f), (float)(all->height - 1)));
    int is_perspective = all->picture->is_perspective;
    float depth = depth_at(all, column, row), m = is_perspective ? depth : 1.0f;
    offset[2] = depth - s->depth;
    offset[0] = (all->across[0] * ((float)column - (float)s->column)) * m;
    offset[1] = (all->down[0] * ((float)row - (float)s->row)) * m;
    for (int c = 0; c < 2 && is_perspective; c++)
        offset[c] = offset[c] + s->ray[c] * offset[2];
    return depth != 0.0f;
}

/* The distance in sites within which things count, at most E3D_OCCLUSION_REACH (R127). */
static float reach_of(const sites *all, const site *s, float radius)
{
    float reach = (radius / fabsf(all->down[0])) * (all->picture->is_perspective ? s->near : 1.0f);
    return ref_min(ref_max(reach, 0.0f), (float)E3D_OCCLUSION_REACH);
}

/* The sectors that what shows to one side hides, counted from that side. */
static uint32_t hidden_on(const sites *all, const site *s, const slice *in, int number, int side, float radius)
{
    float reach = reach_of(all, s, radius);
    float range2 = (radius * radius) * (1.0f - (float)e3d_occlusion_lack(number) * 0x1p-8f);
    float shift = (float)(2 * e3d_occlusion_shift(number, side) + 1) * 0x1p-7f, top = 0.0f;
    float sign = side ? -1.0f : 1.0f, step[2] = {sign * in->step[0], sign * in->step[1]};
    uint32_t hidden = 0;
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
        float t = ((float)tap + shift) * (1.0f / E3D_OCCLUSION_TAPS), offset[3];
        int shows = look(all, s, reach * t + E3D_OCCLUSION_START, step, offset);
        float square = ref_dot3(offset, offset), up = ref_dot3(s->normal, offset), along = sign * ref_dot3(in->along, offset);
        if (!shows || !(square <= range2) || !(up > 0.0f) || !(up * up > square * E3D_OCCLUSION_SLACK))
            continue;
        float front = angle_of(up, along);
        float back = angle_of(ref_max(up - radius * in->facing, 0.0f), along + (sign * radius) * in->leaning);
        float low = ref_min(front, back), high = ref_min(front + ref_max(front - ref_max(low, top), 0.0f) * E3D_OCCLUSION_GAP, 2.0f);
        top = ref_max(top, front);
        hidden |= sectors_below(sector_of(high)) & ~sectors_below(sector_of(low));
    }
    return hidden;
}

/* The sectors in another order: counted from the other side. */
static uint32_t from_other_side(uint32_t sectors)
{
    uint32_t out = 0;
    for (int k = 0; k < SECTORS; k++)
        out |= (sectors >> k & 1u) << (SECTORS - 1 - k);
    return out;
}

/* The sectors that the face itself does not hide. */
static uint32_t above_face(const sites *all, const site *s, const slice *in)
{
    int is_perspective = all->picture->is_perspective;
    float change = s->change[0] * in->step[0] + s->change[1] * in->step[1], side = fabsf(all->down[0]);
    float scale = is_perspective ? side * s->near : side, turned = is_perspective ? 0.0f - change : change;
    float face[3] = {in->side[0] * scale + s->ray[0] * turned, in->side[1] * scale + s->ray[1] * turned, turned};
    float up = ref_dot3(s->normal, face), along = ref_dot3(in->along, face);
    float part = ref_max(fabsf(up) / ref_max(fabsf(up) + fabsf(along), E3D_OCCLUSION_LEAST), 0.0f);
    int32_t count = ref_rint(part * (float)E3D_OCCLUSION_QUADRANT + E3D_OCCLUSION_ROUNDING);
    return up > 0.0f ? ~sectors_below(count) : sectors_below(SECTORS - count);
}

/* The light of sectors, which lie beyond the line of sight from a sector on. */
static float light_of(const slice *in, uint32_t sectors)
{
    int32_t beyond = sector_of(angle_of(ref_max(in->facing, 0.0f), 0.0f - in->leaning)), sum[2] = {0, 0};
    for (int k = 0; k < SECTORS; k++)
        for (int c = 0; c < 2; c++)
            if (sectors >> k & 1u)
                sum[c] += k < beyond ? E3D_OCCLUSION_LIGHT[c][k] : -E3D_OCCLUSION_LIGHT[c][k];
    return (in->facing * (float)sum[0] + in->leaning * (float)sum[1]) * in->scale;
}

static float share_at(const sites *all, const site *s, float radius)
{
    int number = e3d_occlusion_number(s->column % E3D_OCCLUSION_CELL, s->row % E3D_OCCLUSION_CELL);
    if (!s->has_normal)
        return 0.0f;
    slice in = slice_of(all, s, number);
    uint32_t hidden = hidden_on(all, s, &in, number, 0, radius) | from_other_side(hidden_on(all, s, &in, number, 1, radius));
    hidden &= above_face(all, s, &in);
    return hidden ? ref_min(ref_max(light_of(&in, hidden), 0.0f), E3D_OCCLUSION_MOST) : 0.0f;
}

/* ---- the filter (R128) ---- */

/* How far, in sites, a site some steps along a row (axis 0) or column and this one lie off each other's faces, at most. */
static float off_by(const site *here, const site *other, int axis, float steps)
{
    float off = fabsf((other->near - here->near) - here->change[axis] * steps) * here->firm;
    float off_other = fabsf((other->near - here->near) - other->change[axis] * steps) * other->firm;
    return ref_max(off, off_other);
}

/* The mean over nine sites in a row (axis 0) or column; NULL stands for sites outside the picture. */
static float mean(const site *const around[SPAN], const float share[SPAN], int axis)
{
    const site *here = around[MIDDLE];
    float sum = share[MIDDLE], weights = 1.0f;
    for (int k = 0; k < SPAN; k++) {
        const site *other = around[k];
        float steps = (float)(k - MIDDLE);
        if (k == MIDDLE || !other || other->near == 0.0f)
            continue;
        float farther = off_by(here, other, axis, steps);
        float weight = ref_max(ref_max(1.0f - farther, E3D_OCCLUSION_LOOSE - farther * E3D_OCCLUSION_FALL), 0.0f);
        weight = weight * (k == 0 || k == SPAN - 1 ? 0.5f : 1.0f);
        sum = sum + weight * share[k];
        weights = weights + weight;
    }
    return sum / weights;
}

static float mean_at(const sites *all, int32_t column, int32_t row, const float *shares, int axis)
{
    const site *around[SPAN];
    float share[SPAN];
    for (int k = 0; k < SPAN; k++) {
        int32_t i = column + (axis == 0 ? k - MIDDLE : 0), j = row + (axis == 1 ? k - MIDDLE : 0);
        int is_inside = i >= 0 && i < all->width && j >= 0 && j < all->height;
        size_t place = is_inside ? (size_t)j * (size_t)all->width + (size_t)i : 0;
        around[k] = is_inside ? &all->at[place] : NULL;
        share[k] = is_inside ? shares[place] : 0.0f;
    }
    return mean(around, share, axis);
}

/* ---- the wide filter (R216) ---- */

/* The mean over a site and those a cell away along a row (axis 0) or column. */
static float wide_mean_at(const sites *all, int32_t column, int32_t row, const float *means, int axis, float radius)
{
    const site *here = &all->at[(size_t)row * (size_t)all->width + (size_t)column];
    float share = ref_min(ref_max(reach_of(all, here, radius) * E3D_OCCLUSION_WIDEN - 0.5f, 0.0f), 1.0f) * 0.5f;
    float sum = means[here - all->at], weights = 1.0f;
    for (int side = -1; side <= 1; side += 2) {
        int32_t i = column + (axis == 0 ? side * E3D_OCCLUSION_CELL : 0), j = row + (axis == 1 ? side * E3D_OCCLUSION_CELL : 0);
        if (i < 0 || i >= all->width || j < 0 || j >= all->height)
            continue;
        const site *other = &all->at[(size_t)j * (size_t)all->width + (size_t)i];
        float steps = (float)(side * E3D_OCCLUSION_CELL);
        float weight = ref_max(1.0f - off_by(here, other, axis, steps), 0.0f) * share;
        if (other->near == 0.0f)
            continue;
        sum = sum + weight * means[other - all->at];
        weights = weights + weight;
    }
    return sum / weights;
}

/* ---- pixels (R180) ---- */

/* The visibility at a pixel, from the sites around it. */
static float visibility_at(const sites *all, int32_t x, int32_t y)
{
    float near = nearness_of(all->picture, all->picture->depth[(size_t)y * (size_t)all->picture->width + (size_t)x]), sum = 0.0f, weights = 0.0f;
    if (near == 0.0f)
        return 1.0f;
    if (x % E3D_OCCLUSION_STEP == 0 && y % E3D_OCCLUSION_STEP == 0)
        return ref_max(1.0f - all->means[(size_t)(y / E3D_OCCLUSION_STEP) * (size_t)all->width + (size_t)(x / E3D_OCCLUSION_STEP)], 0.0f);
    for (int k = 0; k < 4; k++) {
        int32_t i = x / E3D_OCCLUSION_STEP + k % 2, j = y / E3D_OCCLUSION_STEP + k / 2;
        if ((k % 2 && x % 2 == 0) || (k / 2 && y % 2 == 0) || i >= all->width || j >= all->height)
            continue;
        size_t place = (size_t)j * (size_t)all->width + (size_t)i;
        const site *s = &all->at[place];
        float right = 0.5f * (float)(x - i * E3D_OCCLUSION_STEP), down = 0.5f * (float)(y - j * E3D_OCCLUSION_STEP);
        float off = fabsf(near - ((s->near + s->change[0] * right) + s->change[1] * down)) * s->firm;
        float weight = ref_max(1.0f - off * 2.0f, 0.0f) + E3D_OCCLUSION_REST;
        if (s->near == 0.0f)
            continue;
        sum = sum + weight * all->means[place];
        weights = weights + weight;
    }
    return weights > 0.0f ? ref_max(1.0f - sum / weights, 0.0f) : 1.0f;
}

/* Finds the means of shares along rows, or down columns. */
static void filter(const sites *all, const float *shares, float *means, int axis)
{
    for (int32_t j = 0; j < all->height; j++)
        for (int32_t i = 0; i < all->width; i++)
            means[(size_t)j * (size_t)all->width + (size_t)i] = mean_at(all, i, j, shares, axis);
}

/* Finds the means of means along rows, or down columns. */
static void filter_wide(const sites *all, const float *means, float *out, int axis, float radius)
{
    for (int32_t j = 0; j < all->height; j++)
        for (int32_t i = 0; i < all->width; i++)
            out[(size_t)j * (size_t)all->width + (size_t)i] = wide_mean_at(all, i, j, means, axis, radius);
}

/* Not inlined, so that no arithmetic moves out of the floating-point environment. */
__attribute__((noinline)) static void find(sites *all, float radius, float *visibility)
{
    const e3d_depth_picture *p = all->picture;
    for (int axis = 0; axis < 2; axis++) {
        all->across[axis] = axis ? p->across[1] : p->across[0] * E3D_OCCLUSION_STEP;
        all->down[axis] = axis ? p->down[1] : p->down[0] * E3D_OCCLUSION_STEP;
    }
    for (int32_t j = 0; j < all->height; j++)
        for (int32_t i = 0; i < all->width; i++) {
            size_t place = (size_t)j * (size_t)all->width + (size_t)i;
            all->at[place] = site_at(all, i, j);
            all->share[place] = share_at(all, &all->at[place], radius);
        }
    filter(all, all->share, all->means, 0);
    memcpy(all->share, all->means, (size_t)all->width * (size_t)all->height * sizeof *all->share);
    filter(all, all->share, all->means, 1);
    filter_wide(all, all->means, all->share, 0, radius);
    filter_wide(all, all->share, all->means, 1, radius);
    for (int32_t y = 0; y < p->height; y++)
        for (int32_t x = 0; x < p->width; x++)
            visibility[(size_t)y * (size_t)p->width + (size_t)x] = visibility_at(all, x, y);
}

e3d_status e3d_reference_occlusion(const e3d_depth_picture *picture, float radius, float *visibility)
{
    sites all = {.picture = picture, .width = (picture->width + 1) / E3D_OCCLUSION_STEP, .height = (picture->height + 1) / E3D_OCCLUSION_STEP};
    size_t count = (size_t)all.width * (size_t)all.height;
    all.at = malloc(count * sizeof *all.at);
    all.share = malloc(count * sizeof *all.share);
    all.means = malloc(count * sizeof *all.means);
    int has_memory = all.at && all.share && all.means;
    if (has_memory) {
        e3d_fpenv environment = e3d_fpenv_enter();
        find(&all, radius, visibility);
        e3d_fpenv_leave(environment);
    }
    free(all.at);
    free(all.share);
    free(all.means);
    return has_memory ? E3D_OK : E3D_OUT_OF_MEMORY;
}
