/* Ambient occlusion: how much of the light from all around reaches what shows in a picture (docs/exactness, section 21). */
#ifndef E3D_API_OCCLUSION_H
#define E3D_API_OCCLUSION_H

#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture of depths, as the output depth has them: 0 where nothing shows. In view space, with z the depth, pixel (x, y) at depth d
 * shows (X*m, Y*m, d), X = across[0]*x + across[1], Y = down[0]*y + down[1], where m is d, or without perspective 1. */
typedef struct e3d_depth_picture {
    int32_t width, height;
    const float *depth;
    float across[2], down[2]; /* finite; the first of each isn't 0 */
    int32_t is_perspective;
} e3d_depth_picture;

/* visibility: (height, width), each 1 where nothing nearer than the radius is in the way of light, down to 0. scratch: as large. Both
 * differ from the depths. radius: in view space, more than 0 and finite. */
e3d_status e3d_find_occlusion(e3d_backend backend, int32_t threads, const e3d_depth_picture *picture, float radius, float *scratch,
                              float *visibility);

#ifdef __cplusplus
}
#endif

#endif
