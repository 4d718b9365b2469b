/* Calm triangles: those that differ so little from corner to corner that neighbours may be lit together within a pixel (R152).
 *
 * In: a draw's corners, normals, colours. Out: 1 or 0 for each triangle. Always: what has coordinates of textures is never calm, since
 * colours change within a texel's width.
 */
#include "pyrender/picture.h"

#define TURN_SQUARED (1.0f / 64)  /* of normals: 1/8 of their length */
#define COLOR_CHANGE (1.0f / 64)

static float square_of(const float v[3]) { return (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]; }

static int are_alike(const float a[3], const float b[3])
{
    float between[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    float square = square_of(between), first = square_of(a), second = square_of(b);
    return square <= (first < second ? first : second) * TURN_SQUARED;
}

static int have_one_color(const float a[4], const float b[4])
{
    int same = 1;
    for (int c = 0; c < 4; c++)
        same &= a[c] - b[c] <= COLOR_CHANGE && b[c] - a[c] <= COLOR_CHANGE;
    return same;
}

void e3d_pyr_find_calm(const e3d_pyr_draw *draw, uint8_t *out)
{
    for (int32_t t = 0; t < draw->count; t++) {
        int32_t corner[3];
        int calm = !draw->uvs;
        pyr_corners(draw, t, corner);
        for (int k = 0; k < 3 && calm; k++) {
            size_t a = (size_t)corner[k], b = (size_t)corner[(k + 1) % 3];
            calm &= !draw->normals || are_alike(draw->normals + 3 * a, draw->normals + 3 * b);
            calm &= !draw->colors || have_one_color(draw->colors + 4 * a, draw->colors + 4 * b);
        }
        out[t] = (uint8_t)calm;
    }
}
