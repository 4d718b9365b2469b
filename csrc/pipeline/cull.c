/* cull: boxes against the clip volume, planes by Gribb and Hartmann (2001), the positive vertex.
 *
 * In f64 with slack far above the rounding of the f32 transform: what the rules would keep is never lost.
 */
#include <math.h>

#include "pipeline/frame.h"

void e3d_planes_from(const double m[16], e3d_planes *planes)
{
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 4; k++) {
            planes->p[2 * axis][k] = m[12 + k] + m[4 * axis + k];
            planes->p[2 * axis + 1][k] = m[12 + k] - m[4 * axis + k];
        }
}

int e3d_box_shows(const e3d_planes *planes, const float lo[3], const float hi[3])
{
    for (int i = 0; i < 6; i++) {
        const double *p = planes->p[i];
        double most = p[3], size = fabs(p[3]);
        for (int k = 0; k < 3; k++) {
            double a = p[k] * lo[k], b = p[k] * hi[k];
            most += a > b ? a : b;
            size += fabs(a) > fabs(b) ? fabs(a) : fabs(b);
        }
        if (most < -1e-5 * size) /* also false for NaN: kept */
            return 0;
    }
    return 1;
}
