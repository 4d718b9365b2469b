/* resolve: writes the tile's colours to the caller's picture; several samples are averaged (R33-R36). */
#include "base/limits.h"
#include "data/srgb_tables.h"
#include "e3d.h"
#include "frame/pass/plan.h"
#include "frame/store/backdrop.h"
#include "frame/store/outputs.h"
#include "frame/store/picture.h"
#include "frame/store/resolve.h"

static uint32_t encode_one(const e3d_prepared *pass, const float color[3], float alpha)
{
    float planes[3][1 + E3D_PAD] = {{0}};
    uint32_t rgba[1 + E3D_PAD];
    for (int k = 0; k < 3; k++)
        planes[k][0] = color[k];
    pass->kernels->encode(planes[0], planes[1], planes[2], 1, e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), rgba);
    return (rgba[0] & 0xFFFFFFu) | (alpha > 0.5f ? 0xFF000000u : 0);
}

static float unit(float v)
{
    v = v > 0.0f ? v : 0.0f;
    return v < 1.0f ? v : 1.0f;
}

void e3d_resolve_prepare(const e3d_prepared *pass, e3d_store *out)
{
    const e3d_frame *frame = pass->frame;
    e3d_background *background = &out->background;
    e3d_ink *line = &out->line;
    int opaque = frame->background[3] > 0.5f;
    float pixel[3];
    out->pass = pass;
    e3d_outputs_prepare(pass->targets, out);
    for (int k = 0; k < 3; k++) {
        background->color[k] = unit(frame->background[k]);
        background->sample[k] = opaque ? background->color[k] : 0.0f;
        line->sample[k] = unit(frame->line_color[k]);
        pixel[k] = opaque ? e3d_mean_of(background->color[k], frame->samples_axis * frame->samples_axis) : background->color[k];
    }
    background->sample[3] = opaque;
    line->sample[3] = 1.0f;
    background->rgba = encode_one(pass, pixel, frame->background[3]);
    line->rgba = encode_one(pass, frame->line_color, 1.0f);
    for (int x = 0; x < E3D_TILE; x++)
        background->row[x] = background->rgba;
}

static void fill_samples(const e3d_store *store, e3d_samples *samples)
{
    float *const planes[4] = {samples->color[0], samples->color[1], samples->color[2], samples->counts};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < E3D_TILE_SAMPLES; i++)
            planes[k][i] = store->background.sample[k];
}

void e3d_resolve_begin(const e3d_store *store, e3d_store_memory *memory)
{
    e3d_outputs_begin(store, memory);
    if (!store->pass->targets->color)
        return;
    if (e3d_plans(store->pass, E3D_PLAN_BACKDROP)) {
        e3d_backdrop_fill(store, memory);
        return;
    }
    if (memory->sampled) {
        fill_samples(store, &memory->samples);
        return;
    }
    for (int i = 0; i < E3D_TILE_SAMPLES; i++)
        memory->rgba[i] = store->background.rgba;
}

void e3d_resolve_again(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory)
{
    e3d_outputs_again(store, tile, memory);
    if (store->pass->targets->color)
        e3d_read_tile(store->pass, tile, store->pass->targets->color, sizeof(uint32_t), memory->rgba, E3D_TILE * sizeof(uint32_t));
}

/* Sets a sample's colour, clamped, and whether it counts; or the pixel, with one sample a pixel. */
static void set_sample(e3d_store_memory *memory, int at, const float sample[4], uint32_t rgba)
{
    if (!memory->sampled) {
        memory->rgba[at] = rgba;
        return;
    }
    for (int k = 0; k < 3; k++)
        memory->samples.color[k][at] = sample[k];
    memory->samples.counts[at] = sample[3];
}

void e3d_resolve_hidden(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory)
{
    if (e3d_plans(store->pass, E3D_PLAN_BACKDROP)) {
        e3d_backdrop_batch(store, batch, memory);
        return;
    }
    for (int i = 0; i < batch->count; i++)
        set_sample(memory, batch->sample[i], store->background.sample, store->background.rgba);
}

void e3d_resolve_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory)
{
    const e3d_prepared *pass = store->pass;
    if (!memory->sampled)
        pass->kernels->put(batch, e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), memory->rgba);
    else
        pass->kernels->keep(batch, &memory->samples);
}

void e3d_resolve_overdraw(const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory)
{
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++) {
            int at = y * E3D_TILE + x, count = counts[at];
            if (!count)
                continue;
            const uint8_t *c = E3D_OVERDRAW_RAMP[count < 15 ? count : 15];
            const float sample[4] = {c[0] * E3D_UNORM8, c[1] * E3D_UNORM8, c[2] * E3D_UNORM8, 1.0f};
            set_sample(memory, at, sample,
                       c[0] | (uint32_t)c[1] << 8 | (uint32_t)c[2] << 16 | 0xFF000000u);
        }
}

void e3d_resolve_wire(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory)
{
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++)
            if (counts[y * E3D_TILE + x])
                set_sample(memory, y * E3D_TILE + x, store->line.sample, store->line.rgba);
}

void e3d_resolve_wire_samples(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_samples *samples)
{
    float *const planes[4] = {samples->color[0], samples->color[1], samples->color[2], samples->counts};
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++)
            for (int k = 0; k < 4 && counts[y * E3D_TILE + x]; k++)
                planes[k][y * E3D_TILE + x] = store->line.sample[k];
}

/* Averages the samples of pixels, row by row; with one sample a pixel, copies them. */
static void average(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory)
{
    const e3d_prepared *pass = store->pass;
    int axis = pass->frame->samples_axis;
    for (int y = 0; y < tile->height / axis; y++)
        pass->kernels->average(&memory->samples, axis, y * axis, tile->width / axis, store->background.color,
                               e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), memory->rgba + y * E3D_TILE);
}

void e3d_resolve(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory)
{
    const e3d_prepared *pass = store->pass;
    e3d_outputs_end(store, visible, tile, memory);
    if (!pass->targets->color)
        return;
    if (memory->sampled)
        average(store, tile, memory);
    e3d_write_tile(pass, tile, pass->targets->color, sizeof(uint32_t), memory->rgba, E3D_TILE * sizeof(uint32_t));
}
