/* Finds bodies that enclose a volume: from outside, a ray enters them through a front before it leaves them through a back.
 * In: triangles and their edges. Out: for each triangle whether it belongs to such a body, and to which side its fronts turn.
 * Bodies hang together by edges. One encloses a volume if each edge has two triangles, which run along it in opposite directions,
 * and the sum of signed volumes is not 0. */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "base/joined_sets.h"
#include "e3d_drawing.h"

/* A body has a volume if it is more than this share of the sum of its triangles' absolute volumes. */
#define LEAST_SHARE 0x1p-20

typedef struct body {
    double volume, total; /* six times each */
    int is_open;
} body;

static uint32_t face_of(int32_t side) { return (uint32_t)side / 3; }

static void join_faces(const e3d_side *sides, size_t count, uint32_t *above)
{
    for (size_t i = 0; i < count; i++)
        if (sides[i].uses > 1)
            e3d_join_sets(above, face_of(sides[i].first), face_of(sides[i].second));
}

/* Six times the signed volume between a triangle and a place. */
static double volume_of(const double *places, const int32_t *face, const double *place)
{
    double v[3][3];
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 3; k++)
            v[corner][k] = places[3 * (size_t)face[corner] + (size_t)k] - place[k];
    return (v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2])) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

/* Opens the bodies of all triangles of an edge that has more than two, of which only two are known: those that hold both ends of
 * such edges. */
static void open_crowded(const int32_t *faces, size_t count, const e3d_side *sides, size_t side_count, uint8_t *crowded,
                         uint32_t *above, body *bodies)
{
    for (size_t i = 0; i < side_count; i++)
        if (sides[i].uses > 2)
            crowded[sides[i].low] = crowded[sides[i].high] = 1;
    for (size_t face = 0; face < count; face++, faces += 3)
        if (crowded[faces[0]] + crowded[faces[1]] + crowded[faces[2]] > 1)
            bodies[e3d_set_of(above, (uint32_t)face)].is_open = 1;
}

static int8_t side_of(const body *one)
{
    if (one->is_open || !isfinite(one->total) || !(fabs(one->volume) > one->total * LEAST_SHARE))
        return 0;
    return one->volume > 0 ? 1 : -1;
}

static void find(const double *places, const int32_t *faces, size_t count, const e3d_side *sides, size_t side_count, uint8_t *crowded,
                 uint32_t *above, body *bodies, int8_t *enclosing)
{
    for (size_t face = 0; face < count; face++)
        above[face] = (uint32_t)face;
    join_faces(sides, side_count, above);
    for (size_t i = 0; i < side_count; i++)
        if (sides[i].uses != 2 || faces[sides[i].first] == faces[sides[i].second])
            bodies[e3d_set_of(above, face_of(sides[i].first))].is_open = 1;
    open_crowded(faces, count, sides, side_count, crowded, above, bodies);
    for (size_t face = 0; face < count; face++) {
        uint32_t own = e3d_set_of(above, (uint32_t)face);
        double volume = volume_of(places, faces + 3 * face, places + 3 * (size_t)faces[3 * own]);
        bodies[own].volume += volume;
        bodies[own].total += fabs(volume);
    }
    for (size_t face = 0; face < count; face++)
        enclosing[face] = side_of(&bodies[e3d_set_of(above, (uint32_t)face)]);
}

e3d_status e3d_find_enclosing(const double *places, size_t vertices, const int32_t *faces, size_t count, const e3d_side *sides, size_t side_count,
                              int8_t *enclosing)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    uint32_t *above = malloc((count + 1) * sizeof *above);
    body *bodies = calloc(count + 1, sizeof *bodies);
    uint8_t *crowded = calloc(vertices + 1, sizeof *crowded);
    e3d_status status = above && bodies && crowded ? E3D_OK : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK)
        find(places, faces, count, sides, side_count, crowded, above, bodies, enclosing);
    free(crowded);
    free(above);
    free(bodies);
    e3d_fpenv_leave(saved);
    return status;
}
