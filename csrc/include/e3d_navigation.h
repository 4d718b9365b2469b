/* Where one can stand: the surfaces of meshes sampled on a grid of square cells, seen from above.
 *
 * In:  meshes with a matrix each, Y up: first all as ground, then all as obstacles.
 * Out: for each cell its layers from below upward, in arrays that the grid owns.
 * Always: any position is legal; a triangle that is not finite counts for nothing. A face is ground where its
 *      normal's Y is at least `min_normal_y`; ground is sampled at the cells' centres. A layer that another hides
 *      at less than `headroom` above it is left out. A layer is blocked where any triangle comes nearer than
 *      `radius` to its cell, along x and along z, between `step` and `headroom` above the layer's plane.
 */
#ifndef E3D_NAVIGATION_H
#define E3D_NAVIGATION_H

#include <stdint.h>

#include "e3d.h"

typedef struct e3d_navigation e3d_navigation;

typedef struct e3d_navigation_desc {
    double x, z;  /* the grid's least corner */
    double cell;  /* side of a cell, > 0 */
    int32_t columns, rows; /* along x and z; their product stays below 2^31 */
    double min_normal_y;   /* of a unit normal */
    double step, headroom; /* 0 <= step < headroom */
    double radius;         /* of one who walks, >= 0 */
} e3d_navigation_desc;

/* What a material is to one who walks; what is not solid, such as leaves, is not there for them. */
enum { E3D_SURFACE_WALKABLE = 1, E3D_SURFACE_SOLID = 2 };

typedef struct e3d_navigation_mesh {
    const float *positions;      /* (vertices, 3) */
    const int32_t *faces;        /* (faces_count, 3), in range */
    int64_t faces_count;
    const int32_t *material_ids; /* (faces_count,), in range of kinds */
    const uint8_t *kinds;        /* a material: flags of the enum above */
    double world_from_mesh[16];
} e3d_navigation_mesh;

/* The layers of cell k are starts[k] .. starts[k + 1] - 1; cells run along x first. The height at (x, z) is
 * height + slope_x (x - cx) + slope_z (z - cz), (cx, cz) being the cell's centre. */
typedef struct e3d_navigation_view {
    const int32_t *starts; /* (columns * rows + 1,) */
    const float *height, *slope_x, *slope_z;
    const uint8_t *walkable; /* 0 where the material is not, or something blocks */
    int32_t layers;
} e3d_navigation_view;

e3d_status e3d_navigation_create(const e3d_navigation_desc *desc, e3d_navigation **out);
void e3d_navigation_destroy(e3d_navigation *grid);
e3d_status e3d_navigation_add_ground(e3d_navigation *grid, const e3d_navigation_mesh *mesh);
/* After the last ground, before the first obstacle. */
e3d_status e3d_navigation_sort(e3d_navigation *grid);
void e3d_navigation_add_obstacles(e3d_navigation *grid, const e3d_navigation_mesh *mesh);
void e3d_navigation_get_view(const e3d_navigation *grid, e3d_navigation_view *view);

#endif
