/* resolve: finds the background pixel by pixel if it is an environment (R63) or a gradient (R122). All samples of a pixel share
 * its colour. A gradient is kept as codes of the picture: where no other sample counts, these are written as they are. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "data/code_light.h"
#include "kernels/kernels.h"
#include "kernels/types/samples.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/store/backdrop.h"

/* Clamped colours of pixels of a row. */
typedef struct colors {
    float red[E3D_TILE + E3D_PAD], green[E3D_TILE + E3D_PAD], blue[E3D_TILE + E3D_PAD];
} colors;

/* ---- gradients ---- */

static uint32_t gradient_code(const e3d_gradient *gradient, float t, float threshold)
{
    uint32_t rgba = 0xFF000000u;
    for (int k = 0; k < 3; k++) {
        float v = (gradient->top[k] + (gradient->bottom[k] - gradient->top[k]) * t) * 255.0f + threshold;
        rgba |= (uint32_t)(int32_t)(v < 255.0f ? v : 255.0f) << (8 * k);
    }
    return rgba;
}

void e3d_backdrop_prepare(const e3d_frame *frame, uint32_t (*rows)[E3D_DITHER])
{
    for (int y = 0; y < frame->height; y++) {
        float t = ((float)y + 0.5f) / (float)frame->height;
        for (int x = 0; x < E3D_DITHER; x++) {
            float threshold = ((float)E3D_DITHER_ORDER[y % E3D_DITHER][x] + 0.5f) * 0x1p-6f;
            rows[y][x] = gradient_code(&frame->gradient, t, threshold);
        }
    }
}

/* Writes the codes of `count` pixels from (x, y) on, and up to E3D_DITHER more. */
static void repeat_codes(const e3d_store *store, int x, int y, int count, uint32_t *rgba)
{
    const uint32_t *row = store->gradient[y];
    uint32_t turned[E3D_DITHER];
    for (int k = 0; k < E3D_DITHER; k++)
        turned[k] = row[(x + k) % E3D_DITHER];
    for (int k = 0; k < count; k += E3D_DITHER)
        memcpy(rgba + k, turned, sizeof turned);
}

static void decode_codes(const e3d_store *store, const uint32_t *rgba, int count, colors *out)
{
    float *const planes[3] = {out->red, out->green, out->blue};
    int srgb = e3d_plans(store->pass, E3D_PLAN_ENCODES_SRGB);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < count; i++)
            planes[k][i] = e3d_light_of(rgba[i] >> (8 * k) & 255, srgb);
}

/* ---- pixels ---- */

/* Finds the radiance of an environment, neither tone mapped nor clamped. */
static void find_radiance(const e3d_store *store, int x, int y, int count, colors *out)
{
    float *const planes[3] = {out->red, out->green, out->blue};
    store->pass->kernels->backdrop(&store->pass->frame->backdrop, x, y, count, planes);
}

static void map_tone(const e3d_store *store, int count, colors *row)
{
    const e3d_frame *frame = store->pass->frame;
    float *const planes[3] = {row->red, row->green, row->blue};
    store->pass->kernels->tone(frame->mode == E3D_MODE_LIT ? frame->tone_mapping : E3D_TONE_NONE, planes, count);
}

/* Finds the colours of `count` pixels, from a sample of a tile on. */
static void find_colors(const e3d_store *store, const e3d_tile *tile, int x, int y, int count, colors *out)
{
    int axis = store->pass->frame->samples_axis, column = (tile->x + x) / axis, row = (tile->y + y) / axis;
    if (store->gradient) {
        uint32_t rgba[E3D_TILE + E3D_PAD];
        repeat_codes(store, column, row, count, rgba);
        decode_codes(store, rgba, count, out);
        return;
    }
    find_radiance(store, column, row, count, out);
    map_tone(store, count, out);
}

/* Encodes the colours as pixels. */
static void find_codes(const e3d_store *store, const e3d_tile *tile, int x, int y, int count, uint32_t *rgba)
{
    const e3d_prepared *pass = store->pass;
    int axis = pass->frame->samples_axis;
    colors row;
    if (store->gradient) {
        repeat_codes(store, (tile->x + x) / axis, (tile->y + y) / axis, count, rgba);
        return;
    }
    find_colors(store, tile, x, y, count, &row);
    for (int i = 0; i < count && axis > 1; i++) {
        row.red[i] = e3d_mean_of(row.red[i], axis * axis);
        row.green[i] = e3d_mean_of(row.green[i], axis * axis);
        row.blue[i] = e3d_mean_of(row.blue[i], axis * axis);
    }
    pass->kernels->encode(row.red, row.green, row.blue, count, e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), rgba);
}

static void put_sample(const colors *row, int pixel, int at, e3d_samples *samples)
{
    samples->color[0][at] = row->red[pixel];
    samples->color[1][at] = row->green[pixel];
    samples->color[2][at] = row->blue[pixel];
    samples->counts[at] = 1.0f;
}

/* Fills the rows of samples of one row of pixels. */
static void fill_samples(const colors *row, int axis, int y, e3d_samples *samples)
{
    for (int j = 0; j < axis; j++)
        for (int x = 0; x < E3D_TILE; x++)
            put_sample(row, x / axis, (y + j) * E3D_TILE + x, samples);
}

void e3d_backdrop_fill(const e3d_store *store, e3d_store_memory *memory)
{
    int axis = store->pass->frame->samples_axis;
    colors row;
    for (int y = 0; y < memory->tile.height; y += axis) {
        if (!memory->sampled) {
            find_codes(store, &memory->tile, 0, y, E3D_TILE, memory->rgba + y * E3D_TILE);
            continue;
        }
        find_colors(store, &memory->tile, 0, y, E3D_TILE / axis, &row);
        fill_samples(&row, axis, y, &memory->samples);
    }
}

void e3d_backdrop_pixel(const e3d_store *store, const e3d_tile *tile, int x, int y, float color[4])
{
    colors row;
    find_colors(store, tile, x, y, 1, &row);
    color[0] = row.red[0];
    color[1] = row.green[0];
    color[2] = row.blue[0];
    color[3] = 1.0f;
}

/* How many samples follow each other in a row, from sample `first` on. */
static int run_length(const e3d_batch *batch, int first)
{
    int end = first + 1;
    while (end < batch->count && batch->sample[end] == batch->sample[end - 1] + 1 && batch->sample[end] % E3D_TILE)
        end++;
    return end - first;
}

void e3d_backdrop_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory)
{
    int axis = store->pass->frame->samples_axis;
    for (int i = 0, length; i < batch->count; i += length) {
        colors row;
        uint32_t rgba[E3D_TILE + E3D_PAD];
        int at = batch->sample[i], x = at % E3D_TILE, first = x / axis;
        length = run_length(batch, i);
        int count = (x + length - 1) / axis - first + 1;
        if (memory->sampled)
            find_colors(store, &memory->tile, x, at / E3D_TILE, count, &row);
        else
            find_codes(store, &memory->tile, x, at / E3D_TILE, count, rgba);
        for (int k = 0; k < length; k++) {
            if (!memory->sampled)
                memory->rgba[at + k] = rgba[k];
            else
                put_sample(&row, (x + k) / axis - first, at + k, &memory->samples);
        }
    }
}

void e3d_backdrop_pixels(const e3d_store *store, const e3d_tile *tile, uint32_t *rgba)
{
    int axis = store->pass->frame->samples_axis, width = tile->width / axis;
    for (int y = 0; y < tile->height; y += axis, rgba += E3D_TILE)
        find_codes(store, tile, 0, y, width, rgba);
}

static float finite_or_0(float v) { return fabsf(v) <= FLT_MAX ? v : 0.0f; }

void e3d_backdrop_radiance(const e3d_store *store, const e3d_tile *tile, float (*out)[3])
{
    int axis = store->pass->frame->samples_axis, width = tile->width / axis;
    colors row;
    for (int y = 0; y < tile->height; y += axis, out += E3D_TILE) {
        find_radiance(store, tile->x / axis, (tile->y + y) / axis, width, &row);
        for (int x = 0; x < width; x++) {
            out[x][0] = finite_or_0(row.red[x]);
            out[x][1] = finite_or_0(row.green[x]);
            out[x][2] = finite_or_0(row.blue[x]);
        }
    }
}
