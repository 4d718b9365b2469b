/* Finds which stretches of lines triangles hide.
 * In: triangles and lines on the drawing and in the world. Out: the pieces of each line.
 * On the drawing, a line is inside a triangle between two parameters, found from the signs of three linear functions. In the
 * world, its distance from the triangle's plane is linear, too, after division by w. So what is hidden is one stretch. Distances
 * are judged only within the triangle, where the rounding of its corners matters least: a line that lies there on its plane, up
 * to the thickness, is not hidden by it. This holds for a line on its own faces, and for faces that coincide. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "e3d_drawing.h"
#include "extras/drawing/grid.h"
#include "extras/drawing/stretches.h"

/* What counts as nothing is never more than this share of a line. */
#define MOST_NOTHING 0x1p-7

typedef struct hider {
    double sides[3][3]; /* a x + b y + c >= 0 inside: unit normals */
    double plane[4];    /* positive on the viewer's side: a unit normal */
    double nearest;     /* least depth */
} hider;

typedef struct hiding {
    const e3d_hiders *hiders;
    const e3d_lines *lines;
    hider *prepared;
    double *corners; /* (faces, 3, 2) on the drawing */
    int32_t *order;  /* those that hide anything, by depth */
    size_t count;
    drw_grid grid;
    double low[2], high[2]; /* of the lines */
} hiding;

static int set_side(double side[3], const double *a, const double *b, double turn)
{
    double normal[2] = {(a[1] - b[1]) * turn, (b[0] - a[0]) * turn};
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    if (!(length > 0))
        return 0;
    side[0] = normal[0] / length;
    side[1] = normal[1] / length;
    side[2] = -(side[0] * a[0] + side[1] * a[1]);
    return isfinite(side[2]);
}

/* Sets the sides; 0 if the triangle is no wider than what it reaches beyond its sides: it is seen edge on. */
static int set_sides(hider *made, const double *corner, double reach)
{
    const double *a = corner, *b = corner + 2, *c = corner + 4;
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), turn = area < 0 ? -1 : 1;
    if (!set_side(made->sides[0], a, b, turn) || !set_side(made->sides[1], b, c, turn) || !set_side(made->sides[2], c, a, turn))
        return 0;
    for (int k = 0; k < 3; k++) {
        const double *opposite = corner + 2 * ((k + 2) % 3), *side = made->sides[k];
        if (!((side[0] * opposite[0] + side[1] * opposite[1]) + side[2] > reach))
            return 0;
    }
    return 1;
}

static int set_plane(double plane[4], const double *a, const double *b, const double *c, const double eye[4])
{
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]), to_eye = 0;
    if (!(length > 0) || !isfinite(length))
        return 0;
    for (int k = 0; k < 3; k++)
        to_eye += n[k] * (eye[k] - eye[3] * a[k]);
    length = to_eye < 0 ? -length : length;
    for (int k = 0; k < 3; k++)
        plane[k] = n[k] / length;
    plane[3] = -((plane[0] * a[0] + plane[1] * a[1]) + plane[2] * a[2]);
    return to_eye != 0;
}

static int prepare_one(const hiding *job, size_t face)
{
    const e3d_hiders *h = job->hiders;
    const int32_t *vertex = h->faces + 3 * face;
    const double *places[3];
    hider *made = &job->prepared[face];
    made->nearest = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double *sheet = h->sheet + E3D_SHEET * (size_t)vertex[k];
        places[k] = h->places + 3 * (size_t)vertex[k];
        job->corners[6 * face + 2 * (size_t)k] = sheet[E3D_SHEET_X];
        job->corners[6 * face + 2 * (size_t)k + 1] = sheet[E3D_SHEET_Y];
        made->nearest = sheet[E3D_SHEET_DEPTH] < made->nearest ? sheet[E3D_SHEET_DEPTH] : made->nearest;
    }
    return set_sides(made, job->corners + 6 * face, h->reach) && set_plane(made->plane, places[0], places[1], places[2], h->eye);
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

static int is_beside(const hiding *job, const double *corner)
{
    for (int axis = 0; axis < 2; axis++) {
        double low = fmin(fmin(corner[axis], corner[2 + axis]), corner[4 + axis]) - job->hiders->reach;
        double high = fmax(fmax(corner[axis], corner[2 + axis]), corner[4 + axis]) + job->hiders->reach;
        if (high < job->low[axis] || low > job->high[axis])
            return 1;
    }
    return 0;
}

/* Prepares the triangles, and lists those that hide anything, nearest first. */
static e3d_status prepare(hiding *job)
{
    size_t count = job->hiders->count;
    job->prepared = malloc((count + 1) * sizeof *job->prepared);
    job->corners = malloc((6 * count + 1) * sizeof *job->corners);
    job->order = malloc((count + 1) * sizeof *job->order);
    keyed *keys = malloc((count + 1) * sizeof *keys);
    if (job->prepared && job->corners && job->order && keys) {
        for (size_t face = 0; face < count; face++)
            if (prepare_one(job, face) && !is_beside(job, job->corners + 6 * face))
                keys[job->count++] = (keyed){job->prepared[face].nearest, (int32_t)face};
        qsort(keys, job->count, sizeof *keys, by_depth);
        for (size_t i = 0; i < job->count; i++)
            job->order[i] = keys[i].face;
    }
    free(keys);
    return job->prepared && job->corners && job->order && keys ? E3D_OK : E3D_OUT_OF_MEMORY;
}

static void measure(hiding *job)
{
    for (int axis = 0; axis < 2; axis++)
        job->low[axis] = INFINITY, job->high[axis] = -INFINITY;
    for (size_t i = 0; i < 2 * job->lines->count; i++)
        for (int axis = 0; axis < 2; axis++) {
            double at = job->lines->sheet[E3D_SHEET * i + (size_t)axis];
            job->low[axis] = at < job->low[axis] ? at : job->low[axis];
            job->high[axis] = at > job->high[axis] ? at : job->high[axis];
        }
}

/* A line as the search needs it. */
typedef struct sight {
    const double *places, *sheet; /* of both ends */
    double ends[4], inverse_w[2], farthest, least;
} sight;

static double share(double a, double b, double t) { return a * (1 - t) + b * t; }

/* Narrows a stretch to where a linear function, given at both ends of the line, is not negative. */
static int narrow(drw_stretch *within, double at_start, double at_end)
{
    if (at_start < 0 && at_end < 0)
        return 0;
    if (at_start < 0)
        within->from = fmax(within->from, at_start / (at_start - at_end));
    else if (at_end < 0)
        within->to = fmin(within->to, at_start / (at_start - at_end));
    return within->from < within->to;
}

static int is_inside(const hider *by, const sight *line, double reach, drw_stretch *within)
{
    for (int k = 0; k < 3; k++) {
        const double *side = by->sides[k];
        double at_start = (side[0] * line->ends[0] + side[1] * line->ends[1]) + side[2] + reach;
        double at_end = (side[0] * line->ends[2] + side[1] * line->ends[3]) + side[2] + reach;
        if (!narrow(within, at_start, at_end))
            return 0;
    }
    return 1;
}

static double distance(const hider *by, const double *place)
{
    return ((by->plane[0] * place[0] + by->plane[1] * place[1]) + by->plane[2] * place[2]) + by->plane[3];
}

/* Finds the stretch of a line that a triangle hides; 0 if there is none. */
static int is_hidden(const hider *by, const sight *line, const e3d_hiders *all, drw_stretch *within)
{
    *within = (drw_stretch){0, 1};
    if (!is_inside(by, line, all->reach, within))
        return 0;
    /* Linear on the drawing: distances over w. */
    double at[2] = {distance(by, line->places) * line->inverse_w[0], distance(by, line->places + 3) * line->inverse_w[1]};
    double ends[2] = {within->from, within->to}, over[2];
    int sign[2];
    for (int k = 0; k < 2; k++) {
        over[k] = share(at[0], at[1], ends[k]);
        double limit = all->thickness * share(line->inverse_w[0], line->inverse_w[1], ends[k]);
        sign[k] = over[k] < -limit ? -1 : over[k] > limit ? 1
                                                          : 0;
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
    *line = (sight){.places = job->lines->places + 6 * (size_t)number, .sheet = sheet};
    for (int k = 0; k < 2; k++) {
        line->ends[2 * k] = sheet[E3D_SHEET * k + E3D_SHEET_X];
        line->ends[2 * k + 1] = sheet[E3D_SHEET * k + E3D_SHEET_Y];
        line->inverse_w[k] = sheet[E3D_SHEET * k + E3D_SHEET_INVERSE_W];
    }
    line->farthest = fmax(sheet[E3D_SHEET_DEPTH], sheet[E3D_SHEET + E3D_SHEET_DEPTH]);
    double run = line->ends[2] - line->ends[0], rise = line->ends[3] - line->ends[1], length = sqrt(run * run + rise * rise);
    if (!(length > job->lines->least * MOST_NOTHING) || !isfinite(length))
        return 0;
    line->least = fmin(job->lines->least / length, MOST_NOTHING);
    return 1;
}

static int find_in_cell(const hiding *job, const sight *line, int32_t number, size_t cell, drw_scratch *scratch)
{
    const int32_t *items = job->grid.items;
    for (int32_t i = job->grid.starts[cell]; i < job->grid.starts[cell + 1]; i++) {
        const hider *by = &job->prepared[items[i]];
        drw_stretch within;
        if (by->nearest > line->farthest)
            return 0;
        if (drw_is_new(scratch, items[i], number) && is_hidden(by, line, job->hiders, &within) &&
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
    measure(&job);
    e3d_status status = prepare(&job);
    if (status == E3D_OK)
        status = drw_grid_build(&job.grid, job.corners, 3, job.order, job.count, job.low, job.high, hiders->reach);
    if (status == E3D_OK)
        status = drw_cut_lines(find_stretches, &job, lines->count, hiders->count, threads, pieces, count);
    drw_grid_free(&job.grid);
    free(job.prepared);
    free(job.corners);
    free(job.order);
    e3d_fpenv_leave(saved);
    return status;
}
