/* Numbers and sizes of pictures that programs tend to get wrong. */
#pragma once

#include <stdint.h>

#include "check/driver/random.h"

float hostile_float(random_stream *r);
/* The same for factors of light: zero, denormal, tiny or huge, and always finite. */
float hostile_factor(random_stream *r);
/* NaN, infinite, close to the largest, denormal or -0. */
float hostile_extreme(random_stream *r);
/* Fills an array with numbers from -size to size; if `hostile`, about one in 20 is extreme. */
void hostile_fill(random_stream *r, float *out, size_t count, float size, int hostile);
/* Replaces about one value in `odds`. */
void hostile_replace(float *values, int32_t count, random_stream *r, int32_t odds);
/* Mostly one of the larger sizes. Sides are limited to `most_side` pixels; 0: by nothing. */
void hostile_size(random_stream *r, int32_t most_side, int32_t *width, int32_t *height);
