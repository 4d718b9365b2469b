/* Finds the edges of triangles: which of them share which.
 * In: triangles of vertices by number. Out: each edge once, in the order of its vertices. */
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"

enum { FEW = 32 };

typedef struct half {
    int32_t high, side;
} half;

static int by_high(const void *a, const void *b)
{
    const half *first = a, *second = b;
    if (first->high != second->high)
        return first->high < second->high ? -1 : 1;
    return (first->side > second->side) - (first->side < second->side);
}

static void ends_of(const int32_t *faces, size_t side, int32_t *low, int32_t *high)
{
    int32_t a = faces[side], b = faces[side % 3 == 2 ? side - 2 : side + 1];
    *low = a < b ? a : b;
    *high = a < b ? b : a;
}

/* Sorts the few sides of a vertex by insertion. */
static void sort(half *halves, size_t count)
{
    if (count > FEW) {
        qsort(halves, count, sizeof *halves, by_high);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        half one = halves[i];
        size_t at = i;
        for (; at && by_high(&one, &halves[at - 1]) < 0; at--)
            halves[at] = halves[at - 1];
        halves[at] = one;
    }
}

/* Lists the sides by their lower vertex: those of vertex v are starts[v] .. starts[v + 1] - 1. */
static void sort_by_low(const int32_t *faces, size_t sides, size_t vertices, size_t *starts, half *halves)
{
    int32_t low, high;
    for (size_t side = 0; side < sides; side++) {
        ends_of(faces, side, &low, &high);
        starts[low + 1] += low != high;
    }
    for (size_t v = 0; v < vertices; v++)
        starts[v + 1] += starts[v];
    for (size_t side = 0; side < sides; side++) {
        ends_of(faces, side, &low, &high);
        if (low != high)
            halves[starts[low]++] = (half){high, (int32_t)side};
    }
    memmove(starts + 1, starts, vertices * sizeof *starts);
    starts[0] = 0;
}

static size_t take(const half *halves, size_t count, int32_t low, e3d_side *out)
{
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        if (i && halves[i].high == halves[i - 1].high) {
            e3d_side *same = &out[made - 1];
            same->second = same->uses++ == 1 ? halves[i].side : same->second;
        } else {
            out[made++] = (e3d_side){low, halves[i].high, halves[i].side, -1, 1};
        }
    }
    return made;
}

e3d_status e3d_find_sides(const int32_t *faces, size_t count, size_t vertices, e3d_side **sides, size_t *found)
{
    size_t *starts = calloc(vertices + 2, sizeof *starts);
    half *halves = malloc((3 * count + 1) * sizeof *halves);
    e3d_side *out = malloc((3 * count + 1) * sizeof *out);
    e3d_status status = starts && halves && out ? E3D_OK : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK) {
        *found = 0;
        sort_by_low(faces, 3 * count, vertices, starts, halves);
        for (size_t v = 0; v < vertices; v++) {
            size_t own = starts[v + 1] - starts[v];
            sort(halves + starts[v], own);
            *found += take(halves + starts[v], own, (int32_t)v, out + *found);
        }
        *sides = out;
        out = NULL;
    }
    free(starts);
    free(halves);
    free(out);
    return status;
}

void e3d_unfold_sides(const int32_t *faces, const e3d_side *sides, size_t count, int32_t *ends, int32_t *beside, uint8_t *turned)
{
    for (size_t i = 0; i < count; i++) {
        const e3d_side *side = &sides[i];
        int has_two = side->uses > 1;
        ends[2 * i] = side->low;
        ends[2 * i + 1] = side->high;
        beside[2 * i] = side->first / 3;
        beside[2 * i + 1] = has_two ? side->second / 3 : -1;
        turned[i] = side->uses == 2 && faces[side->first] == faces[side->second];
    }
}

void e3d_find_cosines(const double *normals, const int32_t *beside, const uint8_t *turned, size_t count, double *cosines)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    for (size_t i = 0; i < count; i++) {
        const double *a = normals + 3 * (size_t)beside[2 * i], *b = normals + 3 * (size_t)(beside[2 * i + 1] < 0 ? 0 : beside[2 * i + 1]);
        double cosine = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
        cosines[i] = beside[2 * i + 1] < 0 ? 1 : turned[i] ? -cosine
                                                           : cosine;
    }
    e3d_fpenv_leave(saved);
}
