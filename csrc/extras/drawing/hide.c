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
#include "extras/drawing/grid.h"
#include "extras/drawing/stretches.h"

/* What counts as nothing is never more than this share of a line. */
#define MOST_NOTHING 0x1p-7

typedef struct hiding {
    const e3d_hiders *hiders;
    const e3d_lines *lines;
    double *corners; /* (faces, 3, 2) on the drawing */
    double *nearest; /* (faces,): least depths */
    double *ends;    /* (lines, 2, 2) on the drawing */
    int32_t *order;  /* those that may hide anything, by depth */
    size_t count;
    drw_grid grid;
    double low[2], high[2]; /* of the lines */
} hiding;

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }

/* Copies a triangle's corners; returns whether it may cover a line. */
static int prepare_one(const hiding *job, size_t face)
{
    const int32_t *vertex = job->hiders->faces + 3 * face;
    const double *a = job->hiders->sheet + E3D_SHEET * (size_t)vertex[0], *b = job->hiders->sheet + E3D_SHEET * (size_t)vertex[1],
                 *c = job->hiders->sheet + E3D_SHEET * (size_t)vertex[2];
    double *corner = job->corners + 6 * face, reach = job->hiders->reach;
    int meets = 1;
    for (int axis = 0; axis < 2; axis++) {
        corner[axis] = a[axis];
        corner[2 + axis] = b[axis];
        corner[4 + axis] = c[axis];
        meets &= more(more(a[axis], b[axis]), c[axis]) + reach >= job->low[axis];
        meets &= less(less(a[axis], b[axis]), c[axis]) - reach <= job->high[axis];
    }
    meets &= isfinite(a[E3D_SHEET_DEPTH]) && isfinite(b[E3D_SHEET_DEPTH]) && isfinite(c[E3D_SHEET_DEPTH]);
    job->nearest[face] = less(less(a[E3D_SHEET_DEPTH], b[E3D_SHEET_DEPTH]), c[E3D_SHEET_DEPTH]);
    return meets;
}

typedef struct keyed {
    double depth;
    int32_t face;
} keyed;

static int by_depth(const void *a, const void *b)
{
    const keyed *first = a, *second = b;
    if (first->depth != second->depth)
        return first->depth < second->depth ? -1 : 1;
    return (first->face > second->face) - (first->face < second->face);
}

static e3d_status sort_by_depth(const hiding *job)
{
    keyed *keys = malloc((job->count + 1) * sizeof *keys);
    if (!keys)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < job->count; i++)
        keys[i] = (keyed){job->nearest[job->order[i]], job->order[i]};
    qsort(keys, job->count, sizeof *keys, by_depth);
    for (size_t i = 0; i < job->count; i++)
        job->order[i] = keys[i].face;
    free(keys);
    return E3D_OK;
}

/* Lists the triangles that lines pass, for each cell of the grid, nearest first. */
static e3d_status prepare(hiding *job)
{
    size_t count = job->hiders->count;
    drw_items items = {job->corners, 3};
    for (size_t face = 0; face < count; face++)
        if (prepare_one(job, face))
            job->order[job->count++] = (int32_t)face;
    e3d_status status = drw_grid_make(&job->grid, items, job->order, &job->count, job->ends, job->lines->count, job->low, job->high,
                                      job->hiders->reach);
    if (status == E3D_OK)
        status = sort_by_depth(job);
    return status == E3D_OK ? drw_grid_fill(&job->grid, items, job->order, job->count) : status;
}

static int reserve(hiding *job)
{
    size_t faces = job->hiders->count + 1;
    job->corners = malloc(6 * faces * sizeof *job->corners);
    job->nearest = malloc(faces * sizeof *job->nearest);
    job->order = malloc(faces * sizeof *job->order);
    job->ends = malloc((4 * job->lines->count + 1) * sizeof *job->ends);
    return job->corners && job->nearest && job->order && job->ends;
}

static void measure(hiding *job)
{
    for (size_t i = 0; i < 2 * job->lines->count; i++)
        for (size_t axis = 0; axis < 2; axis++)
            job->ends[2 * i + axis] = job->lines->sheet[E3D_SHEET * i + axis];
    drw_measure(job->ends, job->lines->count, job->low, job->high);
}

/* A line as the search needs it. */
typedef struct sight {
    const double *places; /* of both ends */
    double ends[4], inverse_w[2], farthest, least;
} sight;

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

/* Finds the stretch of a line within a triangle on the drawing; 0 if there is none, or the triangle is seen edge on. */
static int is_inside(const double *corner, const sight *line, double reach, drw_stretch *within)
{
    double u[2] = {corner[2] - corner[0], corner[3] - corner[1]}, v[2] = {corner[4] - corner[0], corner[5] - corner[1]};
    double area = u[0] * v[1] - u[1] * v[0], turn = area < 0 ? -1 : 1;
    if (!(fabs(area) > reach * (fabs(u[0]) + fabs(u[1]) + fabs(v[0]) + fabs(v[1]))))
        return 0;
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

/* A plane through a triangle, with the viewer on its positive side. */
typedef struct plane {
    const double *place;
    double normal[3], length;
} plane;

static int find_plane(const e3d_hiders *all, int32_t face, plane *out)
{
    const int32_t *vertex = all->faces + 3 * (size_t)face;
    const double *a = all->places + 3 * (size_t)vertex[0], *b = all->places + 3 * (size_t)vertex[1],
                 *c = all->places + 3 * (size_t)vertex[2];
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, to_eye = 0;
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (int k = 0; k < 3; k++)
        to_eye += n[k] * (all->eye[k] - all->eye[3] * a[k]);
    for (int k = 0; k < 3; k++)
        out->normal[k] = to_eye < 0 ? -n[k] : n[k];
    out->place = a;
    out->length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    return out->length > 0 && isfinite(out->length) && to_eye != 0;
}

/* The distance of a place from a plane, times the length of its normal. */
static double distance(const plane *from, const double *place)
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += from->normal[k] * (place[k] - from->place[k]);
    return sum;
}

/* Finds the stretch of a line that a triangle hides; 0 if there is none. */
static int is_hidden(const hiding *job, int32_t face, const sight *line, drw_stretch *within)
{
    const e3d_hiders *all = job->hiders;
    plane by;
    *within = (drw_stretch){0, 1};
    if (!is_inside(job->corners + 6 * (size_t)face, line, all->reach, within) || !find_plane(all, face, &by))
        return 0;
    /* Linear on the drawing: distances over w. */
    double at[2] = {distance(&by, line->places) * line->inverse_w[0], distance(&by, line->places + 3) * line->inverse_w[1]};
    double ends[2] = {within->from, within->to}, over[2], thickness = all->thickness * by.length;
    int sign[2];
    for (int k = 0; k < 2; k++) {
        over[k] = share(at[0], at[1], ends[k]);
        double limit = thickness * share(line->inverse_w[0], line->inverse_w[1], ends[k]);
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
    *line = (sight){.places = job->lines->places + 6 * (size_t)number};
    for (int k = 0; k < 2; k++) {
        line->ends[2 * k] = sheet[E3D_SHEET * k + E3D_SHEET_X];
        line->ends[2 * k + 1] = sheet[E3D_SHEET * k + E3D_SHEET_Y];
        line->inverse_w[k] = sheet[E3D_SHEET * k + E3D_SHEET_INVERSE_W];
    }
    line->farthest = more(sheet[E3D_SHEET_DEPTH], sheet[E3D_SHEET + E3D_SHEET_DEPTH]);
    double run = line->ends[2] - line->ends[0], rise = line->ends[3] - line->ends[1], length = sqrt(run * run + rise * rise);
    if (!(length > job->lines->least * MOST_NOTHING) || !isfinite(length))
        return 0;
    line->least = less(job->lines->least / length, MOST_NOTHING);
    return 1;
}

static int find_in_cell(const hiding *job, const sight *line, int32_t number, size_t cell, drw_scratch *scratch)
{
    const int32_t *items = job->grid.items;
    for (int32_t i = job->grid.starts[cell]; i < job->grid.starts[cell + 1]; i++) {
        drw_stretch within;
        if (job->nearest[items[i]] > line->farthest)
            return 0;
        if (drw_is_new(scratch, items[i], number) && is_hidden(job, items[i], line, &within) &&
            drw_add(scratch, within.from, within.to, line->least))
            return 1;
    }
    return 0;
}

static int find_stretches(const void *argument, int32_t number, drw_scratch *scratch, double *least)
{
    const hiding *job = argument;
    sight line;
    if (!find_sight(job, number, &line))
        return 0;
    *least = line.least;
    drw_span rows = drw_rows(&job->grid, line.ends, 2);
    for (int32_t row = rows.first; row <= rows.last; row++) {
        drw_span columns = drw_columns(&job->grid, line.ends, 2, row);
        for (int32_t column = columns.first; column <= columns.last; column++)
            if (find_in_cell(job, &line, number, (size_t)row * (size_t)job->grid.columns + (size_t)column, scratch))
                return 1;
    }
    return 1;
}

e3d_status e3d_hide_lines(const e3d_hiders *hiders, const e3d_lines *lines, int threads, e3d_piece **pieces, size_t *count)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    hiding job = {.hiders = hiders, .lines = lines};
    e3d_status status = reserve(&job) ? E3D_OK : E3D_OUT_OF_MEMORY;
    if (status == E3D_OK) {
        measure(&job);
        status = prepare(&job);
    }
    if (status == E3D_OK)
        status = drw_cut_lines(find_stretches, &job, lines->count, hiders->count, threads, pieces, count);
    drw_grid_free(&job.grid);
    free(job.corners);
    free(job.nearest);
    free(job.order);
    free(job.ends);
    e3d_fpenv_leave(saved);
    return status;
}
