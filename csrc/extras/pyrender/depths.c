/* Depths: tests which is nearer, and turns them into distances. */
#include <math.h>

#include "extras/pyrender/picture.h"

float pyr_metric_depth(const e3d_pyr_frame *frame, double z)
{
    double near = frame->depth_near, far = frame->depth_far;
    if (!(z <= 1))
        return 0;
    if (frame->depth_is_straight)
        return (float)(near + (z + 1) * 0.5 * (far - near));
    if (isinf(far))
        return (float)(2 * near / (1 - z));
    return (float)(2 * near * far / (far + near - z * (far - near)));
}

uint32_t pyr_test_depths(const pyr_band *band, int32_t x, int32_t y, uint32_t mask, const double z[E3D_PYR_PLACES])
{
    const pyr_picture *picture = band->picture;
    double *depth = pyr_depths_at(band, x, y);
    uint32_t kept = 0;
    for (int p = 0; p < picture->places; p++)
        if (mask >> p & 1 && z[p] >= -1 && z[p] <= 1 && z[p] < depth[p]) {
            depth[p] = z[p];
            kept |= 1u << p;
        }
    return kept;
}
