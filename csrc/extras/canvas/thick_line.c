/* Lines wider than a pixel.
 *
 * In:  the pixels at a line's two ends, and its width.
 * Out: the parallelogram along the line through the ends' centres, as wide as it says at any angle,
 *      filled as two triangles. It reaches half a pixel beyond each end along the major axis, so
 *      that it covers the rows or columns of the thin line between the same pixels.
 * Always: the same pixels from either end; each pixel once, since the two triangles share their
 *      diagonal under the top-left rule.
 */
#include "canvas_pixels.h"

/* Half of the line's extent along the minor axis, in 1/256 pixel, rounded to nearest; at an angle this is more than half of
 * its width. Positions then stay within 2^40. */
static int64_t half_extent(double width, double run, double rise)
{
    const double half = HALF_PIXEL * (width < POSITION_LIMIT ? width : POSITION_LIMIT);
    return (int64_t)floor((run > 0.0 ? half * sqrt(run * run + rise * rise) / run : half) + 0.5);
}

/* Half of rise / run pixels, in 1/256 pixel, rounded to nearest. */
static int64_t rise_in_half_pixel(int64_t rise, int64_t run)
{
    return run > 0 ? (int64_t)floor_div((e3d_wide)rise * SUBPIXELS + run, 2 * (e3d_wide)run) : 0;
}

static e3d_subpixel along_axes(bool steep, int64_t major, int64_t minor)
{
    return steep ? (e3d_subpixel){minor, major} : (e3d_subpixel){major, minor};
}

void e3d_canvas_thick_line(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                           double width, e3d_rgba color)
{
    const int64_t dx = x1 - x0;
    const int64_t dy = y1 - y0;
    const bool steep = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
    const bool backward = (steep ? dy : dx) < 0;
    const int64_t run = (steep ? dy : dx) * (backward ? -1 : 1);
    const int64_t rise = (steep ? dx : dy) * (backward ? -1 : 1);
    const int64_t major = (steep ? (backward ? y1 : y0) : (backward ? x1 : x0)) * SUBPIXELS;
    const int64_t minor = (steep ? (backward ? x1 : x0) : (backward ? y1 : y0)) * SUBPIXELS;

    const int64_t half = half_extent(width, (double)run, (double)rise);
    const int64_t lead = rise_in_half_pixel(rise, run);
    const int64_t major_end = major + (run + 1) * SUBPIXELS;
    const int64_t start = minor + HALF_PIXEL - lead;
    const int64_t end = minor + rise * SUBPIXELS + HALF_PIXEL + lead;
    const e3d_subpixel corners[4] = {
        along_axes(steep, major, start - half),
        along_axes(steep, major_end, end - half),
        along_axes(steep, major_end, end + half),
        along_axes(steep, major, start + half),
    };
    const e3d_subpixel halves[2][3] = {
        {corners[0], corners[1], corners[2]},
        {corners[0], corners[2], corners[3]},
    };
    e3d_canvas_fill_scanline(canvas, halves[0], color);
    e3d_canvas_fill_scanline(canvas, halves[1], color);
}
