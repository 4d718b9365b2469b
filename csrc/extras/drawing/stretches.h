/* Stretches of a line, from 0 to 1, and the pieces into which they cut it.
 * In: stretches in any order. Out: pieces of the whole line, inside a stretch or outside of all, by turns. */
#pragma once

#include "base/grow.h"
#include "e3d_drawing.h"

typedef struct drw_stretch {
    double from, to;
} drw_stretch;

/* What a thread takes along from line to line. */
typedef struct drw_scratch {
    e3d_array stretches; /* of drw_stretch: those of the current line */
    int32_t *seen;       /* for each item, the last line that met it, plus 1 */
    int is_out_of_memory;
} drw_scratch;

/* Finds the stretches of a line. Returns 0 if it has no pieces. `least`: what counts as nothing, as a share of the line. */
typedef int (*drw_find)(const void *argument, int32_t line, drw_scratch *scratch, double *least);

/* The pieces of lines 0 .. count - 1, found by several threads. `items`: how many items are met. */
e3d_status drw_cut_lines(drw_find find, const void *argument, size_t count, size_t items, int threads, e3d_piece **pieces,
                         size_t *found);

/* Adds a stretch; returns whether the line is done, since it lies in this stretch, or memory is out. */
int drw_add(drw_scratch *scratch, double from, double to, double least);
/* Whether a line meets an item for the first time. */
static inline int drw_is_new(drw_scratch *scratch, int32_t item, int32_t line)
{
    int is_new = scratch->seen[item] != line + 1;
    scratch->seen[item] = line + 1;
    return is_new;
}
