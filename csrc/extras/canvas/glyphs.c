/* Text in a font of outlines.
 *
 * In:  the alphas of glyphs, which outline.c found; the glyphs of a text by number, and how far apart they are; a position.
 * Out: the colour over each pixel, with its alpha times the glyph's.
 */
#include "canvas_pixels.h"

/* Origins of glyphs lie at quarters of a pixel. */
#define QUARTER (SUBPIXELS / E3D_GLYPH_PHASES)

static void draw_alphas(const e3d_canvas *canvas, const e3d_font *font, const e3d_glyph *glyph, int64_t x, int64_t y,
                        e3d_rgba color)
{
    const int64_t left = x + glyph->box.left, top = y + glyph->box.top;
    const int64_t x0 = max_i64(left, 0), x1 = min_i64(left + glyph->box.width, canvas->width);
    const int64_t y0 = max_i64(top, 0), y1 = min_i64(top + glyph->box.height, canvas->height);
    for (int64_t row = y0; row < y1; row++) {
        const uint8_t *alphas = font->alphas + glyph->first + (row - top) * glyph->box.width - left;
        for (int64_t column = x0; column < x1; column++) {
            e3d_rgba shown = color;
            shown.a = (uint8_t)((2u * color.a * alphas[column] + 255u) / 510u);
            if (shown.a > 0) {
                draw_pixel(pixel_address(canvas, column, row), shown);
            }
        }
    }
}

void e3d_canvas_glyphs(const e3d_canvas *canvas, double x, double y, const int32_t *glyphs, const int32_t *advances,
                       size_t length, const e3d_font *font, e3d_rgba color)
{
    if (!isfinite(x) || !isfinite(y)) {
        return;
    }
    const int64_t left = (int64_t)floor(clamp_position(x) * SUBPIXELS + 0.5);
    int64_t pen = left, baseline = pixel_holding(y) + font->ascent;
    for (size_t k = 0; k < length; k++) {
        if (glyphs[k] < 0) {
            pen = left;
            baseline += font->line_height;
            continue;
        }
        const int64_t quarters = (int64_t)floor_div(pen + QUARTER / 2, QUARTER);
        const int64_t column = (int64_t)floor_div(quarters, E3D_GLYPH_PHASES);
        const e3d_glyph *glyph = font->glyphs + glyphs[k] * E3D_GLYPH_PHASES + (quarters - column * E3D_GLYPH_PHASES);
        draw_alphas(canvas, font, glyph, column, baseline, color);
        pen += advances[k];
    }
}
