/* Clips polygons and segments in clip space to the room before the near plane. */
#pragma once

#include "data/clip_planes.h"

enum { PYR_MOST_CORNERS = 3 + E3D_CLIP_PLANES,
       PYR_SIDE = 64 /* so many times the picture is kept to each side, so that coordinates fit products of 64 bits */ };

static inline double pyr_inside(const double p[4], int plane) { return e3d_inside(p, plane, 0x1p-60, PYR_SIDE, PYR_SIDE); }

/* Clips a polygon; returns how many corners are left. Edges are cut in their own direction; those of frames are cut from the
 * inside to the outside (R7), which rounds differently. */
static inline int pyr_clip_polygon(double p[PYR_MOST_CORNERS][4], int count)
{
    double out[PYR_MOST_CORNERS][4];
    for (int plane = 0; plane < E3D_CLIP_PLANES && count; plane++) {
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const double *a = p[i], *b = p[(i + 1) % count];
            double da = pyr_inside(a, plane), db = pyr_inside(b, plane);
            if (da >= 0 && kept < PYR_MOST_CORNERS) {
                for (int c = 0; c < 4; c++)
                    out[kept][c] = a[c];
                kept++;
            }
            if ((da >= 0) != (db >= 0) && kept < PYR_MOST_CORNERS) {
                double t = da / (da - db);
                for (int c = 0; c < 4; c++)
                    out[kept][c] = a[c] + (b[c] - a[c]) * t;
                kept++;
            }
        }
        count = kept;
        for (int i = 0; i < count; i++)
            for (int c = 0; c < 4; c++)
                p[i][c] = out[i][c];
    }
    return count;
}
