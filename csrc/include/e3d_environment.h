/* Environments: light that comes from all around, as a picture of the whole sphere. docs/exactness, section 13. */
#ifndef E3D_API_ENVIRONMENT_H
#define E3D_API_ENVIRONMENT_H

#include <stdint.h>

#include "e3d_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct e3d_environment e3d_environment;

/* Level l holds the environment as a mirror of roughness l / (E3D_ENVIRONMENT_LEVELS - 1) shows it. */
enum { E3D_ENVIRONMENT_LEVELS = 9,
       E3D_MAX_ENVIRONMENT_SIZE = 16384 };

/* The faces of a cube, +X -X +Y -Y +Z -Z as OpenGL lays them out, each within a border of one texel of its neighbours. */
typedef struct e3d_environment_level {
    const float *texels; /* (6, size + 2, size + 2, 4): red, green, blue, 0 */
    int32_t size;        /* of a face, without its border */
} e3d_environment_level;

/* The last level is irradiance / pi by normal: a rough mirror of 1 gathers light as white Lambert does. */
typedef struct e3d_environment_view {
    e3d_environment_level levels[E3D_ENVIRONMENT_LEVELS];
} e3d_environment_view;

/* pixels: (height, width, 3) linear radiance, top row first, not kept: column u = atan2(z, x) / 2 pi + 1/2 of the width, row
 * asin(y) / pi + 1/2 of the height from below. What isn't finite or is below 0 counts as 0, what is above 2^40 as that.
 * threads: at least 1; the bytes don't depend on it. */
e3d_status e3d_environment_create(const float *pixels, int32_t width, int32_t height, int threads, e3d_environment **out);
void e3d_environment_destroy(e3d_environment *environment);
const e3d_environment_view *e3d_environment_get_view(const e3d_environment *environment);

/* An environment as a frame uses it: turned about +Y by an angle (counter-clockwise from above), and brighter or darker. */
typedef struct e3d_environment_light {
    const e3d_environment *environment; /* or NULL: there is none */
    float cosine, sine;                 /* of the angle */
    float intensity;                    /* factor of the radiance */
} e3d_environment_light;

/* An environment as the background: what is seen along the rays of the pixels. */
typedef struct e3d_backdrop {
    e3d_environment_light light;
    float level;                       /* 0 .. E3D_ENVIRONMENT_LEVELS - 1: how blurred */
    float ray[3], across[3], down[3];  /* world: the ray of the picture's top left corner, and what each pixel adds */
} e3d_backdrop;

/* What surfaces reflect of light that is 1 all around (R64): node (i, j) of 64 x 64 is for roughness i / 63 and a cosine between
 * normal and viewer of (j / 63)^2. GGX reflects F0 * A + B; SHEEN is that of Charlie's distribution with
 * the visibility 1 / (4 (n.l + n.v - (n.l)(n.v))), at most 1. */
enum { E3D_DFG_SIZE = 64 };
typedef enum e3d_dfg { E3D_DFG_A, E3D_DFG_B, E3D_DFG_SHEEN, E3D_DFG_TABLES } e3d_dfg;
extern const float E3D_DFG_TABLE[E3D_DFG_TABLES][E3D_DFG_SIZE * E3D_DFG_SIZE];

#ifdef __cplusplus
}
#endif

#endif
