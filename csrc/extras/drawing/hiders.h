/* Triangles prepared for the search for what hides lines.
 * In: triangles and lines on the drawing and in the world. Out: those that may hide a line, nearest first, in a grid. */
#pragma once

#include "e3d_drawing.h"
#include "extras/drawing/grid.h"

/* The box of a triangle or line on the drawing, in cells of the grid, and a step of its depth. Functions that never descend round
 * both, so that boxes that are apart are apart. */
typedef struct drw_outside {
    float low[2], high[2];
    int32_t step; /* that of the nearest corner */
} drw_outside;

/* The plane of a triangle in the world, with the viewer on its positive side. */
typedef struct drw_plane {
    double place[3], normal[3];
    double limit; /* the thickness, times the length of the normal; infinite for a triangle that hides nothing */
} drw_plane;

typedef struct drw_hiders {
    const e3d_hiders *given;
    size_t count;
    double *corners;       /* (count, 3, 2) on the drawing */
    drw_outside *outsides; /* (count,) with the reach */
    drw_plane *planes;     /* (count,) */
    drw_grid grid;         /* over the lines */
    double nearest, steps_per_depth;
} drw_hiders;

e3d_status drw_hiders_prepare(drw_hiders *all, const e3d_hiders *given, const e3d_lines *lines);
void drw_hiders_free(drw_hiders *all);

/* `at`: corners on the drawing. */
drw_outside drw_outside_of(const drw_hiders *all, const double *at, int corners, double reach, double depth);
static inline int drw_outsides_meet(const drw_outside *a, const drw_outside *b)
{
    return (a->low[0] <= b->high[0]) & (a->low[1] <= b->high[1]) & (b->low[0] <= a->high[0]) & (b->low[1] <= a->high[1]);
}
