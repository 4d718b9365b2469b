/* Random and hostile fonts: outlines of any points, and their glyphs at any size.
 *
 * In:  a stream of random numbers.
 * Out: a font for `e3d_canvas_glyphs`, in memory of the caller.
 * Always: a closed outline leaves nothing covered at the right of its box; otherwise the font tells so.
 */
#pragma once

#include "check/driver/random.h"
#include "e3d_canvas.h"

enum { FONT_GLYPHS = 3,
       FONT_SIDE = 48,
       FONT_PICTURES = FONT_GLYPHS * E3D_GLYPH_PHASES };

typedef struct random_font {
    uint8_t alphas[FONT_PICTURES * FONT_SIDE * FONT_SIDE];
    e3d_glyph glyphs[FONT_PICTURES];
    e3d_font font;
    int is_closed; /* no outline left a row covered behind its last edge */
} random_font;

/* Makes a font. Its glyphs are no wider and no higher than FONT_SIDE. */
void make_random_font(random_stream *r, random_font *made);
/* Numbers of the font's glyphs, and ends of lines; how far the pen moves behind each, also back. */
void random_glyphs(random_stream *r, int32_t *numbers, int32_t *advances, size_t length);
