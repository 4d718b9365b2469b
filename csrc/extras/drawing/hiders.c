/* Chooses the triangles that may hide lines, puts them in order of depth, and lists them in a grid. */
#include "extras/drawing/hiders.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/large_pages.h"

/* The search is so fast beside the making of lists that cells are large. */
#define CELLS_A_TRIANGLE 0.1

static double less(double a, double b) { return b < a ? b : a; }
static double more(double a, double b) { return b > a ? b : a; }

int32_t drw_step_of(const drw_hiders *all, double depth)
{
    double step = (depth - all->nearest) * all->steps_per_depth;
    return step < DRW_STEPS - 1 ? step > 0 ? (int32_t)step : 0 : DRW_STEPS - 1;
}

drw_outside drw_outside_of(const drw_hiders *all, const double *at, int corners, double reach)
{
    drw_outside made;
    for (int axis = 0; axis < 2; axis++) {
        double low = at[axis], high = low;
        for (int k = 1; k < corners; k++) {
            low = less(low, at[2 * k + axis]);
            high = more(high, at[2 * k + axis]);
        }
        made[axis] = (float)((low - reach - all->grid.low[axis]) * all->grid.cells_per_unit[axis]);
        made[2 + axis] = -(float)((high + reach - all->grid.low[axis]) * all->grid.cells_per_unit[axis]);
    }
    return made;
}

/* Copies a triangle's corners; returns whether it may cover a line: it meets the lines' box, and is not seen edge on. */
static int copy_corners(const e3d_hiders *given, size_t face, const double low[2], const double high[2], double *corner)
{
    const int32_t *vertex = given->faces + 3 * face;
    const double *a = given->sheet + E3D_SHEET * (size_t)vertex[0], *b = given->sheet + E3D_SHEET * (size_t)vertex[1],
                 *c = given->sheet + E3D_SHEET * (size_t)vertex[2];
    double reach = given->reach;
    int meets = 1;
    for (int axis = 0; axis < 2; axis++) {
        corner[axis] = a[axis];
        corner[2 + axis] = b[axis];
        corner[4 + axis] = c[axis];
        meets &= more(more(a[axis], b[axis]), c[axis]) + reach >= low[axis];
        meets &= less(less(a[axis], b[axis]), c[axis]) - reach <= high[axis];
    }
    meets &= isfinite(a[E3D_SHEET_DEPTH]) && isfinite(b[E3D_SHEET_DEPTH]) && isfinite(c[E3D_SHEET_DEPTH]);
    double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
    return meets && fabs(u[0] * v[1] - u[1] * v[0]) > reach * (fabs(u[0]) + fabs(u[1]) + fabs(v[0]) + fabs(v[1]));
}

static double least_depth(const e3d_hiders *given, size_t face)
{
    const int32_t *vertex = given->faces + 3 * face;
    double depth[3];
    for (int k = 0; k < 3; k++)
        depth[k] = given->sheet[E3D_SHEET * (size_t)vertex[k] + E3D_SHEET_DEPTH];
    return less(less(depth[0], depth[1]), depth[2]);
}

static drw_plane plane_of(const e3d_hiders *given, size_t face)
{
    const int32_t *vertex = given->faces + 3 * face;
    const double *a = given->places + 3 * (size_t)vertex[0], *b = given->places + 3 * (size_t)vertex[1],
                 *c = given->places + 3 * (size_t)vertex[2];
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, to_eye = 0;
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (int k = 0; k < 3; k++)
        to_eye += n[k] * (given->eye[k] - given->eye[3] * a[k]);
    double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]), sign = to_eye < 0 ? -1 : 1;
    int hides = length > 0 && isfinite(length) && to_eye != 0;
    return (drw_plane){{a[0], a[1], a[2]}, {n[0] * sign, n[1] * sign, n[2] * sign}, hides ? given->thickness * length : INFINITY};
}

/* The triangles that may cover lines, with those that the grid lists first. */
typedef struct chosen {
    int32_t *faces, *listed;
    double *corners, low[2], high[2]; /* the box of the lines */
    size_t count;
} chosen;

/* Chooses triangles, and finds their range of depths. */
static void choose_faces(drw_hiders *all, chosen *out)
{
    double farthest = -INFINITY;
    all->nearest = INFINITY;
    for (size_t face = 0; face < all->given->count; face++) {
        if ((all->given->needless && all->given->needless[face]) ||
            !copy_corners(all->given, face, out->low, out->high, out->corners + 6 * out->count))
            continue;
        double depth = least_depth(all->given, face);
        all->nearest = less(all->nearest, depth);
        farthest = more(farthest, depth);
        out->listed[out->count] = (int32_t)out->count;
        out->faces[out->count++] = (int32_t)face;
    }
    double range = farthest - all->nearest;
    all->steps_per_depth = range > 0 ? DRW_STEPS / range : 0;
}

/* Prepares the triangles that the grid lists, in order of depth. */
static e3d_status sort(drw_hiders *all, chosen *from)
{
    size_t room = all->count + 1;
    all->corners = malloc(6 * room * sizeof *all->corners);
    all->outsides = e3d_large_memory(room * sizeof *all->outsides);
    all->planes = malloc(room * sizeof *all->planes);
    all->nearer = calloc(DRW_STEPS + 1, sizeof *all->nearer);
    if (!all->corners || !all->outsides || !all->planes || !all->nearer)
        return E3D_OUT_OF_MEMORY;
    int32_t *starts = all->nearer; /* where each step begins, and in the end where it ends */
    for (size_t i = 0; i < all->count; i++)
        starts[drw_step_of(all, least_depth(all->given, (size_t)from->faces[from->listed[i]])) + 1]++;
    for (size_t step = 0; step < DRW_STEPS; step++)
        starts[step + 1] += starts[step];
    for (size_t i = 0; i < all->count; i++) {
        size_t face = (size_t)from->faces[from->listed[i]];
        const double *corner = from->corners + 6 * (size_t)from->listed[i];
        double depth = least_depth(all->given, face);
        size_t place = (size_t)starts[drw_step_of(all, depth)]++;
        memcpy(all->corners + 6 * place, corner, 6 * sizeof *corner);
        all->outsides[place] = drw_outside_of(all, corner, 3, all->given->reach);
        all->planes[place] = plane_of(all->given, face);
    }
    return E3D_OK;
}

static double *ends_of(const e3d_lines *lines)
{
    double *ends = malloc((4 * lines->count + 1) * sizeof *ends);
    for (size_t i = 0; ends && i < 2 * lines->count; i++)
        for (size_t axis = 0; axis < 2; axis++)
            ends[2 * i + axis] = lines->sheet[E3D_SHEET * i + axis];
    return ends;
}

static e3d_status list(drw_hiders *all, chosen *some, const double *ends, const e3d_lines *lines)
{
    all->count = some->count;
    drw_items items = {some->corners, 3};
    e3d_status status = drw_grid_make(&all->grid, items, some->listed, &all->count, ends, lines->count, some->low, some->high,
                                      all->given->reach, CELLS_A_TRIANGLE);
    if (status == E3D_OK)
        status = sort(all, some);
    return status == E3D_OK ? drw_grid_fill(&all->grid, (drw_items){all->corners, 3}, all->count) : status;
}

e3d_status drw_hiders_prepare(drw_hiders *all, const e3d_hiders *given, const e3d_lines *lines)
{
    size_t room = given->count + 1;
    double *ends = ends_of(lines);
    chosen some = {malloc(room * sizeof(int32_t)), malloc(room * sizeof(int32_t)), malloc(6 * room * sizeof(double)), {0}, {0}, 0};
    e3d_status status = ends && some.faces && some.listed && some.corners ? E3D_OK : E3D_OUT_OF_MEMORY;
    *all = (drw_hiders){.given = given};
    if (status == E3D_OK) {
        drw_measure(ends, lines->count, some.low, some.high);
        choose_faces(all, &some);
        status = list(all, &some, ends, lines);
    }
    free(ends);
    free(some.faces);
    free(some.listed);
    free(some.corners);
    return status;
}

void drw_hiders_free(drw_hiders *all)
{
    drw_grid_free(&all->grid);
    free(all->corners);
    free(all->outsides);
    free(all->planes);
    free(all->nearer);
}
