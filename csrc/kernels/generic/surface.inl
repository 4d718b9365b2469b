/* surface: finds the planes and attributes of visible primitives, a vector of them at a time (R3, R18, R25). */
#pragma once

#include "kernels/types/shading.h"

/* ---- barycentric planes (R18) ---- */

/* Edges and distances are integers whose products stay below 2^53, so that doubles hold them exactly until they are divided. */
typedef struct plane_numbers {
    vi32 a[3], b[3];   /* of the edges */
    vi32 dx[3], dy[3]; /* from corner (k + 1) % 3 to the base's centre */
} plane_numbers;

static inline void surface_base(const vi32 corner[3], int tile, int32_t reach, vi32 *centre, float *out)
{
    vi32 low = v_mini(v_mini(corner[0], corner[1]), corner[2]);
    vi32 base = v_maxi(v_sra(v_addi(low, v_seti(127 - reach)), 8), v_seti(0));
    *centre = v_addi(v_shl(base, 8), v_seti(128));
    v_storef(out, v_float(v_subi(base, v_seti(tile))));
}

static inline plane_numbers surface_edges(e3d_surfaces *s, int n, int tile_x, int tile_y)
{
    plane_numbers e;
    vi32 x[3], y[3], centre_x, centre_y;
    for (int k = 0; k < 3; k++) {
        x[k] = v_loadi(s->x[k] + n);
        y[k] = v_loadi(s->y[k] + n);
    }
    surface_base(x, tile_x, s->reach, &centre_x, s->base_x + n);
    surface_base(y, tile_y, s->reach, &centre_y, s->base_y + n);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        e.a[k] = v_subi(y[i], y[j]);
        e.b[k] = v_subi(x[j], x[i]);
        e.dx[k] = v_subi(centre_x, x[i]);
        e.dy[k] = v_subi(centre_y, y[i]);
    }
    return e;
}

/* Finds the planes of half a vector, since a vector of doubles holds half as many: plane[row][k][half]. */
static inline void surface_half(const plane_numbers *e, const vf32 iw[3], int half, vf64 plane[3][3][V_HALVES])
{
    vf64 one = v_setd(1.0), a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = v_wideni(e->a[k], half);
        b[k] = v_wideni(e->b[k], half);
    }
    vf64 ra = v_divd(one, v_subd(v_muld(b[2], a[1]), v_muld(b[1], a[2])));
    vf64 rm = v_divd(one, v_widenf(v_max(iw[2], v_max(iw[1], iw[0])), half));
    for (int k = 0; k < 3; k++) {
        vf64 q = v_muld(v_widenf(iw[k], half), rm), step = v_setd(256.0);
        vf64 at = v_addd(v_muld(a[k], v_wideni(e->dx[k], half)), v_muld(b[k], v_wideni(e->dy[k], half)));
        plane[0][k][half] = v_muld(v_muld(at, ra), q);
        plane[1][k][half] = v_muld(v_muld(v_muld(step, a[k]), ra), q);
        plane[2][k][half] = v_muld(v_muld(v_muld(step, b[k]), ra), q);
    }
}

static inline void surface_planes(e3d_surfaces *s, int n, int tile_x, int tile_y)
{
    plane_numbers e = surface_edges(s, n, tile_x, tile_y);
    vf64 plane[3][3][V_HALVES];
    const vf32 iw[3] = {v_loadf(s->iw[0] + n), v_loadf(s->iw[1] + n), v_loadf(s->iw[2] + n)};
    for (int half = 0; half < V_HALVES; half++)
        surface_half(&e, iw, half, plane);
    vmask straight = v_eqi(v_loadi(s->swapped + n), v_seti(0));
    e3d_surface_floats *const rows[3] = {s->p, s->px, s->py};
    for (int row = 0; row < 3; row++) {
        vf32 second = v_narrow(plane[row][1]), third = v_narrow(plane[row][2]);
        v_storef(rows[row][0] + n, v_narrow(plane[row][0]));
        v_storef(rows[row][1] + n, v_self(straight, second, third));
        v_storef(rows[row][2] + n, v_self(straight, third, second));
    }
}

/* ---- vertices to world space (R3) ---- */

/* The elements of arrays that the lanes of one vector take. Their numbers rise by at most 1 from lane to lane: either all are
 * the same, or they are picked from the vector that begins at `first`. */
typedef struct element_lanes {
    int first, same;
    vpick pick;
} element_lanes;

/* Where that vector begins. A vector as long as a cache line takes more than twice as long to load if it is split across two
 * lines. So it begins at a line, as arrays do, unless it would end too early. */
static inline int lanes_first(int first, int last)
{
    enum { LINE = 16 };
    int line = V_LANES == LINE ? first & -LINE : first;
    return first != last && last - line < V_LANES ? line : first;
}

static inline element_lanes elements_of(const int32_t *elements)
{
    int first = elements[0], last = elements[V_LANES - 1], from = lanes_first(first, last);
    return (element_lanes){from, first == last, v_picker(v_subi(v_loadi(elements), v_seti(from)))};
}

/* The surfaces from a vector's first one on: a single address, from which all arrays are at constant offsets, so that the
 * compiler need not keep and spill a pointer for each. */
static inline const e3d_surfaces *surfaces_from(const e3d_surfaces *s, const element_lanes *lanes)
{
    return (const e3d_surfaces *)((const float *)s + lanes->first);
}

static inline vf32 take(const float *elements, const element_lanes *lanes, int same)
{
    return same ? v_setf(elements[0]) : v_pick(elements, lanes->pick);
}

static inline void take_three(const e3d_surface_floats *rows, const element_lanes *lanes, int same, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = take(rows[k], lanes, same);
}

static inline vf32 dot_three(const vf32 a[3], const vf32 b[3])
{
    return v_add(v_add(v_mul(a[0], b[0]), v_mul(a[1], b[1])), v_mul(a[2], b[2]));
}

static inline void cross_three(const vf32 a[3], const vf32 b[3], vf32 out[3])
{
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        out[c] = v_sub(v_mul(a[d], b[e]), v_mul(a[e], b[d]));
    }
}

/* R22: negates the normals of faces that look away, without making -0. */
static inline void surface_turn(e3d_surfaces *s, int vertices, int n)
{
    vmask front = v_eqi(v_loadi(s->back + n), v_seti(0));
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < vertices; k++) {
            vf32 v = v_loadf(s->normal[c][k] + n), zero = v_setf(0.0f);
            v_storef(s->normal[c][k] + n, v_self(front, v_add(zero, v), v_sub(zero, v)));
        }
}

/* Multiplies the vectors of the first `vertices` corners by a matrix of 3 columns, or of 4, of which the last is an offset. */
static inline void surface_transform(const e3d_surface_floats *matrix, int columns, const element_lanes *lanes,
                                     e3d_surface_floats vectors[3][3], int vertices, int n)
{
    vf32 v[3][3]; /* [vertex][component] */
    for (int k = 0; k < vertices; k++)
        for (int c = 0; c < 3; c++)
            v[k][c] = v_loadf(vectors[c][k] + n);
    for (int row = 0; row < 3; row++) {
        vf32 m[3], offset = v_setf(0.0f);
        for (int c = 0; c < 3; c++)
            m[c] = take(matrix[columns * row + c], lanes, lanes->same);
        if (columns == 4)
            offset = take(matrix[4 * row + 3], lanes, lanes->same);
        for (int k = 0; k < vertices; k++) {
            vf32 sum = dot_three(m, v[k]);
            v_storef(vectors[row][k] + n, columns == 4 ? v_add(sum, offset) : sum);
        }
    }
}

/* ---- how texture coordinates change from sample to sample (R25) ---- */

static inline void surface_load(const e3d_surface_floats rows[3], int n, vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_loadf(rows[k] + n);
}

/* Finds the slopes of one coordinate from its values at the corners. */
static inline void slopes_of(const e3d_surfaces *s, const e3d_surface_floats corners[3], float texels, e3d_surface_floats slope[3], int n)
{
    vf32 plane[3][3], sum[3], a[3], corner[3], size = v_setf(texels);
    surface_load(s->p, n, plane[0]);
    surface_load(s->px, n, plane[1]);
    surface_load(s->py, n, plane[2]);
    surface_load(corners, n, corner);
    for (int row = 0; row < 3; row++) {
        sum[row] = v_add(v_add(plane[row][0], plane[row][1]), plane[row][2]);
        a[row] = dot_three(plane[row], corner);
    }
    v_storef(slope[0] + n, v_mul(v_sub(v_mul(a[1], sum[0]), v_mul(a[0], sum[1])), size));
    v_storef(slope[1] + n, v_mul(v_sub(v_mul(a[2], sum[0]), v_mul(a[0], sum[2])), size));
    v_storef(slope[2] + n, v_mul(v_sub(v_mul(a[1], sum[2]), v_mul(a[2], sum[1])), size));
}

static inline void surface_slopes(e3d_surfaces *s, int n)
{
    for (int k = 0; k < 2; k++)
        slopes_of(s, s->uv[k], s->texels[k], s->slope[k], n);
}

static void kernel_surface(e3d_surfaces *s, int tile_x, int tile_y, int wanted)
{
    for (int n = 0; n < s->count; n += V_LANES) {
        element_lanes lanes = elements_of(s->matrix + n);
        const e3d_surfaces *matrices = surfaces_from(s, &lanes);
        surface_planes(s, n, tile_x, tile_y);
        if (wanted & E3D_WANT_POSITION)
            surface_transform(matrices->world, 4, &lanes, s->position, 3, n);
        if (wanted & E3D_WANT_NORMAL) {
            surface_transform(matrices->normals, 3, &lanes, s->normal, wanted & E3D_WANT_FLAT ? 1 : 3, n);
            surface_turn(s, wanted & E3D_WANT_FLAT ? 1 : 3, n);
        }
        if (wanted & E3D_WANT_LEVEL)
            surface_slopes(s, n);
    }
}
