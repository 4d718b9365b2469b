/* Runs of samples, sorted by what owns them. */
#ifndef E3D_RUNS_H
#define E3D_RUNS_H

#include "kernels/types/shown.h"

/* Sorts runs by owner; where they are afterwards. */
e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count);
/* Makes the list of what shows of sorted runs, as pieces. */
void e3d_show_runs(const e3d_run *runs, int32_t count, e3d_shown *out);

#endif
