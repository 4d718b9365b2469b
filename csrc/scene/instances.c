/* instances: poses and boxes of a mesh at many poses, in the space of their node; boxes of triangles. */
#include <math.h>
#include <string.h>

#include "base/fpenv.h"
#include "scene/pose.h"

int e3d_instance_pose(const float *poses, e3d_pose_kind kind, int32_t instance, double out[12])
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

static const double NONE[E3D_BOX] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY, 0};

void e3d_instance_boxes(const float *poses, e3d_pose_kind kind, int32_t count,
                        const double box[E3D_OBJECT_BOX], double *boxes)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (int32_t i = 0; i < count; i++) {
        double pose[12], *out = boxes + E3D_BOX * (size_t)i;
        if (e3d_instance_pose(poses, kind, i, pose) && box[0] <= box[3])
            e3d_pose_box(pose, box, out);
        else
            memcpy(out, NONE, sizeof NONE);
    }
    e3d_fpenv_leave(saved);
}

void e3d_triangle_boxes(const float *positions, const int32_t *faces, int32_t count, double *boxes)
{
    for (int32_t i = 0; i < count; i++) {
        double *box = boxes + E3D_BOX * (size_t)i;
        int finite = 1;
        memcpy(box, NONE, sizeof NONE);
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 3; k++) {
                double v = positions[3 * (size_t)faces[3 * (size_t)i + corner] + k];
                finite = finite && isfinite(v);
                box[k] = v < box[k] ? v : box[k];
                box[3 + k] = v > box[3 + k] ? v : box[3 + k];
                box[6] = fabs(v) > box[6] ? fabs(v) : box[6];
            }
        if (!finite)
            memcpy(box, NONE, sizeof NONE);
    }
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
