/* Boxes as an eye sees them. */
#pragma once

#include "base/limits.h"
#include "kernels/coverage.h"
#include "kernels/types/vertices.h"

/* A box as the camera sees it. */
enum { E3D_BOX_OUTSIDE = 0,
       E3D_BOX_CROSSES,
       E3D_BOX_INSIDE };
typedef struct e3d_box_view {
    int32_t state;
    float near;    /* no z_ndc in the box is less */
    e3d_box samples; /* the samples that it may cover, inclusive */
} e3d_box_view;

#define E3D_DEPTH_UNBOUNDED (-2.0f) /* the nearest depth of a box that reaches the eye: less than any other */
static inline e3d_box e3d_blocks_of(const e3d_box *samples)
{
    return (e3d_box){samples->x0 / E3D_BLOCK, samples->y0 / E3D_BLOCK, samples->x1 / E3D_BLOCK, samples->y1 / E3D_BLOCK};
}

int e3d_box_state(const float clip[16], const float lo[3], const float hi[3]);
/* Finds how the eye sees a box. If the box is outside, only its state is set. */
void e3d_view_box(const e3d_viewport *viewport, const float clip[16], const float lo[3], const float hi[3],
                  e3d_box_view *out);
/* Finds the box of four or more vertices; 0 if not all are in the frustum, or no sample lies between them. */
int e3d_view_vertices(const e3d_viewport *viewport, const e3d_vertices *vertices, e3d_box_view *out);
