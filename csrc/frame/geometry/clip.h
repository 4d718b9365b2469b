/* Primitives cut at the planes that they cross. */
#pragma once

#include "kernels/types/vertices.h"

typedef struct e3d_clip_vertex {
    float v[4];
    float c[3];
} e3d_clip_vertex;
enum { E3D_CLIP_MAX = 40 }; /* 3 vertices, and each of 6 planes adds at most half as many */
int e3d_clip_triangle(const float corner[3][4], const e3d_viewport *viewport,
                      e3d_clip_vertex out[E3D_CLIP_MAX]);
int e3d_clip_line(const float end[2][4], const e3d_viewport *viewport, e3d_clip_vertex out[2]);
int e3d_outcode(const float v[4], const e3d_viewport *viewport);
