/* Lists of lines and polylines: turns positions into pixels, and draws thin or thick lines.
 * In: positions in pixels, any values. Out: what line.c and thick_line.c draw between the pixels that hold the ends. */
#include "canvas_pixels.h"

typedef struct line_style {
    e3d_rgba color;
    double width;
    e3d_line_algorithm algorithm;
} line_style;

static bool is_finite_point(const double *xy)
{
    return isfinite(xy[0]) && isfinite(xy[1]);
}

static void draw_segment(const e3d_canvas *canvas, const double *from, const double *to,
                         bool draw_last, line_style style)
{
    const int64_t x0 = pixel_holding(from[0]);
    const int64_t y0 = pixel_holding(from[1]);
    const int64_t x1 = pixel_holding(to[0]);
    const int64_t y1 = pixel_holding(to[1]);
    if (style.color.a == 0) {
        return;
    }
    if (style.width > 1.0) {
        e3d_canvas_thick_line(canvas, x0, y0, x1, y1, style.width, style.color);
    } else {
        e3d_canvas_thin_line(canvas, x0, y0, x1, y1, true, draw_last, style.color, style.algorithm);
    }
}

void e3d_canvas_lines(const e3d_canvas *canvas, const double *xyxy, size_t count,
                      const uint8_t *colors, size_t color_stride, double width,
                      e3d_line_algorithm algorithm)
{
    for (size_t k = 0; k < count; k++) {
        const double *const ends = xyxy + 4 * k;
        if (is_finite_point(ends) && is_finite_point(ends + 2)) {
            const line_style style = {color_at(colors, color_stride, k), width, algorithm};
            draw_segment(canvas, ends, ends + 2, true, style);
        }
    }
}

void e3d_canvas_polyline(const e3d_canvas *canvas, const double *xy, size_t count, int closed,
                         e3d_rgba color, double width, e3d_line_algorithm algorithm)
{
    const line_style style = {color, width, algorithm};
    const size_t segments = count == 0 ? 0 : (closed ? count : count - 1);
    for (size_t k = 0; k < segments; k++) {
        const double *const from = xy + 2 * k;
        const double *const to = xy + 2 * ((k + 1) % count);
        if (!is_finite_point(from) || !is_finite_point(to)) {
            continue;
        }
        /* The next segment draws the vertex that both share, if there is a next one. */
        const bool has_next = closed || k + 1 < segments;
        const bool continues = has_next && is_finite_point(xy + 2 * ((k + 2) % count));
        draw_segment(canvas, from, to, !continues, style);
    }
}
