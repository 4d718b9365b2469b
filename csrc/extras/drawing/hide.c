/* Finds which stretches of lines triangles hide.
 * In: triangles and lines on the drawing and in the world. Out: the pieces of each line.
 * On the drawing, a line is inside a triangle between two parameters, found from the signs of three linear functions. In the
 * world, its distance from the triangle's plane is linear, too, after division by w. So what is hidden is one stretch. Distances
 * are judged only within the triangle, where the rounding of its corners matters least: a line that lies there on its plane, up
 * to the thickness, is not hidden by it. This holds for a line on its own faces, and for faces that coincide. */
#include <math.h>
#include <stdlib.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"
#include "extras/drawing/hiders.h"
#include "extras/drawing/stretches.h"

/* What counts as nothing is never more than this share of a line. */
#define MOST_NOTHING 0x1p-7

typedef struct hiding {
    const e3d_lines *lines;
    drw_hiders hiders;
} hiding;

/* A line as the search needs it. */
typedef struct sight {
    const double *places; /* of both ends */
    double ends[4], inverse_w[2], least;
    drw_outside opposite; /* of its box */
    int32_t nearer;       /* triangles from this one on are behind it */
    int has_cells;        /* it touches several cells */
} sight;

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }
static double share(double a, double b, double t) { return a * (1 - t) + b * t; }

/* Narrows a stretch to where a linear function, given at both ends of the line, is not negative. */
static int narrow(drw_stretch *within, double at_start, double at_end)
{
    if (at_start < 0 && at_end < 0)
        return 0;
    if (at_start < 0)
        within->from = more(within->from, at_start / (at_start - at_end));
    else if (at_end < 0)
        within->to = less(within->to, at_start / (at_start - at_end));
    return within->from < within->to;
}

/* Finds the stretch of a line within a triangle on the drawing; 0 if there is none. */
static int is_inside(const double *corner, const sight *line, double reach, drw_stretch *within)
{
    double u[2] = {corner[2] - corner[0], corner[3] - corner[1]}, v[2] = {corner[4] - corner[0], corner[5] - corner[1]};
    double turn = u[0] * v[1] - u[1] * v[0] < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        const double *a = corner + 2 * k, *b = corner + 2 * ((k + 1) % 3);
        double normal[2] = {(a[1] - b[1]) * turn, (b[0] - a[0]) * turn}, room = reach * (fabs(normal[0]) + fabs(normal[1]));
        double at_start = normal[0] * (line->ends[0] - a[0]) + normal[1] * (line->ends[1] - a[1]) + room;
        double at_end = normal[0] * (line->ends[2] - a[0]) + normal[1] * (line->ends[3] - a[1]) + room;
        if (!narrow(within, at_start, at_end))
            return 0;
    }
    return 1;
}

/* The distance of a place from a plane, times the length of its normal. */
static double distance(const drw_plane *from, const double *place)
{
    return (from->normal[0] * (place[0] - from->place[0]) + from->normal[1] * (place[1] - from->place[1])) +
           from->normal[2] * (place[2] - from->place[2]);
}

/* Finds the stretch of a line that is behind a triangle, of one within it on the drawing; 0 if there is none.
 * `away`: the distances of the line's ends from the plane. */
static int is_behind(const drw_plane *by, const sight *line, const double away[2], drw_stretch *within)
{
    /* Linear on the drawing: distances over w. */
    double at[2] = {away[0] * line->inverse_w[0], away[1] * line->inverse_w[1]}, ends[2] = {within->from, within->to}, over[2];
    int sign[2];
    for (int k = 0; k < 2; k++) {
        over[k] = share(at[0], at[1], ends[k]);
        double limit = by->limit * share(line->inverse_w[0], line->inverse_w[1], ends[k]);
        sign[k] = (over[k] > limit) - (over[k] < -limit);
    }
    if (sign[0] >= 0 && sign[1] >= 0)
        return 0;
    double crossing = ends[0] + (ends[1] - ends[0]) * (over[0] / (over[0] - over[1]));
    if (sign[0] > 0)
        within->from = crossing;
    else if (sign[1] > 0)
        within->to = crossing;
    return 1;
}

static int find_sight(const hiding *job, int32_t number, sight *line)
{
    const double *sheet = job->lines->sheet + 2 * E3D_SHEET * (size_t)number;
    line->places = job->lines->places + 6 * (size_t)number;
    for (int k = 0; k < 2; k++) {
        line->ends[2 * k] = sheet[E3D_SHEET * k + E3D_SHEET_X];
        line->ends[2 * k + 1] = sheet[E3D_SHEET * k + E3D_SHEET_Y];
        line->inverse_w[k] = sheet[E3D_SHEET * k + E3D_SHEET_INVERSE_W];
    }
    double run = line->ends[2] - line->ends[0], rise = line->ends[3] - line->ends[1], length = sqrt(run * run + rise * rise);
    if (!(length > job->lines->least * MOST_NOTHING) || !isfinite(length))
        return 0;
    line->least = less(job->lines->least / length, MOST_NOTHING);
    line->opposite = drw_opposite(drw_outside_of(&job->hiders, line->ends, 2, 0));
    line->nearer = job->hiders.nearer[drw_step_of(&job->hiders, more(sheet[E3D_SHEET_DEPTH], sheet[E3D_SHEET + E3D_SHEET_DEPTH]))];
    return 1;
}

/* Adds the stretches that the triangles of a cell hide; returns whether the line is done. Most triangles are left out by the
 * first two questions: whether boxes meet, and whether an end of the line is behind the plane. */
static int find_in_cell(const drw_hiders *all, const sight *line, int32_t number, size_t cell, drw_scratch *scratch)
{
    const int32_t *end = all->grid.items + all->grid.starts[cell + 1];
    for (const int32_t *item = all->grid.items + all->grid.starts[cell]; item < end && *item < line->nearer; item++) {
        if (!drw_meets(all->outsides[*item], line->opposite))
            continue;
        const drw_plane *by = &all->planes[*item];
        double away[2] = {distance(by, line->places), distance(by, line->places + 3)};
        if ((away[0] >= -by->limit && away[1] >= -by->limit) || (line->has_cells && !drw_is_new(scratch, *item, number)))
            continue;
        drw_stretch within = {0, 1};
        if (is_inside(all->corners + 6 * (size_t)*item, line, all->given->reach, &within) &&
            is_behind(by, line, away, &within) && drw_add(scratch, within.from, within.to, line->least))
            return 1;
    }
    return 0;
}

static int find_stretches(const void *argument, int32_t number, drw_scratch *scratch, double *least)
{
    const hiding *job = argument;
    const drw_grid *grid = &job->hiders.grid;
    sight line;
    if (!find_sight(job, number, &line))
        return 0;
    *least = line.least;
    if (job->lines->behind && job->lines->behind[number]) {
        drw_add(scratch, 0, 1, line.least);
        return 1;
    }
    drw_block block = drw_block_of(grid, line.ends, 2);
    line.has_cells = block.rows.first < block.rows.last || block.columns.first < block.columns.last;
    for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
        drw_span columns = drw_columns(grid, line.ends, 2, block, row);
        for (int32_t column = columns.first; column <= columns.last; column++)
            if (find_in_cell(&job->hiders, &line, number, (size_t)row * (size_t)grid->columns + (size_t)column, scratch))
                return 1;
    }
    return 1;
}

e3d_status e3d_hide_lines(const e3d_hiders *hiders, const e3d_lines *lines, int threads, e3d_piece **pieces, size_t *count)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    hiding job = {.lines = lines};
    e3d_status status = drw_hiders_prepare(&job.hiders, hiders, lines);
    if (status == E3D_OK)
        status = drw_cut_lines(find_stretches, &job, lines->count, job.hiders.count, threads, pieces, count);
    drw_hiders_free(&job.hiders);
    e3d_fpenv_leave(saved);
    return status;
}
