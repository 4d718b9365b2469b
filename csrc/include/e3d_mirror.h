/* Mirrors: planes that show what they reflect, by pictures that were drawn before (docs/exactness, section 27). */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { E3D_MAX_MIRRORS = 16 };

typedef struct e3d_mirror {
    float plane[4];  /* n and d: points p of the plane have n.p = d (world) */
    float slack;     /* how far from the plane a face's corners may lie */
    /* Where the picture lies in the frame's samples, with multisampling in its pixels */
    int32_t left, top, width, height;
    int32_t scale;         /* 1, 2 or 4: a sample has the mean of scale x scale pixels of the picture */
    const float *radiance; /* (scale * height, scale * width, 3) */
} e3d_mirror;

#ifdef __cplusplus
}
#endif
