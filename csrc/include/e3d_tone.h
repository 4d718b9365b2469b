/* What becomes of colours between light and the picture: fog, tone mapping, and backgrounds that change from row to row. */
#ifndef E3D_API_TONE_H
#define E3D_API_TONE_H

#include <stdint.h>

#include "e3d_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How light of any brightness becomes what a screen can show. NONE: what is above 1 shows as 1. NEUTRAL: Khronos PBR Neutral. ACES:
 * Stephen Hill's fit of the reference rendering transform. AGX: Troy Sobotka's, with its base look. */
#define E3D_EACH_TONE_MAPPING(X) X(E3D_TONE_NONE, none) X(E3D_TONE_NEUTRAL, neutral) X(E3D_TONE_ACES, aces) X(E3D_TONE_AGX, agx)
typedef enum e3d_tone_mapping { E3D_EACH_TONE_MAPPING(E3D_ENUMERATOR) E3D_TONE_MAPPINGS } e3d_tone_mapping;

/* NONE must be 0. LINEAR: all fog from a depth on; EXPONENTIAL: 1 - e^-(density depth)^2 of it. */
typedef enum e3d_fog_kind { E3D_FOG_NONE = 0,
                            E3D_FOG_LINEAR,
                            E3D_FOG_EXPONENTIAL } e3d_fog_kind;

typedef struct e3d_fog {
    e3d_fog_kind kind;
    float color[3];     /* over surfaces, lines and points that are not tone mapped */
    float lit_color[3]; /* over those that are: before the tone mapper */
    float near, far;    /* linear: depths along the view axis; near < far */
    float density;      /* exponential: per unit of depth, >= 0 */
} e3d_fog;

/* A background that goes from one colour to another, row by row. Display values in [0, 1], above and below the picture. */
typedef struct e3d_gradient {
    int32_t shows; /* instead of the frame's background, whose alpha must be 1; a backdrop shows instead of both */
    float top[3], bottom[3];
} e3d_gradient;

#ifdef __cplusplus
}
#endif

#endif
