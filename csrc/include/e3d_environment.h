/* Environments: light that comes from all around, as a picture of the whole sphere. docs/exactness, section 13. */
#pragma once

#include <stdint.h>

#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_environment e3d_environment;

/* Level l shows the environment as a mirror of roughness l / (E3D_ENVIRONMENT_LEVELS - 1) reflects it. */
enum { E3D_ENVIRONMENT_LEVELS = 9,
       E3D_MAX_ENVIRONMENT_SIZE = 16384 };

/* The faces of a cube, +X -X +Y -Y +Z -Z in OpenGL's layout. A border of one texel around each face repeats its neighbours. */
typedef struct e3d_environment_level {
    const float *texels; /* (6, size + 2, size + 2, 4): red, green, blue, 0 */
    int32_t size;        /* of a face, without its border */
} e3d_environment_level;

/* The last level is irradiance / pi by normal: GGX of roughness 1 gathers light as white Lambert does. */
typedef struct e3d_environment_view {
    e3d_environment_level levels[E3D_ENVIRONMENT_LEVELS];
} e3d_environment_view;

/* Builds the levels from pixels, (height, width, 3) linear radiance, top row first, which are not kept. The column is (atan2(z,
 * x) / 2 pi + 1/2) of the width, the row (asin(y) / pi + 1/2) of the height from below. A number that isn't finite or is below 0
 * counts as 0, and one above 2^40 as 2^40. threads: at least 1; their number doesn't change the bytes. */
e3d_status e3d_environment_create(const float *pixels, int32_t width, int32_t height, int threads, e3d_environment **out);
void e3d_environment_destroy(e3d_environment *environment);
const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment);

/* An environment as a frame uses it: turned about +Y (counter-clockwise from above), and scaled in brightness. */
typedef struct e3d_environment_light {
    const e3d_environment *environment; /* or NULL: there is none */
    float cosine, sine;                 /* of the angle */
    float intensity;                    /* factor of the radiance */
} e3d_environment_light;

/* An environment as the background: a pixel shows the radiance along its ray. */
typedef struct e3d_backdrop {
    e3d_environment_light light;
    float level;                       /* 0 .. E3D_ENVIRONMENT_LEVELS - 1: how blurred */
    /* World: the ray of the picture's top left corner, and the steps from a pixel to the next one across and down */
    float ray[3], across[3], down[3];
} e3d_backdrop;

/* Directional albedos (R64): what a surface reflects of light that is 1 all around. Node (i, j) of 64 x 64 is for roughness i /
 * 63 and a cosine between normal and viewer of (j / 63)^2. GGX reflects F0 * A + B. SHEEN is Charlie's distribution with the
 * visibility 1 / (4 (n.l + n.v - (n.l)(n.v))), at most 1. */
enum { E3D_DFG_SIZE = 64 };
typedef enum e3d_dfg { E3D_DFG_A,
                       E3D_DFG_B,
                       E3D_DFG_SHEEN,
                       E3D_DFG_TABLES } e3d_dfg;
extern const float E3D_DFG_TABLE[E3D_DFG_TABLES][E3D_DFG_SIZE * E3D_DFG_SIZE];

#ifdef __cplusplus
}
#endif
