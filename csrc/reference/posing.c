/* posing: moves one vertex after the other, as R71 to R74 say. */
#include <math.h>

#include "base/fpenv.h"
#include "e3d_posing.h"

/* R71: x, y and z of a row of `width` */
static void morph(const float *base, int width, const float *deltas, int32_t targets, const float *weights, int32_t vertices,
                  int32_t vertex, float out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = base[width * vertex + k];
        for (int32_t t = 0; t < targets && deltas; t++)
            if (weights[t] != 0)
                out[k] = out[k] + weights[t] * deltas[3 * ((int64_t)t * vertices + vertex) + k];
    }
}

/* R72: m[row][column] */
static void blend(const e3d_pose_desc *d, const float *matrices, int32_t vertex, float m[3][4])
{
    int any = 0;
    for (int32_t i = 0; i < d->influences; i++) {
        float weight = d->weights[vertex * d->influences + i];
        const float *joint = matrices + E3D_JOINT_MATRIX * (int)d->joints[vertex * d->influences + i];
        if (weight == 0)
            continue;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                m[r][c] = any ? m[r][c] + weight * joint[4 * c + r] : weight * joint[4 * c + r];
        any = 1;
    }
}

/* R22 */
static void make_unit(float v[3])
{
    float square = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
    square = 0x1p-126f > square ? 0x1p-126f : square;
    float factor = 1.0f / sqrtf(square);
    for (int k = 0; k < 3; k++)
        v[k] = v[k] * factor;
}

/* R74 */
static void turn_normal(const float m[3][4], const float n[3], float out[3])
{
    for (int r = 0; r < 3; r++) {
        float cofactor[3];
        int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
        for (int c = 0; c < 3; c++) {
            int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[c] = m[r1][c1] * m[r2][c2] - m[r2][c1] * m[r1][c2];
        }
        out[r] = (cofactor[0] * n[0] + cofactor[1] * n[1]) + cofactor[2] * n[2];
    }
    make_unit(out);
}

/* R74 */
static void turn_tangent(const float m[3][4], const float t[3], float out[3])
{
    for (int r = 0; r < 3; r++)
        out[r] = (m[r][0] * t[0] + m[r][1] * t[1]) + m[r][2] * t[2];
    make_unit(out);
}

/* Keeps a direction that joints do not turn; it is normalised if a target moved it. */
static void keep(const float v[3], int moved, float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v[k];
    if (moved)
        make_unit(out);
}

void e3d_reference_pose(const e3d_mesh_desc *mesh, const e3d_pose_desc *d, const float *matrices, const float *weights,
                        float *positions, float *normals, float *tangents)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    int32_t targets = weights ? d->targets : 0, count = mesh->vertices;
    int skinned = matrices && d->influences;
    for (int32_t v = 0; v < count; v++) {
        float p[3], n[3], m[3][4] = {{0}}, *out = positions + 3 * v;
        if (skinned)
            blend(d, matrices, v, m);
        morph(mesh->positions, 3, d->target_positions, targets, weights, count, v, p);
        for (int r = 0; r < 3; r++)
            out[r] = skinned ? ((m[r][0] * p[0] + m[r][1] * p[1]) + m[r][2] * p[2]) + m[r][3] : p[r];
        if (normals) {
            morph(d->normals, 3, d->target_normals, targets, weights, count, v, n);
            if (skinned)
                turn_normal(m, n, normals + 3 * v);
            else
                keep(n, targets && d->target_normals, normals + 3 * v);
        }
        if (tangents) {
            morph(d->tangents, 4, d->target_tangents, targets, weights, count, v, n);
            if (skinned)
                turn_tangent(m, n, tangents + 4 * v);
            else
                keep(n, targets && d->target_tangents, tangents + 4 * v);
            tangents[4 * v + 3] = d->tangents[4 * v + 3];
        }
    }
    e3d_fpenv_leave(saved);
}
