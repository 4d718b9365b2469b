/* The outlines are closed by definition, wind as they like and may cross themselves: contours of curves and lines, of points on
 * and off the curve in any order, also of a single point.
 */
#include "check/driver/scenes/font_scene.h"

enum { MOST_POINTS = 24,
       MOST_CONTOURS = 3,
       WIDEST = 32767,
       MOST_ADVANCE = 20 * 256,
       MOST_KERNING = 4 * 256,
       CELLS = (FONT_SIDE + 1) * FONT_SIDE };

/* The memory of an outline, and the outline in it. */
typedef struct random_outline {
    int16_t xy[2 * MOST_POINTS];
    uint8_t on_curve[MOST_POINTS];
    int32_t ends[MOST_CONTOURS];
    e3d_outline outline;
} random_outline;

/* From -reach to reach, the ends more often than others. */
static int16_t random_coordinate(random_stream *r, int32_t reach)
{
    if (random_once_in(r, 8))
        return (int16_t)(random_once_in(r, 2) ? reach : -reach);
    return (int16_t)(random_below(r, 2 * reach + 1) - reach);
}

/* At most half of FONT_SIDE a coordinate of `reach`, less the pixel that a shift and rounding may take. */
static e3d_ratio random_ratio(random_stream *r, int32_t reach)
{
    const int32_t most = 256 * (FONT_SIDE / 2 - 2);
    const int32_t numerator = random_once_in(r, 9) ? 0 : random_below(r, most + 1);
    e3d_ratio ratio = {numerator, reach};
    return ratio;
}

static void make_random_outline(random_stream *r, random_outline *made)
{
    const int32_t reach = random_once_in(r, 4) ? WIDEST : 1 + random_below(r, 1200);
    e3d_outline *outline = &made->outline;
    outline->contours = random_below(r, MOST_CONTOURS + 1);
    outline->points = 0;
    for (int32_t contour = 0; contour < outline->contours; contour++) {
        outline->points += 1 + random_below(r, MOST_POINTS / MOST_CONTOURS);
        made->ends[contour] = outline->points;
    }
    for (int32_t k = 0; k < outline->points; k++) {
        made->xy[2 * k] = random_coordinate(r, reach);
        made->xy[2 * k + 1] = random_coordinate(r, reach);
        made->on_curve[k] = (uint8_t)random_below(r, 2);
    }
    outline->xy = made->xy, outline->on_curve = made->on_curve, outline->ends = made->ends;
    outline->scale_x = random_ratio(r, reach);
    outline->scale_y = random_ratio(r, reach);
}

/* Whether each row's edges go down as far as they go up: nothing is covered behind the last one. */
static int is_closed(const e3d_cell *cells, e3d_glyph_box box)
{
    for (int32_t row = 0; row < box.height; row++) {
        int64_t cover = 0;
        for (int32_t column = 0; column <= box.width; column++)
            cover += cells[row * (box.width + 1) + column].cover;
        if (cover != 0)
            return 0;
    }
    return 1;
}

void make_random_font(random_stream *r, random_font *made)
{
    static e3d_cell cells[CELLS];
    random_outline outline;
    size_t first = 0;
    made->is_closed = 1;
    for (int k = 0; k < FONT_PICTURES; k++) {
        e3d_glyph *glyph = &made->glyphs[k];
        if (k % E3D_GLYPH_PHASES == 0)
            make_random_outline(r, &outline);
        outline.outline.shift = k % E3D_GLYPH_PHASES * (256 / E3D_GLYPH_PHASES);
        glyph->first = first;
        glyph->box = e3d_outline_box(&outline.outline);
        memset(cells, 0, sizeof cells);
        e3d_outline_alphas(&outline.outline, glyph->box, cells, made->alphas + first);
        made->is_closed &= is_closed(cells, glyph->box);
        first += (size_t)glyph->box.width * (size_t)glyph->box.height;
    }
    made->font = (e3d_font){made->alphas, made->glyphs, random_below(r, 30), random_below(r, 30)};
}

void random_glyphs(random_stream *r, int32_t *numbers, int32_t *advances, size_t length)
{
    for (size_t k = 0; k < length; k++) {
        numbers[k] = random_below(r, FONT_GLYPHS + 1) - 1;
        advances[k] = random_below(r, MOST_ADVANCE) - random_below(r, MOST_KERNING);
    }
}
