/* Setup: snaps corners, and finds the planes of texels and colours (R38-R40).
 * In: vertices, and the texture. Out: a shape for the kernel. If the texel or the colour is the same everywhere, it is found
 * here, once.
 * Always: planes are finite, since coordinates and uvs are clamped first. */
#include "post/ui/setup.h"

#include <math.h>
#include <string.h>

#include "base/limits.h"

#define POSITION_LIMIT 0x1p20f
#define UV_LIMIT 0x1p15f
/* U mod 256 in the middle of a texel. */
#define TEXEL_MIDDLE 128

static float clamp(float v, float low, float high)
{
    float t = v > low ? v : low;
    return t < high ? t : high;
}

static int32_t snap(float position)
{
    return (int32_t)lrintf(clamp(position, -POSITION_LIMIT, POSITION_LIMIT) * (float)E3D_SUBPIXEL);
}

ui_corner ui_snap(const e3d_ui_vertex *vertex) { return (ui_corner){snap(vertex->x), snap(vertex->y), vertex}; }

int ui_is_finite(const e3d_ui_vertex *vertex) { return isfinite(vertex->x) && isfinite(vertex->y); }

/* Whether two coordinates snap to one place, which mostly shows without snapping; the first one is finite. */
static int same_place(float a, float b) { return a == b || (isfinite(b) && snap(a) == snap(b)); }

static int same_color(const e3d_ui_vertex *a, const e3d_ui_vertex *b) { return memcmp(a->rgba, b->rgba, sizeof a->rgba) == 0; }

int ui_is_rectangle(const e3d_ui_vertex *a, const e3d_ui_vertex *b, const e3d_ui_vertex *c, const e3d_ui_vertex *d)
{
    return a->u == d->u && b->u == c->u && a->v == b->v && c->v == d->v &&
           same_color(a, b) && same_color(a, c) && same_color(a, d) && ui_is_finite(a) && ui_is_finite(c) &&
           same_place(a->x, d->x) && same_place(c->x, b->x) && same_place(a->y, b->y) && same_place(c->y, d->y);
}

int64_t ui_area(const ui_corner c[3])
{
    return (int64_t)(c[1].x - c[0].x) * (c[2].y - c[0].y) - (int64_t)(c[2].x - c[0].x) * (c[1].y - c[0].y);
}

ui_box ui_box_of(const ui_corner *corners, int count, const e3d_canvas *picture)
{
    int32_t x0 = INT32_MAX, y0 = INT32_MAX, x1 = INT32_MIN, y1 = INT32_MIN;
    for (int k = 0; k < count; k++) {
        x0 = corners[k].x < x0 ? corners[k].x : x0, x1 = corners[k].x > x1 ? corners[k].x : x1;
        y0 = corners[k].y < y0 ? corners[k].y : y0, y1 = corners[k].y > y1 ? corners[k].y : y1;
    }
    ui_box box = {ui_first_centre(x0), ui_first_centre(y0), ui_first_centre(x1), ui_first_centre(y1)};
    box.left = box.left < 0 ? 0 : box.left;
    box.top = box.top < 0 ? 0 : box.top;
    box.right = box.right > picture->width ? picture->width : box.right;
    box.bottom = box.bottom > picture->height ? picture->height : box.bottom;
    return box;
}

static double texel_place(float uv, int32_t size) { return (double)clamp(uv, -UV_LIMIT, UV_LIMIT) * (256.0 * size); }

/* Whether a plane has one value everywhere. */
static int is_constant(const e3d_ui_plane *p) { return p->gx == 0.0f && p->gy == 0.0f; }

static int32_t channel_at(const e3d_ui_texture *t, int32_t column, int32_t row, int channel)
{
    const uint8_t *texels = t->pixels + (size_t)row * (size_t)t->stride;
    if (t->format == E3D_UI_A8)
        return channel < 3 ? 255 : texels[column];
    return channel == 3 && t->format == E3D_UI_RGBX8 ? 255 : texels[4 * column + channel];
}

static int32_t mix(int32_t a, int32_t b, int32_t weight) { return (a * (256 - weight) + b * weight + 128) >> 8; }

/* R41 along an axis: the two texels, and the second one's weight. */
static void neighbours(float t, const e3d_ui_texture *texture, int32_t count, int32_t at[2], int32_t *weight)
{
    t = clamp(t, 0.0f, 256.0f * (float)count);
    if (texture->filter == E3D_UI_NEAREST) {
        int32_t i = (int32_t)t >> 8;
        at[0] = at[1] = i < count ? i : count - 1;
        *weight = 0;
        return;
    }
    int32_t p = (int32_t)lrintf(t) - TEXEL_MIDDLE, i = p >> 8;
    at[0] = i > 0 ? i : 0;
    at[1] = i + 1 < count ? i + 1 : count - 1;
    *weight = p & 255;
}

static uint32_t constant_texel(const e3d_ui_texture *t, float u, float v)
{
    int32_t column[2], row[2], fx, fy;
    neighbours(u, t, t->width, column, &fx);
    neighbours(v, t, t->height, row, &fy);
    uint8_t rgba[4];
    for (int k = 0; k < 4; k++) {
        int32_t upper = mix(channel_at(t, column[0], row[0], k), channel_at(t, column[1], row[0], k), fx);
        int32_t lower = mix(channel_at(t, column[0], row[1], k), channel_at(t, column[1], row[1], k), fx);
        rgba[k] = (uint8_t)mix(upper, lower, fy);
    }
    uint32_t texel;
    memcpy(&texel, rgba, sizeof texel);
    return texel;
}

/* Finds the constants of a shape. `color` is the colour of any corner. */
static int finish(e3d_ui_shape *shape, const uint8_t color[4])
{
    shape->color_is_constant = 1;
    for (int k = 0; k < 4; k++)
        shape->color_is_constant &= is_constant(&shape->color[k]);
    memcpy(&shape->rgba, color, sizeof shape->rgba);
    shape->texel_is_constant = is_constant(&shape->u) && is_constant(&shape->v);
    if (shape->texel_is_constant)
        shape->texel = constant_texel(shape->texture, shape->u.at_base, shape->v.at_base);
    int texels_are_opaque = shape->texel_is_constant ? shape->texel >= E3D_UI_ALPHA : shape->texture->format == E3D_UI_RGBX8;
    shape->is_opaque = texels_are_opaque && shape->color_is_constant && color[3] == 255;
    return !shape->color_is_constant || color[3] > 0;
}

static e3d_ui_plane triangle_plane(const ui_corner c[3], const double value[3], double r, double ex, double ey)
{
    double ax = (double)(c[1].x - c[0].x), ay = (double)(c[1].y - c[0].y);
    double cx = (double)(c[2].x - c[0].x), cy = (double)(c[2].y - c[0].y);
    double d1 = value[1] - value[0], d2 = value[2] - value[0];
    double gx = (d1 * cy - d2 * ay) * r, gy = (d2 * ax - d1 * cx) * r;
    return (e3d_ui_plane){(float)((value[0] + ex * gx) + ey * gy), (float)gx, (float)gy};
}

int ui_triangle_shape(const ui_corner c[3], const e3d_ui_texture *texture, ui_box box, e3d_ui_shape *shape)
{
    *shape = (e3d_ui_shape){.texture = texture, .base_x = box.left, .base_y = box.top};
    double r = 256.0 / (double)ui_area(c);
    double ex = (double)(256 * box.left + 128 - c[0].x) / 256.0, ey = (double)(256 * box.top + 128 - c[0].y) / 256.0;
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = texel_place(c[k].vertex->u, texture->width);
        v[k] = texel_place(c[k].vertex->v, texture->height);
    }
    shape->u = triangle_plane(c, u, r, ex, ey);
    shape->v = triangle_plane(c, v, r, ex, ey);
    for (int k = 0; k < 4; k++) {
        const double color[3] = {c[0].vertex->rgba[k], c[1].vertex->rgba[k], c[2].vertex->rgba[k]};
        shape->color[k] = triangle_plane(c, color, r, ex, ey);
    }
    return finish(shape, c[0].vertex->rgba);
}

/* Whether texels follow each other like pixels, each hit in its middle; `first` is then the base's texel. */
static int steps_by_texels(float at_base, float step, int32_t *first)
{
    int is_whole = step == 256.0f && fabsf(at_base) < 0x1p22f && at_base == (float)(int32_t)at_base;
    int32_t place = is_whole ? (int32_t)at_base : 0;
    *first = place >> 8;
    return is_whole && (place & 255) == TEXEL_MIDDLE;
}

/* Finds out whether each pixel that may change has a texel of its own; then blending by weights is not needed. */
static void find_copy(e3d_ui_shape *shape, ui_box drawn)
{
    int32_t column, row;
    if (!steps_by_texels(shape->u.at_base, shape->u.gx, &column) || !steps_by_texels(shape->v.at_base, shape->v.gy, &row))
        return;
    shape->copy_x = column - shape->base_x;
    shape->copy_y = row - shape->base_y;
    shape->is_copy = drawn.left + shape->copy_x >= 0 && drawn.right + shape->copy_x <= shape->texture->width &&
                     drawn.top + shape->copy_y >= 0 && drawn.bottom + shape->copy_y <= shape->texture->height;
}

int ui_rectangle_shape(const ui_corner *a, const ui_corner *c, const e3d_ui_texture *texture, ui_box box, ui_box drawn,
                       e3d_ui_shape *shape)
{
    *shape = (e3d_ui_shape){.texture = texture, .base_x = box.left, .base_y = box.top};
    double ua = texel_place(a->vertex->u, texture->width), uc = texel_place(c->vertex->u, texture->width);
    double va = texel_place(a->vertex->v, texture->height), vc = texel_place(c->vertex->v, texture->height);
    double gx = ((uc - ua) * 256.0) / (double)(c->x - a->x), gy = ((vc - va) * 256.0) / (double)(c->y - a->y);
    double ex = (double)(256 * box.left + 128 - a->x) / 256.0, ey = (double)(256 * box.top + 128 - a->y) / 256.0;
    shape->u = (e3d_ui_plane){(float)(ua + ex * gx), (float)gx, 0.0f};
    shape->v = (e3d_ui_plane){(float)(va + ey * gy), 0.0f, (float)gy};
    int shows = finish(shape, a->vertex->rgba);
    find_copy(shape, drawn);
    return shows;
}
