/* Transform: from object space to clip space and world space.
 *
 * In:  a draw, the number of one of its instances, the mesh's vertices.
 * Out: the instance's f32 matrices; clip positions, world positions, world normals of vertices.
 * Rules: R1 (matrices), R2 (normal matrix), R3 (vertices).
 */
#include <math.h>
#include <string.h>

#include "reference/stages.h"

static void multiply(double out[16], const double a[16], const double b[16])
{
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            out[4 * r + c] = ((a[4 * r] * b[c] + a[4 * r + 1] * b[4 + c]) + a[4 * r + 2] * b[8 + c]) +
                             a[4 * r + 3] * b[12 + c];
}

static void read_pose(double out[16], const e3d_draw *draw, int32_t number)
{
    if (draw->pose_kind == E3D_POSE_MATRIX) {
        for (int k = 0; k < 16; k++)
            out[k] = (double)draw->poses[16 * (size_t)number + (size_t)k];
        return;
    }
    const float *offset = draw->poses + 4 * (size_t)number;
    memset(out, 0, 16 * sizeof *out);
    for (int r = 0; r < 3; r++) {
        out[5 * r] = (double)offset[3];
        out[4 * r + 3] = (double)offset[r];
    }
    out[15] = 1.0;
}

/* The cofactors of the upper left 3x3 part of a matrix; returns its determinant. */
static double find_cofactors(const double m[16], double cofactors[3][3])
{
    for (int r = 0; r < 3; r++) {
        int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
        for (int c = 0; c < 3; c++) {
            int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactors[r][c] = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
        }
    }
    return (m[0] * cofactors[0][0] + m[1] * cofactors[0][1]) + m[2] * cofactors[0][2];
}

/* R2: a matrix proportional to the inverse transpose, scaled so that its greatest element is 1. */
static void make_normal_matrix(ref_instance *instance, const double m[16], const double view_from_world[16])
{
    double cofactors[3][3], of_view[3][3], big = 0.0;
    int finite = 1;
    double det = find_cofactors(m, cofactors);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            finite = finite && isfinite(cofactors[r][c]);
            big = fabs(cofactors[r][c]) > big ? fabs(cofactors[r][c]) : big;
        }
    double scale = (det < 0.0 ? -1.0 : 1.0) / big;
    int usable = finite && isfinite(scale);
    instance->turned_round = det < 0.0;
    instance->mirrored = (det < 0.0) != (find_cofactors(view_from_world, of_view) < 0.0);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            instance->normal_matrix[r][c] = usable ? (float)(cofactors[r][c] * scale) : 0.0f;
}

void ref_round_rows(float out[][4], const double *matrix, int rows)
{
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < 4; c++)
            out[r][c] = (float)matrix[4 * r + c];
}

/* R1 */
void ref_instance_init(ref_instance *out, const e3d_frame *frame, const e3d_draw *draw, int32_t number)
{
    double pose[16], world_from_object[16], clip_from_object[16];
    memcpy(world_from_object, draw->world_from_node, sizeof world_from_object);
    out->object_id = draw->node_id;
    out->instance_id = draw->instance_ids ? draw->instance_ids[number] : draw->first_instance + number;
    if (draw->pose_kind == E3D_POSE_NODES) {
        out->object_id = draw->node_ids[number];
        out->instance_id = 0;
        memcpy(world_from_object, draw->node_worlds + 12 * (size_t)number, 12 * sizeof *world_from_object);
        memcpy(world_from_object + 12, (const double[4]){0, 0, 0, 1}, 4 * sizeof *world_from_object);
    } else if (draw->pose_kind != E3D_POSE_NONE) {
        read_pose(pose, draw, number);
        multiply(world_from_object, draw->world_from_node, pose);
    }
    multiply(clip_from_object, frame->clip_from_world, world_from_object);
    out->draw = draw;
    out->mesh = e3d_mesh_view(draw->mesh);
    out->number = number;
    ref_round_rows(out->clip_from_object, clip_from_object, 4);
    ref_round_rows(out->world_from_object, world_from_object, 3);
    make_normal_matrix(out, world_from_object, frame->view_from_world);
}

static float transform_row(const float row[4], const float p[3])
{
    return ((row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]) + row[3];
}

/* R3 */
void ref_transform_clip(const ref_instance *instance, int32_t vertex, float out[4])
{
    const e3d_mesh_desc *mesh = instance->mesh;
    const float *p = mesh->positions + (size_t)vertex * (size_t)mesh->components;
    for (int r = 0; r < 4; r++)
        out[r] = mesh->components == 4 ? p[r] : transform_row(instance->clip_from_object[r], p);
}

/* R3 */
void ref_transform_point(const float rows[3][4], const float point[3], float out[3])
{
    for (int r = 0; r < 3; r++)
        out[r] = transform_row(rows[r], point);
}

/* R3 */
void ref_transform_normal(const ref_instance *instance, const float normal[3], float out[3])
{
    const float (*n)[3] = instance->normal_matrix;
    for (int r = 0; r < 3; r++)
        out[r] = (n[r][0] * normal[0] + n[r][1] * normal[1]) + n[r][2] * normal[2];
}
