/* The way of colours from light to the picture: fog, tone mapping, and backgrounds that change from row to row. */
#pragma once

#include <stdint.h>

#include "e3d_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How light of any brightness becomes what a screen can show. NONE clamps at 1. NEUTRAL is Khronos PBR Neutral. ACES is Stephen
 * Hill's fit of the reference rendering transform. AGX is Troy Sobotka's, with its base look. */
#define E3D_EACH_TONE_MAPPING(X) X(E3D_TONE_NONE, none) X(E3D_TONE_NEUTRAL, neutral) X(E3D_TONE_ACES, aces) X(E3D_TONE_AGX, agx)
typedef enum e3d_tone_mapping { E3D_EACH_TONE_MAPPING(E3D_ENUMERATOR) E3D_TONE_MAPPINGS } e3d_tone_mapping;

/* NONE must be 0. LINEAR rises from no fog at `near` to all fog at `far`; EXPONENTIAL is 1 - e^-(density depth)^2. */
typedef enum e3d_fog_kind { E3D_FOG_NONE = 0,
                            E3D_FOG_LINEAR,
                            E3D_FOG_EXPONENTIAL } e3d_fog_kind;

typedef struct e3d_fog {
    e3d_fog_kind kind;
    float color[3];     /* the fog over surfaces, lines and points that are not tone mapped */
    float lit_color[3]; /* the fog over those that are; it is added before tone mapping */
    float near, far;    /* linear: depths along the view axis; near < far */
    float density;      /* exponential: per unit of depth, >= 0 */
} e3d_fog;

/* A background that blends from one colour at the top to another at the bottom. Both are display values in [0, 1]. */
typedef struct e3d_gradient {
    /* Not 0: it shows instead of the frame's background, whose alpha must be 1; a backdrop shows instead of both */
    int32_t shows;
    float top[3], bottom[3];
} e3d_gradient;

#ifdef __cplusplus
}
#endif
