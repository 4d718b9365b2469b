/* resolve: the outputs beside colour. Those of a tile are gathered in the worker's memory, then go to the pictures row by row. */
#include <math.h>

#include "core/grow.h"
#include "core/limits.h"
#include "e3d.h"
#include "kernels/types/visible.h"
#include "pipeline/pass/view.h"
#include "pipeline/state/context.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/picture.h"

/* How many words a pixel of each output has, and the word that all of them hold in the background. */
static const struct {
    int channels;
    union {
        int32_t as_int32_t;
        float as_float;
        uint8_t as_uint8_t;
    } background;
} KINDS[E3D_OUTPUTS] = {
#define KIND(output, name, type, channels, background, ...) {channels, {.as_##type = background}},
    E3D_EACH_OUTPUT(KIND)
};

enum { PLACES = E3D_TILE_SAMPLES + E3D_PAD };

int e3d_output_channels(e3d_output_kind kind) { return KINDS[kind].channels; }

int e3d_outputs_prepare(e3d_context *context)
{
    size_t words = 0;
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        void *target = k == E3D_OUTPUT_COLOR ? NULL : e3d_targets_get(context->targets, k); /* which others resolve */
        context->outputs[k] = (e3d_output){target, words};
        words += target ? (size_t)KINDS[k].channels * PLACES : 0;
    }
    for (int32_t w = 0; w < context->renderer->threads; w++)
        if (!e3d_array_reserve(&context->renderer->workers[w]->outputs.words, words, sizeof(int32_t)))
            return 0;
    return 1;
}

void *e3d_outputs_gathered(const e3d_context *context, const e3d_worker *worker, e3d_output_kind kind)
{
    const e3d_output *output = &context->outputs[kind];
    return output->target ? (int32_t *)worker->outputs.words.data + output->first : NULL;
}

void e3d_outputs_begin(const e3d_context *context, e3d_worker *worker)
{
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        int32_t *words = e3d_outputs_gathered(context, worker, k), background = KINDS[k].background.as_int32_t;
        for (int i = 0; words && i < KINDS[k].channels * E3D_TILE_SAMPLES; i++)
            words[i] = background;
    }
}

void e3d_outputs_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        void *pixels = e3d_outputs_gathered(context, worker, k);
        size_t bytes = sizeof(int32_t) * (size_t)KINDS[k].channels;
        if (pixels)
            e3d_read_tile(context, tile, context->outputs[k].target, bytes, pixels, E3D_TILE * bytes);
    }
}

static void put_ndc_depth(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile)
{
    float *pixels = e3d_outputs_gathered(context, worker, E3D_OUTPUT_NDC_DEPTH);
    const e3d_visible_tile *visible = worker->visible;
    int axis = context->frame->samples_axis, middle = axis / 2;
    for (int y = 0; pixels && y < tile->height / axis; y++)
        for (int x = 0; x < tile->width / axis; x++) {
            int at = (y * axis + middle) * E3D_TILE + x * axis + middle;
            pixels[y * E3D_TILE + x] = visible->id[at] >= 0 ? visible->z[at] : INFINITY;
        }
}

void e3d_outputs_end(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile)
{
    put_ndc_depth(context, worker, tile);
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        const void *pixels = e3d_outputs_gathered(context, worker, k);
        size_t bytes = sizeof(int32_t) * (size_t)KINDS[k].channels;
        if (pixels)
            e3d_write_tile(context, tile, context->outputs[k].target, bytes, pixels, E3D_TILE * bytes);
    }
}

void e3d_outputs_blank(const e3d_context *context, const e3d_tile *tile)
{
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        int32_t row[3 * E3D_TILE];
        if (!context->outputs[k].target)
            continue;
        for (int i = 0; i < KINDS[k].channels * E3D_TILE; i++)
            row[i] = KINDS[k].background.as_int32_t;
        e3d_write_tile(context, tile, context->outputs[k].target, sizeof(int32_t) * (size_t)KINDS[k].channels, row, 0);
    }
}
