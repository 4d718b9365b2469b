/* ambient: the share of ambient light that reaches the samples of a batch (R129). */
#include <stdint.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/pass/view.h"
#include "frame/shade/ambient.h"

/* The pixel of a sample, from the tile's first one on. */
static ALWAYS_INLINE intptr_t pixel_of(int32_t sample, int32_t width, int shift)
{
    int32_t x = sample & (E3D_TILE - 1), y = sample >> E3D_TILE_SHIFT;
    return (intptr_t)(y >> shift) * width + (x >> shift);
}

/* Inlined for each `shift`, so that the compiler sees a constant. The picture is in no cache near: what the next batch needs, most
 * likely the rows below, is fetched ahead. */
static ALWAYS_INLINE void find_shifted(const e3d_frame *frame, const e3d_tile *tile, int shift, e3d_batch *batch)
{
    enum { LINE = 16 };
    const float *first = frame->ambient_visibility + (size_t)(tile->y >> shift) * (size_t)frame->width + (tile->x >> shift);
    int32_t width = frame->width, count = e3d_padded_count(batch);
    for (int i = 0; i < count; i += LINE)
        __builtin_prefetch(first + pixel_of(batch->sample[i] + count, width, shift));
    for (int i = 0; i < count; i++)
        batch->visibility[i] = first[pixel_of(batch->sample[i], width, shift)];
}

static void find(const e3d_frame *frame, const e3d_tile *tile, e3d_batch *batch)
{
    if (frame->samples_axis == 4)
        find_shifted(frame, tile, 2, batch);
    else if (frame->samples_axis == 2)
        find_shifted(frame, tile, 1, batch);
    else
        find_shifted(frame, tile, 0, batch);
}

void e3d_find_visibility(const e3d_prepared *pass, const e3d_shade_out *out)
{
    e3d_batch *batch = &out->memory->batch;
    if (!pass->frame->ambient_visibility)
        return;
    if (out->sink == E3D_SINK_PIXELS || out->sink == E3D_SINK_SOLID)
        find(pass->frame, &out->pixels->tile, batch);
    else
        for (int i = 0; i < e3d_padded_count(batch); i++)
            batch->visibility[i] = 1.0f;
}
