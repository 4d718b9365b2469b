/* Half circles around the ends of lines and around points, as corners on the screen (R114). */
#ifndef E3D_ARC_H
#define E3D_ARC_H

#include <stdint.h>

#include "data/half_circle.h"

/* From one side of a line around its end to the other: the last corner is opposite to the first. */
typedef struct e3d_arc {
    int steps;
    int32_t x[E3D_HALF_CIRCLE + 1], y[E3D_HALF_CIRCLE + 1]; /* from the middle, in 1/256 sample */
} e3d_arc;

/* The half circle of a radius (1/256 sample) on the side that (dx, dy) points to; (0, 0) counts as (1, 0). */
void e3d_arc_of(int32_t radius, double dx, double dy, e3d_arc *out);

#endif
