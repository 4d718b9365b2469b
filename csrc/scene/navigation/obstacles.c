/* What stands in the way: triangles cut to the cells that they touch.
 *
 * In:  meshes, once the layers are sorted. Out: layers that are no longer walkable.
 * Always: a triangle blocks a layer of a cell exactly where the part of it that lies in the closed cell, widened
 *      by the radius on all sides, has a point more than the step and less than the headroom above the layer's
 *      plane. Ground counts as well: a table's top blocks the cells that its edge only reaches into.
 */
#include <math.h>

#include "base/fpenv.h"
#include "scene/navigation/navigation.h"

/* A triangle cut by four planes has at most seven corners. Rounding may fold a very long one, so that it crosses a plane
 * again; corners that don't fit are left out. */
enum { ROOM = 16 };

typedef struct polygon {
    double p[ROOM][3];
    int count;
} polygon;

/* Cuts a convex polygon to sign * (coordinate - limit) >= 0 along an axis. */
static void cut(const polygon *in, polygon *out, int axis, double limit, double sign)
{
    out->count = 0;
    for (int k = 0; k < in->count; k++) {
        const double *a = in->p[k], *b = in->p[k + 1 == in->count ? 0 : k + 1];
        double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
        if (da >= 0.0 && out->count < ROOM) {
            double *q = out->p[out->count++];
            q[0] = a[0], q[1] = a[1], q[2] = a[2];
        }
        if (((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) && out->count < ROOM) {
            double t = da / (da - db), *q = out->p[out->count++];
            for (int c = 0; c < 3; c++)
                q[c] = a[c] + t * (b[c] - a[c]);
            q[axis] = limit;
        }
    }
}

static void block_cell(e3d_navigation *grid, int32_t column, int32_t row, const polygon *part)
{
    const e3d_navigation_desc *d = &grid->desc;
    int32_t cell = row * d->columns + column;
    double x = d->x + (column + 0.5) * d->cell, z = d->z + (row + 0.5) * d->cell;
    for (int32_t layer = grid->starts[cell]; layer < grid->starts[cell + 1]; layer++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < part->count; k++) {
            const double *p = part->p[k];
            double plane = grid->height[layer] + grid->slope_x[layer] * (p[0] - x) + grid->slope_z[layer] * (p[2] - z);
            low = fmin(low, p[1] - plane);
            high = fmax(high, p[1] - plane);
        }
        if (high > d->step && low < d->headroom)
            grid->walkable[layer] = 0;
    }
}

static void block(e3d_navigation *grid, const triangle *t)
{
    const e3d_navigation_desc *d = &grid->desc;
    if (!(t->high[1] > grid->lowest + d->step && t->low[1] < grid->highest + d->headroom))
        return;
    double r = d->radius;
    int32_t i0, i1, j0, j1;
    e3d_navigation_span(t->low[2] - r, t->high[2] + r, d->z, d->cell, d->rows, &j0, &j1);
    polygon whole = {.count = 3}, half, row, cell;
    for (int k = 0; k < 9; k++)
        whole.p[k / 3][k % 3] = t->p[k / 3][k % 3];
    for (int32_t j = j0; j <= j1; j++) {
        cut(&whole, &half, 2, d->z + j * d->cell - r, 1.0);
        cut(&half, &row, 2, d->z + (j + 1) * d->cell + r, -1.0);
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < row.count; k++) {
            low = fmin(low, row.p[k][0]);
            high = fmax(high, row.p[k][0]);
        }
        if (row.count == 0)
            continue;
        e3d_navigation_span(low - r, high + r, d->x, d->cell, d->columns, &i0, &i1);
        for (int32_t i = i0; i <= i1; i++) {
            cut(&row, &half, 0, d->x + i * d->cell - r, 1.0);
            cut(&half, &cell, 0, d->x + (i + 1) * d->cell + r, -1.0);
            if (cell.count > 0)
                block_cell(grid, i, j, &cell);
        }
    }
}

void e3d_navigation_add_obstacles(e3d_navigation *grid, const e3d_navigation_mesh *mesh)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    triangle t;
    for (int64_t number = 0; number < mesh->faces_count; number++)
        if (e3d_navigation_triangle(grid, mesh, number, &t) && (t.kind & E3D_SURFACE_SOLID))
            block(grid, &t);
    e3d_fpenv_leave(saved);
}
