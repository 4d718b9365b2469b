/* Poses: quaternion, scale and offset to a matrix and back, products, boxes.
 *
 * In and out: f64. The operations and their order are those of engine/base/linalg (quaternion_to_matrix,
 * matrix_to_quaternion, multiply) and engine/model/scene/instances.py (transform_box): the same bits.
 * Sources: Shoemake 1985; Shepperd 1978; Arvo 1990 for boxes.
 */
#include "scene/pose.h"

#include <math.h>

static int normalize(const double q[4], double out[4])
{
    double square = ((q[0] * q[0] + q[1] * q[1]) + q[2] * q[2]) + q[3] * q[3];
    if (!(square > 0.0 && square < INFINITY))
        return 0;
    double norm = sqrt(square);
    for (int k = 0; k < 4; k++)
        out[k] = q[k] / norm;
    return 1;
}

int e3d_pose_compose(const double rotation[4], const double scale[3], double pose[12])
{
    double q[4];
    if (!normalize(rotation, q))
        return 0;
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double x2 = x + x, y2 = y + y, z2 = z + z;
    const double m[9] = {1.0 - (y * y2 + z * z2), x * y2 - w * z2, x * z2 + w * y2,
                         x * y2 + w * z2, 1.0 - (x * x2 + z * z2), y * z2 - w * x2,
                         x * z2 - w * y2, y * z2 + w * x2, 1.0 - (x * x2 + y * y2)};
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            pose[4 * r + c] = m[3 * r + c] * scale[c];
    return 1;
}

/* Divides by the largest of the four components; w >= 0. A null matrix becomes the identity. */
static void quaternion_of(double m[3][3], double q[4])
{
    double trace = (m[0][0] + m[1][1]) + m[2][2];
    int largest = m[1][1] > m[0][0] ? 1 : 0;
    largest = m[2][2] > m[largest][largest] ? 2 : largest;
    if (trace > m[largest][largest]) {
        q[0] = m[2][1] - m[1][2];
        q[1] = m[0][2] - m[2][0];
        q[2] = m[1][0] - m[0][1];
        q[3] = 1.0 + trace;
    } else {
        int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = ((1.0 + m[i][i]) - m[j][j]) - m[k][k];
        q[j] = m[j][i] + m[i][j];
        q[k] = m[k][i] + m[i][k];
        q[3] = m[k][j] - m[j][k];
    }
    if (!normalize(q, q)) {
        q[0] = q[1] = q[2] = 0.0;
        q[3] = 1.0;
    }
    double sign = q[3] < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 4; k++)
        q[k] = sign * q[k] + 0.0;
}

void e3d_pose_decompose(const double pose[12], double rotation[4], double scale[3])
{
    double a[3][3]; /* axes */
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++)
            a[c][r] = pose[4 * r + c];
        scale[c] = sqrt((a[c][0] * a[c][0] + a[c][1] * a[c][1]) + a[c][2] * a[c][2]);
    }
    double x = a[0][1] * a[1][2] - a[0][2] * a[1][1];
    double y = a[0][2] * a[1][0] - a[0][0] * a[1][2];
    double z = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    if ((x * a[2][0] + y * a[2][1]) + z * a[2][2] < 0.0)
        scale[0] = -scale[0];
    double m[3][3];
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            m[r][c] = pose[4 * r + c] / (scale[c] == 0.0 ? 1.0 : scale[c]);
    quaternion_of(m, rotation);
}

/* The products with the last row 0 0 0 1 are part of the sums, since they decide the sign of a zero. */
void e3d_pose_multiply(const double a[12], const double b[12], double out[12])
{
    for (int r = 0; r < 3; r++) {
        const double *row = a + 4 * r;
        for (int c = 0; c < 4; c++)
            out[4 * r + c] = ((row[0] * b[c] + row[1] * b[4 + c]) + row[2] * b[8 + c]) +
                             row[3] * (c == 3 ? 1.0 : 0.0);
    }
}

void e3d_pose_box(const double pose[12], const double box[E3D_OBJECT_BOX], double out[E3D_BOX])
{
    double center[3], half[3], reach = 0;
    for (int k = 0; k < 3; k++) {
        center[k] = (box[k] + box[3 + k]) * 0.5;
        half[k] = (box[3 + k] - box[k]) * 0.5;
    }
    for (int r = 0; r < 3; r++) {
        const double *m = pose + 4 * r;
        double middle = ((m[3] + m[0] * center[0]) + m[1] * center[1]) + m[2] * center[2];
        double x = fabs(m[0]), y = fabs(m[1]), z = fabs(m[2]);
        double around = (x * half[0] + y * half[1]) + z * half[2];
        double far = ((x * box[6] + y * box[7]) + z * box[8]) + fabs(m[3]);
        out[r] = middle - around;
        out[3 + r] = middle + around;
        reach = far > reach ? far : reach;
    }
    out[6] = reach;
}
