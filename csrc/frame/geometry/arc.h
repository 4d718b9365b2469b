/* Half circles around the ends of lines and around points, as corners on the screen (R114). */
#pragma once

#include <stdint.h>

#include "data/half_circle.h"

/* The half circle around a line's end, from one side of the line to the other; the last corner is opposite to the first. */
typedef struct e3d_arc {
    int steps;
    int32_t x[E3D_HALF_CIRCLE + 1], y[E3D_HALF_CIRCLE + 1]; /* from the centre, in 1/256 sample */
} e3d_arc;

/* Finds the half circle of a radius, in 1/256 sample, on the side that (dx, dy) points to; (0, 0) counts as (1, 0). */
void e3d_arc_of(int32_t radius, double dx, double dy, e3d_arc *out);
