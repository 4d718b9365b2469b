/* Faces: the corners of a triangle that shows, with light and texture coordinates (R259, R260).
 * In: a triangle of a draw. Out: weights over the picture, without clipping (Olano and Greer 1997), and what is interpolated. */
#include "extras/mujoco/shading.h"

/* The weights of three points of clip space over the picture. */
static void set_rows(const muj_point corner[3], double row[3][3])
{
    for (int k = 0; k < 3; k++) {
        const double *a = corner[(k + 1) % 3].p, *b = corner[(k + 2) % 3].p;
        row[k][0] = a[1] * b[3] - a[3] * b[1];
        row[k][1] = a[3] * b[0] - a[0] * b[3];
        row[k][2] = a[0] * b[1] - a[1] * b[0];
    }
}

/* ---- planes ---- */

void muj_set_grid(const muj_view *view, const muj_draw *draw, muj_grid *out)
{
    const e3d_muj_plane *plane = draw->plane;
    muj_point clip[3];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 2; c++)
            out->at[k][c] = plane->lines[c][k == c + 1 ? plane->cells[c] : 0];
        clip[k] = muj_place(view, draw, (double[3]){out->at[k][0], out->at[k][1], 0});
    }
    set_rows(clip, out->row);
}

/* The number of the cell, of those along an axis, in which a coordinate lies. */
static int32_t find_cell(const e3d_muj_plane *plane, int axis, double at)
{
    int32_t low = 0, high = plane->cells[axis] - 1;
    while (low < high) {
        int32_t middle = (low + high + 1) / 2;
        if (plane->lines[axis][middle] <= at)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

int32_t muj_cell_at(const muj_draw *draw, const muj_grid *grid, double x, double y)
{
    const e3d_muj_plane *plane = draw->plane;
    double w[3], at[2];
    for (int k = 0; k < 3; k++)
        w[k] = (grid->row[k][0] * x + grid->row[k][1] * y) + grid->row[k][2];
    double sum = (w[0] + w[1]) + w[2];
    for (int c = 0; c < 2; c++)
        at[c] = ((w[0] * grid->at[0][c] + w[1] * grid->at[1][c]) + w[2] * grid->at[2][c]) / sum;
    int32_t i = find_cell(plane, 0, at[0]), j = find_cell(plane, 1, at[1]);
    double u = (at[0] - plane->lines[0][i]) / (plane->lines[0][i + 1] - plane->lines[0][i]);
    double v = (at[1] - plane->lines[1][j]) / (plane->lines[1][j + 1] - plane->lines[1][j]);
    return 2 * (i * plane->cells[1] + j) + (u + v > 1);
}

static void find_cell_corner(const muj_draw *draw, int32_t triangle, int k, double at[3], float normal[3], float uv[2])
{
    static const int8_t CORNERS[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
    const e3d_muj_plane *plane = draw->plane;
    int32_t cell = triangle / 2, number[2] = {cell / plane->cells[1], cell % plane->cells[1]};
    for (int c = 0; c < 2; c++) {
        at[c] = plane->lines[c][number[c] + CORNERS[triangle & 1][k][c]];
        uv[c] = (float)(at[c] * plane->scale[c] + plane->offset[c]);
    }
    at[2] = 0;
    normal[0] = normal[1] = 0, normal[2] = 1;
}

/* ---- corners ---- */

static void find_shape_corner(const muj_draw *draw, int32_t triangle, int k, double at[3], float normal[3], float uv[2])
{
    size_t corner = 3 * (size_t)triangle + (size_t)k;
    muj_find_corner(draw, triangle, k, at);
    memcpy(normal, draw->shape->normals + 3 * corner, 3 * sizeof *normal);
    uv[0] = draw->shape->uvs ? draw->shape->uvs[2 * corner] : 0;
    uv[1] = draw->shape->uvs ? draw->shape->uvs[2 * corner + 1] : 0;
}

static void find_coordinates(const muj_draw *draw, const double at[3], const float uv[2], float out[3])
{
    out[0] = out[1] = out[2] = 0;
    switch (draw->mapping) {
    case MUJ_UNTEXTURED: break;
    case MUJ_BY_UVS:
    case MUJ_BY_POSITION:
        for (int c = 0; c < 2; c++)
            out[c] = (draw->mapping == MUJ_BY_UVS ? uv[c] : (float)at[c]) * draw->scale[c] + draw->offset[c];
        break;
    case MUJ_BY_DIRECTION:
        for (int c = 0; c < 3; c++)
            out[c] = (float)at[c] * draw->scale[c];
        if (!draw->geom) { /* the sky is turned by a quarter around X */
            float up = out[2];
            out[2] = -out[1];
            out[1] = up;
        }
    }
}

static void turn_normal(const muj_draw *draw, const float normal[3], float out[3])
{
    for (int r = 0; r < 3; r++)
        out[r] = (draw->normal[r][0] * normal[0] + draw->normal[r][1] * normal[1]) + draw->normal[r][2] * normal[2];
}

/* All passes of what isn't lit show the same colour. */
static void fill_colors(const muj_view *view, const muj_draw *draw, int k, muj_face *out)
{
    for (int p = 0; p < MUJ_PASSES; p++)
        for (int c = 0; c < 3; c++)
            out->color[p][k][c] = draw->rgba[c] * view->tint;
}

static void set_line_face(const muj_view *view, const muj_draw *draw, muj_face *out)
{
    memset(out->row, 0, sizeof out->row);
    for (int k = 0; k < 3; k++) {
        out->row[k][2] = 1;
        out->alpha[k] = draw->rgba[3];
        fill_colors(view, draw, k, out);
        for (int c = 0; c < 3; c++)
            out->place[k][c] = (float)(draw->world[c][3] + draw->world[c][2] * draw->line_ends[0][1][2]);
        out->ahead[k] = (float)(((view->ahead[0] * out->place[k][0] + view->ahead[1] * out->place[k][1]) + view->ahead[2] * out->place[k][2]) +
                                view->ahead[3]);
    }
}

void muj_set_face(const muj_picture *picture, const muj_view *view, const muj_draw *draw, int32_t number, int32_t triangle, int all_lights,
                  muj_face *out)
{
    muj_point clip[3];
    double at[3], place[3];
    float normal[3], turned[3], uv[2], lit[MUJ_PASSES][3];
    out->draw = number, out->triangle = triangle;
    if (draw->kind == MUJ_LINES) {
        set_line_face(view, draw, out);
        return;
    }
    for (int k = 0; k < 3; k++) {
        (draw->kind == MUJ_GRID ? find_cell_corner : find_shape_corner)(draw, triangle, k, at, normal, uv);
        clip[k] = muj_place(view, draw, at);
        for (int r = 0; r < 3; r++) {
            place[r] = ((draw->world[r][0] * at[0] + draw->world[r][1] * at[1]) + draw->world[r][2] * at[2]) + draw->world[r][3];
            out->place[k][r] = (float)place[r];
        }
        out->ahead[k] = (float)(((view->ahead[0] * place[0] + view->ahead[1] * place[1]) + view->ahead[2] * place[2]) + view->ahead[3]);
        out->alpha[k] = draw->is_haze ? uv[0] : draw->rgba[3];
        find_coordinates(draw, at, uv, out->coordinates[k]);
        if (!draw->is_lit) {
            fill_colors(view, draw, k, out);
            continue;
        }
        turn_normal(draw, normal, turned);
        muj_light_vertex(picture, view, draw, place, turned, all_lights, lit);
        for (int p = 0; p <= picture->shadow_count; p++)
            memcpy(out->color[p][k], lit[p], sizeof lit[p]);
    }
    set_rows(clip, out->row);
}
