/* The lines of a view, before anything hides them.
 * In: the edges of surfaces, other lines, and a view. Out: those that it shows, cut by its planes and by the frame's sides. */
#pragma once

#include "base/grow.h"
#include "e3d_drawing.h"

/* A line in the world. */
typedef struct drw_line {
    double ends[6];
    int32_t part;
    int8_t kind;
    uint8_t is_behind; /* it is known to be hidden */
} drw_line;

/* Finds which triangles are seen from the front, 1, or from the back, -1; 0 is edge on. */
void drw_find_facing(const e3d_edges *edges, const double eye[4], int8_t *facing);
/* Whether a triangle is the back of a body that encloses a volume. From an edge of two backs, the way to a viewer outside of the body
 * leads through this. */
uint8_t drw_is_back(const e3d_edges *edges, const int8_t *facing, int32_t face);
/* Appends the lines of drw_line: edges first, in their order. */
e3d_status drw_find_lines(const e3d_edges *edges, const int8_t *facing, const e3d_other_lines *others, const e3d_view *view,
                          e3d_array *lines);
