/* cull: which groups of clusters may show, from the nearest to the farthest.
 *
 * In:  the frame's instances, and the boxes of their meshes' groups.
 * Out: items, sorted by the depth of their nearest corner, in an order that no thread's timing changes.
 * Always: what the rules would keep is never lost: boxes are given the rounding of the f32 transform, many times over. A box
 *      is outside when all its corners are beyond one plane (Gribb and Hartmann 2001, for all corners at once).
 */
#include <math.h>
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "core/mesh.h"
#include "core/pool.h"
#include "core/vectors.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/types/vertices.h"
#include "pipeline/counts.h"
#include "pipeline/cull.h"
#include "pipeline/draws.h"
#include "pipeline/frame.h"

static inline float4 column(const float m[16], int c) { return (float4){m[c], m[4 + c], m[8 + c], m[12 + c]}; }

/* The eight corners of a box in clip space, and for each component what rounding may have moved. */
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
    out->slack = size * splat(0x1p-20f); /* some f32 roundings here, some in the kernels */
}

/* Left, top, right and bottom of what lies from lo to hi: samples whose centres are within, and a quarter of a sample more for the
 * snapping. */
static e3d_box samples_of(const e3d_viewport *viewport, float4 lo, float4 hi)
{
    float half_x = 0.5f * (float)viewport->width, half_y = 0.5f * (float)viewport->height;
    float last_x = (float)(viewport->width - 1), last_y = (float)(viewport->height - 1);
    const float4 sides = {lo[0], hi[1], hi[0], lo[1]}, scale = {half_x, -half_y, half_x, -half_y};
    const float4 centre = {half_x, half_y, half_x, half_y}, before = {0.75f, 0.75f, 0.25f, 0.25f}, last = {last_x, last_y, last_x, last_y};
    int4 at = __builtin_convertvector(less_of(more_of(centre + sides * scale - before, splat(0.0f)), last), int4); /* a NaN: 0 */
    return (e3d_box){at[0], at[1], at[2], at[3]};
}

/* Rectangle of samples and nearest depth; the whole picture and the nearest of all where the box reaches the eye. */
static void project(const e3d_viewport *viewport, const corners *c, e3d_box_view *out)
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

/* 0: all corners are beyond one plane; E3D_BOX_INSIDE: none is beyond any. */
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
    const int three = 7; /* w is compared, too, but doesn't count */
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
        project(viewport, &c, out);
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
        int at = i < v->count - 4 ? i : v->count - 4; /* the last may be looked at twice */
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

const float *e3d_culling_matrix(const e3d_frame *frame, const e3d_instance *instance)
{
    return frame->frozen_clip_from_world ? instance->frozen : instance->clip;
}

/* ---- items ---- */

enum { GROUPS_A_TASK = 512 };

/* What one task left in its thread's list. */
typedef struct task {
    int32_t worker, count;
    size_t first;
} task;

static void add_item(e3d_context *context, e3d_worker *worker, const e3d_draw_state *draw, uint32_t number,
                     int32_t group, int64_t unit)
{
    const e3d_instance *instance = &context->instances[number];
    const e3d_group_box *box = &draw->mesh->groups[group];
    e3d_item item = {number, (uint32_t)group, (int32_t)(draw - context->draws), (int32_t)unit,
                     {E3D_BOX_CROSSES, E3D_DEPTH_UNBOUNDED, {0, 0, 0, 0}}};
    int bounded = draw->mesh->desc.components == 3;
    if (bounded && box->any_finite)
        e3d_view_box(&context->viewport, e3d_culling_matrix(context->frame, instance), box->lo, box->hi, &item.view);
    if (bounded && context->frame->culling != E3D_CULLING_NONE && (!box->any_finite || item.view.state == E3D_BOX_OUTSIDE)) {
        worker->counters.clusters[E3D_FATE_OUTSIDE] += box->clusters;
        worker->counters.triangles[E3D_FATE_OUTSIDE] += box->triangles;
        return;
    }
    const e3d_box blocks = e3d_blocks_of(&item.view.samples);
    worker->counters.blocks += (int64_t)(blocks.x1 - blocks.x0 + 1) * (blocks.y1 - blocks.y0 + 1);
    if (!e3d_array_reserve(&worker->items, worker->items.count + 1, sizeof item)) {
        worker->failed = 1;
        return;
    }
    ((e3d_item *)worker->items.data)[worker->items.count++] = item;
}

/* Groups [first, end) of the frame: draw after draw, instance after instance. */
static void cull_groups(e3d_context *context, e3d_worker *worker, int64_t first, int64_t end)
{
    const e3d_draw_state *draw = e3d_draw_of_group(context, first);
    for (int64_t unit = first; unit < end;) {
        while (unit >= draw->group_base + (int64_t)draw->mesh->group_count * draw->draw->instances)
            draw++;
        int32_t groups = draw->mesh->group_count;
        int64_t within = unit - draw->group_base;
        uint32_t number = (uint32_t)(draw->instance_base + within / groups);
        int32_t group = (int32_t)(within % groups);
        for (; group < groups && unit < end; group++, unit++)
            if (context->instances[number].shows)
                add_item(context, worker, draw, number, group, unit);
            else {
                worker->counters.clusters[E3D_FATE_OUTSIDE] += draw->mesh->groups[group].clusters;
                worker->counters.triangles[E3D_FATE_OUTSIDE] += draw->mesh->groups[group].triangles;
            }
    }
}

static void cull_work(void *argument, int number)
{
    e3d_context *context = argument;
    e3d_worker *worker = context->renderer->workers[number];
    task *tasks = context->renderer->tasks.data;
    while (!atomic_load(&context->stop)) {
        int64_t at = atomic_fetch_add(&context->next, 1), first = at * GROUPS_A_TASK;
        if (first >= context->groups)
            return;
        int64_t end = first + GROUPS_A_TASK < context->groups ? first + GROUPS_A_TASK : context->groups;
        size_t before = worker->items.count;
        cull_groups(context, worker, first, end);
        tasks[at] = (task){number, (int32_t)(worker->items.count - before), before};
    }
}

/* ---- from the nearest to the farthest ---- */

enum { BUCKETS = 1024 };

/* Logarithmic in the distance of z_ndc from the far plane: in perspective about the distance from the eye. */
static uint32_t bucket_of(float near)
{
    float from_far = 1.0f - near;
    uint32_t bits, most = 129u << 5;
    from_far = from_far > 0x1p-30f ? from_far : 0x1p-30f;
    memcpy(&bits, &from_far, 4);
    bits >>= 18; /* the exponent and 5 bits more */
    return bits < most ? most - bits < BUCKETS ? most - bits : BUCKETS - 1 : 0;
}

static int sort_items(e3d_context *context, int64_t task_count)
{
    e3d_renderer *renderer = context->renderer;
    const task *tasks = renderer->tasks.data;
    uint32_t start[BUCKETS] = {0}, total = 0;
    for (int32_t w = 0; w < renderer->threads; w++) {
        const e3d_item *items = renderer->workers[w]->items.data;
        for (size_t i = 0; i < renderer->workers[w]->items.count; i++)
            start[bucket_of(items[i].view.near)]++;
    }
    for (int b = 0; b < BUCKETS; b++) {
        uint32_t count = start[b];
        start[b] = total;
        total += count;
    }
    if (!e3d_array_reserve(&renderer->items, (size_t)total + 1, sizeof(e3d_item)))
        return 0;
    e3d_item *out = renderer->items.data;
    for (int64_t t = 0; t < task_count; t++) {
        const e3d_item *items = renderer->workers[tasks[t].worker]->items.data;
        for (int32_t i = 0; i < tasks[t].count; i++) {
            const e3d_item *item = &items[tasks[t].first + i];
            out[start[bucket_of(item->view.near)]++] = *item;
        }
    }
    context->items = out;
    context->item_count = total;
    return 1;
}

int e3d_find_items(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    int64_t task_count = (context->groups + GROUPS_A_TASK - 1) / GROUPS_A_TASK;
    if (!e3d_array_reserve(&renderer->tasks, (size_t)task_count + 1, sizeof(task)))
        return 0;
    for (int32_t w = 0; w < renderer->threads; w++)
        renderer->workers[w]->items.count = 0;
    atomic_store(&context->next, 0);
    e3d_pool_run(task_count > 1 ? renderer->threads : 1, cull_work, context);
    for (int32_t w = 0; w < renderer->threads; w++)
        if (renderer->workers[w]->failed)
            return 0;
    return sort_items(context, task_count);
}
