/* The shapes of the user interface: a triangle, or two triangles that are a rectangle. Private to csrc/post/ui. */
#pragma once

#include "e3d_ui.h"
#include "kernels/types/ui.h"

/* Pixels [left, right) x [top, bottom). */
typedef struct ui_box {
    int32_t left, top, right, bottom;
} ui_box;

/* A corner's place in 1/256 pixel (R38), and the vertex. */
typedef struct ui_corner {
    int32_t x, y;
    const e3d_ui_vertex *vertex;
} ui_corner;

/* Whether a vertex has a finite position (R38). */
int ui_is_finite(const e3d_ui_vertex *vertex);

/* Snaps a finite vertex. */
ui_corner ui_snap(const e3d_ui_vertex *vertex);

/* Whether b and d are the other two corners of the rectangle of a and c (R39). */
int ui_is_rectangle(const e3d_ui_vertex *a, const e3d_ui_vertex *b, const e3d_ui_vertex *c, const e3d_ui_vertex *d);

/* The first column or row whose centre is at a place or behind it: ceil((place - 128) / 256). */
static inline int32_t ui_first_centre(int32_t place) { return (place + 127) >> 8; }

/* Twice the area (R9). */
int64_t ui_area(const ui_corner corners[3]);

/* The pixels whose centres lie in the half-open box of some corners, clipped to the picture: a centre on the right or lower
 * side of a triangle isn't covered. */
ui_box ui_box_of(const ui_corner *corners, int count, const e3d_canvas *picture);

/* Find the planes of R40 from the box's first pixel on, and the constants that save work for the kernel. A triangle is given
 * by its corners, in the order of a positive area; a rectangle, which has an area, by its opposite corners a and c. `drawn`
 * is the part of the box that may change. They return 0 if nothing shows. */
int ui_triangle_shape(const ui_corner corners[3], const e3d_ui_texture *texture, ui_box box, e3d_ui_shape *shape);
int ui_rectangle_shape(const ui_corner *a, const ui_corner *c, const e3d_ui_texture *texture, ui_box box, ui_box drawn,
                       e3d_ui_shape *shape);
