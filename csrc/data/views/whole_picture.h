/* The picture that a frame is a part of, such as the one with the mirror that shows the frame (R273). */
#pragma once

#include <math.h>

#include "e3d.h"

typedef struct e3d_whole {
    int32_t width, height; /* its pixels */
    float fineness;        /* pixels of the frame that are side by side in one of it */
} e3d_whole;

static inline e3d_whole e3d_whole_of(const e3d_frame *frame)
{
    return frame->whole_width ? (e3d_whole){frame->whole_width, frame->whole_height, frame->fineness}
                              : (e3d_whole){frame->width, frame->height, 1.0f};
}

static inline int e3d_whole_is_valid(const e3d_frame *frame)
{
    const e3d_whole whole = e3d_whole_of(frame);
    return whole.width >= 1 && whole.height >= 1 && whole.width <= E3D_MAX_SIZE && whole.height <= E3D_MAX_SIZE &&
           whole.fineness > 0.0f && isfinite(whole.fineness);
}
