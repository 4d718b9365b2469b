/* What the canvas's files share: fixed-point positions, wide integers, and how a colour gets onto
 * pixels. Private to csrc/extras/canvas.
 *
 * Always: addresses are built only from coordinates already clipped to the framebuffer.
 */
#pragma once

#include "e3d_canvas.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Products of two positions need up to 84 bits; gcc and clang have this type on every 64-bit target. */
__extension__ typedef __int128 e3d_wide;

/* Sub-pixel positions count 1/256 pixel: a pixel's centre is at 256 i + 128. */
#define SUBPIXELS 256
#define HALF_PIXEL 128

/* Positions are clamped to [-2^31, 2^31] pixels. */
#define POSITION_LIMIT 2147483648.0

static inline double clamp_position(double position)
{
    if (position < -POSITION_LIMIT) {
        return -POSITION_LIMIT;
    }
    return position > POSITION_LIMIT ? POSITION_LIMIT : position;
}

/* The index of the column or row of pixels that holds a position. */
static inline int64_t pixel_holding(double position)
{
    return (int64_t)floor(clamp_position(position));
}

/* The first column or row whose pixel centres lie at or beyond a position. */
static inline int64_t first_centre(double position)
{
    return (int64_t)ceil(clamp_position(position) - 0.5);
}

/* Quotients rounded down and up, for a positive denominator. */
static inline e3d_wide floor_div(e3d_wide numerator, e3d_wide denominator)
{
    const e3d_wide quotient = numerator / denominator;
    return quotient - (numerator % denominator < 0);
}

static inline e3d_wide ceil_div(e3d_wide numerator, e3d_wide denominator)
{
    return -floor_div(-numerator, denominator);
}

static inline int64_t min_i64(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static inline int64_t max_i64(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

static inline uint8_t *pixel_address(const e3d_canvas *canvas, int64_t x, int64_t y)
{
    return canvas->pixels + (ptrdiff_t)y * canvas->stride + (ptrdiff_t)x * 4;
}

/* Porter and Duff's "over" with straight alpha, each channel rounded to the nearest integer:
 * with s, a the source's colour and alpha, d, b the destination's, all 0 ... 255,
 *     weight = 255 a + b (255 - a)                       alpha  = round(weight / 255)
 *     colour = round((255 a s + b (255 - a) d) / weight)
 * On an opaque destination (b = 255) that is round((a s + (255 - a) d) / 255), and 255. */
static inline uint8_t over_opaque(uint32_t source, uint32_t alpha, uint32_t destination)
{
    return (uint8_t)((alpha * source + (255u - alpha) * destination + 127u) / 255u);
}

static inline void blend_pixel(uint8_t *pixel, e3d_rgba color)
{
    /* Most pictures are opaque, and dividing by a constant takes a third of the time. */
    if (pixel[3] == 255) {
        pixel[0] = over_opaque(color.r, color.a, pixel[0]);
        pixel[1] = over_opaque(color.g, color.a, pixel[1]);
        pixel[2] = over_opaque(color.b, color.a, pixel[2]);
        return;
    }
    const uint32_t source = 255u * color.a;
    const uint32_t destination = (uint32_t)pixel[3] * (255u - color.a);
    const uint32_t weight = source + destination; /* >= 255, since a transparent source is never drawn */
    const uint32_t half = weight / 2;
    pixel[0] = (uint8_t)((source * color.r + destination * pixel[0] + half) / weight);
    pixel[1] = (uint8_t)((source * color.g + destination * pixel[1] + half) / weight);
    pixel[2] = (uint8_t)((source * color.b + destination * pixel[2] + half) / weight);
    pixel[3] = (uint8_t)((weight + 127u) / 255u);
}

static inline void draw_pixel(uint8_t *pixel, e3d_rgba color)
{
    if (color.a == 255) {
        memcpy(pixel, &color, sizeof color);
    } else {
        blend_pixel(pixel, color);
    }
}

/* Draws pixels [x0, x1) of row y; they are on the canvas. */
void e3d_canvas_span(const e3d_canvas *canvas, int64_t y, int64_t x0, int64_t x1, e3d_rgba color);

/* Draws pixels [x0, x1) x [y0, y1), clipped. */
void e3d_canvas_box(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                    e3d_rgba color);

/* A position in 1/256 pixel, at most 2^40 from the origin. */
typedef struct e3d_subpixel {
    int64_t x, y;
} e3d_subpixel;

/* Fills one triangle row by row (triangle_scanline.c) or by edge functions (triangle_edge.c). */
void e3d_canvas_fill_scanline(const e3d_canvas *canvas, const e3d_subpixel vertices[3],
                              e3d_rgba color);
void e3d_canvas_fill_edge(const e3d_canvas *canvas, const e3d_subpixel vertices[3], e3d_rgba color);

/* Twice the signed area; positive where a, b, c turn clockwise on the screen (y down). */
static inline e3d_wide doubled_area(e3d_subpixel a, e3d_subpixel b, e3d_subpixel c)
{
    return (e3d_wide)(b.x - a.x) * (c.y - a.y) - (e3d_wide)(b.y - a.y) * (c.x - a.x);
}

/* The first column or row whose pixel centres lie at or beyond a sub-pixel position. */
static inline int64_t first_centre_subpixel(int64_t position)
{
    const int64_t shifted = position - HALF_PIXEL + SUBPIXELS - 1;
    return shifted / SUBPIXELS - (shifted % SUBPIXELS < 0);
}

/* Draws a thick line (thick_line.c) from the centre of pixel (x0, y0) to that of (x1, y1). */
void e3d_canvas_thick_line(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                           double width, e3d_rgba color);

/* Draws a line one pixel wide (line.c) between two pixels, without an end whose flag is false. */
void e3d_canvas_thin_line(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                          bool draw_first, bool draw_last, e3d_rgba color,
                          e3d_line_algorithm algorithm);

/* Returns a row of a glyph's cell (font.c): eight characters, '#' where the glyph is. */
const char *e3d_font_row(uint8_t code, int32_t row);

/* The colour of primitive k. */
static inline e3d_rgba color_at(const uint8_t *colors, size_t stride, size_t k)
{
    e3d_rgba color;
    memcpy(&color, colors + k * stride, sizeof color);
    return color;
}
