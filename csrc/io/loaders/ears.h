/* Triangles of one polygon that may be concave: ear clipping. */
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct e3d_point {
    double x, y;
} e3d_point;

/* Room for polygons of up to so many corners. */
typedef struct e3d_ears {
    e3d_point *points; /* the polygon's points, all finite; the caller fills them in */
    int32_t *before, *after; /* for each corner its neighbours among those that are left */
    int32_t *reflex, *place; /* the corners that turn right, and for each corner its place among them, or -1 */
    int32_t reflex_count;
} e3d_ears;

/* Cuts a polygon of `count` corners, three or more, of either winding. `triangles` becomes count - 2 triples of corner
 * numbers with the same winding. Each test takes one from *tests; below 0 the rest of the polygon is cut as a fan. */
void e3d_clip_ears(e3d_ears *ears, int32_t count, int64_t *tests, int32_t *triangles);
