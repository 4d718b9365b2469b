/* Faces: triangles that show, with their weights over the picture, light and texture coordinates (R259, R260).
 * In: a triangle of a draw. Out: weights without clipping (Olano and Greer 1997), and what is interpolated. */
#include "extras/mujoco/shading.h"

/* A point of the picture, times its distance; and the distance. */
typedef double point[3];

static void place_on_picture(const muj_seen *seen, const double at[3], point out)
{
    for (int r = 0; r < 3; r++)
        out[r] = (seen->rows[r][0] * at[0] + seen->rows[r][1] * at[1]) + (seen->rows[r][2] * at[2] + seen->rows[r][3]);
}

/* The weight of corner k at (x, y) in pixels is row[k] . (x, y, 1), over the three's sum. */
static void set_rows(const point corner[3], double row[3][3])
{
    for (int k = 0; k < 3; k++) {
        const double *a = corner[(k + 1) % 3], *b = corner[(k + 2) % 3];
        row[k][0] = a[1] * b[2] - a[2] * b[1];
        row[k][1] = a[2] * b[0] - a[0] * b[2];
        row[k][2] = a[0] * b[1] - a[1] * b[0];
    }
}

/* ---- planes ---- */

static void set_grid(const muj_seen *seen, const muj_draw *draw, muj_grid *out)
{
    const e3d_muj_plane *plane = draw->plane;
    point clip[3];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 2; c++)
            out->at[k][c] = plane->lines[c][k == c + 1 ? plane->cells[c] : 0];
        place_on_picture(seen, (double[3]){out->at[k][0], out->at[k][1], 0}, clip[k]);
    }
    set_rows(clip, out->row);
    for (int c = 0; c < 2; c++)
        out->per_length[c] = plane->cells[c] / (plane->lines[c][plane->cells[c]] - plane->lines[c][0]);
}

void muj_see(muj_shader *shader, const muj_draw *draw, int32_t number)
{
    muj_seen *seen = &shader->seen;
    if (seen->number == number)
        return;
    seen->number = number;
    for (int r = 0; r < 3; r++)
        muj_compose(shader->view->rows[r < 2 ? r : 3], draw->world, seen->rows[r]);
    if (draw->kind == MUJ_GRID)
        set_grid(seen, draw, &seen->grid);
}

/* The number of the cell, of those along an axis, in which a coordinate lies: near where it were if all were of one size, as
 * they mostly are. */
static int32_t find_cell(const e3d_muj_plane *plane, int axis, double per_length, double at)
{
    const double *line = plane->lines[axis];
    int32_t last = plane->cells[axis] - 1;
    double place = (at - line[0]) * per_length;
    int32_t cell = place > 0 ? place < last ? (int32_t)place : last : 0;
    while (cell < last && line[cell + 1] <= at)
        cell++;
    while (cell > 0 && line[cell] > at)
        cell--;
    return cell;
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
    int32_t i = find_cell(plane, 0, grid->per_length[0], at[0]), j = find_cell(plane, 1, grid->per_length[1], at[1]);
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

/* ---- faces ---- */

/* All passes of what isn't lit show the same colour. */
static void fill_colors(const muj_shader *shader, const muj_draw *draw, muj_face *out)
{
    for (int p = 0; p < shader->lamps.passes; p++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                ((float *)out)[muj_color_at(p) + 3 * c + k] = draw->rgba[c] * shader->view->tint;
}

static void set_places(const muj_view *view, const muj_draw *draw, const double at[3], int k, float place[3], muj_face *out)
{
    double world[3];
    for (int r = 0; r < 3; r++) {
        world[r] = ((draw->world[r][0] * at[0] + draw->world[r][1] * at[1]) + draw->world[r][2] * at[2]) + draw->world[r][3];
        place[r] = out->place[r][k] = (float)world[r];
    }
    out->ahead[k] = (float)(((view->ahead[0] * world[0] + view->ahead[1] * world[1]) + view->ahead[2] * world[2]) + view->ahead[3]);
}

/* A line is of one colour, as far away as its end. */
static void set_line(const muj_shader *shader, const muj_draw *draw, muj_face *out)
{
    float place[3];
    memset(out->across, 0, sizeof out->across);
    memset(out->down, 0, sizeof out->down);
    for (int k = 0; k < 3; k++) {
        out->base[k] = 1;
        out->alpha[k] = draw->rgba[3];
        set_places(shader->view, draw, (double[3]){0, 0, draw->line_ends[0][1][2]}, k, place, out);
    }
    fill_colors(shader, draw, out);
}

/* Sets what needs the corners' places; light follows later. `face` is the number of `out`. */
static void set_triangle(muj_shader *shader, const muj_draw *draw, int32_t triangle, int32_t column, int32_t face, muj_face *out)
{
    point clip[3];
    double at[3], row[3][3], x = column * MUJ_COLUMN + 0.5, y = shader->top + 0.5;
    float normal[3], place[3][3], turned[3][3], uv[2], coordinates[3];
    for (int k = 0; k < 3; k++) {
        (draw->kind == MUJ_GRID ? find_cell_corner : find_shape_corner)(draw, triangle, k, at, normal, uv);
        place_on_picture(&shader->seen, at, clip[k]);
        set_places(shader->view, draw, at, k, place[k], out);
        out->alpha[k] = draw->is_haze ? uv[0] : draw->rgba[3];
        find_coordinates(draw, at, uv, coordinates);
        turn_normal(draw, normal, turned[k]);
        for (int c = 0; c < 3; c++)
            out->coordinates[c][k] = coordinates[c];
    }
    set_rows(clip, row);
    for (int k = 0; k < 3; k++) {
        out->base[k] = (float)((row[k][0] * x + row[k][1] * y) + row[k][2]);
        out->across[k] = (float)row[k][0], out->down[k] = (float)row[k][1];
    }
    if (draw->is_lit)
        muj_add_corners(shader, draw, face, (const float (*)[3])place, (const float (*)[3])turned);
    else
        fill_colors(shader, draw, out);
}

int32_t muj_find_face(muj_shader *shader, const muj_draw *draw, int32_t number, int32_t triangle, int32_t column)
{
    uint32_t slot = ((uint32_t)triangle * 5 + (uint32_t)number * 31 + (uint32_t)column * 1021) % MUJ_FACES;
    muj_known *known = &shader->known[slot];
    if (known->serial == shader->serial && known->number == number && known->triangle == triangle && known->column == column)
        return known->face;
    size_t first = shader->faces.count;
    if (first > INT32_MAX / 2 || !e3d_array_reserve(&shader->faces, first + sizeof(muj_face) / sizeof(float) + 8, sizeof(float)))
        return MUJ_NONE;
    shader->faces.count += (size_t)shader->stride;
    *known = (muj_known){shader->serial, number, triangle, column, (int32_t)first};
    muj_face *face = (muj_face *)((float *)shader->faces.data + first);
    muj_see(shader, draw, number);
    if (draw->kind == MUJ_LINES)
        set_line(shader, draw, face);
    else
        set_triangle(shader, draw, triangle, column, (int32_t)first, face);
    return (int32_t)first;
}
