/* Fuzzes the sums of angle-weighted normals, and the edges of the same triangles.
 *
 * In:  a byte each: positions, groups, triangles in a block, whether doubles; positions; six bytes a triangle.
 * Claims: an index out of range is found; sums are finite, and no longer than their corners allow; a group without
 *      corners has none; triangles wound the other way round add the opposite, to the bit; of the sides between two points the first is
 *      an edge, and no other.
 */
#include "e3d_surfaces.h"
#include "check/fuzz/input.h"

#include <math.h>

enum { MOST_TRIANGLES = 96 };

static int32_t faces[3 * MOST_TRIANGLES], groups[3 * MOST_TRIANGLES];

static bool are_in_range(const e3d_surface *surface)
{
    bool all = true;
    for (size_t i = 0; i < 3 * surface->face_count; i++)
        all &= faces[i] >= 0 && (size_t)faces[i] < surface->position_count && groups[i] >= 0 &&
               (size_t)groups[i] < surface->group_count;
    return all;
}

static void claim_sizes(const e3d_surface *surface, const double *sums)
{
    for (size_t group = 0; group < surface->group_count; group++) {
        double corners = 0;
        for (size_t i = 0; i < 3 * surface->face_count; i++)
            corners += (size_t)groups[i] == group;
        const double *const sum = sums + 3 * group;
        CLAIM(fabs(sum[0]) <= 3.1416 * corners && fabs(sum[1]) <= 3.1416 * corners && fabs(sum[2]) <= 3.1416 * corners);
    }
}

static void swap(int32_t *a, int32_t *b)
{
    const int32_t kept = *a;
    *a = *b;
    *b = kept;
}

/* Where a group has several corners of a triangle, they would be added in another order. */
static bool groups_differ(size_t triangles)
{
    bool all = true;
    for (size_t i = 0; i < 3 * triangles; i += 3)
        all &= groups[i] != groups[i + 1] && groups[i + 1] != groups[i + 2] && groups[i + 2] != groups[i];
    return all;
}

static void claim_opposite(const e3d_surface *surface, size_t block, const double *sums)
{
    double *opposite = room_for(3 * surface->group_count, sizeof(double));
    for (size_t k = 0; k < 3 * surface->group_count; k++)
        opposite[k] = 0;
    for (size_t i = 0; i < 3 * surface->face_count; i += 3) {
        swap(&faces[i + 1], &faces[i + 2]);
        swap(&groups[i + 1], &groups[i + 2]);
    }
    CLAIM(e3d_smooth_sums(surface, block, opposite) == E3D_SUMS_DONE);
    for (size_t k = 0; k < 3 * surface->group_count; k++)
        CLAIM(opposite[k] == -sums[k]);
    free(opposite);
}

/* Points are those of each vertex, or NULL; the groups tell which sides are wanted. */
static void claim_edges(const e3d_surface *surface, const int32_t *points, size_t point_count)
{
    static uint8_t wanted[3 * MOST_TRIANGLES], first[3 * MOST_TRIANGLES];
    const e3d_sides sides = {surface->faces, points, wanted, surface->face_count, point_count};
    size_t count = 3 * surface->face_count;
    for (size_t i = 0; i < count; i++) {
        wanted[i] = groups[i] % 3 != 0;
        first[i] = 0;
    }
    CLAIM(e3d_find_edges(&sides, first));
    for (size_t i = 0; i < count; i++) {
        int32_t ends[2] = {faces[i], faces[i % 3 == 2 ? i - 2 : i + 1]};
        bool is_first = wanted[i];
        for (int k = 0; k < 2 && points; k++)
            ends[k] = points[ends[k]];
        for (size_t j = 0; j < i && is_first; j++) {
            int32_t a = faces[j], b = faces[j % 3 == 2 ? j - 2 : j + 1];
            a = points ? points[a] : a;
            b = points ? points[b] : b;
            is_first = !(wanted[j] && ((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0])));
        }
        CLAIM(first[i] == (is_first && ends[0] != ends[1]));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    e3d_surface surface = {.faces = faces, .groups = groups, .position_count = 1 + (size_t)take_below(&in, 16)};
    surface.group_count = 1 + (size_t)take_below(&in, 16);
    const size_t block = 1 + (size_t)take_below(&in, 8);
    surface.are_doubles = take_byte(&in) & 1;
    void *positions = take_positions(&in, surface.position_count, surface.are_doubles);
    surface.positions = positions;
    surface.face_count = in.left / 6 < MOST_TRIANGLES ? in.left / 6 : MOST_TRIANGLES;
    for (size_t i = 0; i < 3 * surface.face_count; i++) {
        faces[i] = (int8_t)take_byte(&in);
        groups[i] = (int8_t)take_byte(&in);
    }
    double *sums = room_for(3 * surface.group_count, sizeof(double));
    for (size_t k = 0; k < 3 * surface.group_count; k++)
        sums[k] = 0;
    const e3d_sums_problem problem = e3d_smooth_sums(&surface, block, sums);
    CLAIM((problem == E3D_SUMS_DONE) == are_in_range(&surface));
    if (problem == E3D_SUMS_DONE) {
        claim_sizes(&surface, sums);
        if (groups_differ(surface.face_count))
            claim_opposite(&surface, block, sums);
        const int32_t points[16] = {0, 1, 1, 2, 3, 3, 3, 4, 4, 5, 6, 7, 7, 0, 1, 9};
        claim_edges(&surface, NULL, surface.position_count);
        claim_edges(&surface, points, 10);
    }
    free(sums);
    free(positions);
    return 0;
}
