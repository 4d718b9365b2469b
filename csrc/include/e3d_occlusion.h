/* Ambient occlusion: how much of the light from all around reaches what shows in a picture (docs/exactness, section 21). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture of depths and normals, as these outputs: 0 where nothing shows. Pixel (x, y) at depth d is (X * m, Y * m, d) in
 * view space, whose third axis points away here, with X = across[0] * x + across[1] and Y = down[0] * y + down[1]; m is d, or 1
 * without perspective. */
typedef struct e3d_depth_picture {
    int32_t width, height;
    const float *depth;  /* (height, width) */
    const float *normal; /* (height, width, 3), as the output: the third axis points to the viewer */
    float across[2], down[2]; /* finite; across[0] and down[0] aren't 0 */
    int32_t is_perspective;
} e3d_depth_picture;

/* The size of the scratch memory of e3d_find_occlusion, in floats; 0 if there is no such picture. */
size_t e3d_occlusion_scratch(int32_t width, int32_t height);
/* visibility: (height, width), 1 where nothing within the radius blocks the light, down to 0; not the array of depths. scratch:
 * as many floats as e3d_occlusion_scratch returns. radius: in view space, finite and above 0. */
e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                              float *visibility);

#ifdef __cplusplus
}
#endif
