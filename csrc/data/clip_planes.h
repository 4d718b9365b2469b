/* The planes at which primitives are clipped (R7). */
#pragma once

enum { E3D_CLIP_PLANES = 6 };

/* The distance of a point inside one of the planes: the near plane, the least w, or a multiple of the picture on each side. */
static inline double e3d_inside(const double p[4], int plane, double least_w, double across, double up)
{
    switch (plane) {
    case 0: return p[2] + p[3];
    case 1: return p[3] - least_w;
    case 2: return across * p[3] + p[0];
    case 3: return across * p[3] - p[0];
    case 4: return up * p[3] + p[1];
    default: return up * p[3] - p[1];
    }
}
