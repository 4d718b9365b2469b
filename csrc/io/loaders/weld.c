/* Corners with three indices each become vertices with one.
 *
 * In:  indices of positions, and of texture coordinates and normals or none. Out: faces and vertices.
 * Corners are sorted by their position by counting; the few that share one are told apart one by one, or
 * sorted where they are many. So the vertices stand in the order of (position, uv, normal), as the
 * positions of a file do, which keeps neighbours together.
 */
#include "e3d_rows.h"

#include "io/loaders/short_sort.h"

#include <stdlib.h>
#include <string.h>

/* Up to so many corners of one position are each compared with all. */
#define FEW 24

typedef struct corner {
    int32_t uv, normal, number;
} corner;

typedef struct vertices {
    size_t count;
    int32_t *position, *uv, *normal; /* uv and normal may be NULL */
} vertices;

static int compare_corners(const void *left, const void *right)
{
    const corner *a = left, *b = right;
    if (a->uv != b->uv)
        return a->uv < b->uv ? -1 : 1;
    return a->normal < b->normal ? -1 : a->normal > b->normal;
}

E3D_DEFINE_SHORT_SORT(sort_corners, corner, compare_corners, FEW)

/* Gives the corners of one position their vertices. */
static void number_corners(corner *corners, size_t count, int32_t position, vertices *made,
                           int32_t *faces)
{
    bool are_equal = true;
    for (size_t i = 1; i < count; i++)
        are_equal &= corners[i].uv == corners[0].uv && corners[i].normal == corners[0].normal;
    if (!are_equal)
        sort_corners(corners, count);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || compare_corners(&corners[i - 1], &corners[i]) != 0) {
            made->position[made->count] = position;
            if (made->uv)
                made->uv[made->count] = corners[i].uv;
            if (made->normal)
                made->normal[made->count] = corners[i].normal;
            made->count++;
        }
        faces[corners[i].number] = (int32_t)(made->count - 1);
    }
}

/* Fills starts[p + 1] with the end of position p's corners, in the order of positions; 0 if one is out of range. */
static bool count_corners(const int32_t *positions, size_t corners, size_t position_count,
                          uint32_t *starts)
{
    for (size_t i = 0; i < corners; i++) {
        if (positions[i] < 0 || (size_t)positions[i] >= position_count)
            return false;
        starts[positions[i] + 1]++;
    }
    for (size_t p = 0; p < position_count; p++)
        starts[p + 1] += starts[p];
    return true;
}

size_t e3d_weld_corners(const int32_t *positions, const int32_t *uvs, const int32_t *normals,
                        size_t corners, size_t position_count, int32_t *faces, int32_t *of_position,
                        int32_t *of_uv, int32_t *of_normal)
{
    vertices made = {0, of_position, uvs ? of_uv : NULL, normals ? of_normal : NULL};
    uint32_t *starts = calloc(position_count + 2, sizeof *starts);
    corner *sorted = malloc((corners ? corners : 1) * sizeof *sorted);
    const bool done = starts && sorted && corners <= INT32_MAX &&
                      count_corners(positions, corners, position_count, starts);
    if (done) {
        for (size_t i = 0; i < corners; i++)
            sorted[starts[positions[i]]++] =
                (corner){uvs ? uvs[i] : -1, normals ? normals[i] : -1, (int32_t)i};
        /* Filling in moved each start to the next one. */
        for (size_t p = 0; p < position_count; p++) {
            const uint32_t first = p ? starts[p - 1] : 0;
            if (starts[p] > first)
                number_corners(sorted + first, starts[p] - first, (int32_t)p, &made, faces);
        }
    }
    free(sorted);
    free(starts);
    return done ? made.count : SIZE_MAX;
}

size_t e3d_mark_used(const int32_t *indices, size_t count, uint8_t *used, size_t total)
{
    for (size_t i = 0; i < count; i++)
        if ((uint32_t)indices[i] < total)
            used[indices[i]] = 1;
    size_t marked = 0;
    for (size_t k = 0; k < total; k++)
        marked += used[k];
    return marked;
}
