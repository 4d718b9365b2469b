/* resolve: the outputs other than colour. They are gathered for a tile in the worker's memory, and then go to the pictures row
 * by row. */
#include <math.h>

#include "base/always_inline.h"
#include "e3d.h"
#include "frame/pass/plan.h"
#include "frame/store/backdrop.h"
#include "frame/store/outputs.h"
#include "frame/store/picture.h"

/* The number of words that a pixel of each output has, and the background's word, which all of them hold. */
static const struct {
    int channels;
    union {
        int32_t as_int32_t;
        float as_float;
        uint8_t as_uint8_t;
    } background;
} KINDS[E3D_OUTPUTS] = {
#define KIND(output, name, type, channels, background, ...) {channels, {.as_##type = background}},
    E3D_EACH_OUTPUT(KIND)};

enum { PLACES = E3D_TILE_SAMPLES + E3D_PAD };

int e3d_output_channels(e3d_output_kind kind) { return KINDS[kind].channels; }

void e3d_outputs_prepare(const e3d_targets *targets, e3d_store *out)
{
    out->words = 0;
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        void *target = k == E3D_OUTPUT_COLOR ? NULL : e3d_targets_get(targets, k); /* another function resolves the colour */
        out->outputs[k] = (e3d_output){target, out->words};
        out->words += target ? (size_t)KINDS[k].channels * PLACES : 0;
    }
}

void *e3d_outputs_gathered(const e3d_store *store, const e3d_store_memory *memory, e3d_output_kind kind)
{
    const e3d_output *output = &store->outputs[kind];
    return output->target ? (int32_t *)memory->words.data + output->first : NULL;
}

/* R123: whether the background has radiance. */
static int has_radiance(const e3d_store *store)
{
    return store->outputs[E3D_OUTPUT_RADIANCE].target && e3d_shows_environment(store->pass->frame);
}

void e3d_outputs_begin(const e3d_store *store, e3d_store_memory *memory)
{
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        int32_t *words = e3d_outputs_gathered(store, memory, k), background = KINDS[k].background.as_int32_t;
        if (k == E3D_OUTPUT_NDC_DEPTH) /* put_ndc_depth writes all of it */
            continue;
        for (int i = 0; words && i < KINDS[k].channels * E3D_TILE_SAMPLES; i++)
            words[i] = background;
    }
    if (has_radiance(store))
        e3d_backdrop_radiance(store, &memory->tile, e3d_outputs_gathered(store, memory, E3D_OUTPUT_RADIANCE));
}

void e3d_outputs_again(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory)
{
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        void *pixels = e3d_outputs_gathered(store, memory, k);
        size_t bytes = sizeof(int32_t) * (size_t)KINDS[k].channels;
        if (pixels)
            e3d_read_tile(store->pass, tile, store->outputs[k].target, bytes, pixels, E3D_TILE * bytes);
    }
}

/* Inlined, and all depths are read, so that the compiler makes vectors of neighbouring samples. */
static ALWAYS_INLINE void put_row(const float *restrict z, const int32_t *restrict id, int axis, int count, float *restrict out)
{
    for (int x = 0; x < count; x++) {
        float depth = z[x * axis];
        out[x] = id[x * axis] >= 0 ? depth : INFINITY;
    }
}

static void put_ndc_depth(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory)
{
    float *pixels = e3d_outputs_gathered(store, memory, E3D_OUTPUT_NDC_DEPTH);
    int axis = store->pass->frame->samples_axis, middle = axis / 2;
    for (int y = 0; pixels && y < tile->height / axis; y++, pixels += E3D_TILE) {
        int at = (y * axis + middle) * E3D_TILE + middle;
        if (axis == 1)
            put_row(visible->z + at, visible->id + at, 1, tile->width, pixels);
        else
            put_row(visible->z + at, visible->id + at, axis, tile->width / axis, pixels);
    }
}

void e3d_outputs_end(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory)
{
    put_ndc_depth(store, visible, tile, memory);
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        const void *pixels = e3d_outputs_gathered(store, memory, k);
        size_t bytes = sizeof(int32_t) * (size_t)KINDS[k].channels;
        if (pixels)
            e3d_write_tile(store->pass, tile, store->outputs[k].target, bytes, pixels, E3D_TILE * bytes);
    }
}

/* Row by row. */
static void blank_radiance(const e3d_store *store, const e3d_tile *tile)
{
    int axis = store->pass->frame->samples_axis;
    float pixels[E3D_TILE][3];
    e3d_tile row = *tile;
    row.height = axis;
    for (; row.y < tile->y + tile->height; row.y += axis) {
        e3d_backdrop_radiance(store, &row, pixels);
        e3d_write_tile(store->pass, &row, store->outputs[E3D_OUTPUT_RADIANCE].target, sizeof *pixels, pixels, sizeof pixels);
    }
}

void e3d_outputs_blank(const e3d_store *store, const e3d_tile *tile)
{
    if (has_radiance(store))
        blank_radiance(store, tile);
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        int32_t row[4 * E3D_TILE]; /* room for the most channels that an output has */
        if (!store->outputs[k].target || (k == E3D_OUTPUT_RADIANCE && has_radiance(store)))
            continue;
        for (int i = 0; i < KINDS[k].channels * E3D_TILE; i++)
            row[i] = KINDS[k].background.as_int32_t;
        e3d_write_tile(store->pass, tile, store->outputs[k].target, sizeof(int32_t) * (size_t)KINDS[k].channels, row, 0);
    }
}
