/* Lines one pixel wide: Bresenham's algorithm and the plain DDA, in all octants, clipped exactly.
 *
 * In:  the pixels at a line's two ends.
 * Out: one pixel for each step k = 0 ... n along the major axis: the one nearest to the line, ties to the
 *      smaller coordinate. So the two directions of a line give the same pixels.
 * Always: clipping picks the range of k, and starts the walk inside it with the error term that an
 *      unclipped walk would have there: the pixels are those of the whole line.
 * Source: J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal
 *      4(1), 1965; the ties and the clipping are our own derivation, given at `step_reaching`.
 */
#include "canvas_pixels.h"

/* A line walked along its major axis, always towards larger major coordinates. The minor coordinate
 * at step k is minor + direction * floor((2 k rise + run - tie) / (2 run)): rounded to nearest, a tie
 * goes against a rising line (tie = 1) and along a falling one (tie = 0): to the smaller coordinate. */
typedef struct line_walk {
    int64_t major, minor; /* the pixel at step 0 */
    int64_t run, rise;    /* 0 <= rise <= run <= 2^32 */
    int64_t direction;    /* the direction of the minor coordinate: +1 or -1 */
    int64_t tie;
    int64_t first, last; /* the steps to draw */
    bool steep;          /* the major axis is y */
} line_walk;

static line_walk walk_between(int64_t x0, int64_t y0, int64_t x1, int64_t y1, bool draw_first,
                              bool draw_last)
{
    const int64_t dx = x1 - x0;
    const int64_t dy = y1 - y0;
    const bool steep = (dy < 0 ? -dy : dy) > (dx < 0 ? -dx : dx);
    const bool backward = (steep ? dy : dx) < 0;
    line_walk walk = {.steep = steep};
    walk.major = steep ? (backward ? y1 : y0) : (backward ? x1 : x0);
    walk.minor = steep ? (backward ? x1 : x0) : (backward ? y1 : y0);
    const int64_t delta_minor = (steep ? dx : dy) * (backward ? -1 : 1);
    walk.run = (steep ? dy : dx) * (backward ? -1 : 1);
    walk.rise = delta_minor < 0 ? -delta_minor : delta_minor;
    walk.direction = delta_minor < 0 ? -1 : 1;
    walk.tie = walk.direction > 0;
    walk.first = (backward ? draw_last : draw_first) ? 0 : 1;
    walk.last = (backward ? draw_first : draw_last) ? walk.run : walk.run - 1;
    return walk;
}

/* Keeps the steps whose major coordinate is on the canvas; false if there are none. */
static bool clip_major(line_walk *walk, int64_t size)
{
    walk->first = max_i64(walk->first, -walk->major);
    walk->last = min_i64(walk->last, size - 1 - walk->major);
    return walk->first <= walk->last;
}

/* The first step at which the minor coordinate has moved by `offset` >= 1 pixels: the least k with
 * 2 k rise + run - tie >= 2 run offset. */
static e3d_wide step_reaching(const line_walk *walk, int64_t offset)
{
    const e3d_wide target = (e3d_wide)(2 * walk->run) * offset - walk->run + walk->tie;
    return ceil_div(target, 2 * walk->rise);
}

/* Keeps the steps whose minor coordinate is on the canvas; false if there are none. The coordinate is
 * monotonic in k, so they are a range, and `step_reaching` gives both of its ends. */
static bool clip_minor(line_walk *walk, int64_t size)
{
    const bool rising = walk->direction > 0;
    const int64_t enter = rising ? -walk->minor : walk->minor - (size - 1);
    const int64_t leave = (rising ? size - 1 - walk->minor : walk->minor) + 1;
    if (leave <= 0 || enter > walk->rise) {
        return false;
    }
    if (enter > 0) {
        const e3d_wide first = step_reaching(walk, enter);
        walk->first = first > walk->first ? (int64_t)first : walk->first;
    }
    if (leave <= walk->rise) {
        const e3d_wide last = step_reaching(walk, leave) - 1;
        walk->last = last < walk->last ? (int64_t)last : walk->last;
    }
    return walk->first <= walk->last;
}

static void draw_bresenham(const e3d_canvas *canvas, const line_walk *walk, e3d_rgba color)
{
    const int64_t period = 2 * walk->run;
    int64_t minor = walk->minor;
    int64_t error = walk->run - walk->tie;
    if (walk->first > 0) {
        const e3d_wide moved = (e3d_wide)(2 * walk->rise) * walk->first + error;
        minor += walk->direction * (int64_t)(moved / period);
        error = (int64_t)(moved % period);
    }
    error -= period; /* so that the loop only tests a sign */

    const int64_t major = walk->major + walk->first;
    const ptrdiff_t along_major = walk->steep ? canvas->stride : 4;
    const ptrdiff_t along_minor = (walk->steep ? 4 : canvas->stride) * (ptrdiff_t)walk->direction;
    ptrdiff_t offset = 0; /* from the first pixel; unlike a pointer it may step past the last one */
    uint8_t *const start =
        walk->steep ? pixel_address(canvas, minor, major) : pixel_address(canvas, major, minor);
    for (int64_t k = walk->first; k <= walk->last; k++) {
        draw_pixel(start + offset, color);
        offset += along_major;
        error += 2 * walk->rise;
        if (error >= 0) {
            error -= period;
            offset += along_minor;
        }
    }
}

/* ceil() for |value| < 2^62. Without SSE4.1 that would be a call, too slow for each pixel. */
static inline int64_t round_up(double value)
{
    const int64_t truncated = (int64_t)value;
    return truncated + ((double)truncated < value);
}

/* The digital differential analyser: the minor coordinate in floating point, one slope a step, rounded at
 * each pixel. Slopes are multiplied rather than added up, so that no error gathers along the line and a
 * clipped line has the pixels of the whole one. The rounded slope may send a tie the other way than
 * Bresenham's exact one. Of the steps whose major coordinate is on the canvas every one is visited. */
static void draw_dda(const e3d_canvas *canvas, const line_walk *walk, e3d_rgba color)
{
    const int64_t size = walk->steep ? canvas->width : canvas->height;
    const double rise = (double)(walk->direction * walk->rise);
    const double slope = walk->run > 0 ? rise / (double)walk->run : 0.0;
    for (int64_t k = walk->first; k <= walk->last; k++) {
        const int64_t major = walk->major + k;
        const int64_t minor = walk->minor + round_up((double)k * slope - 0.5);
        if (minor >= 0 && minor < size) {
            draw_pixel(walk->steep ? pixel_address(canvas, minor, major)
                                   : pixel_address(canvas, major, minor),
                       color);
        }
    }
}

void e3d_canvas_thin_line(const e3d_canvas *canvas, int64_t x0, int64_t y0, int64_t x1, int64_t y1,
                          bool draw_first, bool draw_last, e3d_rgba color,
                          e3d_line_algorithm algorithm)
{
    line_walk walk = walk_between(x0, y0, x1, y1, draw_first, draw_last);
    if (!clip_major(&walk, walk.steep ? canvas->height : canvas->width)) {
        return;
    }
    if (algorithm == E3D_LINE_DDA) {
        draw_dda(canvas, &walk, color);
    } else if (clip_minor(&walk, walk.steep ? canvas->width : canvas->height)) {
        draw_bresenham(canvas, &walk, color);
    }
}
