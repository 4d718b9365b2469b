/* Finds the normals of triangles, and which are too flat to have one.
 * In: triangles. Out: a unit normal for each, 0 for those that are flat. */
#include <math.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"

static double square_of(const double v[3]) { return (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]; }

void e3d_find_normals(const double *places, const int32_t *faces, size_t count, double lowest, double *normals)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t face = 0; face < count; face++) {
        const double *a = places + 3 * (size_t)faces[3 * face], *b = places + 3 * (size_t)faces[3 * face + 1],
                     *c = places + 3 * (size_t)faces[3 * face + 2];
        double u[3], v[3], w[3], *n = normals + 3 * face;
        for (int k = 0; k < 3; k++) {
            u[k] = b[k] - a[k];
            v[k] = c[k] - a[k];
            w[k] = c[k] - b[k];
        }
        for (int k = 0; k < 3; k++)
            n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
        double longest = square_of(u), length = sqrt(square_of(n));
        longest = square_of(v) > longest ? square_of(v) : longest;
        longest = square_of(w) > longest ? square_of(w) : longest;
        int is_flat = !(length > lowest * sqrt(longest)) || !isfinite(length);
        for (int k = 0; k < 3; k++)
            n[k] = is_flat ? 0 : n[k] / length;
    }
    e3d_fpenv_leave(saved);
}
