/* The planes that primitives of clip space are cut at (R7). */
#ifndef E3D_CLIP_PLANES_H
#define E3D_CLIP_PLANES_H

enum { E3D_CLIP_PLANES = 6 };

/* How far a point is inside: of the near plane, of a least w, and of so many times the picture to each side. */
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

#endif
