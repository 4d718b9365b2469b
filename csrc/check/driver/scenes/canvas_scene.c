/* Random and hostile 2-D drawing: every call of the canvas, at any position, in odd sizes; also text of a random font.
 *
 * The same calls are made twice, with either algorithm that fills triangles; the framebuffers must
 * be equal. Rows are wider than the picture, and what lies beside it must stay as it was.
 */
#include "check/driver/scenes/canvas_scene.h"

#include <math.h>
#include <stdio.h>

#include "check/driver/scenes/font_scene.h"
#include "e3d_canvas.h"

enum { BESIDE = 3,
       CANVAS_BYTES = 4 * CANVAS_SIDE * (CANVAS_SIDE + BESIDE),
       SHAPES = 4,
       UNTOUCHED = 0x5A };

static const double HOSTILE[] = {0.0, -1e-300, 0.5, 1e9, -3e9, 1e300, INFINITY, -INFINITY, NAN};

/* Mostly on the picture, sometimes far away. */
static void random_positions(random_stream *r, double *values, int count)
{
    float extent = random_once_in(r, 3) ? 1e5f : 30.0f;
    for (int i = 0; i < count; i++) {
        values[i] = random_float(r, -extent, CANVAS_SIDE + extent);
        if (random_once_in(r, 3))
            values[i] = (double)(int64_t)values[i];
        if (random_once_in(r, 20))
            values[i] = HOSTILE[random_below(r, sizeof HOSTILE / sizeof *HOSTILE)];
    }
}

static void random_text(random_stream *r, uint8_t *codes, size_t length)
{
    for (size_t i = 0; i < length; i++)
        codes[i] = random_once_in(r, 9) ? '\n' : (uint8_t)random_bits(r);
}

static void draw_glyphs(const e3d_canvas *canvas, random_stream *r, const double *at, const e3d_font *font, e3d_rgba color)
{
    int32_t numbers[4 * SHAPES], advances[4 * SHAPES];
    random_glyphs(r, numbers, advances, 4 * SHAPES);
    e3d_canvas_glyphs(canvas, at[0], at[1], numbers, advances, 4 * SHAPES, font, color);
}

static void draw_shape(const e3d_canvas *canvas, random_stream *r, const e3d_font *font, e3d_triangle_algorithm fill)
{
    double at[6 * SHAPES];
    uint8_t bytes[4 * SHAPES];
    random_positions(r, at, 6 * SHAPES);
    random_text(r, bytes, sizeof bytes);
    e3d_rgba color = {bytes[0], bytes[1], bytes[2], bytes[3]};
    if (random_once_in(r, 2))
        color.a = 255;
    e3d_line_algorithm line = (e3d_line_algorithm)random_below(r, 2);
    double width = random_once_in(r, 2) ? 1.0 : random_float(r, 0.0f, 12.0f);
    size_t stride = random_once_in(r, 2) ? 4 : 0;
    int closed = random_below(r, 2), scale = 1 + random_below(r, 4);
    switch (random_below(r, 8)) {
    case 0: e3d_canvas_points(canvas, at, 3 * SHAPES, bytes, 0); break;
    case 1: e3d_canvas_lines(canvas, at, SHAPES, bytes, stride, width, line); break;
    case 2: e3d_canvas_polyline(canvas, at, 2 * SHAPES, closed, color, width, line); break;
    case 3: e3d_canvas_triangles(canvas, at, SHAPES, bytes, stride, fill); break;
    case 4: e3d_canvas_rectangle(canvas, at[0], at[1], at[2], at[3], color); break;
    case 5: e3d_canvas_rectangle_outline(canvas, at[0], at[1], at[2], at[3], color); break;
    case 6: draw_glyphs(canvas, r, at, font, color); break;
    default: e3d_canvas_text(canvas, at[0], at[1], bytes, sizeof bytes, scale, color);
    }
}

static void draw_all(const e3d_canvas *canvas, random_stream r, int calls, const e3d_font *font,
                     e3d_triangle_algorithm fill)
{
    e3d_canvas_clear(canvas, (e3d_rgba){10, 20, 30, 255});
    for (int i = 0; i < calls; i++)
        draw_shape(canvas, &r, font, fill);
}

static int margin_untouched(const e3d_canvas *canvas, int32_t rows)
{
    for (int32_t row = 0; row < rows; row++)
        for (ptrdiff_t k = 4 * (ptrdiff_t)canvas->width; k < canvas->stride; k++)
            if (canvas->pixels[row * canvas->stride + k] != UNTOUCHED)
                return 0;
    return 1;
}

outcome compare_canvas(random_stream r, int32_t most_side, int calls, const char *title)
{
    static uint8_t edge[CANVAS_BYTES], scanline[CANVAS_BYTES];
    static random_font made;
    const ptrdiff_t stride = 4 * (ptrdiff_t)(most_side + BESIDE);
    const size_t size = (size_t)most_side * (size_t)stride;
    memset(edge, UNTOUCHED, size);
    memset(scanline, UNTOUCHED, size);
    int32_t width = random_below(&r, most_side + 1);
    int32_t height = random_below(&r, most_side + 1);
    const e3d_canvas first = {edge, width, height, stride}, second = {scanline, width, height, stride};
    make_random_font(&r, &made);
    draw_all(&first, r, calls, &made.font, E3D_TRIANGLE_EDGE);
    draw_all(&second, r, calls, &made.font, E3D_TRIANGLE_SCANLINE);
    outcome result = {.hash = hash_bytes(HASH_START, edge, size)};
    result.agrees = memcmp(edge, scanline, size) == 0 && margin_untouched(&first, most_side) && made.is_closed;
    if (!result.agrees && title != NULL)
        fprintf(stderr, "%s: triangle fills differ, a byte beside a row was touched, or a glyph is open\n", title);
    return result;
}
