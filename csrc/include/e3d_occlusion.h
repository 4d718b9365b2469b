/* Ambient occlusion: how much of the light from all around reaches what shows in a picture (docs/exactness, section 21). */
#pragma once

#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture of depths, as the output depth: 0 where nothing shows. Pixel (x, y) at depth d is (X * m, Y * m, d) in view space,
 * with X = across[0] * x + across[1] and Y = down[0] * y + down[1]; m is d, or 1 without perspective. */
typedef struct e3d_depth_picture {
    int32_t width, height;
    const float *depth;
    float across[2], down[2]; /* finite; across[0] and down[0] aren't 0 */
    int32_t is_perspective;
} e3d_depth_picture;

/* visibility: (height, width), 1 where nothing within the radius blocks the light, down to 0. scratch: an array of that size.
 * Neither may be the array of depths. radius: in view space, finite and above 0. */
e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                              float *visibility);

#ifdef __cplusplus
}
#endif
