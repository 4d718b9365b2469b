/* Finds where segments of a drawing lie on earlier ones, so that each stroke is drawn once.
 * In: segments, the most important first. Out: the pieces of each; hidden are those on an earlier segment. */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "base/large_pages.h"
#include "e3d_drawing.h"
#include "extras/drawing/grid.h"
#include "extras/drawing/outsides.h"
#include "extras/drawing/stretches.h"

#define CELLS_A_SEGMENT 0.5

typedef struct repetition {
    const double *segments;
    drw_outside *outsides; /* (count,): their boxes with the tolerance */
    double tolerance;
    drw_grid grid;
} repetition;

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }

/* A segment as the search needs it. */
typedef struct stroke {
    const double *ends;
    double run, rise, square, length;
} stroke;

static stroke stroke_of(const double *ends)
{
    stroke made = {ends, ends[2] - ends[0], ends[3] - ends[1], 0, 0};
    made.square = made.run * made.run + made.rise * made.rise;
    made.length = sqrt(made.square);
    return made;
}

/* Finds the stretch of segment a along which b lies within the tolerance: all of what they share, or nothing. Most pairs are told
 * apart without a division: beside each other, or both ends of b on one side of a. */
static int is_repeated(const stroke *a, const double *b, double tolerance, drw_stretch *within)
{
    double x[2] = {b[0] - a->ends[0], b[2] - a->ends[0]}, y[2] = {b[1] - a->ends[1], b[3] - a->ends[1]};
    double along[2] = {a->run * x[0] + a->rise * y[0], a->run * x[1] + a->rise * y[1]};
    if ((along[0] <= 0 && along[1] <= 0) || (along[0] >= a->square && along[1] >= a->square))
        return 0;
    double aside[2] = {a->run * y[0] - a->rise * x[0], a->run * y[1] - a->rise * x[1]}, limit = tolerance * a->length;
    if ((aside[0] > limit && aside[1] > limit) || (aside[0] < -limit && aside[1] < -limit))
        return 0;
    double s = along[0] / a->square, t = along[1] / a->square;
    double ends[2] = {more(less(s, t), 0), less(more(s, t), 1)};
    if (!(ends[0] < ends[1]))
        return 0;
    for (int k = 0; k < 2; k++)
        if (!(fabs(aside[0] + (aside[1] - aside[0]) * ((ends[k] - s) / (t - s))) <= limit))
            return 0;
    *within = (drw_stretch){ends[0], ends[1]};
    return 1;
}

static int find_stretches(const void *argument, int32_t number, drw_scratch *scratch, double *least)
{
    const repetition *job = argument;
    const drw_grid *grid = &job->grid;
    const stroke own = stroke_of(job->segments + 4 * (size_t)number);
    drw_stretch within;
    if (!(own.length > 0) || !isfinite(own.length))
        return 0;
    *least = less(job->tolerance / own.length, 0.5);
    drw_outside opposite = drw_opposite(job->outsides[number]);
    drw_block block = drw_block_of(grid, own.ends, 2);
    for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
        drw_span columns = drw_columns(grid, own.ends, 2, block, row);
        for (int32_t column = columns.first; column <= columns.last; column++) {
            size_t cell = (size_t)row * (size_t)grid->columns + (size_t)column;
            for (int32_t i = grid->starts[cell]; i < grid->starts[cell + 1] && grid->items[i] < number; i++)
                if (drw_meets(job->outsides[grid->items[i]], opposite) && drw_is_new(scratch, grid->items[i], number) &&
                    is_repeated(&own, job->segments + 4 * (size_t)grid->items[i], job->tolerance, &within) &&
                    drw_add(scratch, within.from, within.to, *least))
                    return 1;
        }
    }
    return 1;
}

/* The box of a segment with a margin beyond the tolerance that rounding stays below. */
static drw_outside outside_of(const double *ends, double tolerance)
{
    double size = (fabs(ends[0]) + fabs(ends[1])) + (fabs(ends[2]) + fabs(ends[3])), margin = tolerance + (tolerance + size) * 0x1p-20;
    return (drw_outside){(float)(less(ends[0], ends[2]) - margin), (float)(less(ends[1], ends[3]) - margin),
                         -(float)(more(ends[0], ends[2]) + margin), -(float)(more(ends[1], ends[3]) + margin)};
}

e3d_status e3d_hide_repeated(const double *segments, size_t count, double tolerance, int threads, e3d_piece **pieces, size_t *found)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    repetition job = {.segments = segments, .tolerance = tolerance};
    double low[2], high[2];
    int32_t *order = malloc((count + 1) * sizeof *order);
    job.outsides = e3d_large_memory((count + 1) * sizeof *job.outsides);
    e3d_status status = order && job.outsides ? E3D_OK : E3D_OUT_OF_MEMORY;
    for (size_t i = 0; status == E3D_OK && i < count; i++) {
        order[i] = (int32_t)i;
        job.outsides[i] = outside_of(segments + 4 * i, tolerance);
    }
    drw_measure(segments, count, low, high);
    drw_items items = {segments, 2};
    size_t kept = count;
    if (status == E3D_OK)
        status = drw_grid_make(&job.grid, items, order, &kept, NULL, 0, low, high, tolerance, CELLS_A_SEGMENT);
    if (status == E3D_OK)
        status = drw_grid_fill(&job.grid, items, count);
    if (status == E3D_OK)
        status = drw_cut_lines(find_stretches, &job, count, count, threads, pieces, found);
    drw_grid_free(&job.grid);
    free(order);
    free(job.outsides);
    e3d_fpenv_leave(saved);
    return status;
}
