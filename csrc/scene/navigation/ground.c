/* The layers of the grid: ground faces sampled at the cells' centres, then sorted from below upward.
 * In: meshes, one after another. Out: samples in any order, and by e3d_navigation_sort the layers.
 * Always: a cell's layers are at least the headroom apart. Of two nearer ones the upper stays, and of two at the same height
 * the one that was given first. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fpenv.h"
#include "scene/navigation/navigation.h"

/* Heights nearer than this are one surface, such as two triangles whose common edge passes over a cell's centre. */
#define SAME_HEIGHT 1e-4f
/* A centre on an edge belongs to both triangles, whatever the rounding. */
#define EDGE_SLACK 1e-9

e3d_status e3d_navigation_create(const e3d_navigation_desc *desc, e3d_navigation **out)
{
    int64_t cells = (int64_t)desc->columns * desc->rows;
    if (desc->columns < 1 || desc->rows < 1 || cells >= INT32_MAX || !(desc->cell > 0.0) ||
        !(desc->step >= 0.0) || !(desc->headroom > desc->step) || !(desc->radius >= 0.0))
        return E3D_INVALID_ARGUMENT;
    e3d_navigation *grid = calloc(1, sizeof *grid);
    if (!grid)
        return E3D_OUT_OF_MEMORY;
    grid->desc = *desc;
    grid->starts = calloc((size_t)cells + 1, sizeof *grid->starts);
    if (!grid->starts) {
        free(grid);
        return E3D_OUT_OF_MEMORY;
    }
    *out = grid;
    return E3D_OK;
}

void e3d_navigation_destroy(e3d_navigation *grid)
{
    if (!grid)
        return;
    free(grid->samples);
    free(grid->starts);
    free(grid->height);
    free(grid->slope_x);
    free(grid->slope_z);
    free(grid->walkable);
    free(grid);
}

int e3d_navigation_triangle(const e3d_navigation *grid, const e3d_navigation_mesh *mesh, int64_t number,
                            triangle *out)
{
    const double *m = mesh->world_from_mesh;
    for (int corner = 0; corner < 3; corner++) {
        const float *v = mesh->positions + 3 * (int64_t)mesh->faces[3 * number + corner];
        for (int axis = 0; axis < 3; axis++) {
            const double *row = m + 4 * axis;
            out->p[corner][axis] = ((row[0] * v[0] + row[1] * v[1]) + row[2] * v[2]) + row[3];
        }
    }
    double e[2][3];
    for (int axis = 0; axis < 3; axis++) {
        double a = out->p[0][axis], b = out->p[1][axis], c = out->p[2][axis];
        e[0][axis] = b - a;
        e[1][axis] = c - a;
        out->low[axis] = fmin(a, fmin(b, c));
        out->high[axis] = fmax(a, fmax(b, c));
    }
    double *n = out->normal;
    n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
    n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
    n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    if (!(length > 0.0) || !isfinite(length)) /* NaN and infinity show up in the products */
        return 0;
    out->is_ground = n[1] >= grid->desc.min_normal_y * length && n[1] > 0.0;
    out->kind = mesh->kinds[mesh->material_ids[number]];
    return 1;
}

/* The number of a cell; `before` and `last` stand for those outside of the row. */
static int32_t within(double cell, int32_t before, int32_t last)
{
    if (cell < 0.0)
        return before;
    return cell > last ? last : (int32_t)cell;
}

void e3d_navigation_span(double low, double high, double start, double cell, int32_t count, int32_t *first,
                         int32_t *last)
{
    double a = ceil((low - start) / cell) - 1.0, b = floor((high - start) / cell);
    *first = within(a, 0, count);
    *last = within(b, -1, count - 1);
}

static int add_sample(e3d_navigation *grid, sample added)
{
    if (grid->count == grid->capacity) {
        int64_t capacity = grid->capacity ? 2 * grid->capacity : 4096;
        if (capacity > INT32_MAX)
            return 0;
        sample *samples = realloc(grid->samples, (size_t)capacity * sizeof *samples);
        if (!samples)
            return 0;
        grid->samples = samples;
        grid->capacity = capacity;
    }
    grid->samples[grid->count++] = added;
    return 1;
}

/* Samples a ground triangle at every centre that it covers, edges included. */
static int sample_triangle(e3d_navigation *grid, const triangle *t)
{
    const e3d_navigation_desc *d = &grid->desc;
    int32_t i0, i1, j0, j1;
    e3d_navigation_span(t->low[0], t->high[0], d->x, d->cell, d->columns, &i0, &i1);
    e3d_navigation_span(t->low[2], t->high[2], d->z, d->cell, d->rows, &j0, &j1);
    double slope_x = -t->normal[0] / t->normal[1], slope_z = -t->normal[2] / t->normal[1];
    double slack = -EDGE_SLACK * t->normal[1];
    for (int32_t j = j0; j <= j1; j++) {
        double z = d->z + (j + 0.5) * d->cell;
        for (int32_t i = i0; i <= i1; i++) {
            double x = d->x + (i + 0.5) * d->cell;
            int inside = 1;
            for (int k = 0; k < 3 && inside; k++) {
                const double *a = t->p[k], *b = t->p[k == 2 ? 0 : k + 1];
                /* Counter-clockwise from above: x to the right, z towards the viewer. */
                inside = (b[2] - a[2]) * (x - a[0]) - (b[0] - a[0]) * (z - a[2]) >= slack;
            }
            if (!inside)
                continue;
            double y = t->p[0][1] + slope_x * (x - t->p[0][0]) + slope_z * (z - t->p[0][2]);
            sample s = {j * d->columns + i, (float)y, (float)slope_x, (float)slope_z,
                        (t->kind & E3D_SURFACE_WALKABLE) != 0};
            if (isfinite(s.height) && !add_sample(grid, s))
                return 0;
        }
    }
    return 1;
}

e3d_status e3d_navigation_add_ground(e3d_navigation *grid, const e3d_navigation_mesh *mesh)
{
    e3d_fpenv saved = e3d_fpenv_enter();
    int has_room = 1;
    triangle t;
    for (int64_t number = 0; number < mesh->faces_count && has_room; number++)
        if (e3d_navigation_triangle(grid, mesh, number, &t) && t.is_ground && (t.kind & E3D_SURFACE_SOLID))
            has_room = sample_triangle(grid, &t);
    e3d_fpenv_leave(saved);
    return has_room ? E3D_OK : E3D_OUT_OF_MEMORY;
}

enum { RUN = 16 };

/* Sorts from below upward; equal heights keep their order. */
static void sort_run(sample *samples, int64_t count)
{
    for (int64_t k = 1; k < count; k++) {
        sample s = samples[k];
        int64_t place = k;
        for (; place > 0 && samples[place - 1].height > s.height; place--)
            samples[place] = samples[place - 1];
        samples[place] = s;
    }
}

/* Merges two sorted runs, one behind the other. */
static void merge_runs(const sample *from, int64_t first, int64_t second, sample *to)
{
    int64_t a = 0, b = first, end = first + second;
    while (a < first && b < end)
        *to++ = from[b].height < from[a].height ? from[b++] : from[a++];
    memcpy(to, from + a, (size_t)(first - a) * sizeof *to);
    memcpy(to + (first - a), from + b, (size_t)(end - b) * sizeof *to);
}

/* Sorts one cell's samples, which are few in most cells. `beside` has room for as many. Returns the array that then holds
 * them. */
static sample *sort_cell(sample *samples, int64_t count, sample *beside)
{
    for (int64_t k = 0; k < count; k += RUN)
        sort_run(samples + k, count - k < RUN ? count - k : RUN);
    for (int64_t run = RUN; run < count; run *= 2) {
        for (int64_t k = 0; k < count; k += 2 * run) {
            int64_t first = count - k < run ? count - k : run, rest = count - k - first;
            merge_runs(samples + k, first, rest < run ? rest : run, beside + k);
        }
        sample *sorted = beside;
        beside = samples;
        samples = sorted;
    }
    return samples;
}

/* Counts each cell's samples into `starts`, one place further; returns the greatest count. */
static int64_t count_samples(e3d_navigation *grid)
{
    int32_t most = 0;
    for (int64_t k = 0; k < grid->count; k++) {
        int32_t count = ++grid->starts[grid->samples[k].cell + 1];
        most = count > most ? count : most;
    }
    return most;
}

/* Appends to the layers those of one cell's sorted samples that one can stand on. */
static void keep_layers(e3d_navigation *grid, const sample *samples, int64_t count)
{
    int64_t above = 0;
    for (int64_t k = 0; k < count; k++) {
        above = above > k ? above : k + 1;
        while (above < count && samples[above].height - samples[k].height <= SAME_HEIGHT)
            above++;
        if (above < count && samples[above].height - samples[k].height < grid->desc.headroom)
            continue;
        int32_t layer = grid->layers++;
        grid->height[layer] = samples[k].height;
        grid->slope_x[layer] = samples[k].slope_x;
        grid->slope_z[layer] = samples[k].slope_z;
        grid->walkable[layer] = samples[k].walkable;
        if (samples[k].walkable) {
            float reach = (float)(0.5 * grid->desc.cell + grid->desc.radius);
            float rise = 1.001f * reach * (fabsf(samples[k].slope_x) + fabsf(samples[k].slope_z));
            grid->lowest = fminf(grid->lowest, samples[k].height - rise);
            grid->highest = fmaxf(grid->highest, samples[k].height + rise);
        }
        k = above - 1; /* samples at the same height */
    }
}

e3d_status e3d_navigation_sort(e3d_navigation *grid)
{
    int64_t cells = (int64_t)grid->desc.columns * grid->desc.rows;
    size_t count = (size_t)grid->count;
    sample *sorted = malloc((count ? count : 1) * sizeof *sorted);
    sample *beside = malloc(((size_t)count_samples(grid) + 1) * sizeof *beside);
    int32_t *next = malloc((size_t)cells * sizeof *next);
    grid->height = malloc((count ? count : 1) * sizeof(float));
    grid->slope_x = malloc((count ? count : 1) * sizeof(float));
    grid->slope_z = malloc((count ? count : 1) * sizeof(float));
    grid->walkable = malloc(count ? count : 1);
    if (!sorted || !beside || !next || !grid->height || !grid->slope_x || !grid->slope_z || !grid->walkable) {
        free(sorted);
        free(beside);
        free(next);
        return E3D_OUT_OF_MEMORY;
    }
    for (int64_t cell = 0; cell < cells; cell++) {
        next[cell] = grid->starts[cell];
        grid->starts[cell + 1] += grid->starts[cell];
    }
    for (size_t k = 0; k < count; k++)
        sorted[next[grid->samples[k].cell]++] = grid->samples[k];
    free(next);
    free(grid->samples);
    grid->samples = NULL;
    grid->count = grid->capacity = 0;
    grid->lowest = INFINITY;
    grid->highest = -INFINITY;
    int32_t start = 0;
    for (int64_t cell = 0; cell < cells; cell++) {
        int32_t end = grid->starts[cell + 1];
        const sample *upward = sort_cell(sorted + start, end - start, beside);
        grid->starts[cell] = grid->layers;
        keep_layers(grid, upward, end - start);
        start = end;
    }
    grid->starts[cells] = grid->layers;
    free(beside);
    free(sorted);
    return E3D_OK;
}

void e3d_navigation_get_view(const e3d_navigation *grid, e3d_navigation_view *view)
{
    *view = (e3d_navigation_view){grid->starts, grid->height, grid->slope_x,
                                  grid->slope_z, grid->walkable, grid->layers};
}
