/* A tree of boxes over triangles, four below each, to find those that may touch.
 * In: the triangles' places. Out: the tree, whose leaves are triangles in the order of a curve that fills space. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/vectors.h"
#include "e3d_status.h"

/* Four boxes, rounded outward. */
typedef struct drw_four {
    float4 low[3], high[3];
} drw_four;

enum { DRW_LEVELS = 17 };

/* Level 0 holds the triangles' boxes, padded with empty ones; box i of a level is around four i of the one below it. */
typedef struct drw_boxes {
    drw_four *levels[DRW_LEVELS];
    size_t fours[DRW_LEVELS]; /* of each level */
    int depth;                /* levels */
    int32_t *items;           /* the triangle of each box of level 0; -1 for padding */
} drw_boxes;

/* Triangles with a corner that is not finite have empty boxes. */
e3d_status drw_boxes_build(drw_boxes *boxes, const double *places, const int32_t *faces, size_t count, double margin);
void drw_boxes_free(drw_boxes *boxes);

/* A box of four alone, in all lanes. */
static inline drw_four drw_one_of(const drw_four *four, int lane)
{
    drw_four one;
    for (int k = 0; k < 3; k++) {
        one.low[k] = splat(four->low[k][lane]);
        one.high[k] = splat(four->high[k][lane]);
    }
    return one;
}

/* The box around four, in all lanes. */
static inline drw_four drw_around(const drw_four *four)
{
    drw_four around;
    for (int k = 0; k < 3; k++) {
        float4 low = less_of(four->low[k], LANES(four->low[k], four->low[k], 2, 3, 0, 1));
        float4 high = more_of(four->high[k], LANES(four->high[k], four->high[k], 2, 3, 0, 1));
        around.low[k] = less_of(low, LANES(low, low, 1, 0, 3, 2));
        around.high[k] = more_of(high, LANES(high, high, 1, 0, 3, 2));
    }
    return around;
}

/* A bit for each lane whose boxes meet. */
static inline int drw_fours_meet(const drw_four *a, const drw_four *b)
{
    int4 meet = (a->low[0] <= b->high[0]) & (b->low[0] <= a->high[0]);
    for (int k = 1; k < 3; k++)
        meet &= (a->low[k] <= b->high[k]) & (b->low[k] <= a->high[k]);
    return lanes_of(meet);
}
