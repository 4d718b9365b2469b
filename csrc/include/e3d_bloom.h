/* Bloom: light above 1 glows around where it comes from. docs/exactness, R124. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_bloom {
    const float *radiance; /* (height, width, 3) */
    uint8_t *color;        /* (height, width, 4) RGBA: the glow is added; alpha stays */
    int32_t width, height; /* 1 .. E3D_MAX_SIZE */
    float strength;        /* 0 .. 2^20 */
    int32_t srgb;          /* colours are sRGB, else linear */
} e3d_bloom;

/* The size of the scratch memory of e3d_add_bloom, in floats. */
size_t e3d_bloom_scratch(int32_t width, int32_t height, int32_t threads);
/* threads: at least 1; their number doesn't change the bytes. scratch: as many floats as e3d_bloom_scratch returns. */
e3d_status e3d_add_bloom(const e3d_bloom *bloom, e3d_backend backend, int32_t threads, float *scratch);

#ifdef __cplusplus
}
#endif
