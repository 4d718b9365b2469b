/* The user interface's triangles, drawn a pixel at a time, from section 11 of docs/exactness alone.
 * In: a picture, and a list whose counts, sizes and indices csrc/post/ui/ui.c has checked. Out: the picture's pixels.
 * Rules: R37 (order), R38 (positions), R39 (rectangles), R12 (coverage), R40 (planes), R41 (texels), R42 (blending). */
#include "reference/post/ui.h"

#include <math.h>

#include "base/fpenv.h"
#include "reference/arithmetic.h"

enum { U,
       V,
       RED,
       PLANES = RED + 4 };

/* A corner: its place in 1/256 pixel, and the values of all planes there. */
typedef struct corner {
    int64_t x, y;
    double value[PLANES];
} corner;

typedef struct plane {
    float at_base, gx, gy;
} plane;

typedef struct box {
    int64_t left, top, right, bottom; /* pixels; right and bottom are the last ones */
} box;

typedef struct shape {
    int is_rectangle;
    corner corners[3];
    box pixels; /* the shape's pixels that are in the picture */
    plane planes[PLANES];
} shape;

static uint32_t index_at(const e3d_ui_list *list, uint32_t at)
{
    return list->index_bytes == 2 ? ((const uint16_t *)list->indices)[at] : ((const uint32_t *)list->indices)[at];
}

static const e3d_ui_vertex *vertex_at(const e3d_ui_list *list, const e3d_ui_command *command, uint32_t at)
{
    return &list->vertices[command->first_vertex + index_at(list, at)];
}

/* R38; the product is exact. */
static int64_t snap(float position) { return ref_rint(ref_clamp(position, -0x1p20f, 0x1p20f) * 256.0f); }

static int is_finite(const e3d_ui_vertex *vertex) { return isfinite(vertex->x) && isfinite(vertex->y); }

/* R38 */
static corner corner_of(const e3d_ui_vertex *vertex, const e3d_ui_texture *texture)
{
    corner c = {.x = snap(vertex->x), .y = snap(vertex->y)};
    c.value[U] = (double)ref_clamp(vertex->u, -0x1p15f, 0x1p15f) * (256.0 * texture->width);
    c.value[V] = (double)ref_clamp(vertex->v, -0x1p15f, 0x1p15f) * (256.0 * texture->height);
    for (int k = 0; k < 4; k++)
        c.value[RED + k] = vertex->rgba[k];
    return c;
}

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }
static int64_t greatest(int64_t a, int64_t b) { return a > b ? a : b; }

/* floor(n / 256) */
static int64_t floor_256(int64_t n) { return n >= 0 ? n / 256 : -((255 - n) / 256); }

/* The box of R10, clipped to the picture. */
static box box_of(const corner corners[3], const e3d_canvas *picture)
{
    int64_t x0 = corners[0].x, x1 = x0, y0 = corners[0].y, y1 = y0;
    for (int k = 1; k < 3; k++) {
        x0 = least(x0, corners[k].x), x1 = greatest(x1, corners[k].x);
        y0 = least(y0, corners[k].y), y1 = greatest(y1, corners[k].y);
    }
    return (box){greatest(-floor_256(128 - x0), 0), greatest(-floor_256(128 - y0), 0),
                 least(floor_256(x1 - 128), picture->width - 1), least(floor_256(y1 - 128), picture->height - 1)};
}

static int64_t doubled_area(const corner c[3])
{
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

/* R40 of a triangle. */
static plane plane_of(const shape *s, int which)
{
    const corner *c = s->corners;
    double r = 256.0 / (double)doubled_area(c);
    double ax = (double)(c[1].x - c[0].x), ay = (double)(c[1].y - c[0].y);
    double cx = (double)(c[2].x - c[0].x), cy = (double)(c[2].y - c[0].y);
    double d1 = c[1].value[which] - c[0].value[which], d2 = c[2].value[which] - c[0].value[which];
    double gx = (d1 * cy - d2 * ay) * r, gy = (d2 * ax - d1 * cx) * r;
    double ex = (double)(256 * s->pixels.left + 128 - c[0].x) / 256.0;
    double ey = (double)(256 * s->pixels.top + 128 - c[0].y) / 256.0;
    return (plane){(float)((c[0].value[which] + ex * gx) + ey * gy), (float)gx, (float)gy};
}

/* R40 of a rectangle, whose corners 0 and 2 are opposite. */
static void rectangle_planes(shape *s)
{
    const corner *a = &s->corners[0], *c = &s->corners[2];
    double gx = ((c->value[U] - a->value[U]) * 256.0) / (double)(c->x - a->x);
    double gy = ((c->value[V] - a->value[V]) * 256.0) / (double)(c->y - a->y);
    double ex = (double)(256 * s->pixels.left + 128 - a->x) / 256.0;
    double ey = (double)(256 * s->pixels.top + 128 - a->y) / 256.0;
    s->planes[U] = (plane){(float)(a->value[U] + ex * gx), (float)gx, 0.0f};
    s->planes[V] = (plane){(float)(a->value[V] + ey * gy), 0.0f, (float)gy};
    for (int k = RED; k < PLANES; k++)
        s->planes[k] = (plane){(float)a->value[k], 0.0f, 0.0f};
}

/* R40 */
static float plane_at(const shape *s, int which, int64_t x, int64_t y)
{
    const plane *p = &s->planes[which];
    return (p->at_base + (float)(x - s->pixels.left) * p->gx) + (float)(y - s->pixels.top) * p->gy;
}

/* R12 of a triangle, R39 of a rectangle. */
static int covers(const shape *s, int64_t x, int64_t y)
{
    const corner *c = s->corners;
    int64_t px = 256 * x + 128, py = 256 * y + 128;
    if (s->is_rectangle)
        return px >= least(c[0].x, c[2].x) && px < greatest(c[0].x, c[2].x) && py >= least(c[0].y, c[2].y) &&
               py < greatest(c[0].y, c[2].y);
    for (int k = 0; k < 3; k++) {
        const corner *i = &c[(k + 1) % 3], *j = &c[(k + 2) % 3];
        int64_t a = i->y - j->y, b = j->x - i->x;
        int64_t e = a * (px - i->x) + b * (py - i->y);
        int top_left = a > 0 || (a == 0 && b > 0);
        if (e < 0 || (e == 0 && !top_left))
            return 0;
    }
    return 1;
}

static int over255(int n) { return (n + 127) / 255; }

static int channel_of(const e3d_ui_texture *texture, int column, int row, int channel)
{
    const uint8_t *pixels = texture->pixels + (size_t)row * (size_t)texture->stride;
    if (texture->format == E3D_UI_A8)
        return channel < 3 ? 255 : pixels[column];
    return channel == 3 && texture->format == E3D_UI_RGBX8 ? 255 : pixels[4 * column + channel];
}

static int clamped(int index, int count) { return (int)greatest(0, least(index, count - 1)); }

static int blended(int from, int to, int weight) { return (from * (256 - weight) + to * weight + 128) >> 8; }

/* R41; u and v in 1/256 texel. */
static int texel(const e3d_ui_texture *texture, float u, float v, int channel)
{
    int width = texture->width, height = texture->height;
    u = ref_clamp(u, 0.0f, 256.0f * (float)width);
    v = ref_clamp(v, 0.0f, 256.0f * (float)height);
    if (texture->filter == E3D_UI_NEAREST)
        return channel_of(texture, clamped((int)u >> 8, width), clamped((int)v >> 8, height), channel);
    int pu = ref_rint(u) - 128, pv = ref_rint(v) - 128;
    int iu = ref_floor_256(pu), iv = ref_floor_256(pv);
    int left = clamped(iu, width), right = clamped(iu + 1, width);
    int top = clamped(iv, height), bottom = clamped(iv + 1, height);
    int fu = pu - 256 * iu, fv = pv - 256 * iv;
    int upper = blended(channel_of(texture, left, top, channel), channel_of(texture, right, top, channel), fu);
    int lower = blended(channel_of(texture, left, bottom, channel), channel_of(texture, right, bottom, channel), fu);
    return blended(upper, lower, fv);
}

/* R42 */
static void draw_pixel(const shape *s, const e3d_ui_texture *texture, int64_t x, int64_t y, uint8_t *pixel)
{
    int source[4];
    float u = plane_at(s, U, x, y), v = plane_at(s, V, x, y);
    for (int k = 0; k < 4; k++) {
        int color = ref_rint(ref_clamp(plane_at(s, RED + k, x, y), 0.0f, 255.0f));
        source[k] = over255(texel(texture, u, v, k) * color);
    }
    int alpha = source[3];
    source[3] = 255;
    for (int k = 0; k < 4; k++)
        pixel[k] = (uint8_t)over255(source[k] * alpha + pixel[k] * (255 - alpha));
}

/* R37 */
static void draw_shape(const shape *s, const e3d_ui_command *command, const e3d_ui_texture *texture, const e3d_canvas *picture)
{
    for (int64_t y = greatest(s->pixels.top, command->top); y <= s->pixels.bottom && y < command->bottom; y++)
        for (int64_t x = greatest(s->pixels.left, command->left); x <= s->pixels.right && x < command->right; x++)
            if (covers(s, x, y))
                draw_pixel(s, texture, x, y, picture->pixels + y * picture->stride + 4 * x);
}

static void draw_triangle(const e3d_ui_vertex *const vertices[3], const e3d_ui_command *command,
                          const e3d_ui_texture *texture, const e3d_canvas *picture)
{
    shape s = {.is_rectangle = 0};
    for (int k = 0; k < 3; k++) {
        if (!is_finite(vertices[k]))
            return;
        s.corners[k] = corner_of(vertices[k], texture);
    }
    int64_t area = doubled_area(s.corners);
    if (area == 0)
        return;
    if (area < 0) {
        corner second = s.corners[1];
        s.corners[1] = s.corners[2];
        s.corners[2] = second;
    }
    s.pixels = box_of(s.corners, picture);
    for (int k = 0; k < PLANES; k++)
        s.planes[k] = plane_of(&s, k);
    draw_shape(&s, command, texture, picture);
}

static int same_color(const e3d_ui_vertex *a, const e3d_ui_vertex *b) { return memcmp(a->rgba, b->rgba, 4) == 0; }

/* R39: whether two triangles that form one rectangle begin at index `at`. */
static int begins_rectangle(const e3d_ui_list *list, const e3d_ui_command *command, uint32_t at)
{
    if (at + 6 > command->first_index + command->index_count)
        return 0;
    if (index_at(list, at) != index_at(list, at + 3) || index_at(list, at + 2) != index_at(list, at + 4))
        return 0;
    const e3d_ui_vertex *a = vertex_at(list, command, at), *b = vertex_at(list, command, at + 1);
    const e3d_ui_vertex *c = vertex_at(list, command, at + 2), *d = vertex_at(list, command, at + 5);
    if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !is_finite(d))
        return 0;
    return snap(a->x) == snap(d->x) && snap(b->x) == snap(c->x) && snap(a->y) == snap(b->y) && snap(c->y) == snap(d->y) &&
           a->u == d->u && b->u == c->u && a->v == b->v && c->v == d->v &&
           same_color(a, b) && same_color(a, c) && same_color(a, d);
}

static void draw_rectangle(const e3d_ui_vertex *const vertices[3], const e3d_ui_command *command,
                           const e3d_ui_texture *texture, const e3d_canvas *picture)
{
    shape s = {.is_rectangle = 1};
    for (int k = 0; k < 3; k++)
        s.corners[k] = corner_of(vertices[k], texture);
    if (s.corners[0].x == s.corners[2].x || s.corners[0].y == s.corners[2].y)
        return;
    s.pixels = box_of(s.corners, picture);
    rectangle_planes(&s);
    draw_shape(&s, command, texture, picture);
}

void e3d_reference_ui(const e3d_canvas *picture, const e3d_ui_list *list)
{
    e3d_fpenv environment = e3d_fpenv_enter();
    for (uint32_t k = 0; k < list->command_count; k++) {
        const e3d_ui_command *command = &list->commands[k];
        const e3d_ui_texture *texture = &list->textures[command->texture];
        uint32_t at = command->first_index, end = at + command->index_count;
        while (at < end) {
            const e3d_ui_vertex *vertices[3];
            for (uint32_t i = 0; i < 3; i++)
                vertices[i] = vertex_at(list, command, at + i);
            if (begins_rectangle(list, command, at)) {
                draw_rectangle(vertices, command, texture, picture);
                at += 6;
            } else {
                draw_triangle(vertices, command, texture, picture);
                at += 3;
            }
        }
    }
    e3d_fpenv_leave(environment);
}
