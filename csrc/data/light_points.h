/* The points of a soft light's disc from which exact shadows are cast (R197). */
#pragma once

enum { E3D_LIGHT_POINTS = 32 };

/* Places on a disc of radius 1, in 1/1024. */
extern const float E3D_LIGHT_POINT_X[E3D_LIGHT_POINTS], E3D_LIGHT_POINT_Y[E3D_LIGHT_POINTS];
