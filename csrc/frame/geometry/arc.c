/* geometry: round ends of lines, and round points (R114, R115). Larger circles have more corners, so that all look equally
 * round. */
#include <math.h>

#include "frame/geometry/arc.h"

/* The number of chords of a half circle, a power of two: a chord parts from the circle by at most 0.16 of a sample. */
static int steps_of(int32_t radius)
{
    int steps = 2;
    for (int32_t most = 128; radius > most && steps < E3D_HALF_CIRCLE; most *= 4)
        steps *= 2;
    return steps;
}

void e3d_arc_of(int32_t radius, double dx, double dy, e3d_arc *out)
{
    double length = sqrt(dx * dx + dy * dy);
    double ux = length > 0.0 ? dx / length : 1.0, uy = length > 0.0 ? dy / length : 0.0;
    out->steps = steps_of(radius);
    for (int j = 0; j <= out->steps; j++) {
        int step = j * (E3D_HALF_CIRCLE / out->steps);
        double c = e3d_half_circle_cosine(step), s = e3d_half_circle_sine(step);
        out->x[j] = (int32_t)lrint((double)radius * (c * uy + s * ux));
        out->y[j] = (int32_t)lrint((double)radius * (s * uy - c * ux));
    }
}
