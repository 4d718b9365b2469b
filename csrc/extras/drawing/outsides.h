/* Boxes on the drawing that tell at once that most things are apart.
 * In: the boxes of triangles, lines or segments. Out: whether two meet. */
#pragma once

#include "base/vectors.h"

/* The lower limits of a box, and its upper ones negated. A function that never descends rounds them, so that boxes that are apart
 * are apart. */
typedef float4 drw_outside;

/* What a box must not exceed to meet another one. */
static inline drw_outside drw_opposite(drw_outside box) { return -LANES(box, box, 2, 3, 0, 1); }
static inline int drw_meets(drw_outside box, drw_outside opposite) { return lanes_of(box <= opposite) == 15; }
