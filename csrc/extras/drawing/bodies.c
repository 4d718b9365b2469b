/* Finds the bodies of triangles: what hangs together by vertices.
 * In: triangles of vertices by number. Out: for each triangle the least vertex of its body.
 * The method is union-find with path halving (Tarjan and van Leeuwen, 1984), the lesser vertex being the root. */
#include "e3d_drawing.h"

static int32_t root_of(int32_t *above, int32_t vertex)
{
    while (above[vertex] != vertex) {
        above[vertex] = above[above[vertex]];
        vertex = above[vertex];
    }
    return vertex;
}

static void join(int32_t *above, int32_t a, int32_t b)
{
    a = root_of(above, a);
    b = root_of(above, b);
    above[a < b ? b : a] = a < b ? a : b;
}

void e3d_number_bodies(const int32_t *faces, size_t count, size_t vertices, int32_t *above, int32_t *bodies)
{
    for (size_t v = 0; v < vertices; v++)
        above[v] = (int32_t)v;
    for (size_t face = 0; face < count; face++) {
        join(above, faces[3 * face], faces[3 * face + 1]);
        join(above, faces[3 * face], faces[3 * face + 2]);
    }
    for (size_t face = 0; face < count; face++)
        bodies[face] = root_of(above, faces[3 * face]);
}
