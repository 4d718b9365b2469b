/* resolve: the tile's colours to the caller's picture, averaged where there are several samples (R33-R36). */
#include <string.h>

#include "core/srgb_tables.h"
#include "pipeline/frame.h"

static float unit(float v)
{
    v = v > 0.0f ? v : 0.0f;
    return v < 1.0f ? v : 1.0f;
}

void e3d_resolve_begin(const e3d_context *context, e3d_worker *worker)
{
    e3d_tile_memory *memory = worker->tile;
    e3d_outputs_begin(context, worker);
    if (!context->targets->color)
        return;
    int single = context->frame->samples_axis == 1;
    uint32_t rgba = single ? context->background_rgba : 0;
    for (int i = 0; i < E3D_TILE_SAMPLES; i++)
        memory->rgba[i] = rgba;
    for (int k = 0; k < 3 && !single; k++) {
        float value = unit(context->frame->background[k]);
        for (int i = 0; i < E3D_TILE_SAMPLES; i++)
            memory->color[k][i] = value;
    }
}

static void show_background(const e3d_context *context, e3d_tile_memory *memory, int at)
{
    int single = context->frame->samples_axis == 1;
    memory->rgba[at] = single ? context->background_rgba : 0;
    for (int k = 0; k < 3 && !single; k++)
        memory->color[k][at] = unit(context->frame->background[k]);
}

void e3d_resolve_hidden(const e3d_context *context, e3d_worker *worker)
{
    const e3d_batch *batch = &worker->tile->batch;
    for (int i = 0; i < batch->count; i++)
        show_background(context, worker->tile, batch->sample[i]);
}

void e3d_resolve_batch(const e3d_context *context, e3d_worker *worker)
{
    e3d_tile_memory *memory = worker->tile;
    const e3d_batch *batch = &memory->batch;
    if (context->frame->samples_axis == 1) {
        context->kernels->put(batch, context->srgb, memory->rgba);
        return;
    }
    for (int i = 0; i < batch->count; i++) {
        memory->rgba[batch->sample[i]] = 1;
        for (int k = 0; k < 3; k++)
            memory->color[k][batch->sample[i]] = unit(batch->color[k][i]);
    }
}

static void set_sample(const e3d_context *context, e3d_tile_memory *memory, int at, const float color[3],
                       uint32_t rgba)
{
    if (context->frame->samples_axis == 1) {
        memory->rgba[at] = rgba;
        return;
    }
    memory->rgba[at] = 1;
    for (int k = 0; k < 3; k++)
        memory->color[k][at] = unit(color[k]);
}

void e3d_resolve_overdraw(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    e3d_tile_memory *memory = worker->tile;
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++) {
            int at = y * E3D_TILE + x, count = memory->mark[at];
            if (!count)
                continue;
            const uint8_t *c = E3D_OVERDRAW_RAMP[count < 15 ? count : 15];
            const float color[3] = {c[0] * E3D_UNORM8, c[1] * E3D_UNORM8, c[2] * E3D_UNORM8};
            set_sample(context, memory, at, color,
                       c[0] | (uint32_t)c[1] << 8 | (uint32_t)c[2] << 16 | 0xFF000000u);
        }
}

void e3d_resolve_wire(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    e3d_tile_memory *memory = worker->tile;
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++)
            if (memory->mark[y * E3D_TILE + x])
                set_sample(context, memory, y * E3D_TILE + x, context->frame->line_color,
                           context->line_rgba);
}

/* One pixel of several samples: mean colour and share of opaque samples. */
static float average(const e3d_context *context, const e3d_tile_memory *memory, int at, float out[3])
{
    int axis = context->frame->samples_axis, all = axis * axis, covered = 0;
    int opaque = context->frame->background[3] > 0.5f;
    float sum[3] = {0, 0, 0};
    for (int y = 0; y < axis; y++)
        for (int x = 0; x < axis; x++) {
            int i = at + y * E3D_TILE + x;
            if (!memory->rgba[i] && !opaque)
                continue;
            covered++;
            for (int k = 0; k < 3; k++)
                sum[k] = sum[k] + memory->color[k][i];
        }
    float scale = covered ? 1.0f / (float)covered : 0.0f;
    for (int k = 0; k < 3; k++)
        out[k] = covered ? sum[k] * scale : unit(context->frame->background[k]);
    return (float)covered / (float)all;
}

static void resolve_samples(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    e3d_tile_memory *memory = worker->tile;
    e3d_batch *batch = &memory->batch;
    int axis = context->frame->samples_axis;
    for (int y = 0; y < tile->height / axis; y++) {
        float alpha[E3D_TILE];
        uint32_t encoded[E3D_TILE + E3D_PAD];
        int count = tile->width / axis;
        for (int x = 0; x < count; x++) {
            float mean[3];
            alpha[x] = average(context, memory, (y * E3D_TILE + x) * axis, mean);
            for (int k = 0; k < 3; k++)
                batch->color[k][x] = mean[k];
        }
        context->kernels->encode(batch->color[0], batch->color[1], batch->color[2], count,
                                 context->srgb, encoded);
        uint8_t *row = context->targets->color +
                       4 * ((size_t)(tile->y / axis + y) * context->frame->width + tile->x / axis);
        memcpy(row, encoded, 4 * (size_t)count);
        for (int x = 0; x < count; x++)
            row[4 * x + 3] = (uint8_t)(255.0f * alpha[x] + 0.5f);
    }
}

void e3d_resolve_empty(const e3d_context *context, const e3d_tile *tile)
{
    e3d_outputs_empty(context, tile);
    if (context->targets->color)
        e3d_write_rows(context, tile, context->targets->color, sizeof(uint32_t), context->background_row, 0);
}

void e3d_resolve(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    e3d_outputs_end(context, worker, tile);
    if (!context->targets->color)
        return;
    if (context->frame->samples_axis > 1)
        resolve_samples(context, worker, tile);
    else
        e3d_write_rows(context, tile, context->targets->color, sizeof(uint32_t), worker->tile->rgba, E3D_TILE * sizeof(uint32_t));
}
