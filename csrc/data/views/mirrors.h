/* Whether the mirrors of a frame can be drawn. */
#pragma once

#include "e3d.h"

static inline int e3d_mirrors_are_valid(const e3d_frame *frame)
{
    if (frame->mirror_count < 0 || frame->mirror_count > E3D_MAX_MIRRORS || (frame->mirror_count && !frame->mirrors))
        return 0;
    for (int32_t i = 0; i < frame->mirror_count; i++) {
        const e3d_mirror *mirror = &frame->mirrors[i];
        if ((mirror->scale != 1 && mirror->scale != 2 && mirror->scale != 4) || mirror->width < 0 || mirror->height < 0 || (mirror->width && mirror->height && !mirror->radiance))
            return 0;
    }
    return 1;
}
