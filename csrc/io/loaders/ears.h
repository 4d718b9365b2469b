/* Triangles of one polygon that may be concave: ear clipping. */
#ifndef E3D_LOADERS_EARS_H
#define E3D_LOADERS_EARS_H

#include <stddef.h>
#include <stdint.h>

typedef struct e3d_point {
    double x, y;
} e3d_point;

/* Room for polygons of up to so many corners. */
typedef struct e3d_ears {
    e3d_point *points; /* of the polygon: the caller's to fill in, all finite */
    int32_t *before, *after; /* of each corner its neighbours among those that are left */
    int32_t *reflex, *place; /* the corners that turn right; of each corner its place among them, -1 for none */
    int32_t reflex_count;
} e3d_ears;

/* Cuts the polygon of `count` corners, three or more, either way round; `triangles` become count - 2 triples of corner
 * numbers, wound like it. What was tested is taken from *tests; below 0 the rest of the polygon is cut as a fan. */
void e3d_clip_ears(e3d_ears *ears, int32_t count, int64_t *tests, int32_t *triangles);

#endif
