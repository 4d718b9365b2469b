/* The data that the files of navigation share: the grid, and a triangle in the world. */
#pragma once

#include "e3d_navigation.h"

typedef struct sample {
    int32_t cell;
    float height, slope_x, slope_z;
    uint8_t walkable;
} sample;

struct e3d_navigation {
    e3d_navigation_desc desc;
    sample *samples;
    int64_t count, capacity; /* of samples, until they are sorted */
    int32_t *starts;
    float *height, *slope_x, *slope_z;
    uint8_t *walkable;
    int32_t layers;
    float lowest, highest; /* of the walkable layers, anywhere in their cells */
};

typedef struct triangle {
    double p[3][3]; /* world space */
    double low[3], high[3];
    double normal[3]; /* not of unit length */
    int is_ground;
    uint8_t kind; /* E3D_SURFACE_... of its material */
} triangle;

/* Finds the corners of face `number` of a mesh; 0 if it is not finite or has no area. */
int e3d_navigation_triangle(const e3d_navigation *grid, const e3d_navigation_mesh *mesh, int64_t number,
                            triangle *out);

/* The cells that [low, high] touches, edges included; first > last if there are none. */
void e3d_navigation_span(double low, double high, double start, double cell, int32_t count, int32_t *first,
                         int32_t *last);
