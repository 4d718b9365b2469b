/* resolve: the outputs beside colour, from the visible sample of each pixel (R21, R22, R35). */
#include <math.h>
#include <string.h>

#include "pipeline/frame.h"

/* The tile's pixels in the picture. */
typedef struct pixel_box {
    int32_t x, y, width, height;
} pixel_box;

static pixel_box pixels_of(const e3d_context *context, const e3d_tile *tile)
{
    int axis = context->frame->samples_axis;
    return (pixel_box){tile->x / axis, tile->y / axis, tile->width / axis, tile->height / axis};
}

static void fill(void *target, const e3d_context *context, const pixel_box *box, int channels, int byte)
{
    if (!target)
        return;
    for (int32_t y = 0; y < box->height; y++) {
        size_t first = (size_t)(box->y + y) * context->frame->width + box->x;
        memset((char *)target + first * channels * 4, byte, (size_t)box->width * channels * 4);
    }
}

void e3d_outputs_begin(const e3d_context *context, const e3d_tile *tile)
{
    const e3d_targets *t = context->targets;
    pixel_box box = pixels_of(context, tile);
    void *const ids[] = {t->triangle_id, t->object_id, t->instance_id, t->material_id};
    void *const vectors[] = {t->albedo, t->normal, t->position, t->world_normal, t->world_position,
                             t->barycentric};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++)
        fill(ids[i], context, &box, 1, 0xFF);
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        fill(vectors[i], context, &box, 3, 0);
    fill(t->depth, context, &box, 1, 0);
    fill(t->uv, context, &box, 2, 0);
}

enum { NOT_CHOSEN = -1 };

/* Where each sample of the batch goes in the picture: samples that stand for no pixel go nowhere. */
static void choose(const e3d_context *context, const e3d_batch *batch, const e3d_tile *tile, int64_t *at)
{
    int32_t axis = context->frame->samples_axis, middle = axis / 2;
    for (int i = 0; i < batch->count; i++) {
        int32_t x = tile->x + (batch->sample[i] & (E3D_TILE - 1));
        int32_t y = tile->y + batch->sample[i] / E3D_TILE;
        int chosen = x % axis == middle && y % axis == middle;
        at[i] = chosen ? (int64_t)(y / axis) * context->frame->width + x / axis : NOT_CHOSEN;
    }
}

static void scatter(float *target, const e3d_batch *batch, const int64_t *at, int channels, int channel,
                    const float *values)
{
    for (int i = 0; i < batch->count; i++)
        if (at[i] != NOT_CHOSEN)
            target[at[i] * channels + channel] = isfinite(values[i]) ? values[i] : 0.0f;
}

static void scatter_all(float *target, const e3d_batch *batch, const int64_t *at, int channels,
                        const e3d_lane_array *values)
{
    for (int k = 0; target && k < channels; k++)
        scatter(target, batch, at, channels, k, values[k]);
}

/* Row r of view_from_world applied to a position (w = 1) or a direction (w = 0). */
static void to_view(const e3d_context *context, const e3d_batch *batch, const e3d_lane_array *v, int row,
                    int w, float *out)
{
    const float *m = context->view + 4 * row;
    for (int i = 0; i < batch->count; i++) {
        float sum = (m[0] * v[0][i] + m[1] * v[1][i]) + m[2] * v[2][i];
        out[i] = w ? sum + m[3] : sum;
    }
}

static void scatter_view(const e3d_context *context, const e3d_batch *batch, const int64_t *at)
{
    const e3d_targets *t = context->targets;
    e3d_lane_array values;
    for (int k = 0; t->position && k < 3; k++) {
        to_view(context, batch, batch->position, k, 1, values);
        scatter(t->position, batch, at, 3, k, values);
    }
    for (int k = 0; t->normal && k < 3; k++) {
        to_view(context, batch, batch->normal, k, 0, values);
        scatter(t->normal, batch, at, 3, k, values);
    }
    if (t->depth) {
        to_view(context, batch, batch->position, 2, 1, values);
        for (int i = 0; i < batch->count; i++)
            values[i] = 0.0f - values[i];
        scatter(t->depth, batch, at, 1, 0, values);
    }
}

static void scatter_ids(const e3d_context *context, const e3d_worker *worker, const int64_t *at)
{
    const e3d_targets *t = context->targets;
    const e3d_batch *batch = &worker->tile->batch;
    const e3d_visible_piece *pieces = worker->pieces.data;
    const e3d_group *groups = worker->groups.data;
    for (int i = 0; i < batch->count; i++) {
        const e3d_visible_piece *piece = &pieces[worker->tile->surfaces.piece[batch->surface[i]]];
        if (at[i] == NOT_CHOSEN)
            continue;
        if (t->triangle_id)
            t->triangle_id[at[i]] = e3d_face_of(piece);
        if (t->object_id)
            t->object_id[at[i]] = e3d_object_id(piece->draw->draw, piece->instance);
        if (t->instance_id)
            t->instance_id[at[i]] = e3d_instance_id(piece->draw->draw, piece->instance);
        if (t->material_id)
            t->material_id[at[i]] = groups[piece->group].material->id;
    }
}

void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    const e3d_targets *t = context->targets;
    const e3d_batch *batch = &worker->tile->batch;
    int64_t at[E3D_BATCH];
    choose(context, batch, tile, at);
    scatter_ids(context, worker, at);
    scatter_view(context, batch, at);
    scatter_all(t->albedo, batch, at, 3, batch->color);
    scatter_all(t->world_normal, batch, at, 3, batch->normal);
    scatter_all(t->world_position, batch, at, 3, batch->position);
    scatter_all(t->uv, batch, at, 2, batch->uv);
    scatter_all(t->barycentric, batch, at, 3, batch->b);
}

void e3d_outputs_no_depth(const e3d_context *context, const e3d_tile *tile)
{
    float *target = context->targets->ndc_depth;
    pixel_box box = pixels_of(context, tile);
    for (int32_t y = 0; target && y < box.height; y++)
        for (int32_t x = 0; x < box.width; x++)
            target[(size_t)(box.y + y) * context->frame->width + box.x + x] = INFINITY;
}

void e3d_outputs_depth(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile)
{
    float *target = context->targets->ndc_depth;
    if (!target)
        return;
    int axis = context->frame->samples_axis, middle = axis / 2;
    pixel_box box = pixels_of(context, tile);
    for (int32_t y = 0; y < box.height; y++) {
        float *row = target + (size_t)(box.y + y) * context->frame->width + box.x;
        for (int32_t x = 0; x < box.width; x++) {
            int at = (y * axis + middle) * E3D_TILE + x * axis + middle;
            row[x] = worker->visible->id[at] >= 0 ? worker->visible->z[at] : INFINITY;
        }
    }
}
