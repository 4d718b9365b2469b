/* Area lights at a sample (R231-R236). */
#pragma once

#include "reference/surface.h"

/* A light as seen from a sample: its middle, the vectors of its extent, and its corners along these. */
typedef struct ref_area {
    float d[3], u[3], v[3], window;
    const float (*corner)[2];
    int corners;
} ref_area;

/* R233: the axes of a lobe: where it leans, beside that, and the normal. */
typedef struct ref_area_frame {
    float axis[3][3], sine, cosine;
} ref_area_frame;

/* A light on a sample: the light in the axes of a frame, the mean direction to it, the share of it that arrives, e of R236. */
typedef struct ref_area_lit {
    ref_area turned;
    float l[3], share, e;
} ref_area_lit;

/* Finds the light as seen from p; returns 0 if it doesn't reach p. */
int ref_area_reach(const e3d_light *light, const float p[3], ref_area *out);
void ref_find_area_frame(const float normal[3], const float view[3], ref_area_frame *out);
/* Turns a light to the axes of a frame. */
void ref_area_turn(const ref_area_frame *frame, ref_area *area);
/* R235 */
void ref_area_integral(const ref_area *seen, float sum[3]);
/* R234: sum_z of the light as a lobe sees it. */
float ref_area_shine(const ref_area *turned, const ref_area_frame *frame, float roughness);
/* R236: returns 0 if light n adds nothing. */
int ref_area_light(const e3d_frame *frame, int32_t n, const ref_surface *s, const ref_area_frame *axes, ref_area_lit *out);
