/* cull: the boxes of clusters and instances as an eye sees them.
 * Always: nothing that the rules would draw is lost. Boxes grow by many times the rounding of the f32 transform. A box is
 * outside if all its corners are beyond one plane (Gribb and Hartmann 2001, for all corners at once). */
#include <math.h>
#include <string.h>

#include "base/vectors.h"
#include "frame/pass/boxes.h"

static inline float4 column(const float m[16], int c) { return (float4){m[c], m[4 + c], m[8 + c], m[12 + c]}; }

/* The eight corners of a box in clip space, and a bound of the rounding of each component. */
typedef struct corners {
    float4 at[8], slack;
} corners;

static void find_corners(const float clip[16], const float lo[3], const float hi[3], corners *out)
{
    float4 size = size_of(column(clip, 3));
    out->at[0] = column(clip, 3);
    for (int k = 0; k < 3; k++) {
        float4 axis = column(clip, k), a = axis * splat(lo[k]), b = axis * splat(hi[k]);
        size += more_of(size_of(a), size_of(b));
        for (int i = 0; i < 1 << k; i++) {
            out->at[i | 1 << k] = out->at[i] + b;
            out->at[i] = out->at[i] + a;
        }
    }
    out->slack = size * splat(0x1p-20f); /* some f32 roundings here, and some in the kernels */
}

/* The box of the samples whose centres lie from lo to hi, with a quarter of a sample added for the snapping. */
static e3d_box samples_of(const e3d_viewport *viewport, float4 lo, float4 hi)
{
    float half_x = 0.5f * (float)viewport->width, half_y = 0.5f * (float)viewport->height;
    float last_x = (float)(viewport->width - 1), last_y = (float)(viewport->height - 1);
    const float4 sides = {lo[0], hi[1], hi[0], lo[1]}, scale = {half_x, -half_y, half_x, -half_y};
    float reach = (float)viewport->reach * (1.0f / E3D_SUBPIXEL), up = 0.75f + reach, down = 0.25f - reach;
    const float4 centre = {half_x, half_y, half_x, half_y}, before = {up, up, down, down}, last = {last_x, last_y, last_x, last_y};
    int4 at = __builtin_convertvector(less_of(more_of(centre + sides * scale - before, splat(0.0f)), last), int4); /* a NaN: 0 */
    return (e3d_box){at[0], at[1], at[2], at[3]};
}

/* Finds the samples and the nearest depth of a box. If it reaches the eye, these are the whole picture and the nearest depth
 * there is. */
static void project_corners(const e3d_viewport *viewport, const corners *c, e3d_box_view *out)
{
    float4 lo = c->at[0] / splat(c->at[0][3]), hi = lo, nearest = c->at[0];
    for (int i = 1; i < 8; i++) {
        float4 ndc = c->at[i] / splat(c->at[i][3]);
        lo = less_of(lo, ndc);
        hi = more_of(hi, ndc);
        nearest = less_of(nearest, c->at[i]);
    }
    float w = nearest[3] - c->slack[3], all = (c->slack[0] + c->slack[1]) + (c->slack[2] + c->slack[3]);
    if (!(w > E3D_W_MIN) || !(all < INFINITY)) {
        *out = (e3d_box_view){out->state, E3D_DEPTH_UNBOUNDED, {0, 0, viewport->width - 1, viewport->height - 1}};
        return;
    }
    float4 most = more_of(size_of(lo), size_of(hi));
    float4 moved = (c->slack + most * splat(c->slack[3])) / splat(w);
    lo -= moved;
    hi += moved;
    out->near = lo[2] > E3D_DEPTH_UNBOUNDED ? lo[2] : E3D_DEPTH_UNBOUNDED;
    out->samples = samples_of(viewport, lo, hi);
}

/* The state of a box: outside if all corners are beyond one plane, inside if none is beyond any. */
static int state_of(const corners *c)
{
    float4 w = splat(c->at[0][3]);
    float4 most_low = w + c->at[0], most_high = w - c->at[0], least_low = most_low, least_high = most_high;
    for (int i = 1; i < 8; i++) {
        w = splat(c->at[i][3]);
        float4 low = w + c->at[i], high = w - c->at[i];
        most_low = more_of(most_low, low);
        most_high = more_of(most_high, high);
        least_low = less_of(least_low, low);
        least_high = less_of(least_high, high);
    }
    float4 slack = c->slack + splat(c->slack[3]);
    const int three = 7; /* w is compared, too, but is ignored */
    if ((lanes_of(most_low < -slack) | lanes_of(most_high < -slack)) & three)
        return E3D_BOX_OUTSIDE;
    int inside = lanes_of(least_low > slack) & lanes_of(least_high > slack) & three;
    return inside == three ? E3D_BOX_INSIDE : E3D_BOX_CROSSES;
}

int e3d_box_state(const float clip[16], const float lo[3], const float hi[3])
{
    corners c;
    find_corners(clip, lo, hi, &c);
    return state_of(&c);
}

void e3d_view_box(const e3d_viewport *viewport, const float clip[16], const float lo[3], const float hi[3],
                  e3d_box_view *out)
{
    corners c;
    find_corners(clip, lo, hi, &c);
    out->state = state_of(&c);
    if (out->state != E3D_BOX_OUTSIDE)
        project_corners(viewport, &c, out);
}

static inline int4 load_words(const int32_t *p)
{
    int4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline int32_t least(int4 v)
{
    int32_t a = v[0] < v[1] ? v[0] : v[1], b = v[2] < v[3] ? v[2] : v[3];
    return a < b ? a : b;
}

int e3d_view_vertices(const e3d_viewport *viewport, const e3d_vertices *v, e3d_box_view *out)
{
    if (v->special || v->count < 4)
        return 0;
    int4 x[2], y[2];
    float4 z = load4(v->zn);
    x[0] = x[1] = load_words(v->sx);
    y[0] = y[1] = load_words(v->sy);
    for (int i = 4; i < v->count; i += 4) {
        int at = i < v->count - 4 ? i : v->count - 4; /* the last four vertices may overlap the ones before */
        int4 ax = load_words(v->sx + at), ay = load_words(v->sy + at);
        x[0] = choose_bits(ax < x[0], ax, x[0]);
        x[1] = choose_bits(ax > x[1], ax, x[1]);
        y[0] = choose_bits(ay < y[0], ay, y[0]);
        y[1] = choose_bits(ay > y[1], ay, y[1]);
        z = less_of(load4(v->zn + at), z);
    }
    int32_t left = least(x[0]), top = least(y[0]);
    const int32_t xs[3] = {left, -least(-x[1]), left}, ys[3] = {top, -least(-y[1]), top};
    float a = z[0] < z[1] ? z[0] : z[1], b = z[2] < z[3] ? z[2] : z[3];
    *out = (e3d_box_view){E3D_BOX_INSIDE, a < b ? a : b, e3d_sample_box(xs, ys, viewport)};
    return out->samples.x0 <= out->samples.x1 && out->samples.y0 <= out->samples.y1;
}
