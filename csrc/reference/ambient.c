/* Ambient: light from all around, by the direction that a surface faces.
 *
 * In:  the frame's ambient light, a normal.
 * Out: what a white surface shows of it, without occlusion.
 * Rules: R130.
 */
#include "reference/arithmetic.h"
#include "reference/surface.h"

void ref_ambient(const e3d_frame *frame, const float normal[3], float out[3])
{
    float x = normal[0], y = normal[1], z = normal[2];
    const float factors[E3D_AMBIENT_TERMS] = {1.0f, x, y, z, x * x - z * z, y * y - z * z, x * y, y * z, z * x};
    for (int c = 0; c < 3; c++) {
        out[c] = frame->ambient[c];
        for (int t = 0; t < E3D_AMBIENT_TERMS && frame->ambient_light.is_given; t++)
            out[c] = out[c] + frame->ambient_light.terms[t][c] * factors[t];
        out[c] = frame->ambient_light.is_given ? ref_max(out[c], 0.0f) : out[c];
    }
}
