/* Ambient occlusion: from a picture of depths, the share of light from all around that reaches each pixel.
 * In: depths, 0 where nothing shows; the radius within which things count. Out: visibility in [0, 1], one value a pixel.
 * Rules: R125 (places), R126 (normals and directions), R127 (shares), R128 (filter).
 * Sources: Jimenez et al. 2016 (slices through the line of sight, and the integral over one), Bavoil and Sainz 2009 (places
 * and directions that differ from pixel to pixel). */
#include "reference/post/ambient_occlusion.h"

#include "base/fpenv.h"
#include "data/occlusion_pattern.h"
#include "reference/arithmetic.h"

enum { SPAN = E3D_OCCLUSION_SPAN,
       MIDDLE = E3D_OCCLUSION_FILTER };

/* The surface that a pixel shows. */
typedef struct pixel {
    int32_t x, y;
    float depth, m, ray[2];
    float normal[3], length2; /* the normal points towards the viewer; it isn't of unit length */
} pixel;

static float depth_at(const e3d_depth_picture *p, int32_t x, int32_t y)
{
    int is_inside = x >= 0 && x < p->width && y >= 0 && y < p->height;
    return is_inside ? p->depth[(size_t)y * (size_t)p->width + (size_t)x] : 0.0f;
}

/* R125 */
static float nearness_at(const e3d_depth_picture *p, int32_t x, int32_t y)
{
    float depth = depth_at(p, x, y);
    return p->is_perspective && depth != 0.0f ? 1.0f / depth : depth;
}

static float scale_at(const e3d_depth_picture *p, float depth) { return p->is_perspective ? depth : 1.0f; }

/* R126 */
static float change_of(float before, float here, float behind)
{
    float back = here - before, on = behind - here;
    float back_size = before == 0.0f ? E3D_OCCLUSION_NO_CHANGE : fabsf(back), on_size = behind == 0.0f ? E3D_OCCLUSION_NO_CHANGE : fabsf(on);
    if (ref_min(back_size, on_size) >= E3D_OCCLUSION_NO_CHANGE)
        return 0.0f;
    return back_size >= on_size ? on : back;
}

/* R126: the slope of depth, from the change of nearness. */
static float slope(const e3d_depth_picture *p, float change, float step, float depth)
{
    return p->is_perspective ? (change * (-1.0f / step)) * depth : change * (1.0f / step);
}

static pixel pixel_at(const e3d_depth_picture *p, int32_t x, int32_t y)
{
    pixel at = {.x = x, .y = y, .depth = depth_at(p, x, y)};
    float near = nearness_at(p, x, y);
    at.m = scale_at(p, at.depth);
    at.ray[0] = p->across[0] * (float)x + p->across[1];
    at.ray[1] = p->down[0] * (float)y + p->down[1];
    float g = slope(p, change_of(nearness_at(p, x - 1, y), near, nearness_at(p, x + 1, y)), p->across[0], at.depth);
    float h = slope(p, change_of(nearness_at(p, x, y - 1), near, nearness_at(p, x, y + 1)), p->down[0], at.depth);
    float w = p->is_perspective ? (1.0f + at.ray[0] * g) + at.ray[1] * h : 1.0f;
    at.normal[0] = g;
    at.normal[1] = h;
    at.normal[2] = 0.0f - w;
    at.length2 = (g * g + h * h) + w * w;
    return at;
}

/* R127: how far the surface that many pixels away rises, and its weight. */
static float rise(const e3d_depth_picture *p, const pixel *at, float away, const float step[2], float radius, float *counts)
{
    int32_t x = ref_rint(ref_min(ref_max((float)at->x + away * step[0], 0.0f), (float)(p->width - 1)));
    int32_t y = ref_rint(ref_min(ref_max((float)at->y + away * step[1], 0.0f), (float)(p->height - 1)));
    float depth = depth_at(p, x, y);
    *counts = 0.0f;
    if (depth == 0.0f)
        return 0.0f;
    float d[3] = {(p->across[0] * ((float)x - (float)at->x)) * scale_at(p, depth),
                  (p->down[0] * ((float)y - (float)at->y)) * scale_at(p, depth), depth - at->depth};
    for (int c = 0; c < 2 && p->is_perspective; c++)
        d[c] = d[c] + at->ray[c] * d[2];
    float square = ref_dot3(d, d), above = ref_max(ref_dot3(at->normal, d), 0.0f);
    float sine2 = ((above * above) * (1.0f / at->length2)) / ref_max(square, 0x1p-126f);
    *counts = ref_min(ref_max(E3D_OCCLUSION_FALL - square * (E3D_OCCLUSION_FALL / (radius * radius)), 0.0f), 1.0f);
    return ref_min(1.0f, sine2 - E3D_OCCLUSION_SLACK);
}

/* R127: the share of light from one side that a horizon hides; the horizon is given by its squared sine. */
static float hidden_share(const e3d_depth_picture *p, const pixel *at, const float side[2], float horizon)
{
    float along = at->normal[0] * side[0] + at->normal[1] * side[1], ray2 = 1.0f, rest = 1.0f;
    if (p->is_perspective) {
        ray2 = (at->ray[0] * at->ray[0] + at->ray[1] * at->ray[1]) + 1.0f;
        float q = at->ray[0] * side[0] + at->ray[1] * side[1];
        along = along * ray2 + q;
        rest = ray2 - q * q;
    }
    float scale2 = (at->length2 * ray2) * rest, scale = 1.0f / sqrtf(scale2), facing = sqrtf(rest);
    float s2 = ref_min((horizon * scale2) / (rest + along * along), 1.0f), s = sqrtf(s2);
    float arc = (s2 * s) * ((E3D_ARC_A0 + E3D_ARC_A1 * s) + sqrtf(1.0f - s) * (E3D_ARC_B0 + E3D_ARC_B1 * s));
    return ref_min(ref_max((facing * s2 + along * arc) * scale, 0.0f), E3D_OCCLUSION_MOST);
}

static float share_at(const e3d_depth_picture *p, int32_t x, int32_t y, float radius)
{
    pixel at = pixel_at(p, x, y);
    if (at.depth == 0.0f)
        return 0.0f;
    int number = e3d_occlusion_number(x % E3D_OCCLUSION_CELL, y % E3D_OCCLUSION_CELL);
    float pixel_size = fabsf(p->down[0]), shift = (float)e3d_occlusion_shift(number) * 0x1p-6f, direction[2];
    e3d_occlusion_direction(number, direction);
    float step[2] = {direction[0] * (pixel_size / fabsf(p->across[0])), direction[1]};
    float side[2] = {p->across[0] < 0.0f ? 0.0f - direction[0] : direction[0], p->down[0] < 0.0f ? 0.0f - direction[1] : direction[1]};
    float reach = radius / pixel_size, horizon = 0.0f, sum = 0.0f;
    if (p->is_perspective)
        reach = ref_max(reach * nearness_at(p, x, y), 0.0f);
    reach = ref_min(reach, (float)E3D_OCCLUSION_REACH);
    for (int tap = 0; tap < E3D_OCCLUSION_TAPS; tap++) {
        float t = ((float)tap + shift) * (1.0f / E3D_OCCLUSION_TAPS);
        float counts, next = rise(p, &at, reach * (t * t) + 1.0f, step, radius, &counts);
        sum = sum + ref_max(next - horizon, 0.0f) * counts;
        horizon = ref_max(counts > 0.0f ? next : 0.0f, horizon); /* what lies too far in front hides nothing behind it */
    }
    return sum > 0.0f ? hidden_share(p, &at, side, sum) : 0.0f;
}

/* R128: the mean of nine pixels in a row or column. */
static float mean(const e3d_depth_picture *p, const float near[SPAN], const float share[SPAN])
{
    float here = near[MIDDLE], change = change_of(near[MIDDLE - 1], here, near[MIDDLE + 1]), sum = share[MIDDLE], weights = 1.0f;
    float over_step = 1.0f / (E3D_OCCLUSION_STEP * fabsf(p->down[0]));
    if (p->is_perspective && here != 0.0f)
        over_step = over_step / fabsf(here);
    for (int k = 0; k < SPAN; k++) {
        if (k == MIDDLE || near[k] == 0.0f)
            continue;
        float off = (near[k] - here) - change * (float)(k - MIDDLE);
        float weight = ref_max(1.0f - fabsf(off) * over_step, 0.0f) * (k == 0 || k == SPAN - 1 ? 0.5f : 1.0f);
        sum = sum + weight * share[k];
        weights = weights + weight;
    }
    return sum / weights;
}

static float mean_across(const e3d_depth_picture *p, int32_t x, int32_t y, const float *shares)
{
    float near[SPAN], share[SPAN];
    for (int k = 0; k < SPAN; k++) {
        int32_t column = x + k - MIDDLE;
        int is_inside = column >= 0 && column < p->width;
        near[k] = nearness_at(p, column, y);
        share[k] = is_inside ? shares[(size_t)y * (size_t)p->width + (size_t)column] : 0.0f;
    }
    return mean(p, near, share);
}

static float visibility_at(const e3d_depth_picture *p, int32_t x, int32_t y, const float *shares)
{
    float near[SPAN], share[SPAN];
    for (int k = 0; k < SPAN; k++) {
        int32_t row = y + k - MIDDLE;
        near[k] = nearness_at(p, x, row);
        share[k] = row >= 0 && row < p->height ? mean_across(p, x, row, shares) : 0.0f;
    }
    return near[MIDDLE] == 0.0f ? 1.0f : ref_max(1.0f - mean(p, near, share), 0.0f);
}

/* Not inlined, so that no arithmetic moves out of the floating-point environment. */
__attribute__((noinline)) static void find(const e3d_depth_picture *p, float radius, float *scratch, float *visibility)
{
    size_t width = (size_t)p->width;
    for (int32_t y = 0; y < p->height; y++)
        for (int32_t x = 0; x < p->width; x++)
            scratch[(size_t)y * width + (size_t)x] = share_at(p, x, y, radius);
    for (int32_t y = 0; y < p->height; y++)
        for (int32_t x = 0; x < p->width; x++)
            visibility[(size_t)y * width + (size_t)x] = visibility_at(p, x, y, scratch);
}

void e3d_reference_occlusion(const e3d_depth_picture *picture, float radius, float *scratch, float *visibility)
{
    e3d_fpenv environment = e3d_fpenv_enter();
    find(picture, radius, scratch, visibility);
    e3d_fpenv_leave(environment);
}
