/* Fuzzes the welding of corners, and the marking of what is used.
 *
 * In:  a byte each: the number of positions, which lists there are; then three bytes a corner.
 * Claims: a corner's vertex has the corner's indices; vertices stand in order, so that none is there twice.
 */
#include "check/fuzz/input.h"
#include "e3d_rows.h"

enum { POSITION,
       UV,
       NORMAL,
       LISTS };

typedef struct corners {
    int32_t *given[LISTS]; /* NULL where there is no such list */
    int32_t *made[LISTS];
    int32_t *faces;
    size_t count, positions;
} corners;

static void claim_vertices(const corners *c, size_t vertices)
{
    for (size_t i = 0; i < c->count; i++) {
        CLAIM(c->faces[i] >= 0 && (size_t)c->faces[i] < vertices);
        for (int list = 0; list < LISTS; list++)
            CLAIM(!c->given[list] || c->made[list][c->faces[i]] == c->given[list][i]);
    }
    for (size_t v = 1; v < vertices; v++) {
        int order = 0;
        for (int list = 0; list < LISTS && order == 0; list++)
            if (c->given[list])
                order = (c->made[list][v] > c->made[list][v - 1]) - (c->made[list][v] < c->made[list][v - 1]);
        CLAIM(order > 0);
    }
}

static void claim_used(const corners *c)
{
    uint8_t *used = calloc(c->positions + 1, 1), *expected = calloc(c->positions + 1, 1);
    size_t total = 0;
    CLAIM(used && expected);
    for (size_t i = 0; i < c->count; i++)
        if (c->given[POSITION][i] >= 0 && (size_t)c->given[POSITION][i] < c->positions)
            expected[c->given[POSITION][i]] = 1;
    for (size_t p = 0; p < c->positions; p++)
        total += expected[p];
    CLAIM(e3d_mark_used(c->given[POSITION], c->count, used, c->positions) == total);
    CLAIM(memcmp(used, expected, c->positions) == 0);
    free(used);
    free(expected);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    corners c = {.positions = take_byte(&in)};
    const uint32_t lists = take_byte(&in) | 1;
    c.count = in.left / LISTS;
    c.faces = room_for(c.count, sizeof(int32_t));
    for (int list = 0; list < LISTS; list++) {
        if (!(lists >> list & 1))
            continue;
        c.given[list] = room_for(c.count, sizeof(int32_t));
        c.made[list] = room_for(c.count, sizeof(int32_t));
        for (size_t i = 0; i < c.count; i++) {
            const uint8_t byte = in.at[i * LISTS + (size_t)list];
            c.given[list][i] = list == POSITION && c.positions > 127 ? byte : (int8_t)byte;
        }
    }
    int in_range = 1;
    for (size_t i = 0; i < c.count; i++)
        in_range &= c.given[POSITION][i] >= 0 && (size_t)c.given[POSITION][i] < c.positions;
    const size_t vertices = e3d_weld_corners(c.given[POSITION], c.given[UV], c.given[NORMAL], c.count, c.positions,
                                             c.faces, c.made[POSITION], c.made[UV], c.made[NORMAL]);
    CLAIM((vertices == SIZE_MAX) == !in_range);
    if (in_range)
        claim_vertices(&c, vertices);
    claim_used(&c);
    free(c.faces);
    for (int list = 0; list < LISTS; list++) {
        free(c.given[list]);
        free(c.made[list]);
    }
    return 0;
}
