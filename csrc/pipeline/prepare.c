/* prepare: a frame's tables (draws, units of work, instance matrices R1-R2) and constants. */
#include <math.h>
#include <string.h>

#include "core/always_inline.h"
#include "core/grow.h"
#include "core/limits.h"
#include "core/mesh.h"
#include "core/pool.h"
#include "core/srgb_tables.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "pipeline/cull.h"
#include "pipeline/draws.h"
#include "pipeline/facing.h"
#include "pipeline/frame.h"
#include "pipeline/lines.h"
#include "pipeline/plan.h"
#include "pipeline/prepare.h"

/* Two columns of a row. */
typedef double double2 __attribute__((vector_size(16)));

static inline double2 load2(const double *p)
{
    double2 v;
    memcpy(&v, p, sizeof v);
    return v;
}

/* b: rows, in registers: what is stored by ones is waited for when it is loaded by twos. */
static ALWAYS_INLINE void multiply_rows(const double a[16], const double2 b[4][2], double out[16])
{
    for (int r = 0; r < 4; r++)
        for (int h = 0; h < 2; h++) {
            const double *m = a + 4 * r;
            double2 sum = ((m[0] * b[0][h] + m[1] * b[1][h]) + m[2] * b[2][h]) + m[3] * b[3][h];
            memcpy(out + 4 * r + 2 * h, &sum, sizeof sum);
        }
}

static inline void multiply(const double a[16], const double b[16], double out[16])
{
    double2 rows[4][2];
    for (int r = 0; r < 4; r++)
        for (int h = 0; h < 2; h++)
            rows[r][h] = load2(b + 4 * r + 2 * h);
    multiply_rows(a, rows, out);
}

static void multiply_pose(const double a[16], const e3d_draw *draw, int32_t instance, double out[16])
{
    if (draw->pose_kind == E3D_POSE_MATRIX) {
        double pose[16];
        for (int k = 0; k < 16; k++)
            pose[k] = draw->poses[16 * (size_t)instance + k];
        multiply(a, pose, out);
        return;
    }
    const float *p = draw->poses + 4 * (size_t)instance;
    const double2 rows[4][2] = {{{p[3], 0}, {0, p[0]}}, {{0, p[3]}, {0, p[1]}}, {{0, 0}, {p[3], p[2]}}, {{0, 0}, {0, 1}}};
    multiply_rows(a, rows, out);
}

/* Those of the upper left 3x3; its determinant. */
static double find_cofactors(const double m[16], double cofactor[9])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[3 * r + c] = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
        }
    return (m[0] * cofactor[0] + m[1] * cofactor[1]) + m[2] * cofactor[2];
}

/* R2 */
static void normal_matrix(const e3d_context *context, const double m[16], e3d_instance *out)
{
    double cofactor[9], big = 0;
    int finite = 1;
    double det = find_cofactors(m, cofactor);
    for (int k = 0; k < 9; k++) {
        big = fabs(cofactor[k]) > big ? fabs(cofactor[k]) : big;
        finite = finite && isfinite(cofactor[k]);
    }
    out->mirrored = (det < 0) != context->mirrors;
    double scale = 1.0 / big;
    finite = finite && isfinite(scale);
    for (int k = 0; k < 9; k++)
        out->normal[k] = finite ? (float)(cofactor[k] * (det < 0 ? -scale : scale)) : 0.0f;
}

static void clip_matrix(const double clip_from_world[16], const double world[16], float out[16])
{
    double clip[16];
    multiply(clip_from_world, world, clip);
    for (int k = 0; k < 16; k++)
        out[k] = (float)clip[k];
}

static const double LAST_ROW[4] = {0, 0, 0, 1};

static void world_matrix(const e3d_draw *draw, int32_t instance, double out[16])
{
    if (draw->pose_kind == E3D_POSE_NONE) {
        memcpy(out, draw->world_from_node, 16 * sizeof *out);
    } else if (draw->pose_kind == E3D_POSE_NODES) {
        memcpy(out, draw->node_worlds + 12 * (size_t)instance, 12 * sizeof *out);
        memcpy(out + 12, LAST_ROW, sizeof LAST_ROW);
    } else {
        multiply_pose(draw->world_from_node, draw, instance, out);
    }
}

/* Besides clip space, which tells whether more is needed. */
static void prepare_surface(const e3d_context *context, const double world[16], e3d_instance *out)
{
    for (int k = 0; k < 12; k++)
        out->world[k] = (float)world[k];
    normal_matrix(context, world, out);
    e3d_facing_prepare(&context->viewport, out->clip, &out->facing);
    out->ready = 1;
}

void e3d_prepare_surface(const e3d_context *context, e3d_instance *instance)
{
    double world[16];
    const e3d_draw_state *state = &context->draws[instance->draw];
    world_matrix(state->draw, (int32_t)(instance - context->instances - state->instance_base), world);
    prepare_surface(context, world, instance);
}

static void prepare_instance(const e3d_context *context, const e3d_draw *draw, int32_t instance, int units, e3d_instance *out)
{
    const e3d_frame *frame = context->frame;
    double world[16];
    world_matrix(draw, instance, world);
    clip_matrix(frame->clip_from_world, world, out->clip);
    if (frame->frozen_clip_from_world)
        clip_matrix(frame->frozen_clip_from_world, world, out->frozen);
    const e3d_mesh *mesh = draw->mesh;
    const float *cull = e3d_culling_matrix(frame, out);
    int one = mesh->group_count == 1; /* whose box is tried soon, by one thread */
    int later = one && (frame->culling == E3D_CULLING_ALL || frame->culling == E3D_CULLING_ALWAYS); /* if it isn't hidden */
    out->shows = mesh->desc.components == 4 || frame->culling == E3D_CULLING_NONE ||
                 (mesh->any_finite && (one || e3d_box_state(cull, mesh->lo, mesh->hi) != E3D_BOX_OUTSIDE));
    out->ready = 0;
    if (units || (out->shows && !later)) /* lines and points are wider than the box */
        prepare_surface(context, world, out);
}

enum { INSTANCES_A_TASK = 256 };

static void instances_work(void *argument, int worker)
{
    e3d_context *context = argument;
    (void)worker;
    for (;;) {
        int64_t first = atomic_fetch_add(&context->next, INSTANCES_A_TASK);
        if (first >= context->instance_count)
            return;
        const e3d_draw_state *state = e3d_draw_of_instance(context, first);
        for (int64_t i = first; i < first + INSTANCES_A_TASK && i < context->instance_count; i++) {
            while (i >= state->instance_base + state->draw->instances)
                state++;
            prepare_instance(context, state->draw, (int32_t)(i - state->instance_base), state->units, &context->instances[i]);
            context->instances[i].draw = (int32_t)(state - context->draws);
            if (state->draw->pose_kind != E3D_POSE_NODES)
                context->instances[i].order =
                    state->order + (uint32_t)(i - state->instance_base) * (uint32_t)state->primitives;
        }
    }
}

static int32_t units_of(int32_t count) { return (count + E3D_LINES_A_UNIT - 1) / E3D_LINES_A_UNIT; }

static int has_two_sided(const e3d_frame *frame)
{
    for (int32_t m = 0; m < frame->material_count; m++)
        if (frame->materials[m].two_sided)
            return 1;
    return 0;
}

static e3d_status prepare_draws(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    int64_t primitives = 0, instances = 0, units = 0, groups = 0;
    int two_sided = has_two_sided(frame);
    for (int32_t d = 0; d < frame->draw_count; d++) {
        const e3d_draw *draw = &frame->draws[d];
        const e3d_mesh_desc *desc = &draw->mesh->desc;
        e3d_draw_state *s = &context->draws[d];
        *s = (e3d_draw_state){.draw = draw, .mesh = draw->mesh, .instance_base = instances, .unit_base = units,
                              .group_base = groups, .any_two_sided = two_sided};
        s->line_units = units_of(desc->lines_count);
        s->point_units = units_of(desc->points_count);
        s->edge_units = e3d_plans(context, E3D_PLAN_EDGES) ? units_of(desc->edges_count) : 0;
        s->units = s->line_units + s->point_units + s->edge_units;
        int64_t all = (int64_t)desc->faces_count + desc->lines_count + desc->points_count;
        if (all > INT32_MAX || primitives + all * draw->instances > INT32_MAX ||
            instances + draw->instances > INT32_MAX)
            return E3D_TOO_MANY_PRIMITIVES;
        primitives += all * draw->instances;
        instances += draw->instances;
        s->primitives = (int32_t)all;
        units += (int64_t)s->units * draw->instances;
        groups += (int64_t)draw->mesh->group_count * draw->instances;
    }
    context->instance_count = (int32_t)instances;
    context->units = units;
    context->groups = groups;
    return E3D_OK;
}

/* Gives the next instances of a draw their place in the order; 0 if it has no more. */
static int place_instances(e3d_context *context, e3d_draw_state *state, uint32_t order, int32_t count)
{
    if (state->placed + count > state->draw->instances)
        return 0;
    if (state->draw->pose_kind == E3D_POSE_NODES)
        context->instances[state->instance_base + state->placed].order = order;
    state->order = order;
    state->placed += count;
    return 1;
}

/* R16 */
static e3d_status prepare_turns(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    int32_t count = frame->order ? frame->order_count : frame->draw_count;
    uint32_t order = 0;
    if (!e3d_array_reserve(&context->renderer->turns, (size_t)count + 1, sizeof(e3d_turn)))
        return E3D_OUT_OF_MEMORY;
    e3d_turn *turns = context->renderer->turns.data;
    for (int32_t t = 0; t < count; t++) {
        int32_t d = frame->order ? frame->order[t] : t;
        if (d < 0 || d >= frame->draw_count)
            return E3D_INVALID_ARGUMENT;
        e3d_draw_state *state = &context->draws[d];
        int32_t instances = state->draw->pose_kind == E3D_POSE_NODES ? 1 : state->draw->instances;
        turns[t] = (e3d_turn){order, d, state->placed};
        if (!place_instances(context, state, order, instances))
            return E3D_INVALID_ARGUMENT;
        order += (uint32_t)instances * (uint32_t)state->primitives;
    }
    for (int32_t d = 0; d < frame->draw_count; d++)
        if (context->draws[d].placed != context->draws[d].draw->instances)
            return E3D_INVALID_ARGUMENT;
    context->turns = turns;
    context->turn_count = count;
    return E3D_OK;
}

static float guard_factor(double half)
{
    double factor = 1;
    while (factor * 2 <= E3D_GUARD / half)
        factor *= 2;
    return (float)factor;
}

static void prepare_viewport(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    e3d_viewport *v = &context->viewport;
    v->width = frame->width * frame->samples_axis;
    v->height = frame->height * frame->samples_axis;
    v->scale_x = 128.0f * (float)v->width;
    v->scale_y = 128.0f * (float)v->height;
    v->guard_x = guard_factor(v->width / 2.0);
    v->guard_y = guard_factor(v->height / 2.0);
    context->tiles_x = (v->width + E3D_TILE - 1) / E3D_TILE;
    context->tiles_y = (v->height + E3D_TILE - 1) / E3D_TILE;
}

static uint32_t encode_one(const e3d_context *context, const float color[3], float alpha)
{
    float planes[3][1 + E3D_PAD] = {{0}};
    uint32_t rgba[1 + E3D_PAD];
    for (int k = 0; k < 3; k++)
        planes[k][0] = color[k];
    context->kernels->encode(planes[0], planes[1], planes[2], 1, e3d_plans(context, E3D_PLAN_ENCODES_SRGB), rgba);
    return (rgba[0] & 0xFFFFFFu) | (alpha > 0.5f ? 0xFF000000u : 0);
}

/* R33 of a pixel whose samples are alike. */
static float mean_of(float value, int count)
{
    float sum = 0.0f;
    for (int i = 0; i < count; i++)
        sum = sum + value;
    return sum * (1.0f / (float)count);
}

static float unit(float v)
{
    v = v > 0.0f ? v : 0.0f;
    return v < 1.0f ? v : 1.0f;
}

static void prepare_background(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    int opaque = frame->background[3] > 0.5f;
    float pixel[3];
    for (int k = 0; k < 3; k++) {
        context->background[k] = unit(frame->background[k]);
        context->background_sample[k] = opaque ? context->background[k] : 0.0f;
        context->line_sample[k] = unit(frame->line_color[k]);
        pixel[k] = opaque ? mean_of(context->background[k], frame->samples_axis * frame->samples_axis) : context->background[k];
    }
    context->background_sample[3] = opaque;
    context->line_sample[3] = 1.0f;
    context->background_rgba = encode_one(context, pixel, frame->background[3]);
    context->line_rgba = encode_one(context, frame->line_color, 1.0f);
    for (int x = 0; x < E3D_TILE; x++)
        context->background_row[x] = context->background_rgba;
}

/* The lights' positions and ranges as the light kernel reads them, a vector of lights at a time. */
static int prepare_lights(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    size_t room = (size_t)frame->light_count + E3D_PAD;
    if (!e3d_array_reserve(&context->renderer->reach, 5 * room, sizeof(float)))
        return 0;
    float *rows = context->renderer->reach.data;
    for (int k = 0; k < 5; k++)
        context->lighting.reach[k] = rows + (size_t)k * room;
    for (size_t n = 0; n < room; n++) {
        const e3d_light *light = n < (size_t)frame->light_count ? &frame->lights[n] : NULL;
        int point = light && light->kind == E3D_LIGHT_POINT;
        for (int k = 0; k < 3; k++)
            rows[(size_t)k * room + n] = point ? light->position[k] : 0.0f;
        rows[3 * room + n] = point ? light->range * light->range : NAN;
        rows[4 * room + n] = 1.0f / rows[3 * room + n];
    }
    context->lighting.lights = frame->lights;
    context->lighting.light_count = frame->light_count;
    return 1;
}

/* R11 */
static void prepare_lines(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    float axis = (float)frame->samples_axis;
    int32_t line = (int32_t)lrintf(frame->line_width * axis * 128.0f);
    int32_t point = (int32_t)lrintf(frame->point_size * axis * 128.0f);
    context->line_half = line > 1 ? line : 1;
    context->point_half = point > 1 ? point : 1;
    context->wide_lines = frame->line_width > 1.0f;
    context->line_reach = context->wide_lines ? (int32_t)lrint((double)context->line_half * sqrt(2.0)) : context->line_half;
}

static void prepare_constants(e3d_context *context)
{
    const e3d_frame *frame = context->frame;
    double cofactor[9];
    for (int k = 0; k < 12; k++)
        context->view[k] = (float)frame->view_from_world[k];
    for (int c = 0; c < 256; c++)
        context->unorm8[c] = (float)(frame->decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257) * E3D_UNORM16;
    memcpy(context->lighting.ambient, frame->ambient, sizeof frame->ambient);
    memcpy(context->lighting.clamp, frame->light_clamp, sizeof frame->light_clamp);
    memcpy(context->lighting.eye, frame->eye, sizeof frame->eye);
    context->mirrors = find_cofactors(frame->view_from_world, cofactor) < 0;
    prepare_lines(context);
    int bits = 0;
    while ((1 << bits) < context->renderer->threads)
        bits++;
    for (int pass = 0; pass < E3D_PASSES; pass++)
        context->tables[pass] = (e3d_record_table){context->records[pass], context->drawn, bits};
    prepare_background(context);
}

e3d_status e3d_prepare(e3d_context *context)
{
    e3d_renderer *renderer = context->renderer;
    const e3d_frame *frame = context->frame;
    if (!e3d_array_reserve(&renderer->draws, (size_t)frame->draw_count + 1, sizeof(e3d_draw_state)))
        return E3D_OUT_OF_MEMORY;
    context->draws = renderer->draws.data;
    context->plan = e3d_plan_of(frame, context->targets);
    prepare_viewport(context);
    e3d_status status = prepare_draws(context);
    if (status != E3D_OK)
        return status;
    if (!e3d_array_reserve(&renderer->instances, (size_t)context->instance_count + 1,
                           sizeof(e3d_instance)))
        return E3D_OUT_OF_MEMORY;
    context->instances = renderer->instances.data;
    if (!e3d_array_reserve(&renderer->marks, (size_t)context->instance_count + 1, 1))
        return E3D_OUT_OF_MEMORY;
    context->marks = memset(renderer->marks.data, 0, (size_t)context->instance_count);
    status = prepare_turns(context);
    if (status != E3D_OK)
        return status;
    prepare_constants(context);
    if (!prepare_lights(context))
        return E3D_OUT_OF_MEMORY;
    atomic_store(&context->next, 0);
    e3d_pool_run(context->instance_count > 2 * INSTANCES_A_TASK ? renderer->threads : 1,
                 instances_work, context);
    return E3D_OK;
}
