/* Clear, points and rectangles: the canvas's simplest calls, and the spans that the others use.
 * In: a framebuffer, positions in pixels, colours. Out: pixels.
 * A rectangle takes the pixels whose centres it holds, including its left and top sides. This is the triangles' rule, so that
 * rectangles which share a side share no pixel. */
#include "canvas_pixels.h"

static void overwrite_span(uint8_t *pixel, int64_t count, e3d_rgba color)
{
    for (int64_t i = 0; i < count; i++) {
        memcpy(pixel + 4 * i, &color, sizeof color);
    }
}

void e3d_canvas_span(const e3d_canvas *canvas, int64_t y, int64_t x0, int64_t x1, e3d_rgba color)
{
    uint8_t *const pixel = pixel_address(canvas, x0, y);
    if (color.a == 255) {
        overwrite_span(pixel, x1 - x0, color);
        return;
    }
    for (int64_t i = 0; i < x1 - x0; i++) {
        blend_pixel(pixel + 4 * i, color);
    }
}

void e3d_canvas_box(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                    e3d_rgba color)
{
    x0 = max_i64(x0, 0);
    y0 = max_i64(y0, 0);
    x1 = min_i64(x1, canvas->width);
    y1 = min_i64(y1, canvas->height);
    if (x0 >= x1 || color.a == 0) {
        return;
    }
    for (int64_t y = y0; y < y1; y++) {
        e3d_canvas_span(canvas, y, x0, x1, color);
    }
}

void e3d_canvas_clear(const e3d_canvas *canvas, e3d_rgba color)
{
    if (canvas->width == 0) {
        return; /* such a framebuffer may have no pixels to point at */
    }
    for (int64_t y = 0; y < canvas->height; y++) {
        overwrite_span(pixel_address(canvas, 0, y), canvas->width, color);
    }
}

void e3d_canvas_points(const e3d_canvas *canvas, const double *xy, size_t count,
                       const uint8_t *colors, size_t color_stride)
{
    for (size_t k = 0; k < count; k++) {
        const double x = xy[2 * k];
        const double y = xy[2 * k + 1];
        /* Written so that a NaN fails it. */
        const bool inside = x >= 0.0 && y >= 0.0 && x < canvas->width && y < canvas->height;
        const e3d_rgba color = color_at(colors, color_stride, k);
        if (inside && color.a != 0) {
            draw_pixel(pixel_address(canvas, (int64_t)x, (int64_t)y), color);
        }
    }
}

typedef struct pixel_box {
    int64_t x0, y0, x1, y1;
} pixel_box;

static bool rectangle_pixels(double x, double y, double width, double height, pixel_box *box)
{
    if (!isfinite(x) || !isfinite(y) || isnan(width) || isnan(height)) {
        return false;
    }
    *box = (pixel_box){first_centre(x), first_centre(y), first_centre(x + width),
                       first_centre(y + height)};
    return box->x0 < box->x1 && box->y0 < box->y1;
}

void e3d_canvas_rectangle(const e3d_canvas *canvas, double x, double y, double width, double height,
                          e3d_rgba color)
{
    pixel_box box;
    if (rectangle_pixels(x, y, width, height, &box)) {
        e3d_canvas_box(canvas, box.x0, box.y0, box.x1, box.y1, color);
    }
}

void e3d_canvas_rectangle_outline(const e3d_canvas *canvas, double x, double y, double width,
                                  double height, e3d_rgba color)
{
    pixel_box box;
    if (!rectangle_pixels(x, y, width, height, &box)) {
        return;
    }
    /* Four boxes that share no pixel, so that a translucent outline has no dots at its corners. */
    e3d_canvas_box(canvas, box.x0, box.y0, box.x1, box.y0 + 1, color);
    if (box.y1 - box.y0 > 1) {
        e3d_canvas_box(canvas, box.x0, box.y1 - 1, box.x1, box.y1, color);
    }
    e3d_canvas_box(canvas, box.x0, box.y0 + 1, box.x0 + 1, box.y1 - 1, color);
    if (box.x1 - box.x0 > 1) {
        e3d_canvas_box(canvas, box.x1 - 1, box.y0 + 1, box.x1, box.y1 - 1, color);
    }
}
