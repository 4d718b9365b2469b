/* Finds the bodies of triangles: what hangs together by vertices.
 * In: triangles of vertices by number. Out: for each triangle the least vertex of its body. */
#include "base/joined_sets.h"
#include "e3d_drawing.h"

void e3d_number_bodies(const int32_t *faces, size_t count, size_t vertices, int32_t *above, int32_t *bodies)
{
    uint32_t *sets = (uint32_t *)above; /* numbers of vertices are below 2^31 */
    for (size_t v = 0; v < vertices; v++)
        sets[v] = (uint32_t)v;
    for (size_t face = 0; face < count; face++) {
        const int32_t *corners = faces + 3 * face;
        e3d_join_sets(sets, (uint32_t)corners[0], (uint32_t)corners[1]);
        e3d_join_sets(sets, (uint32_t)corners[0], (uint32_t)corners[2]);
    }
    for (size_t face = 0; face < count; face++)
        bodies[face] = (int32_t)e3d_set_of(sets, (uint32_t)faces[3 * face]);
}
