/* Boxes around points. */
#pragma once

#include <math.h>
#include <stdint.h>

/* Extends a box by a point, if that is finite; *any tells whether the box holds a point already. */
static inline void e3d_grow_bounds(const float *p, float lo[3], float hi[3], int32_t *any)
{
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
        return;
    for (int k = 0; k < 3; k++) {
        lo[k] = *any && lo[k] < p[k] ? lo[k] : p[k];
        hi[k] = *any && hi[k] > p[k] ? hi[k] : p[k];
    }
    *any = 1;
}
