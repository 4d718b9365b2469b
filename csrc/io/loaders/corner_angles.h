/* Vectors in double precision, and angles without libm, whose last bit differs from machine to machine. */
#pragma once

#include <math.h>
#include <stddef.h>

#define PI 3.141592653589793

typedef struct vector {
    double x, y, z;
} vector;

static inline vector minus(vector a, vector b) { return (vector){a.x - b.x, a.y - b.y, a.z - b.z}; }

static inline double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline double length_of(vector v) { return sqrt(dot(v, v)); }

/* acos(x) = sqrt(1 - x) * polynomial(x) for 0 <= x <= 1 to 2e-8 (Abramowitz and Stegun, 4.4.46). */
static inline double arc_cosine(double x)
{
    static const double coefficients[] = {0.0066700901, -0.0170881256, 0.0308918810, -0.0501743046,
                                          0.0889789874, -0.2145988016, 1.5707963050};
    const double size = fabs(x) > 1 ? 1 : fabs(x);
    double polynomial = -0.0012624911;
    for (size_t k = 0; k < sizeof coefficients / sizeof *coefficients; k++)
        polynomial = polynomial * size + coefficients[k];
    const double angle = sqrt(1 - size) * polynomial;
    return x < 0 ? PI - angle : angle;
}
