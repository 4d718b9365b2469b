/* Runs of samples, sorted by what owns them. */
#ifndef E3D_RUNS_H
#define E3D_RUNS_H

#include "base/limits.h"
#include "kernels/types/shown.h"

/* A thread's memory, of one tile. */
typedef struct e3d_runs_memory {
    e3d_run rows[E3D_TILE_SAMPLES + 1]; /* what shows, row by row */
    char apart[2048]; /* padding against 4K aliasing: sorting reads `rows` and writes `spare`; loads at the same offset in a
                       * page as a store before them would wait for it */
    e3d_run spare[E3D_TILE_SAMPLES]; /* while runs are sorted */
} e3d_runs_memory;

/* Sorts runs by owner; where they are afterwards. */
e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count);
/* Makes the list of what shows of sorted runs, as primitives. */
void e3d_show_runs(const e3d_run *runs, int32_t count, e3d_shown *out);

#endif
