/* Polygons and segments of clip space, cut where they leave the room before the near plane. */
#ifndef E3D_PYR_CLIP_H
#define E3D_PYR_CLIP_H

enum { PYR_CLIP_PLANES = 6,
       PYR_MOST_CORNERS = 3 + PYR_CLIP_PLANES,
       PYR_SIDE = 64 /* times the picture to each side is kept */ };

/* How far a point is inside: of the near plane, of w > 0, and of PYR_SIDE times the picture to each side, so that what is left has coordinates
 * that 64 bits multiply. */
static inline double pyr_inside(const double p[4], int plane)
{
    switch (plane) {
    case 0: return p[2] + p[3];
    case 1: return p[3] - 0x1p-60;
    case 2: return PYR_SIDE * p[3] + p[0];
    case 3: return PYR_SIDE * p[3] - p[0];
    case 4: return PYR_SIDE * p[3] + p[1];
    default: return PYR_SIDE * p[3] - p[1];
    }
}

/* Cuts a polygon; returns how many corners are left. */
static inline int pyr_clip_polygon(double p[PYR_MOST_CORNERS][4], int count)
{
    double out[PYR_MOST_CORNERS][4];
    for (int plane = 0; plane < PYR_CLIP_PLANES && count; plane++) {
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

#endif
