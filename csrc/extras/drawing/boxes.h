/* A tree of boxes over triangles, to find those that may touch.
 * In: the triangles' places. Out: the tree, whose leaves are triangles in the order of a curve that fills space. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_status.h"

typedef struct drw_box {
    double low[3], high[3];
} drw_box;

/* Level 0 holds a box for each triangle, padded with empty ones to a power of two; box i of a level is above boxes 2 i and 2 i + 1
 * of the one below it. */
typedef struct drw_boxes {
    drw_box *levels[33];
    int depth; /* levels */
    int32_t *items; /* the triangle of each box of level 0; -1 for padding */
} drw_boxes;

/* Empty if a corner is not finite. */
drw_box drw_box_of(const double *places, const int32_t *face, double margin);
e3d_status drw_boxes_build(drw_boxes *boxes, const double *places, const int32_t *faces, size_t count, double margin);
void drw_boxes_free(drw_boxes *boxes);

static inline int drw_boxes_meet(const drw_box *a, const drw_box *b)
{
    int meet = 1;
    for (int k = 0; k < 3; k++)
        meet &= (a->low[k] <= b->high[k]) & (b->low[k] <= a->high[k]);
    return meet;
}
