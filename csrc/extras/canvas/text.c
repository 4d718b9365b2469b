/* Text in the built-in bitmap font.
 *
 * In:  codes of the font, a position, an integer scale.
 * Out: the font's pixels as squares of scale x scale pixels, those that touch in a row drawn as one box;
 *      no pixel is drawn twice, so that translucent text is even.
 */
#include "canvas_pixels.h"

static bool is_on_canvas(const e3d_canvas *canvas, int64_t x, int64_t y, int64_t width,
                         int64_t height)
{
    return x < canvas->width && y < canvas->height && x + width > 0 && y + height > 0;
}

static void draw_glyph_row(const e3d_canvas *canvas, int64_t x, int64_t y, const char *row,
                           int32_t scale, e3d_rgba color)
{
    int32_t column = 0;
    while (column < E3D_FONT_WIDTH) {
        const int32_t start = column;
        while (column < E3D_FONT_WIDTH && row[column] == '#') {
            column++;
        }
        if (column > start) {
            e3d_canvas_box(canvas, x + (int64_t)start * scale, y, x + (int64_t)column * scale,
                           y + scale, color);
        }
        column++;
    }
}

static void draw_glyph(const e3d_canvas *canvas, int64_t x, int64_t y, uint8_t code, int32_t scale,
                       e3d_rgba color)
{
    for (int32_t row = 0; row < E3D_FONT_HEIGHT; row++) {
        draw_glyph_row(canvas, x, y + (int64_t)row * scale, e3d_font_row(code, row), scale, color);
    }
}

void e3d_canvas_text(const e3d_canvas *canvas, double x, double y, const uint8_t *codes,
                     size_t length, int32_t scale, e3d_rgba color)
{
    if (!isfinite(x) || !isfinite(y)) {
        return;
    }
    const int64_t width = (int64_t)E3D_FONT_WIDTH * scale;
    const int64_t height = (int64_t)E3D_FONT_HEIGHT * scale;
    const int64_t left = pixel_holding(x);
    int64_t cell_x = left;
    int64_t cell_y = pixel_holding(y);
    for (size_t k = 0; k < length; k++) {
        if (codes[k] == '\n') {
            cell_x = left;
            cell_y += height;
            continue;
        }
        if (is_on_canvas(canvas, cell_x, cell_y, width, height)) {
            draw_glyph(canvas, cell_x, cell_y, codes[k], scale, color);
        }
        cell_x += width;
    }
}

void e3d_text_size(const uint8_t *codes, size_t length, int32_t scale, int64_t *width,
                   int64_t *height)
{
    int64_t lines = 1, column = 0, longest = 0;
    for (size_t k = 0; k < length; k++) {
        if (codes[k] == '\n') {
            lines++;
            column = 0;
        } else {
            column++;
            longest = max_i64(longest, column);
        }
    }
    *width = longest * E3D_FONT_WIDTH * scale;
    *height = lines * E3D_FONT_HEIGHT * scale;
}
