/* cast: grids of casters in the plane of a light. A cell holds every caster that R99 may find for a sample in it; none is lost.
 * For a directional light x and y of the corners are those of R99, to the bit; for a point light they are divided by z, and a
 * margin allows for the rounding. */
#include "frame/cast/grids.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/pool.h"

enum {
    CASTERS_A_TASK = 4096,
    CELLS_A_TASK = 4096,
    LARGE = 4, /* casters of this level and above go to cells some levels finer: a city from above then takes half the time */
    FINER = 2,
    /* Aim: about so many in a cell of the finest level. With more cells, finding one in memory takes longer than testing its
     * casters */
    CASTERS_A_CELL = 4
};
#define SHAPE_MARGIN 0x1p-18 /* a share of the squared size: six roundings of R99, each of 2^-24 */
#define CELL_MARGIN 0.51     /* in cell sides: half a cell, and more than the rounding of cell_of */
#define SLOPE_MARGIN 0x1p-20f /* four roundings of a slope below 2 */

/* One light's work: what all tasks read, and the counters that they share. */
typedef struct grid_job {
    const float (*world)[9];
    int64_t casters;
    const e3d_light *light;
    e3d_caster_light *out;
    float (*corners)[9];
    /* Of one grid: */
    int face; /* the face of the cube; -1: a directional light */
    e3d_caster_grid *grid;
    e3d_caster_box *boxes;
    _Atomic uint32_t *counts; /* how many boxes each cell has, of all levels */
    e3d_caster_box *bounds;   /* of each task */
} grid_job;

static int tasks_of(int64_t items, int64_t each) { return (int)((items + each - 1) / each); }

/* For numbers, not NaNs. (fminf of the C library would be a call.) */
static inline float lesser(float a, float b) { return a < b ? a : b; }
static inline float greater(float a, float b) { return a > b ? a : b; }

static float least(const float v[3]) { return lesser(lesser(v[0], v[1]), v[2]); }
static float most(const float v[3]) { return greater(greater(v[0], v[1]), v[2]); }

/* ---- corners (R98) ---- */

static void find_corners(void *argument, int task)
{
    const grid_job *job = argument;
    int directional = !e3d_light_traits_of(job->light->kind).has_position, k = job->out->axis;
    const float *slope = job->out->slope, *at = job->light->position;
    int64_t end = ((int64_t)task + 1) * CASTERS_A_TASK;
    for (int64_t n = (int64_t)task * CASTERS_A_TASK; n < end && n < job->casters; n++)
        for (int v = 0; v < 3; v++) {
            const float *p = job->world[n] + 3 * v;
            float *out = job->corners[n] + v;
            for (int c = 0; c < 2 && directional; c++)
                out[3 * c] = p[(k + 1 + c) % 3] - slope[c] * p[k];
            if (directional)
                out[6] = job->light->to_light[k] > 0.0f ? 0.0f - p[k] : p[k];
            for (int c = 0; c < 3 && !directional; c++)
                out[3 * c] = p[c] - at[c];
        }
}

/* Spared casters get corners that are NaN, so that no grid takes them. */
static void leave_out_spared(const e3d_caster_faces *casters, const e3d_light *light, float (*corners)[9])
{
    const e3d_caster_instance *instance = casters->instances.data;
    for (; instance->draw >= 0; instance++) {
        if (!(casters->casters.draws[instance->draw].spared_lights >> light->shadow.exact & 1))
            continue;
        for (int64_t n = instance->first; n < instance[1].first; n++)
            corners[n][0] = NAN;
    }
}

/* ---- boxes ---- */

static int is_finite(const float corners[9])
{
    float sum = 0;
    for (int k = 0; k < 9; k++)
        sum += corners[k] - corners[k]; /* 0, or a NaN */
    return sum == 0.0f;
}

/* Whether a caster surely misses all rays through a face of the cube: all its corners are farther out than the face's edge at
 * their z. */
static int is_beside(const float x[3], const float z[3], float side)
{
    for (int v = 0; v < 3; v++)
        if (!(side * x[v] > fabsf(z[v])))
            return 0;
    return 1;
}

/* Finds the range of slopes of a triangle. If a part of it lies behind the light, the range is everything. */
static void find_slopes(const float x[3], const float z[3], float *low, float *high)
{
    *low = -1.0f;
    *high = 1.0f;
    if (least(z) <= 0.0f)
        return;
    const float slopes[3] = {x[0] / z[0], x[1] / z[1], x[2] / z[2]};
    *low = greater(-1.0f, least(slopes) - SLOPE_MARGIN);
    *high = lesser(1.0f, most(slopes) + SLOPE_MARGIN);
}

/* Finds the box of a caster in the light's plane; 0 if it cannot hide the light. */
static int find_box(const grid_job *job, int64_t n, e3d_caster_box *box)
{
    const float *corners = job->corners[n];
    box->caster = (uint32_t)n;
    if (!is_finite(corners) || !is_finite(job->world[n]))
        return 0;
    if (job->face < 0) {
        for (int c = 0; c < 2; c++) {
            box->low[c] = least(corners + 3 * c);
            box->high[c] = most(corners + 3 * c);
        }
        box->near = least(corners + 6);
        return 1;
    }
    int k = job->face / 2;
    float z[3];
    for (int v = 0; v < 3; v++)
        z[v] = job->face & 1 ? 0.0f - corners[3 * k + v] : corners[3 * k + v];
    box->near = least(z);
    if (most(z) <= 0.0f || box->near > job->light->range * 1.001f)
        return 0;
    for (int c = 0; c < 2; c++) {
        const float *x = corners + 3 * ((k + 1 + c) % 3);
        if (is_beside(x, z, 1.0f) || is_beside(x, z, -1.0f))
            return 0;
        find_slopes(x, z, &box->low[c], &box->high[c]);
        if (!(box->low[c] <= box->high[c]))
            return 0;
    }
    return 1;
}

static void widen(e3d_caster_box *bounds, const e3d_caster_box *box)
{
    bounds->near = lesser(bounds->near, box->near);
    for (int c = 0; c < 2; c++) {
        bounds->low[c] = lesser(bounds->low[c], box->low[c]);
        bounds->high[c] = greater(bounds->high[c], box->high[c]);
    }
}

static const e3d_caster_box NOTHING = {INFINITY, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 0};

static void bound_some(void *argument, int task)
{
    grid_job *job = argument;
    e3d_caster_box *bounds = &job->bounds[task], box;
    int64_t end = ((int64_t)task + 1) * CASTERS_A_TASK;
    *bounds = NOTHING;
    for (int64_t n = (int64_t)task * CASTERS_A_TASK; n < end && n < job->casters; n++)
        if (find_box(job, n, &box)) {
            widen(bounds, &box);
            bounds->caster++;
        }
}

/* ---- cells ---- */

/* The cell of a coordinate, as kernel_exact_shadows finds it. */
static int32_t cell_of(const e3d_caster_grid *grid, float x, int axis)
{
    float at = (x - grid->low[axis]) * grid->scale[axis], last = (float)((1 << (grid->levels - 1)) - 1);
    at = at > 0.0f ? at : 0.0f;
    return (int32_t)(at < last ? at : last);
}

/* The cells of a box at one level. */
typedef struct cell_range {
    int32_t level, first[2], last[2];
} cell_range;

static int32_t most_across(const cell_range *range)
{
    int32_t columns = range->last[0] - range->first[0], rows = range->last[1] - range->first[1];
    return columns > rows ? columns : rows;
}

static cell_range cells_at(const e3d_caster_grid *grid, const e3d_caster_box *box, int32_t level)
{
    cell_range range = {.level = level};
    for (int axis = 0; axis < 2; axis++) {
        range.first[axis] = cell_of(grid, box->low[axis], axis) >> level;
        range.last[axis] = cell_of(grid, box->high[axis], axis) >> level;
    }
    return range;
}

static cell_range cells_of(const e3d_caster_grid *grid, const e3d_caster_box *box)
{
    int32_t level = 0;
    cell_range range = cells_at(grid, box, 0);
    while (most_across(&range) > 1)
        range = cells_at(grid, box, ++level);
    return level >= LARGE ? cells_at(grid, box, level - FINER) : range;
}

/* ---- cells that a large caster touches ---- */

/* The edges of a caster of a directional light. A point is inside if all edge functions are at least -slack; slack is more than
 * the roundings of R99 add up to. */
typedef struct caster_shape {
    double a[3], b[3], c[3], slack;
} caster_shape;

static int find_shape(const float corners[9], caster_shape *out)
{
    const float *x = corners, *y = corners + 3;
    double width = (double)most(x) - least(x), height = (double)most(y) - least(y), size = width > height ? width : height;
    double area = ((double)x[1] - x[0]) * ((double)y[2] - y[0]) - ((double)x[2] - x[0]) * ((double)y[1] - y[0]);
    double sign = area < 0 ? -1 : 1;
    out->slack = SHAPE_MARGIN * size * size;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        out->a[k] = sign * ((double)y[i] - y[j]);
        out->b[k] = sign * ((double)x[j] - x[i]);
        out->c[k] = -(out->a[k] * x[i] + out->b[k] * y[i]);
    }
    return sign * area > out->slack;
}

/* Whether a cell surely lies outside an edge. The cell is taken a little larger, for the rounding of cell_of. */
static int misses_cell(const caster_shape *shape, const e3d_caster_grid *grid, int32_t level, int32_t column, int32_t row)
{
    double side = 1 << level, x = (column + 0.5) * side / grid->scale[0] + grid->low[0], y = (row + 0.5) * side / grid->scale[1] + grid->low[1];
    double half_x = CELL_MARGIN * side / grid->scale[0], half_y = CELL_MARGIN * side / grid->scale[1];
    for (int k = 0; k < 3; k++) {
        double inside = shape->a[k] * x + shape->b[k] * y + shape->c[k];
        if (inside + fabs(shape->a[k]) * half_x + fabs(shape->b[k]) * half_y < -shape->slack)
            return 1;
    }
    return 0;
}

/* The number of the first cell of a level, counted over all levels. */
static size_t level_start(const e3d_caster_grid *grid, int level)
{
    size_t start = 0;
    for (int l = 0; l < level; l++)
        start += (size_t)1 << 2 * (grid->levels - 1 - l);
    return start;
}

static void visit_cells(const grid_job *job, const e3d_caster_box *box, int puts)
{
    cell_range range = cells_of(job->grid, box);
    size_t start = level_start(job->grid, range.level);
    caster_shape shape;
    int shaped = job->face < 0 && most_across(&range) > 1 && find_shape(job->corners[box->caster], &shape);
    for (int32_t y = range.first[1]; y <= range.last[1]; y++)
        for (int32_t x = range.first[0]; x <= range.last[0]; x++) {
            if (shaped && misses_cell(&shape, job->grid, range.level, x, y))
                continue;
            size_t cell = start + ((size_t)y << (job->grid->levels - 1 - range.level)) + (size_t)x;
            uint32_t at = atomic_fetch_add_explicit(&job->counts[cell], 1, memory_order_relaxed);
            if (puts)
                job->boxes[at] = *box;
        }
}

static void visit_some(const grid_job *job, int task, int puts)
{
    e3d_caster_box box;
    int64_t end = ((int64_t)task + 1) * CASTERS_A_TASK;
    for (int64_t n = (int64_t)task * CASTERS_A_TASK; n < end && n < job->casters; n++)
        if (find_box(job, n, &box))
            visit_cells(job, &box, puts);
}

static void count_some(void *job, int task) { visit_some(job, task, 0); }
static void put_some(void *job, int task) { visit_some(job, task, 1); }

static int nearer_first(const void *left, const void *right)
{
    const e3d_caster_box *a = left, *b = right;
    return a->near < b->near ? -1 : a->near > b->near;
}

/* Puts boxes into their cells. After `put_some`, the count of a cell is where it ends. */
static void sort_some(void *argument, int task)
{
    const grid_job *job = argument;
    size_t cells = level_start(job->grid, job->grid->levels), end = ((size_t)task + 1) * CELLS_A_TASK;
    for (size_t cell = (size_t)task * CELLS_A_TASK; cell < end && cell < cells; cell++) {
        uint32_t first = cell ? job->counts[cell - 1] : 0, count = job->counts[cell] - first;
        if (count > 1)
            qsort(job->boxes + first, count, sizeof *job->boxes, nearer_first);
    }
}

/* ---- one grid ---- */

/* Gives the grid the bounds of all boxes and about as many cells as there are casters; returns the number of cells. */
static uint32_t size_grid(grid_job *job, int tasks)
{
    e3d_caster_grid *grid = job->grid;
    e3d_caster_box all = NOTHING;
    for (int t = 0; t < tasks; t++) {
        widen(&all, &job->bounds[t]);
        all.caster += job->bounds[t].caster;
    }
    grid->levels = all.caster > 0;
    while (grid->levels && grid->levels < E3D_CASTER_LEVELS && CASTERS_A_CELL * ((uint64_t)1 << 2 * (grid->levels - 1)) < all.caster)
        grid->levels++;
    grid->near = all.near;
    for (int c = 0; c < 2; c++) {
        float cells = (float)(1 << (grid->levels ? grid->levels - 1 : 0)), scale = cells / (all.high[c] - all.low[c]);
        grid->low[c] = all.low[c];
        grid->high[c] = all.high[c];
        grid->scale[c] = scale < 0x1p100f ? scale : 0.0f;
    }
    return all.caster;
}

/* Turns the counts of cells into places; returns how many boxes there are in all. */
static uint64_t place_cells(const grid_job *job, size_t cells)
{
    uint64_t sum = 0;
    for (size_t cell = 0; cell < cells; cell++) {
        uint32_t here = job->counts[cell];
        job->counts[cell] = (uint32_t)sum;
        sum += here;
    }
    return sum;
}

/* Makes a grid. Its starts begin with a 0, so that each cell's end is the next one's start. */
static int find_grid(grid_job *job, e3d_array *starts, e3d_array *boxes, int32_t threads)
{
    e3d_caster_grid *grid = job->grid;
    int tasks = tasks_of(job->casters, CASTERS_A_TASK);
    e3d_pool_share(threads, tasks, bound_some, job);
    if (!size_grid(job, tasks))
        return 1;
    size_t cells = level_start(grid, grid->levels);
    if (!e3d_array_reserve(starts, cells + 1, sizeof(uint32_t)))
        return 0;
    memset(starts->data, 0, (cells + 1) * sizeof(uint32_t));
    job->counts = (_Atomic uint32_t *)starts->data + 1;
    e3d_pool_share(threads, tasks, count_some, job);
    uint64_t all = place_cells(job, cells);
    if (all > UINT32_MAX || !e3d_array_reserve(boxes, (size_t)all, sizeof(e3d_caster_box)))
        return 0;
    job->boxes = boxes->data;
    e3d_pool_share(threads, tasks, put_some, job);
    e3d_pool_share(threads, tasks_of((int64_t)cells, CELLS_A_TASK), sort_some, job);
    grid->boxes = boxes->data;
    grid->filled = 0;
    for (int level = 0; level < grid->levels; level++) {
        grid->starts[level] = (const uint32_t *)starts->data + level_start(grid, level);
        grid->filled |= (uint32_t)(grid->starts[level][0] != grid->starts[level][(size_t)1 << 2 * (grid->levels - 1 - level)]) << level;
    }
    return 1;
}

/* The axis along which a vector is longest. */
static int longest(const float v[3])
{
    float a = fabsf(v[0]), b = fabsf(v[1]), c = fabsf(v[2]);
    if (a >= b && a >= c)
        return 0;
    return b >= c ? 1 : 2;
}

/* R98 */
static void turn_to(const e3d_light *light, e3d_caster_light *out)
{
    const float *l = light->to_light;
    out->axis = longest(l);
    for (int c = 0; c < 2; c++)
        out->slope[c] = l[(out->axis + 1 + c) % 3] / l[out->axis];
}

int e3d_find_grids(const e3d_caster_faces *casters, const e3d_light *light, e3d_light_memory *memory, e3d_caster_light *out, int32_t threads)
{
    int tasks = tasks_of(casters->count, CASTERS_A_TASK), directional = !e3d_light_traits_of(light->kind).has_position;
    memset(out->grids, 0, sizeof out->grids);
    if (directional)
        turn_to(light, out);
    grid_job job = {.world = (const float (*)[9])casters->world.data, .casters = casters->count, .light = light, .out = out};
    job.bounds = malloc(((size_t)tasks + 1) * sizeof *job.bounds);
    int done = job.bounds && e3d_array_reserve(&memory->corners, (size_t)casters->count + 1, sizeof(float[9]));
    out->corners = memory->corners.data;
    job.corners = memory->corners.data;
    if (done) {
        e3d_pool_share(threads, tasks, find_corners, &job);
        leave_out_spared(casters, light, job.corners);
    }
    for (int face = 0; face < (directional ? 1 : E3D_CASTER_FACES) && done; face++) {
        job.face = directional ? -1 : face;
        job.grid = &out->grids[face];
        done = find_grid(&job, &memory->starts[face], &memory->boxes[face], threads);
    }
    free(job.bounds);
    return done;
}
