/* What is behind glass: a picture of what isn't blended, ever more blurred from level to level, which glass shows bent
 * (docs/exactness, section 25). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_frame.h"
#include "e3d_status.h"
#include "e3d_tone.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture of what isn't blended (e3d_frame.opaque_only); with several samples a pixel, edges are as smooth behind glass. */
typedef struct e3d_behind {
    const float *radiance; /* (height, width, 3) */
    const uint8_t *color;  /* (height, width, 4) RGBA */
    int32_t width, height; /* 1 .. E3D_MAX_SIZE */
    int32_t srgb;          /* colours are sRGB, else linear */
    int32_t is_transparent; /* the background's alpha is 0 */
    e3d_tone_mapping tone_mapping;
} e3d_behind;

/* Whether a frame in mode lit draws glass that bends or blurs what is behind it. It reads draws and materials alone. */
int e3d_refracts(const e3d_frame *frame);
/* The size of e3d_frame.behind for a picture, in floats. */
size_t e3d_behind_floats(int32_t width, int32_t height);
/* Finds the levels. threads: at least 1; their number doesn't change the bytes. levels: as many floats as e3d_behind_floats returns. */
e3d_status e3d_find_behind(const e3d_behind *picture, e3d_backend backend, int32_t threads, float *levels);

#ifdef __cplusplus
}
#endif
