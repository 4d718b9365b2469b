/* Fuzzes the cutting of polygons into triangles.
 *
 * In:  a byte each: positions, whether doubles, whether indices, tests; positions; then polygons: a size and indices.
 * Claims: an index out of range is found; triangles have corners of their polygon, three different ones; all edges of a
 *      polygon are shown once, and with enough tests none is cut as a fan.
 */
#include "check/fuzz/input.h"
#include "e3d_surfaces.h"

enum { MOST_CORNERS = 256,
       MOST_POSITIONS = 32,
       ENOUGH = 100000000 };

static bool are_in_range(const e3d_polygons *p)
{
    bool all = p->indices || p->corner_count <= p->position_count;
    for (size_t i = 0; p->indices && i < p->corner_count; i++)
        all &= p->indices[i] >= 0 && (size_t)p->indices[i] < p->position_count;
    return all;
}

static void claim_triangles(const e3d_polygons *p, const e3d_cut *made, size_t triangles)
{
    size_t triangle = 0;
    int32_t first = 0;
    bool all_visible = true;
    for (size_t k = 0; k < p->count; k++) {
        int32_t shown = 0;
        const int32_t size = p->sizes[k];
        for (int32_t t = 0; t < size - 2; t++, triangle++) {
            const int32_t *const c = made->corners + 3 * triangle;
            CLAIM(made->polygons[triangle] == (int32_t)k);
            CLAIM(c[0] != c[1] && c[1] != c[2] && c[2] != c[0]);
            for (int edge = 0; edge < 3; edge++) {
                CLAIM(c[edge] >= first && c[edge] < first + size);
                shown += made->visible[3 * triangle + edge];
                all_visible &= made->visible[3 * triangle + edge];
            }
        }
        CLAIM(shown == (size < 3 ? 0 : size));
        first += size;
    }
    CLAIM(triangle == triangles && made->all_visible == all_visible);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    int32_t sizes[MOST_CORNERS], indices[MOST_CORNERS];
    input in = {bytes, size};
    e3d_polygons given = {.sizes = sizes, .position_count = 1 + (size_t)take_below(&in, MOST_POSITIONS)};
    given.are_doubles = take_byte(&in) & 1;
    given.indices = take_byte(&in) & 3 ? indices : NULL;
    const uint32_t few = take_byte(&in);
    int64_t tests = few < 128 ? ENOUGH : few;
    void *positions = take_positions(&in, given.position_count, given.are_doubles);
    given.positions = positions;
    size_t triangles = 0;
    while (in.left && given.count < MOST_CORNERS) {
        const size_t left = MOST_CORNERS - given.corner_count;
        const int32_t corners = take_below(&in, (int32_t)(left < 40 ? left + 1 : 40));
        for (int32_t k = 0; k < corners; k++)
            indices[given.corner_count++] = (int8_t)take_byte(&in);
        sizes[given.count++] = corners;
        triangles += corners < 3 ? 0 : (size_t)corners - 2;
    }
    e3d_cut made = {.corners = room_for(3 * triangles, sizeof(int32_t)), .visible = room_for(3 * triangles, 1)};
    made.polygons = room_for(triangles, sizeof(int32_t));
    const e3d_cut_problem problem = e3d_cut_polygons(&given, &tests, &made);
    CLAIM((problem == E3D_CUT_DONE) == are_in_range(&given));
    if (problem == E3D_CUT_DONE) {
        claim_triangles(&given, &made, triangles);
        CLAIM(made.is_complete || few >= 128);
    }
    free(positions);
    free(made.corners);
    free(made.polygons);
    free(made.visible);
    return 0;
}
