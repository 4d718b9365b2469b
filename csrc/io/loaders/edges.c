/* Edges: finds which sides of triangles are edges of the model, each edge once.
 * In: faces, whose indices are in range; perhaps the points of their vertices; perhaps which sides are wanted. Out: for each
 * side whether it is the first one of its edge.
 * Always: time grows with the number of sides, whatever they are: sides are listed by their lesser point, and each list marks
 * the greater points that it has met. */
#include <stdlib.h>

#include "e3d_surfaces.h"

/* Whether a side is wanted and has two different points. */
typedef struct side {
    int32_t lesser, greater;
} side;

static int find_side(const e3d_sides *s, size_t number, side *out)
{
    size_t face = number / 3, k = number % 3;
    int32_t a = s->faces[number], b = s->faces[3 * face + (k + 1) % 3];
    if (s->points) {
        a = s->points[a];
        b = s->points[b];
    }
    *out = a < b ? (side){a, b} : (side){b, a};
    return a != b && (!s->wanted || s->wanted[number]);
}

/* Finds where the list of each point ends; the lists follow each other, and are filled from their ends. */
static size_t count_sides(const e3d_sides *s, uint32_t *ends)
{
    size_t count = 0;
    side at;
    for (size_t n = 0; n < 3 * s->face_count; n++)
        if (find_side(s, n, &at)) {
            ends[at.lesser]++;
            count++;
        }
    for (size_t p = 1; p < s->point_count; p++)
        ends[p] += ends[p - 1];
    return count;
}

typedef struct listed {
    int32_t greater;
    uint32_t number; /* of the side */
} listed;

/* Lists the last sides first, so that each list begins with its first side. */
static void list_sides(const e3d_sides *s, uint32_t *ends, listed *lists)
{
    side at;
    for (size_t n = 3 * s->face_count; n-- > 0;)
        if (find_side(s, n, &at))
            lists[--ends[at.lesser]] = (listed){at.greater, (uint32_t)n};
}

/* met[greater] is the last point, counted from 1, in whose list it was. */
static void keep_first(const uint32_t *starts, size_t point_count, const listed *lists, size_t count, int32_t *met, uint8_t *first)
{
    for (size_t p = 0; p < point_count; p++) {
        size_t end = p + 1 < point_count ? starts[p + 1] : count;
        for (size_t i = starts[p]; i < end; i++) {
            int32_t *last = &met[lists[i].greater];
            if (*last == (int32_t)p + 1)
                continue;
            *last = (int32_t)p + 1;
            first[lists[i].number] = 1;
        }
    }
}

bool e3d_find_edges(const e3d_sides *sides, uint8_t *first)
{
    uint32_t *starts = calloc(sides->point_count + 1, sizeof *starts);
    int32_t *met = calloc(sides->point_count + 1, sizeof *met);
    listed *lists = NULL;
    if (starts && met) {
        size_t count = count_sides(sides, starts);
        lists = malloc((count + 1) * sizeof *lists);
        if (lists) {
            list_sides(sides, starts, lists);
            keep_first(starts, sides->point_count, lists, count, met, first);
        }
    }
    bool done = lists != NULL;
    free(lists);
    free(met);
    free(starts);
    return done;
}
