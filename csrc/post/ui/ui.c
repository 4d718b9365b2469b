/* The user interface: checks a list, and then draws its triangles in order (R37).
 * In: a picture and a list, of any values. Out: the picture, which is unchanged if the list is refused.
 * Always: no index, texture or pixel beyond its array is read or written. */
#include "e3d_ui.h"

#include <math.h>
#include <stdint.h>

#include "base/fpenv.h"
#include "kernels/kernels.h"
#include "reference/post/ui.h"
#include "post/ui/covers.h"
#include "post/ui/setup.h"
#include "post/ui/spans.h"

static int picture_is_valid(const e3d_canvas *picture)
{
    if (picture->width < 0 || picture->width > E3D_UI_MAX_SIDE || picture->height < 0 || picture->height > E3D_UI_MAX_SIDE)
        return 0;
    return picture->pixels != NULL || picture->width == 0 || picture->height == 0;
}

static int texture_is_valid(const e3d_ui_texture *t)
{
    if (t->pixels == NULL || t->width < 1 || t->width > E3D_UI_MAX_SIDE || t->height < 1 || t->height > E3D_UI_MAX_SIDE)
        return 0;
    if (t->format != E3D_UI_RGBA8 && t->format != E3D_UI_A8 && t->format != E3D_UI_RGBX8)
        return 0;
    if (t->filter != E3D_UI_BILINEAR && t->filter != E3D_UI_NEAREST)
        return 0;
    int32_t size = t->format == E3D_UI_A8 ? 1 : 4;
    if (((uintptr_t)t->pixels | (uintptr_t)t->stride) % (uintptr_t)size != 0)
        return 0;
    return t->stride >= size * t->width && (int64_t)t->stride * t->height <= INT32_MAX;
}

static uint32_t index_at(const e3d_ui_list *list, uint32_t at)
{
    return list->index_bytes == 2 ? ((const uint16_t *)list->indices)[at] : ((const uint32_t *)list->indices)[at];
}

static int command_is_valid(const e3d_ui_list *list, const e3d_ui_command *command)
{
    if (command->texture >= list->texture_count || command->index_count % 3 != 0)
        return 0;
    if ((uint64_t)command->first_index + command->index_count > list->index_count)
        return 0;
    uint32_t greatest = 0;
    for (uint32_t k = 0; k < command->index_count; k++) {
        uint32_t index = index_at(list, command->first_index + k);
        greatest = index > greatest ? index : greatest;
    }
    return command->index_count == 0 || (uint64_t)command->first_vertex + greatest < list->vertex_count;
}

static int list_is_valid(const e3d_ui_list *list)
{
    if ((list->index_bytes != 2 && list->index_bytes != 4) || list->index_count > INT32_MAX)
        return 0;
    for (uint32_t k = 0; k < list->texture_count; k++)
        if (!texture_is_valid(&list->textures[k]))
            return 0;
    for (uint32_t k = 0; k < list->command_count; k++)
        if (!command_is_valid(list, &list->commands[k]))
            return 0;
    return 1;
}

/* The target of drawing: picture, kernels and covers. */
typedef struct ui_target {
    const e3d_canvas *picture;
    const e3d_kernels *kernels;
    ui_covers covers;
} ui_target;

/* A command, its triangle at `at`, and the number of that triangle among all. */
typedef struct ui_item {
    const e3d_ui_list *list;
    const e3d_ui_command *command;
    uint32_t at;
    uint64_t order;
} ui_item;

/* A triangle, or the first one of two that form a rectangle; then vertices 0 and 2 are opposite. */
typedef struct ui_figure {
    int is_rectangle;
    const e3d_ui_vertex *vertices[3];
} ui_figure;

/* The argument of the function that draws the visible parts of a shape. */
typedef struct ui_painting {
    const ui_target *target;
    const e3d_ui_shape *shape;
} ui_painting;

static int32_t least(int32_t a, int32_t b) { return a < b ? a : b; }
static int32_t greatest(int32_t a, int32_t b) { return a > b ? a : b; }

static ui_box within_scissor(ui_box box, const e3d_ui_command *command)
{
    return (ui_box){greatest(box.left, command->left), greatest(box.top, command->top), least(box.right, command->right),
                    least(box.bottom, command->bottom)};
}

static const e3d_ui_texture *texture_of(const ui_item *item) { return &item->list->textures[item->command->texture]; }

static void draw_triangle(const ui_figure *figure, const ui_item *item, const ui_target *target)
{
    ui_corner corners[3];
    for (int k = 0; k < 3; k++) {
        if (!ui_is_finite(figure->vertices[k]))
            return;
        corners[k] = ui_snap(figure->vertices[k]);
    }
    int64_t area = ui_area(corners);
    if (area < 0) {
        ui_corner second = corners[1];
        corners[1] = corners[2];
        corners[2] = second;
    }
    ui_box box = ui_box_of(corners, 3, target->picture), drawn = within_scissor(box, item->command);
    e3d_ui_shape shape;
    if (area == 0 || ui_is_empty(drawn) || !ui_triangle_shape(corners, texture_of(item), box, &shape))
        return;
    ui_edges edges;
    ui_edges_begin(&edges, corners, drawn.top);
    e3d_ui_rows rows;
    for (rows.first = drawn.top; rows.first < drawn.bottom; rows.first += rows.count) {
        rows.count = least(drawn.bottom - rows.first, E3D_UI_ROWS);
        ui_edges_rows(&edges, drawn.left, drawn.right, &rows);
        target->kernels->ui(target->picture, &shape, &rows);
    }
}

static void draw_box(const void *what, ui_box part)
{
    const ui_painting *painting = what;
    e3d_ui_rows rows;
    for (int k = 0; k < least(part.bottom - part.top, E3D_UI_ROWS); k++)
        rows.left[k] = part.left, rows.right[k] = part.right;
    for (rows.first = part.top; rows.first < part.bottom; rows.first += rows.count) {
        rows.count = least(part.bottom - rows.first, E3D_UI_ROWS);
        painting->target->kernels->ui(painting->target->picture, painting->shape, &rows);
    }
}

/* Finds the shape of a rectangle, and the part of it that may change; 0 if that is empty. */
static int rectangle_shape(const ui_figure *figure, const ui_item *item, const ui_target *target, ui_box *drawn,
                           e3d_ui_shape *shape)
{
    const ui_corner opposite[2] = {ui_snap(figure->vertices[0]), ui_snap(figure->vertices[2])};
    ui_box box = ui_box_of(opposite, 2, target->picture);
    *drawn = within_scissor(box, item->command);
    return !ui_is_empty(*drawn) && ui_rectangle_shape(&opposite[0], &opposite[1], texture_of(item), box, *drawn, shape);
}

static const e3d_ui_vertex *vertex_at(const ui_item *item, uint32_t at)
{
    return &item->list->vertices[item->command->first_vertex + index_at(item->list, at)];
}

/* Whether this triangle and the next one have the indices (a, b, c) and (a, c, d). */
static int is_pair(const ui_item *item)
{
    uint32_t at = item->at;
    if (item->command->index_count - (at - item->command->first_index) < 6)
        return 0;
    return index_at(item->list, at) == index_at(item->list, at + 3) &&
           index_at(item->list, at + 2) == index_at(item->list, at + 4);
}

static ui_figure figure_of(const ui_item *item)
{
    ui_figure figure;
    const e3d_ui_vertex **v = figure.vertices;
    for (uint32_t k = 0; k < 3; k++)
        v[k] = vertex_at(item, item->at + k);
    figure.is_rectangle = is_pair(item) && ui_is_rectangle(v[0], v[1], v[2], vertex_at(item, item->at + 5));
    return figure;
}

/* Visits all triangles in order. */
static void each_figure(const e3d_ui_list *list, ui_target *target,
                        void (*visit)(const ui_item *item, const ui_figure *figure, ui_target *target))
{
    uint64_t order = 0;
    for (uint32_t k = 0; k < list->command_count; k++) {
        const e3d_ui_command *command = &list->commands[k];
        ui_item item = {.list = list, .command = command, .at = command->first_index};
        while (item.at < command->first_index + command->index_count) {
            ui_figure figure = figure_of(&item);
            item.order = order++;
            visit(&item, &figure, target);
            item.at += figure.is_rectangle ? 6 : 3;
        }
    }
}

/* Whether a rectangle is large enough for a cover. Glyphs, which most rectangles are, need no further test. */
static int is_large(const ui_figure *figure)
{
    const e3d_ui_vertex *a = figure->vertices[0], *c = figure->vertices[2];
    return fabsf(c->x - a->x) * fabsf(c->y - a->y) >= (float)UI_LEAST_COVER;
}

static void note_cover(const ui_item *item, const ui_figure *figure, ui_target *target)
{
    ui_box drawn;
    e3d_ui_shape shape;
    if (figure->is_rectangle && is_large(figure) && rectangle_shape(figure, item, target, &drawn, &shape) && shape.is_opaque)
        ui_covers_add(&target->covers, drawn, item->order);
}

static void draw_figure(const ui_item *item, const ui_figure *figure, ui_target *target)
{
    if (!figure->is_rectangle) {
        draw_triangle(figure, item, target);
        return;
    }
    ui_box drawn;
    e3d_ui_shape shape;
    if (!rectangle_shape(figure, item, target, &drawn, &shape))
        return;
    const ui_painting painting = {target, &shape};
    /* Drawing something small is faster than looking through the covers. */
    if (ui_pixels_of(drawn) < UI_LEAST_COVER)
        draw_box(&painting, drawn);
    else
        ui_covers_around(&target->covers, drawn, item->order, draw_box, &painting);
}

e3d_status e3d_ui_draw(e3d_backend backend, const e3d_canvas *picture, const e3d_ui_list *list)
{
    if (!e3d_backend_available(backend))
        return E3D_UNSUPPORTED_BACKEND;
    if (!picture_is_valid(picture) || !list_is_valid(list))
        return E3D_INVALID_ARGUMENT;
    if (backend == E3D_BACKEND_SCALAR) {
        e3d_reference_ui(picture, list);
        return E3D_OK;
    }
    int narrow = picture->width < E3D_UI_LEAST_WIDTH;
    ui_target target = {.picture = picture, .kernels = e3d_kernels_for(narrow ? E3D_BACKEND_PORTABLE : backend)};
    e3d_fpenv saved = e3d_fpenv_enter();
    each_figure(list, &target, note_cover);
    each_figure(list, &target, draw_figure);
    e3d_fpenv_leave(saved);
    return E3D_OK;
}
