/* NaN, infinite, denormal and huge numbers; odd and tiny sizes. */
#include "check/driver/hostile.h"

#include <math.h>

static const int32_t SIZES[][2] = {
    {64, 64}, {65, 63}, {129, 97}, {160, 120}, {31, 200}, {7, 3}, {1, 1}, {1, 300}, {300, 1}};
static const float HOSTILE[] = {
    0.0f, -0.0f, 1e-45f, -1e-39f, 1e-20f, 1e20f, -3e38f, INFINITY, -INFINITY, NAN, 32768.0f, 0.5f};
static const float EXTREME[] = {NAN, INFINITY, -INFINITY, 1e38f, -1e38f, 1e-40f, -0.0f};

enum { FLOATS = sizeof HOSTILE / sizeof *HOSTILE,
       FACTORS = 6 /* the first of them */ };

float hostile_float(random_stream *r) { return HOSTILE[random_below(r, FLOATS)]; }

float hostile_factor(random_stream *r) { return HOSTILE[random_below(r, FACTORS)]; }

float hostile_extreme(random_stream *r) { return EXTREME[random_below(r, sizeof EXTREME / sizeof *EXTREME)]; }

void hostile_fill(random_stream *r, float *out, size_t count, float size, int hostile)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = random_float(r, -size, size);
        if (hostile && random_once_in(r, 20))
            out[i] = hostile_extreme(r);
    }
}

void hostile_replace(float *values, int32_t count, random_stream *r, int32_t odds)
{
    for (int32_t i = 0; i < count; i++)
        if (random_once_in(r, odds))
            values[i] = hostile_float(r);
}

static int32_t limited(int32_t side, int32_t most) { return most > 0 && side > most ? most : side; }

void hostile_size(random_stream *r, int32_t most_side, int32_t *width, int32_t *height)
{
    int32_t count = random_once_in(r, 4) ? (int32_t)(sizeof SIZES / sizeof *SIZES) : 5;
    const int32_t *size = SIZES[random_below(r, count)];
    *width = limited(size[0], most_side);
    *height = limited(size[1], most_side);
}
