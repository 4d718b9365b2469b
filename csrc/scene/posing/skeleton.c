/* skeleton: finds the matrices of a skin's joints from the poses of nodes (R70), in f64, with each number rounded once. */
#include <string.h>

#include "base/fpenv.h"
#include "e3d_posing.h"
#include "scene/pose.h"

_Static_assert((int)E3D_POSED_BOX == (int)E3D_OBJECT_BOX, "one kind of box");

void e3d_skeleton_matrices(const e3d_skeleton *s, const double *poses, double *ways, float *matrices)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = 0; i < s->links; i++) {
        const double *pose = poses + 12 * (size_t)s->slots[i];
        if (s->above[i] < 0)
            memcpy(ways + 12 * (size_t)i, pose, 12 * sizeof *ways);
        else
            e3d_pose_multiply(ways + 12 * (size_t)s->above[i], pose, ways + 12 * (size_t)i);
    }
    for (int32_t j = 0; j < s->joints; j++) {
        double m[12];
        float *out = matrices + E3D_JOINT_MATRIX * (size_t)j;
        e3d_pose_multiply(ways + 12 * (size_t)s->ends[j], s->inverse_binds + 12 * (size_t)j, m);
        for (int c = 0; c < 4; c++)
            for (int r = 0; r < 4; r++)
                out[4 * c + r] = r < 3 ? (float)m[4 * r + c] : 0;
    }
    e3d_fpenv_leave(saved);
}
