/* Runs of samples, sorted by what owns them. */
#pragma once

#include "base/limits.h"
#include "kernels/types/shown.h"

/* A thread's memory, of one tile. */
typedef struct e3d_runs_memory {
    e3d_run rows[E3D_TILE_SAMPLES + 1]; /* the runs that show, row by row */
    /* Padding against 4K aliasing: sorting reads `rows` and writes `spare`, and a load waits for an earlier store at the same
     * offset in a page */
    char apart[2048];
    e3d_run spare[E3D_TILE_SAMPLES]; /* scratch for sorting runs */
} e3d_runs_memory;

/* Sorts runs by owner; returns the array that holds them afterwards. */
e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count);
/* Turns sorted runs into the list of what shows, primitive by primitive. */
void e3d_show_runs(const e3d_run *runs, int32_t count, e3d_shown *out);
