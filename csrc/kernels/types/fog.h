/* Fog as an eye sees it. */
#pragma once

#include "e3d.h"

typedef struct e3d_fog_view {
    e3d_fog_kind kind;
    float row[4]; /* the row of view_from_world for which depth is 0 - z */
    float color[3];
    float near, scale; /* linear: scale is 1 over the range of depths */
    float density;     /* exponential */
} e3d_fog_view;
