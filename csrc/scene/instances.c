/* instances: the boxes of a mesh at many poses, in the space of their node. */
#include <math.h>
#include <string.h>

#include "core/fpenv.h"
#include "scene/pose.h"

static int pose_of(const float *poses, e3d_pose_kind kind, int32_t instance, double out[12])
{
    int finite = 1, numbers = kind == E3D_POSE_MATRIX ? 16 : 4;
    const float *p = poses + numbers * (size_t)instance;
    for (int k = 0; k < numbers; k++)
        finite = finite && isfinite(p[k]);
    if (kind == E3D_POSE_MATRIX) {
        for (int k = 0; k < 12; k++)
            out[k] = p[k];
    } else {
        const double matrix[12] = {p[3], 0, 0, p[0], 0, p[3], 0, p[1], 0, 0, p[3], p[2]};
        memcpy(out, matrix, sizeof matrix);
    }
    return finite;
}

void e3d_instance_boxes(const float *poses, e3d_pose_kind kind, int32_t count,
                        const double box[E3D_OBJECT_BOX], double *boxes)
{
    static const double NONE[E3D_BOX] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY, 0};
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = 0; i < count; i++) {
        double pose[12], *out = boxes + E3D_BOX * (size_t)i;
        if (pose_of(poses, kind, i, pose) && box[0] <= box[3])
            e3d_pose_box(pose, box, out);
        else
            memcpy(out, NONE, sizeof NONE);
    }
    e3d_fpenv_leave(saved);
}

int e3d_boxes_union(const double *boxes, int32_t count, double box[E3D_OBJECT_BOX])
{
    for (int k = 0; k < 3; k++) {
        box[k] = INFINITY;
        box[3 + k] = -INFINITY;
        box[6 + k] = 0;
    }
    for (int32_t i = 0; i < count; i++) {
        const double *b = boxes + E3D_BOX * (size_t)i;
        for (int k = 0; k < 3; k++) {
            box[k] = b[k] < box[k] ? b[k] : box[k];
            box[3 + k] = b[3 + k] > box[3 + k] ? b[3 + k] : box[3 + k];
            box[6 + k] = b[6] > box[6 + k] ? b[6] : box[6 + k];
        }
    }
    return box[0] <= box[3];
}
