/* Clipping: triangles that reach behind the near plane, far to the side, or behind a mirror; and lines (R257).
 * In: points of clip space. Out: records.
 * Always: depth is that of the whole triangle, whatever is left of it. */
#include <math.h>

#include "extras/mujoco/geometry.h"

#define LEAST_W 1e-9

enum { PLANES = 7,
       MOST = 3 + PLANES };

muj_point muj_place(const muj_view *view, const muj_draw *draw, const double local[3])
{
    double at[3];
    muj_point out;
    for (int r = 0; r < 3; r++)
        at[r] = ((draw->world[r][0] * local[0] + draw->world[r][1] * local[1]) + draw->world[r][2] * local[2]) + draw->world[r][3];
    for (int r = 0; r < 4; r++)
        out.p[r] = ((view->rows[r][0] * at[0] + view->rows[r][1] * at[1]) + view->rows[r][2] * at[2]) + view->rows[r][3];
    out.distance = view->has_clip ? ((view->clip[0] * at[0] + view->clip[1] * at[1]) + view->clip[2] * at[2]) + view->clip[3] : 1;
    return out;
}

static double inside(const muj_view *view, const muj_point *a, int plane)
{
    switch (plane) {
    case 0: return a->p[3] - a->p[2];
    case 1: return a->p[3] - LEAST_W;
    case 2: return a->distance;
    case 3: return view->guard * a->p[3] + a->p[0];
    case 4: return view->guard * a->p[3] - a->p[0];
    case 5: return view->guard * a->p[3] + a->p[1];
    default: return view->guard * a->p[3] - a->p[1];
    }
}

static muj_point cut(const muj_point *a, const muj_point *b, double t)
{
    muj_point out = {.distance = a->distance + (b->distance - a->distance) * t};
    for (int c = 0; c < 4; c++)
        out.p[c] = a->p[c] + (b->p[c] - a->p[c]) * t;
    return out;
}

/* Both triangles of an edge cut it from the inside to the outside, and get the same point. */
static int clip_polygon(const muj_view *view, muj_point polygon[MOST], int count)
{
    muj_point out[MOST];
    for (int plane = 0; plane < PLANES && count; plane++) {
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const muj_point *a = &polygon[i], *b = &polygon[(i + 1) % count];
            double da = inside(view, a, plane), db = inside(view, b, plane);
            if (da >= 0 && kept < MOST)
                out[kept++] = *a;
            if (da >= 0 && db < 0 && kept < MOST)
                out[kept++] = cut(a, b, da / (da - db));
            else if (da < 0 && db >= 0 && kept < MOST)
                out[kept++] = cut(b, a, db / (db - da));
        }
        count = kept;
        memcpy(polygon, out, (size_t)count * sizeof *out);
    }
    return count;
}

/* The depth's plane over the picture, through corners that may be behind the eye; 0 if there is none. */
static int set_depth_plane(const muj_point corner[3], double out[3])
{
    double row[3][3], det = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = corner[(k + 1) % 3].p, *b = corner[(k + 2) % 3].p;
        row[k][0] = a[1] * b[3] - a[3] * b[1];
        row[k][1] = a[3] * b[0] - a[0] * b[3];
        row[k][2] = a[0] * b[1] - a[1] * b[0];
    }
    for (int c = 0; c < 3; c++)
        det += row[0][c] * corner[0].p[c == 2 ? 3 : c];
    for (int c = 0; c < 3; c++)
        out[c] = ((row[0][c] * corner[0].p[2] + row[1][c] * corner[1].p[2]) + row[2][c] * corner[2].p[2]) / det;
    return ((out[0] - out[0]) + (out[1] - out[1])) + (out[2] - out[2]) == 0;
}

/* Snaps a point to 1/256 pixel; 0 if it is farther out than clipping leaves. */
static int snap(const muj_view *view, const muj_point *point, int32_t *x, int32_t *y)
{
    double w = point->p[3] > LEAST_W ? point->p[3] : LEAST_W, px = point->p[0] / w, py = point->p[1] / w;
    if (!(fabs(px) < view->guard + 64 && fabs(py) < view->guard + 64))
        return 0;
    *x = (int32_t)rint(px * MUJ_SUB), *y = (int32_t)rint(py * MUJ_SUB);
    return 1;
}

static void add_cut(const muj_view *view, const muj_point *const corner[3], int32_t facing, const double depth[3], int32_t number,
                    int32_t triangle, e3d_array *out)
{
    int32_t x[3], y[3];
    for (int k = 0; k < 3; k++)
        if (!snap(view, corner[k], &x[k], &y[k]))
            return;
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0 || (facing > 0 && area > 0) || (facing < 0 && area < 0))
        return;
    if (area < 0) {
        int32_t kept_x = x[1], kept_y = y[1];
        x[1] = x[2], x[2] = kept_x;
        y[1] = y[2], y[2] = kept_y;
    }
    muj_record *record = muj_new_record(out);
    if (!record || !muj_set_pixels(view, x, y, record))
        return;
    muj_set_edges(x, y, record);
    record->zx = depth[0], record->zy = depth[1];
    record->z = (depth[0] * record->x0 + depth[1] * record->y0) + depth[2];
    record->draw = number, record->triangle = triangle;
    out->count++;
}

void muj_clip_triangle(const muj_view *view, const muj_point corner[3], int32_t facing, int32_t number, int32_t triangle, e3d_array *out)
{
    muj_point polygon[MOST];
    double depth[3];
    memcpy(polygon, corner, 3 * sizeof *corner);
    if (!set_depth_plane(corner, depth))
        return;
    int count = clip_polygon(view, polygon, 3);
    for (int k = 1; k + 1 < count; k++)
        add_cut(view, (const muj_point *const[3]){&polygon[0], &polygon[k], &polygon[k + 1]}, facing, depth, number, triangle, out);
}

/* ---- lines ---- */

/* The part of a line that is left; 0 if there is none. */
static int clip_line(const muj_view *view, const muj_point end[2], double range[2])
{
    range[0] = 0, range[1] = 1;
    for (int plane = 0; plane < PLANES; plane++) {
        double a = inside(view, &end[0], plane), b = inside(view, &end[1], plane);
        if (a < 0 && b < 0)
            return 0;
        if (a < 0 && a / (a - b) > range[0])
            range[0] = a / (a - b);
        if (b < 0 && a / (a - b) < range[1])
            range[1] = a / (a - b);
    }
    return range[0] < range[1];
}

void muj_add_line(const muj_view *view, const muj_point end[2], double width, int32_t number, int32_t triangle, e3d_array *out)
{
    double range[2], at[2][3];
    if (!clip_line(view, end, range))
        return;
    for (int e = 0; e < 2; e++) {
        muj_point p = cut(&end[0], &end[1], range[e]);
        for (int c = 0; c < 3; c++)
            at[e][c] = p.p[c] / p.p[3];
    }
    double dx = at[1][0] - at[0][0], dy = at[1][1] - at[0][1], square = dx * dx + dy * dy, length = sqrt(square);
    if (!(length > 0))
        return;
    double across = dy / length * (0.5 * width), down = dx / length * (0.5 * width), slope = (at[1][2] - at[0][2]) / square;
    if (view->first_sample == MUJ_SUB / 2) { /* with one sample a pixel, a line is whole pixels wide along an axis */
        double half = 0.5 * (width < 1.5 ? 1 : floor(width + 0.5));
        across = fabs(dx) >= fabs(dy) ? 0 : half, down = fabs(dx) >= fabs(dy) ? half : 0;
    }
    double depth[3] = {slope * dx, slope * dy, 0};
    if (view->first_sample == MUJ_SUB / 2) { /* and its depth changes along the other axis only */
        int steep = fabs(dx) < fabs(dy);
        depth[0] = steep ? 0 : (at[1][2] - at[0][2]) / dx, depth[1] = steep ? (at[1][2] - at[0][2]) / dy : 0;
    }
    depth[2] = at[0][2] - (depth[0] * at[0][0] + depth[1] * at[0][1]);
    muj_point corner[4];
    for (int k = 0; k < 4; k++) {
        const double *e = at[k >> 1];
        double sign = k & 1 ? 1 : -1;
        corner[k] = (muj_point){{e[0] - sign * across, e[1] + sign * down, 0, 1}, 1};
    }
    add_cut(view, (const muj_point *const[3]){&corner[0], &corner[1], &corner[2]}, 0, depth, number, triangle, out);
    add_cut(view, (const muj_point *const[3]){&corner[1], &corner[3], &corner[2]}, 0, depth, number, triangle, out);
}
