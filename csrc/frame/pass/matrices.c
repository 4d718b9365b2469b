/* prepare: world, clip and normal matrices (R1, R2). */
#include <math.h>
#include <string.h>

#include "base/matrix.h"
#include "frame/pass/matrices.h"

static void multiply_pose(const double a[16], const e3d_draw *draw, int32_t instance, double out[16])
{
    if (draw->pose_kind == E3D_POSE_MATRIX) {
        double pose[16];
        for (int k = 0; k < 16; k++)
            pose[k] = draw->poses[16 * (size_t)instance + k];
        e3d_multiply(a, pose, out);
        return;
    }
    const float *p = draw->poses + 4 * (size_t)instance;
    const e3d_double2 rows[4][2] = {{{p[3], 0}, {0, p[0]}}, {{0, p[3]}, {0, p[1]}}, {{0, 0}, {p[3], p[2]}}, {{0, 0}, {0, 1}}};
    e3d_multiply_rows(a, rows, out);
}

int e3d_mirrors(const double m[16])
{
    double cofactor[9];
    return e3d_find_cofactors(m, cofactor) < 0;
}

/* R2 */
int e3d_normal_matrix(const double world[16], float out[9])
{
    double cofactor[9], big = 0;
    int finite = 1;
    double det = e3d_find_cofactors(world, cofactor);
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
    e3d_multiply(clip_from_world, world, clip);
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
