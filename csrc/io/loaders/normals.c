/* Angle-weighted normals: what the corners of triangles add to the normals of their groups.
 *
 * In:  positions, the triangles' indices of them, and the group of each corner. Out: sums, not normalised.
 * Every operation is one of + - * / and the square root in double precision, in the order written here;
 * sums are made of blocks of triangles, and then of the blocks' sums: docs of engine3d.model.geometry.normals.
 * Always: what is not finite adds zero, and so does a triangle without area.
 */
#include "e3d_surfaces.h"

#include "base/fpenv.h"
#include "io/loaders/corner_angles.h"

#include <math.h>
#include <stdlib.h>

static inline vector position_at(const e3d_surface *surface, size_t index)
{
    if (surface->are_doubles) {
        const double *const p = (const double *)surface->positions + 3 * index;
        return (vector){p[0], p[1], p[2]};
    }
    const float *const p = (const float *)surface->positions + 3 * index;
    return (vector){p[0], p[1], p[2]};
}

static inline vector face_normal(vector ab, vector ac)
{
    const vector area = {ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z,
                         ab.x * ac.y - ab.y * ac.x};
    if (!isfinite(area.x) || !isfinite(area.y) || !isfinite(area.z))
        return (vector){0, 0, 0};
    const double length = length_of(area), divisor = length == 0 ? 1 : length;
    return (vector){area.x / divisor, area.y / divisor, area.z / divisor};
}

static inline void add_triangle(const e3d_surface *surface, size_t face, double *sums)
{
    const int32_t *const corners = surface->faces + 3 * face, *const groups = surface->groups + 3 * face;
    const vector a = position_at(surface, (size_t)corners[0]), b = position_at(surface, (size_t)corners[1]),
                 c = position_at(surface, (size_t)corners[2]);
    const vector edges[3] = {minus(b, a), minus(c, b), minus(a, c)};
    const double lengths[3] = {length_of(edges[0]), length_of(edges[1]), length_of(edges[2])};
    const vector normal = face_normal(edges[0], minus(c, a));
    for (size_t k = 0; k < 3; k++) {
        const size_t back = (k + 2) % 3;
        const double cosine = -dot(edges[k], edges[back]) / (lengths[k] * lengths[back]);
        const double arc = arc_cosine(cosine), angle = isfinite(arc) ? arc : 0;
        double *const sum = sums + 3 * (size_t)groups[k];
        sum[0] += angle * normal.x;
        sum[1] += angle * normal.y;
        sum[2] += angle * normal.z;
    }
}

static bool are_in_range(const int32_t *indices, size_t count, size_t limit)
{
    for (size_t i = 0; i < count; i++)
        if (indices[i] < 0 || (size_t)indices[i] >= limit)
            return false;
    return true;
}

/* Adds the sums of a block to the total, and sets them to zero. */
static void add_block(const int32_t *groups, size_t corners, double *block, double *sums)
{
    for (size_t i = 0; i < corners; i++)
        for (size_t axis = 0; axis < 3; axis++) {
            const size_t at = 3 * (size_t)groups[i] + axis;
            sums[at] += block[at];
            block[at] = 0;
        }
}

e3d_sums_problem e3d_smooth_sums(const e3d_surface *surface, size_t block_faces, double *sums)
{
    if (!are_in_range(surface->faces, 3 * surface->face_count, surface->position_count) ||
        !are_in_range(surface->groups, 3 * surface->face_count, surface->group_count))
        return E3D_SUMS_OUT_OF_RANGE;
    double *const block = calloc(3 * surface->group_count + 1, sizeof *block);
    if (!block)
        return E3D_SUMS_NO_MEMORY;
    const e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t face = 0; face < surface->face_count; face += block_faces) {
        const size_t left = surface->face_count - face, count = left < block_faces ? left : block_faces;
        for (size_t k = 0; k < count; k++)
            add_triangle(surface, face + k, block);
        add_block(surface->groups + 3 * face, 3 * count, block, sums);
    }
    e3d_fpenv_leave(saved);
    free(block);
    return E3D_SUMS_DONE;
}
