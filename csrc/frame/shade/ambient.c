/* ambient: the share of ambient light that reaches the samples of a batch (R129). */
#include <stdint.h>

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/pass/view.h"
#include "frame/shade/ambient.h"

/* Inlined for each `shift`, so that the compiler sees a constant. */
static ALWAYS_INLINE void find_shifted(const e3d_frame *frame, const e3d_tile *tile, int shift, e3d_batch *batch)
{
    const float *first = frame->ambient_visibility + (size_t)(tile->y >> shift) * (size_t)frame->width + (tile->x >> shift);
    for (int i = 0; i < e3d_padded_count(batch); i++) {
        int32_t x = batch->sample[i] & (E3D_TILE - 1), y = batch->sample[i] >> E3D_TILE_SHIFT;
        batch->visibility[i] = first[(intptr_t)(y >> shift) * frame->width + (x >> shift)];
    }
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
