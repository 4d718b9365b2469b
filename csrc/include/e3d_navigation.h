/* A navigation grid: where a walker can stand on the surfaces of meshes. The grid has square cells, seen from above.
 * In: meshes with a matrix each, Y up: first all as ground, then all as obstacles.
 * Out: for each cell its layers from below upward, in arrays that the grid owns.
 * Always: any position is legal; a triangle that is not finite is ignored.
 * A face is ground where its normal's Y is at least `min_normal_y`; ground is sampled at the cells' centres. A layer is left out
 * if another one lies less than `headroom` above it. A layer is blocked if a triangle comes nearer than `radius` to its cell,
 * along x and along z, between `step` and `headroom` above the layer's plane. */
#pragma once

#include <stdint.h>

#include "e3d.h"

typedef struct e3d_navigation e3d_navigation;

typedef struct e3d_navigation_desc {
    double x, z;  /* the grid's least corner */
    double cell;  /* side of a cell, > 0 */
    int32_t columns, rows; /* along x and z; their product stays below 2^31 */
    double min_normal_y;   /* of a unit normal */
    double step, headroom; /* 0 <= step < headroom */
    double radius;         /* of the walker, >= 0 */
} e3d_navigation_desc;

/* What a material means to a walker: one that is not solid, such as leaves, does not stop or carry him. */
enum { E3D_SURFACE_WALKABLE = 1,
       E3D_SURFACE_SOLID = 2 };

typedef struct e3d_navigation_mesh {
    const float *positions;      /* (vertices, 3) */
    const int32_t *faces;        /* (faces_count, 3), in range */
    int64_t faces_count;
    const int32_t *material_ids; /* (faces_count,), in range of kinds */
    const uint8_t *kinds;        /* for each material flags of the enum above */
    double world_from_mesh[16];
} e3d_navigation_mesh;

/* The layers of cell k are starts[k] .. starts[k + 1] - 1; cells are numbered along x first. A layer's height at (x, z) is
 * height + slope_x (x - cx) + slope_z (z - cz), with the cell's centre at (cx, cz). */
typedef struct e3d_navigation_view {
    const int32_t *starts; /* (columns * rows + 1,) */
    const float *height, *slope_x, *slope_z;
    const uint8_t *walkable; /* 0: the material isn't walkable, or something blocks the layer */
    int32_t layers;
} e3d_navigation_view;

e3d_status e3d_navigation_create(const e3d_navigation_desc *desc, e3d_navigation **out);
void e3d_navigation_destroy(e3d_navigation *grid);
e3d_status e3d_navigation_add_ground(e3d_navigation *grid, const e3d_navigation_mesh *mesh);
/* To be called after the last ground, before the first obstacle. */
e3d_status e3d_navigation_sort(e3d_navigation *grid);
void e3d_navigation_add_obstacles(e3d_navigation *grid, const e3d_navigation_mesh *mesh);
void e3d_navigation_get_view(const e3d_navigation *grid, e3d_navigation_view *view);
