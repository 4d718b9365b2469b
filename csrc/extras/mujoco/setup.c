/* Setup: vertices to 1/256 pixel, triangles to records (R257).
 * In: draws. Out: records of the triangles that may cover a sample.
 * Always: edges are whole numbers, so that triangles which share one leave no sample out, and cover none twice. */
#include <math.h>

#include "extras/mujoco/geometry.h"

/* ---- vertices ---- */

static void compose_all(const muj_view *view, const muj_draw *draw, double out[4][4])
{
    for (int r = 0; r < 4; r++)
        muj_compose(view->rows[r], draw->world, out[r]);
}

static double apply(const double row[4], const double at[3]) { return (row[0] * at[0] + row[1] * at[1]) + (row[2] * at[2] + row[3]); }

int muj_is_outside(const muj_draw *draw, const muj_view *view)
{
    double m[4][4], clip[4];
    int all = 127;
    compose_all(view, draw, m);
    muj_compose(view->clip, draw->world, clip);
    for (int i = 0; i < 8 && all; i++) {
        double p[4], at[3];
        for (int c = 0; c < 3; c++)
            at[c] = i >> c & 1 ? draw->shape->high[c] : draw->shape->low[c];
        for (int r = 0; r < 4; r++)
            p[r] = apply(m[r], at);
        all &= (p[2] > p[3]) | (p[2] < 0) << 1 | (p[0] < view->low[0] * p[3]) << 2 | (p[0] > (view->high[0] + 1) * p[3]) << 3 |
               (p[1] < view->low[1] * p[3]) << 4 | (p[1] > (view->high[1] + 1) * p[3]) << 5 |
               (view->has_clip && apply(clip, at) < 0) << 6;
    }
    return all != 0;
}

static int reserve_vertices(muj_worker *worker, size_t count)
{
    size_t room = (count + 16) / 16 * 16; /* whole vectors */
    if (!e3d_array_reserve(&worker->numbers, 5 * room, sizeof(float)))
        return 0;
    float *numbers = worker->numbers.data;
    worker->vertices = (muj_vertices){numbers, numbers + room, numbers + 2 * room, (int32_t (*)[2])(numbers + 3 * room)};
    return 1;
}

int muj_choose(const muj_kernels *kernels, const muj_draw *draw, const muj_view *view, int32_t facing, muj_worker *worker)
{
    const e3d_muj_shape *shape = draw->shape;
    double m[4][4], clip[4];
    muj_projection projection = {.most = (float)view->guard * MUJ_SUB, .has_clip = view->has_clip};
    muj_choice choice = {facing, view->samples, {{0}}, {view->low[0], view->low[1]}, {view->high[0], view->high[1]}};
    for (int axis = 0; axis < 2; axis++)
        for (int s = 0; s < view->samples; s++)
            choice.at[axis][s] = muj_sample_at(view->samples, axis, s);
    if (!reserve_vertices(worker, (size_t)shape->vertices) ||
        !e3d_array_reserve(&worker->chosen, (size_t)shape->triangles + 16, sizeof(int32_t)))
        return 0;
    compose_all(view, draw, m);
    muj_compose(view->clip, draw->world, clip);
    for (int c = 0; c < 4; c++) {
        for (int r = 0; r < 4; r++)
            projection.column[c][r] = (float)m[r][c] * (r < 2 ? MUJ_SUB : 1);
        projection.clip[c] = (float)clip[c];
    }
    kernels->transform(&projection, shape->positions, shape->vertices, &worker->vertices);
    worker->chosen.count = (size_t)kernels->choose(&choice, &worker->vertices, shape->corners, 0, shape->triangles, worker->chosen.data);
    return 1;
}

void muj_free_worker(muj_worker *worker)
{
    e3d_array_free(&worker->records);
    e3d_array_free(&worker->numbers);
    e3d_array_free(&worker->chosen);
}

void muj_find_corner(const muj_draw *draw, int32_t triangle, int corner, double out[3])
{
    const float *p = draw->shape->positions + 3 * (size_t)draw->shape->corners[3 * (size_t)triangle + (size_t)corner];
    for (int c = 0; c < 3; c++)
        out[c] = p[c];
}

/* ---- records ---- */

/* Depth is that of the vertices as they were before they were snapped. */
static void set_depth(const muj_vertices *v, const int32_t corner[3], muj_record *out)
{
    double x = v->x[corner[0]], y = v->y[corner[0]], z = v->z[corner[0]];
    double x1 = v->x[corner[1]] - x, y1 = v->y[corner[1]] - y, z1 = v->z[corner[1]] - z;
    double x2 = v->x[corner[2]] - x, y2 = v->y[corner[2]] - y, z2 = v->z[corner[2]] - z;
    double area = x1 * y2 - x2 * y1, scale = area != 0 ? MUJ_SUB / area : 0;
    out->zx = (z1 * y2 - z2 * y1) * scale;
    out->zy = (z2 * x1 - z1 * x2) * scale;
    out->z = z + (out->zx * (out->x0 - x * (1.0 / MUJ_SUB)) + out->zy * (out->y0 - y * (1.0 / MUJ_SUB)));
}

/* Adds a triangle of vertices that need no clipping. With rows downwards, fronts have negative areas. */
static void add_plain(const muj_view *view, const muj_vertices *v, const int32_t corner[3], int32_t facing, int32_t number, int32_t triangle,
                      e3d_array *out)
{
    int32_t x[3], y[3];
    for (int k = 0; k < 3; k++)
        x[k] = v->snapped[corner[k]][0], y[k] = v->snapped[corner[k]][1];
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0 || (facing > 0 && area > 0) || (facing < 0 && area < 0))
        return;
    muj_record *record = muj_new_record(out);
    if (!record || !muj_set_pixels(view, x, y, record))
        return;
    if (area < 0) {
        int32_t kept_x = x[1], kept_y = y[1];
        x[1] = x[2], x[2] = kept_x;
        y[1] = y[2], y[2] = kept_y;
    }
    muj_set_edges(x, y, record);
    set_depth(v, corner, record);
    record->draw = number;
    record->triangle = triangle;
    out->count++;
}

/* ---- draws ---- */

void muj_set_up(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, int32_t triangle, muj_worker *worker)
{
    const int32_t *corner = draw->shape->corners + 3 * (size_t)triangle, (*at)[2] = worker->vertices.snapped;
    if (at[corner[0]][0] != MUJ_OUTSIDE && at[corner[1]][0] != MUJ_OUTSIDE && at[corner[2]][0] != MUJ_OUTSIDE) {
        add_plain(view, &worker->vertices, corner, facing, number, triangle, &worker->records);
        return;
    }
    muj_point point[3];
    for (int k = 0; k < 3; k++) {
        double local[3];
        muj_find_corner(draw, triangle, k, local);
        point[k] = muj_place(view, draw, local);
    }
    muj_clip_triangle(view, point, facing, number, triangle, &worker->records);
}

void muj_set_up_grid(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, e3d_array *out)
{
    static const int8_t CORNERS[2][3] = {{0, 1, 2}, {1, 3, 2}};
    const e3d_muj_plane *plane = draw->plane;
    for (int t = 0; t < 2; t++) {
        muj_point at[3];
        for (int k = 0; k < 3; k++) {
            double local[3] = {0};
            for (int c = 0; c < 2; c++)
                local[c] = plane->lines[c][CORNERS[t][k] >> c & 1 ? plane->cells[c] : 0];
            at[k] = muj_place(view, draw, local);
        }
        muj_clip_triangle(view, at, facing, number, t, out);
    }
}

/* ---- lines ---- */

static void add_local_line(const muj_view *view, const muj_draw *draw, const double from[3], const double to[3], double width,
                           int32_t number, int32_t triangle, e3d_array *out)
{
    muj_point end[2] = {muj_place(view, draw, from), muj_place(view, draw, to)};
    muj_add_line(view, end, width, number, triangle, out);
}

void muj_set_up_lines(const muj_view *view, int32_t number, const muj_draw *draw, e3d_array *out)
{
    for (int32_t i = 0; i < draw->lines; i++) {
        double at[2][3];
        for (int e = 0; e < 2; e++)
            for (int c = 0; c < 3; c++)
                at[e][c] = draw->line_ends[i][e][c];
        add_local_line(view, draw, at[0], at[1], draw->width, number, i, out);
    }
}

/* Whether a triangle shows a side that is culled. For one that is partly behind the eye, the homogeneous area decides. */
static int is_culled(const muj_view *view, const muj_draw *draw, double at[3][3], int32_t facing)
{
    muj_point c[3];
    for (int k = 0; k < 3; k++)
        c[k] = muj_place(view, draw, at[k]);
    const double *p = c[0].p, *q = c[1].p, *r = c[2].p;
    double area = p[0] * (q[1] * r[3] - q[3] * r[1]) - p[1] * (q[0] * r[3] - q[3] * r[0]) + p[3] * (q[0] * r[1] - q[1] * r[0]);
    return (facing > 0 && area > 0) || (facing < 0 && area < 0);
}

static void set_up_grid_lines(const muj_view *view, int32_t number, const muj_draw *draw, double width, e3d_array *out)
{
    const e3d_muj_plane *plane = draw->plane;
    for (int axis = 0; axis < 2; axis++) {
        int other = 1 - axis;
        for (int32_t i = 0; i <= plane->cells[axis]; i++) {
            double from[3] = {0}, to[3] = {0};
            from[axis] = to[axis] = plane->lines[axis][i];
            from[other] = plane->lines[other][0];
            to[other] = plane->lines[other][plane->cells[other]];
            add_local_line(view, draw, from, to, width, number, 0, out);
        }
    }
}

void muj_set_up_wireframe(const muj_view *view, int32_t number, const muj_draw *draw, int32_t facing, double width, e3d_array *out)
{
    if (draw->kind == MUJ_GRID) {
        set_up_grid_lines(view, number, draw, width, out);
        return;
    }
    for (int32_t t = 0; t < draw->shape->triangles; t++) {
        double at[3][3];
        for (int k = 0; k < 3; k++)
            muj_find_corner(draw, t, k, at[k]);
        if (is_culled(view, draw, at, facing))
            continue;
        for (int k = 0; k < 3; k++)
            if (draw->shape->edges[t] >> k & 1)
                add_local_line(view, draw, at[k], at[(k + 1) % 3], width, number, t, out);
    }
}
