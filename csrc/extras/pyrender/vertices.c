/* Vertices: object space to clip space, the world, and normals there (R146).
 *
 * In: a draw. Out: its vertices. Always: world positions and normals are f32 as in pyrender's shader, clip space f64.
 */
#include <math.h>

#include "base/matrix.h"
#include "extras/pyrender/picture.h"

/* The inverse transpose of the upper 3x3 part, up to its scale, since normals are normalised anyway. */
static void set_normal_matrix(const double m[16], float out[9])
{
    double cofactor[9], det = e3d_find_cofactors(m, cofactor), most = 0;
    for (int k = 0; k < 9; k++)
        most = fabs(cofactor[k]) > most ? fabs(cofactor[k]) : most;
    double scale = most > 0 ? (det < 0 ? -1 / most : 1 / most) : 0;
    for (int k = 0; k < 9; k++)
        out[k] = (float)(cofactor[k] * scale);
}

static void set_normal(const float m[9], const float n[3], float out[3])
{
    float v[3];
    for (int r = 0; r < 3; r++)
        v[r] = (m[3 * r] * n[0] + m[3 * r + 1] * n[1]) + m[3 * r + 2] * n[2];
    float square = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
    float scale = square > 0 ? 1 / sqrtf(square) : 0;
    for (int r = 0; r < 3; r++)
        out[r] = v[r] * scale;
}

void pyr_transform(const e3d_pyr_frame *frame, const e3d_pyr_draw *draw, int32_t first, int32_t end, pyr_vertex *out)
{
    double clip[16];
    float normal[9];
    e3d_multiply(frame->clip_from_world, draw->world, clip);
    set_normal_matrix(draw->world, normal);
    int is_lit = frame->shading == E3D_PYR_LIT;
    for (int32_t i = first; i < end; i++) {
        const float *p = draw->positions + 3 * (size_t)i;
        double x = p[0], y = p[1], z = p[2];
        for (int r = 0; r < 4; r++)
            out[i].clip[r] = ((clip[4 * r] * x + clip[4 * r + 1] * y) + clip[4 * r + 2] * z) + clip[4 * r + 3];
        memset(out[i].world, 0, sizeof out[i].world + sizeof out[i].normal);
        if (!is_lit)
            continue;
        const double *w = draw->world;
        for (int r = 0; r < 3; r++)
            out[i].world[r] = (float)(((w[4 * r] * x + w[4 * r + 1] * y) + w[4 * r + 2] * z) + w[4 * r + 3]);
        if (draw->normals)
            set_normal(normal, draw->normals + 3 * (size_t)i, out[i].normal);
    }
}
