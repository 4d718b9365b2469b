/* resolve: where an environment is the background, its colours are looked up pixel by pixel (R63); all samples of a pixel share one. */
#include "core/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"
#include "pipeline/store/backdrop.h"
#include "pipeline/store/store.h"

/* Clamped colours of pixels of a row. */
typedef struct colors {
    float red[E3D_TILE + E3D_PAD], green[E3D_TILE + E3D_PAD], blue[E3D_TILE + E3D_PAD];
} colors;

/* Of `count` pixels from a sample of a tile on. */
static void find_colors(const e3d_store *store, const e3d_tile *tile, int x, int y, int count, colors *out)
{
    const e3d_prepared *pass = store->pass;
    int axis = pass->frame->samples_axis;
    float *const planes[3] = {out->red, out->green, out->blue};
    pass->kernels->backdrop(&pass->frame->backdrop, (tile->x + x) / axis, (tile->y + y) / axis, count, planes);
}

static void encode(const e3d_store *store, const colors *row, int count, uint32_t *rgba)
{
    const e3d_prepared *pass = store->pass;
    pass->kernels->encode(row->red, row->green, row->blue, count, e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), rgba);
}

static void put_sample(const colors *row, int pixel, int at, e3d_samples *samples)
{
    samples->color[0][at] = row->red[pixel];
    samples->color[1][at] = row->green[pixel];
    samples->color[2][at] = row->blue[pixel];
    samples->counts[at] = 1.0f;
}

/* Rows of samples of one row of pixels. */
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
        find_colors(store, &memory->tile, 0, y, E3D_TILE / axis, &row);
        if (memory->sampled)
            fill_samples(&row, axis, y, &memory->samples);
        else
            encode(store, &row, E3D_TILE, memory->rgba + y * E3D_TILE);
    }
}

void e3d_backdrop_pixel(const e3d_store *store, int32_t x, int32_t y, float color[4])
{
    const e3d_prepared *pass = store->pass;
    colors row;
    float *const planes[3] = {row.red, row.green, row.blue};
    pass->kernels->backdrop(&pass->frame->backdrop, x, y, 1, planes);
    color[0] = row.red[0];
    color[1] = row.green[0];
    color[2] = row.blue[0];
    color[3] = 1.0f;
}

/* How many samples from one on follow each other in a row. */
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
        find_colors(store, &memory->tile, x, at / E3D_TILE, count, &row);
        if (!memory->sampled)
            encode(store, &row, count, rgba);
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
    colors row;
    for (int y = 0; y < tile->height; y += axis, rgba += E3D_TILE) {
        find_colors(store, tile, 0, y, width, &row);
        for (int x = 0; x < width && axis > 1; x++) {
            row.red[x] = e3d_mean_of(row.red[x], axis * axis);
            row.green[x] = e3d_mean_of(row.green[x], axis * axis);
            row.blue[x] = e3d_mean_of(row.blue[x], axis * axis);
        }
        encode(store, &row, width, rgba);
    }
}
