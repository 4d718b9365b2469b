/* Views: what a frame needs of a camera's pose. f64; the operations and their order are those of inverse, multiply and normalize
 * in engine/base/linalg, to the bit. Inverse by Laplace's expansion in 2x2 determinants.
 */
#include <math.h>

#include "base/fpenv.h"
#include "base/matrix.h"
#include "e3d_scene.h"

/* Finds the 2x2 determinants of two rows, by columns 01, 02, 03, 12, 13, 23. */
static void find_pairs(const double u[4], const double v[4], double pairs[6])
{
    int n = 0;
    for (int i = 0; i < 4; i++)
        for (int j = i + 1; j < 4; j++)
            pairs[n++] = u[i] * v[j] - u[j] * v[i];
}

/* Finds the 3x3 determinants of a row and a pair of others, without each of the columns in turn. */
static void find_minors(const double r[4], const double p[6], double minors[4])
{
    minors[0] = (r[1] * p[5] - r[2] * p[4]) + r[3] * p[3];
    minors[1] = (r[0] * p[5] - r[2] * p[2]) + r[3] * p[1];
    minors[2] = (r[0] * p[4] - r[1] * p[2]) + r[3] * p[0];
    minors[3] = (r[0] * p[3] - r[1] * p[1]) + r[2] * p[0];
}

static int invert(const double m[16], double out[16])
{
    static const int PARTNER[4] = {1, 0, 3, 2}; /* the row that a minor keeps of its pair */
    double pairs[2][6], minors[4][4];
    find_pairs(m, m + 4, pairs[0]);
    find_pairs(m + 8, m + 12, pairs[1]);
    for (int row = 0; row < 4; row++)
        find_minors(m + 4 * PARTNER[row], pairs[row < 2], minors[row]);
    const double *last = m + 12;
    double determinant = ((last[0] * -minors[3][0] + last[1] * minors[3][1]) + last[2] * -minors[3][2]) + last[3] * minors[3][3];
    if (determinant == 0.0)
        return 0;
    int finite = 1;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            double entry = (row + column) & 1 ? -minors[column][row] : minors[column][row];
            out[4 * row + column] = entry / determinant + 0.0;
            finite &= isfinite(out[4 * row + column]) != 0;
        }
    return finite;
}

static void normalize(const double v[3], double out[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++)
        largest = fabs(v[k]) > largest ? fabs(v[k]) : largest;
    largest = largest == 0.0 ? 1.0 : largest;
    for (int k = 0; k < 3; k++)
        out[k] = v[k] / largest;
    double norm = sqrt((out[0] * out[0] + out[1] * out[1]) + out[2] * out[2]);
    norm = norm == 0.0 ? 1.0 : norm;
    for (int k = 0; k < 3; k++)
        out[k] = out[k] / norm;
}

int e3d_invert(const double m[16], double out[16])
{
    e3d_fpenv saved = e3d_fpenv_enter();
    int good = invert(m, out);
    e3d_fpenv_leave(saved);
    return good;
}

int e3d_camera_view(const double clip_from_view[16], const double world_from_view[16], e3d_camera *out)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    int good = invert(world_from_view, out->view_from_world);
    if (good) {
        e3d_multiply(clip_from_view, out->view_from_world, out->clip_from_world);
        const double axis[3] = {world_from_view[2], world_from_view[6], world_from_view[10]};
        normalize(axis, out->towards_viewer);
        int perspective = clip_from_view[12] != 0 || clip_from_view[13] != 0 || clip_from_view[14] != 0;
        for (int k = 0; k < 3; k++)
            out->eye[k] = perspective ? world_from_view[4 * k + 3] : out->towards_viewer[k];
        out->eye[3] = perspective ? 1.0 : 0.0;
    }
    e3d_fpenv_leave(saved);
    return good;
}
