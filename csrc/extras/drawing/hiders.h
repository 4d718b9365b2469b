/* Triangles prepared for the search for what hides lines.
 * In: triangles and lines on the drawing and in the world. Out: those that may hide a line, nearest first, in a grid. */
#pragma once

#include "e3d_drawing.h"
#include "extras/drawing/grid.h"
#include "extras/drawing/outsides.h"

/* The plane of a triangle in the world, with the viewer on its positive side. */
typedef struct drw_plane {
    double place[3], normal[3];
    double limit; /* the thickness, times the length of the normal; infinite for a triangle that hides nothing */
} drw_plane;

/* Depths are told apart by so many steps. */
enum { DRW_STEPS = 2048 };

typedef struct drw_hiders {
    const e3d_hiders *given;
    size_t count;
    double *corners;       /* (count, 3, 2) on the drawing */
    drw_outside *outsides; /* (count,) with the reach */
    int32_t *nearer;       /* (DRW_STEPS,): how many triangles have at most a step of depth */
    drw_plane *planes;     /* (count,) */
    drw_grid grid;         /* over the lines */
    double nearest, steps_per_depth;
} drw_hiders;

e3d_status drw_hiders_prepare(drw_hiders *all, const e3d_hiders *given, const e3d_lines *lines);
void drw_hiders_free(drw_hiders *all);

/* In cells of the grid. `at`: corners on the drawing. */
drw_outside drw_outside_of(const drw_hiders *all, const double *at, int corners, double reach);
int32_t drw_step_of(const drw_hiders *all, double depth);
