/* shade: the outputs beside colour, from the visible sample of each pixel (R21, R22, R35). Samples come in the order of their
 * surfaces.
 */
#include <float.h>
#include <math.h>

#include "core/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "pipeline/pass/draws.h"
#include "pipeline/shade/surface.h"
#include "pipeline/shade/values.h"
#include "pipeline/state/context.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/outputs.h"

/* The pixel that each of the batch's samples stands for. */
static const int32_t *pixels_of(const e3d_context *context, const e3d_batch *batch, int32_t *room)
{
    int32_t axis = context->frame->samples_axis, middle = axis / 2;
    if (axis == 1)
        return batch->sample;
    for (int i = 0; i < batch->count; i++) {
        int32_t x = batch->sample[i] % E3D_TILE, y = batch->sample[i] / E3D_TILE;
        int stands = x % axis == middle && y % axis == middle;
        room[i] = stands ? y / axis * E3D_TILE + x / axis : E3D_NO_PIXEL;
    }
    return room;
}

static void make_finite(const float *values, int count, float *out)
{
    for (int i = 0; i < count; i++)
        out[i] = fabsf(values[i]) <= FLT_MAX ? values[i] : 0.0f;
}

/* The values of one output, by channels, each to its pixel. */
static void put(const e3d_context *context, const e3d_worker *worker, e3d_output_kind kind, const int32_t *at,
                const e3d_lane_array *values)
{
    float *pixels = e3d_outputs_gathered(context, worker, kind);
    int count = worker->tile->batch.count, channels = e3d_output_channels(kind);
    e3d_lane_array finite[3];
    if (!pixels)
        return;
    for (int k = 0; k < channels; k++)
        make_finite(values[k], count, finite[k]);
    for (int i = 0; i < count && channels == 1; i++)
        pixels[at[i]] = finite[0][i];
    for (int k = 0; k < 2 && channels == 2; k++)
        for (int i = 0; i < count; i++)
            pixels[2 * at[i] + k] = finite[k][i];
    for (int i = 0; i < count && channels == 3; i++)
        for (int k = 0; k < 3; k++)
            pixels[3 * at[i] + k] = finite[k][i];
}

/* Rows of view_from_world applied to positions (w = 1) or directions (w = 0). */
static void to_view(const e3d_context *context, const e3d_batch *batch, const e3d_lane_array *v, int w, e3d_lane_array out[3])
{
    for (int row = 0; row < 3; row++) {
        const float *m = context->view->rows + 4 * row;
        for (int i = 0; i < batch->count; i++) {
            float sum = (m[0] * v[0][i] + m[1] * v[1][i]) + m[2] * v[2][i];
            out[row][i] = w ? sum + m[3] : sum;
        }
    }
}

static void put_view(const e3d_context *context, const e3d_worker *worker, const int32_t *at)
{
    const e3d_batch *batch = &worker->tile->batch;
    const e3d_targets *t = context->targets;
    e3d_lane_array v[3];
    if (t->normal) {
        to_view(context, batch, batch->normal, 0, v);
        put(context, worker, E3D_OUTPUT_NORMAL, at, v);
    }
    if (t->position || t->depth) {
        to_view(context, batch, batch->position, 1, v);
        put(context, worker, E3D_OUTPUT_POSITION, at, v);
        for (int i = 0; i < batch->count; i++)
            v[2][i] = 0.0f - v[2][i];
        put(context, worker, E3D_OUTPUT_DEPTH, at, v + 2);
    }
}

/* R19 */
static void put_barycentric(const e3d_context *context, const e3d_worker *worker, const int32_t *at)
{
    const e3d_batch *batch = &worker->tile->batch;
    e3d_lane_array b[3];
    for (int k = 0; k < 3 && context->targets->barycentric; k++)
        for (int i = 0; i < batch->count; i++) {
            float v = batch->weight[k][i] * batch->r[i];
            b[k][i] = v < 1.0f ? v : 1.0f;
        }
    put(context, worker, E3D_OUTPUT_BARYCENTRIC, at, b);
}

static void put_id(int32_t *pixels, const int32_t *at, int count, int32_t id)
{
    for (int i = 0; i < count; i++)
        pixels[at[i]] = id;
}

/* Samples of one surface are neighbours. */
static void put_ids(const e3d_context *context, const e3d_worker *worker, const int32_t *at)
{
    const e3d_batch *batch = &worker->tile->batch;
    const e3d_visible_primitive *pieces = worker->surface.pieces.data;
    const e3d_bucket *buckets = worker->surface.buckets.data;
    int32_t *triangles = e3d_outputs_gathered(context, worker, E3D_OUTPUT_TRIANGLE_ID);
    int32_t *objects = e3d_outputs_gathered(context, worker, E3D_OUTPUT_OBJECT_ID);
    int32_t *instances = e3d_outputs_gathered(context, worker, E3D_OUTPUT_INSTANCE_ID);
    int32_t *materials = e3d_outputs_gathered(context, worker, E3D_OUTPUT_MATERIAL_ID);
    if (!triangles && !objects && !instances && !materials)
        return;
    for (int i = 0, end = 0; i < batch->count; i = end) {
        while (end < batch->count && batch->surface[end] == batch->surface[i])
            end++;
        const e3d_visible_primitive *piece = &pieces[worker->tile->surfaces.piece[batch->surface[i]]];
        const e3d_draw *draw = piece->draw->draw;
        if (triangles)
            put_id(triangles, at + i, end - i, e3d_face_of(piece));
        if (objects)
            put_id(objects, at + i, end - i, e3d_object_id(draw, piece->instance));
        if (instances)
            put_id(instances, at + i, end - i, e3d_instance_id(draw, piece->instance));
        if (materials)
            put_id(materials, at + i, end - i, buckets[piece->bucket].material->id);
    }
}

void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker)
{
    const e3d_batch *batch = &worker->tile->batch;
    int32_t room[E3D_BATCH];
    const int32_t *at = pixels_of(context, batch, room);
    put_ids(context, worker, at);
    put_view(context, worker, at);
    put(context, worker, E3D_OUTPUT_ALBEDO, at, batch->color);
    put(context, worker, E3D_OUTPUT_WORLD_NORMAL, at, batch->normal);
    put(context, worker, E3D_OUTPUT_WORLD_POSITION, at, batch->position);
    put(context, worker, E3D_OUTPUT_UV, at, batch->uv);
    put_barycentric(context, worker, at);
}
