/* The casters of exact shadows: draws that may hide a frame's lights, whether the picture shows them or not. */
#pragma once

#include <stdint.h>

#include "e3d_draw.h"
#include "e3d_material.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The order of the draws does not matter. Lines and points cast no shadows. */
typedef struct e3d_casters {
    const e3d_draw *draws;
    int32_t draw_count;
    const e3d_material *materials; /* the draws' material_base counts from here */
    int32_t material_count;
    /* A number of this list of draws, or 0. While it stays the same, a renderer keeps what it found out about the draws. */
    int64_t version;
} e3d_casters;

#ifdef __cplusplus
}
#endif
