/* cull: finds what the backface test of clusters needs (kernels/generic/facing.inl): an instance's eye, and how its clip matrix
 * scales. */
#include <math.h>

#include "frame/pass/facing.h"

static double determinant(const float *x, const float *y, const float *w)
{
    return (double)x[0] * ((double)y[1] * w[2] - (double)y[2] * w[1]) -
           (double)x[1] * ((double)y[0] * w[2] - (double)y[2] * w[0]) +
           (double)x[2] * ((double)y[0] * w[1] - (double)y[1] * w[0]);
}

static float length_of(const float v[3])
{
    return (float)sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
}

void e3d_facing_prepare(const e3d_viewport *viewport, const float clip[16], e3d_facing *out)
{
    const float *x = clip, *y = clip + 4, *w = clip + 12;
    double det = determinant(x, y, w), size = (double)length_of(x) * length_of(y) * length_of(w);
    *out = (e3d_facing){.sign = 0};
    if (!(fabs(det) > 1e-4 * size)) /* the matrix is orthographic, flat, or not finite */
        return;
    /* M e = -t by Cramer's rule: one column is replaced at a time. */
    for (int k = 0; k < 3; k++) {
        float a[3][3];
        for (int j = 0; j < 3; j++) {
            a[0][j] = j == k ? -x[3] : x[j];
            a[1][j] = j == k ? -y[3] : y[j];
            a[2][j] = j == k ? -w[3] : w[j];
        }
        out->eye[k] = (float)(determinant(a[0], a[1], a[2]) / det);
    }
    out->sign = det < 0 ? 1 : -1; /* Y points down on the screen */
    out->scale = (float)(fabs(det) / size * viewport->scale_x * viewport->scale_y);
    out->length[0] = length_of(x);
    out->length[1] = length_of(y);
    out->length[2] = length_of(w);
    out->length[3] = length_of(clip + 8);
}
