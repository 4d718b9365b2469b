/* Finds where segments of a drawing lie on earlier ones, so that each stroke is drawn once.
 * In: segments, the most important first. Out: the pieces of each; hidden are those on an earlier segment. */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"
#include "extras/drawing/grid.h"
#include "extras/drawing/stretches.h"

typedef struct repetition {
    const double *segments;
    double tolerance;
    drw_grid grid;
} repetition;

static double length_of(const double *a) { return sqrt((a[2] - a[0]) * (a[2] - a[0]) + (a[3] - a[1]) * (a[3] - a[1])); }

/* Finds the stretch of segment a along which b lies within the tolerance: all of what they share, or nothing. */
static int is_repeated(const double *a, const double *b, double tolerance, drw_stretch *within)
{
    double run = a[2] - a[0], rise = a[3] - a[1], square = run * run + rise * rise;
    double s = (run * (b[0] - a[0]) + rise * (b[1] - a[1])) / square, t = (run * (b[2] - a[0]) + rise * (b[3] - a[1])) / square;
    double from = fmax(fmin(s, t), 0), to = fmin(fmax(s, t), 1);
    if (!(from < to))
        return 0;
    double aside[2] = {run * (b[1] - a[1]) - rise * (b[0] - a[0]), run * (b[3] - a[1]) - rise * (b[2] - a[0])};
    double limit = tolerance * sqrt(square), ends[2] = {from, to};
    for (int k = 0; k < 2; k++) {
        double along = (ends[k] - s) / (t - s);
        if (!(fabs(aside[0] + (aside[1] - aside[0]) * along) <= limit))
            return 0;
    }
    *within = (drw_stretch){from, to};
    return 1;
}

static int find_stretches(const void *argument, int32_t number, drw_scratch *scratch, double *least)
{
    const repetition *job = argument;
    const drw_grid *grid = &job->grid;
    const double *own = job->segments + 4 * (size_t)number;
    double length = length_of(own);
    drw_stretch within;
    if (!(length > 0) || !isfinite(length))
        return 0;
    *least = fmin(job->tolerance / length, 0.5);
    drw_block block = drw_block_of(grid, own, 2);
    for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
        drw_span columns = drw_columns(grid, own, 2, block, row);
        for (int32_t column = columns.first; column <= columns.last; column++) {
            size_t cell = (size_t)row * (size_t)grid->columns + (size_t)column;
            for (int32_t i = grid->starts[cell]; i < grid->starts[cell + 1]; i++)
                if (grid->items[i] < number && drw_is_new(scratch, grid->items[i], number) &&
                    is_repeated(own, job->segments + 4 * (size_t)grid->items[i], job->tolerance, &within) &&
                    drw_add(scratch, within.from, within.to, *least))
                    return 1;
        }
    }
    return 1;
}

e3d_status e3d_hide_repeated(const double *segments, size_t count, double tolerance, int threads, e3d_piece **pieces, size_t *found)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    repetition job = {.segments = segments, .tolerance = tolerance};
    double low[2], high[2];
    int32_t *order = malloc((count + 1) * sizeof *order);
    e3d_status status = order ? E3D_OK : E3D_OUT_OF_MEMORY;
    for (size_t i = 0; order && i < count; i++)
        order[i] = (int32_t)i;
    drw_measure(segments, count, low, high);
    drw_items items = {segments, 2};
    size_t kept = count;
    if (status == E3D_OK)
        status = drw_grid_make(&job.grid, items, order, &kept, NULL, 0, low, high, tolerance);
    if (status == E3D_OK)
        status = drw_grid_fill(&job.grid, items, order, kept);
    if (status == E3D_OK)
        status = drw_cut_lines(find_stretches, &job, count, count, threads, pieces, found);
    drw_grid_free(&job.grid);
    free(order);
    e3d_fpenv_leave(saved);
    return status;
}
