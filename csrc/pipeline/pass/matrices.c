/* prepare: world, clip and normal matrices (R1, R2). */
#include <math.h>
#include <string.h>

#include "core/always_inline.h"
#include "e3d.h"
#include "pipeline/pass/matrices.h"

/* Two columns of a row. */
typedef double double2 __attribute__((vector_size(16)));

static inline double2 load2(const double *p)
{
    double2 v;
    memcpy(&v, p, sizeof v);
    return v;
}

/* b: rows, in registers: what is stored by ones is waited for when it is loaded by twos. */
static ALWAYS_INLINE void multiply_rows(const double a[16], const double2 b[4][2], double out[16])
{
    for (int r = 0; r < 4; r++)
        for (int h = 0; h < 2; h++) {
            const double *m = a + 4 * r;
            double2 sum = ((m[0] * b[0][h] + m[1] * b[1][h]) + m[2] * b[2][h]) + m[3] * b[3][h];
            memcpy(out + 4 * r + 2 * h, &sum, sizeof sum);
        }
}

static inline void multiply(const double a[16], const double b[16], double out[16])
{
    double2 rows[4][2];
    for (int r = 0; r < 4; r++)
        for (int h = 0; h < 2; h++)
            rows[r][h] = load2(b + 4 * r + 2 * h);
    multiply_rows(a, rows, out);
}

static void multiply_pose(const double a[16], const e3d_draw *draw, int32_t instance, double out[16])
{
    if (draw->pose_kind == E3D_POSE_MATRIX) {
        double pose[16];
        for (int k = 0; k < 16; k++)
            pose[k] = draw->poses[16 * (size_t)instance + k];
        multiply(a, pose, out);
        return;
    }
    const float *p = draw->poses + 4 * (size_t)instance;
    const double2 rows[4][2] = {{{p[3], 0}, {0, p[0]}}, {{0, p[3]}, {0, p[1]}}, {{0, 0}, {p[3], p[2]}}, {{0, 0}, {0, 1}}};
    multiply_rows(a, rows, out);
}

/* The cofactors of the upper left 3x3, and its determinant. */
static double find_cofactors(const double m[16], double cofactor[9])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[3 * r + c] = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
        }
    return (m[0] * cofactor[0] + m[1] * cofactor[1]) + m[2] * cofactor[2];
}

int e3d_mirrors(const double m[16])
{
    double cofactor[9];
    return find_cofactors(m, cofactor) < 0;
}

/* R2 */
int e3d_normal_matrix(const double world[16], float out[9])
{
    double cofactor[9], big = 0;
    int finite = 1;
    double det = find_cofactors(world, cofactor);
    for (int k = 0; k < 9; k++) {
        big = fabs(cofactor[k]) > big ? fabs(cofactor[k]) : big;
        finite = finite && isfinite(cofactor[k]);
    }
    double scale = 1.0 / big;
    finite = finite && isfinite(scale);
    for (int k = 0; k < 9; k++)
        out[k] = finite ? (float)(cofactor[k] * (det < 0 ? -scale : scale)) : 0.0f;
    return det < 0;
}

void e3d_clip_matrix(const double clip_from_world[16], const double world[16], float out[16])
{
    double clip[16];
    multiply(clip_from_world, world, clip);
    for (int k = 0; k < 16; k++)
        out[k] = (float)clip[k];
}

static const double LAST_ROW[4] = {0, 0, 0, 1};

void e3d_world_matrix(const e3d_draw *draw, int32_t instance, double out[16])
{
    if (draw->pose_kind == E3D_POSE_NONE) {
        memcpy(out, draw->world_from_node, 16 * sizeof *out);
    } else if (draw->pose_kind == E3D_POSE_NODES) {
        memcpy(out, draw->node_worlds + 12 * (size_t)instance, 12 * sizeof *out);
        memcpy(out + 12, LAST_ROW, sizeof LAST_ROW);
    } else {
        multiply_pose(draw->world_from_node, draw, instance, out);
    }
}
