/* The places of a pixel's samples with multisampling (R103). */
#pragma once

#include <stdint.h>

enum { E3D_MOST_MSAA_SAMPLES = 16 };

/* Offsets of the samples from the pixel's centre, in 1/256 pixel, Y down. */
typedef struct e3d_sample_pattern {
    int32_t count;
    int32_t reach; /* the greatest offset along an axis */
    int32_t x[E3D_MOST_MSAA_SAMPLES], y[E3D_MOST_MSAA_SAMPLES];
} e3d_sample_pattern;

/* The pattern of 2, 4, 8 or 16 samples; NULL for other numbers. */
const e3d_sample_pattern *e3d_sample_pattern_of(int32_t samples);
