/* What casts exact shadows: draws that a frame's lights may be hidden by, in the picture or not. */
#ifndef E3D_API_CASTERS_H
#define E3D_API_CASTERS_H

#include <stdint.h>

#include "e3d_draw.h"
#include "e3d_material.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Their order does not matter. Lines and points cast nothing. */
typedef struct e3d_casters {
    const e3d_draw *draws;
    int32_t draw_count;
    const e3d_material *materials; /* that the draws count from their own bases */
    int32_t material_count;
    /* 0, or a number that stands for these draws as they are: for as long as it stays, a renderer keeps what it found out about them. */
    int64_t version;
} e3d_casters;

#ifdef __cplusplus
}
#endif

#endif
