/* A glyph's outline turned into alphas: for each pixel, the share of its area that the outline covers.
 *
 * In:  contours of quadratic curves in units of the font, y up, as TrueType has them; a scale.
 * Out: a box of pixels around the origin of the glyph, and an alpha for each of them.
 * Always: integers alone, so that the alphas are the same on every machine. Positions count 1/256 pixel. Each step
 *         rounds as docs/canvas.md says. Contours wind around what they fill; where two overlap, they cover a pixel once.
 */
#include "canvas_pixels.h"

/* A chord may leave its curve by 1/64 pixel. */
#define FLATNESS 4
#define MOST_HALVINGS 6
/* Twice the area of a pixel, in units of 1/256 x 1/256 pixel. */
#define DOUBLED_PIXEL (2 * SUBPIXELS * SUBPIXELS)

/* What one edge adds to the cells of a row. */
typedef struct tracer {
    e3d_cell *cells; /* (width + 1) x height */
    int64_t columns; /* width + 1 */
    e3d_subpixel corner;
} tracer;

static int64_t floor_quotient(int64_t numerator, int64_t denominator)
{
    return (int64_t)floor_div(numerator, denominator);
}

static int64_t scaled(int64_t units, e3d_ratio scale)
{
    return floor_quotient(2 * units * scale.numerator + scale.denominator, 2 * (int64_t)scale.denominator);
}

static e3d_subpixel point_at(const e3d_outline *outline, int32_t k)
{
    e3d_subpixel at = {scaled(outline->xy[2 * k], outline->scale_x) + outline->shift,
                       -scaled(outline->xy[2 * k + 1], outline->scale_y)};
    return at;
}

static e3d_subpixel middle(e3d_subpixel a, e3d_subpixel b)
{
    e3d_subpixel between = {floor_quotient(a.x + b.x, 2), floor_quotient(a.y + b.y, 2)};
    return between;
}

e3d_glyph_box e3d_outline_box(const e3d_outline *outline)
{
    e3d_subpixel low = {INT32_MAX, INT32_MAX}, high = {INT32_MIN, INT32_MIN};
    for (int32_t k = 0; k < outline->points; k++) {
        e3d_subpixel at = point_at(outline, k);
        low.x = min_i64(low.x, at.x), low.y = min_i64(low.y, at.y);
        high.x = max_i64(high.x, at.x), high.y = max_i64(high.y, at.y);
    }
    e3d_glyph_box box = {0};
    if (outline->points > 0) {
        box.left = (int32_t)floor_quotient(low.x, SUBPIXELS), box.top = (int32_t)floor_quotient(low.y, SUBPIXELS);
        box.width = (int32_t)(floor_quotient(high.x + SUBPIXELS - 1, SUBPIXELS) - box.left);
        box.height = (int32_t)(floor_quotient(high.y + SUBPIXELS - 1, SUBPIXELS) - box.top);
    }
    return box;
}

/* Adds the part of an edge that lies in one row, from x0 to x1 >= x0. What lies to the right of it is covered, or uncovered
 * where the sign is -1. */
static void trace_row(e3d_cell *row, int64_t x0, int64_t x1, int64_t height, int64_t sign)
{
    int64_t done = 0, from = x0;
    for (int64_t column = x0 / SUBPIXELS; done < height; column++) {
        int64_t to = min_i64(x1, (column + 1) * SUBPIXELS);
        int64_t reached = to == x1 ? height : floor_quotient((to - x0) * height, x1 - x0);
        row[column].cover += (int32_t)(sign * (reached - done));
        row[column].area += sign * (reached - done) * (from + to - 2 * column * SUBPIXELS);
        done = reached, from = to;
    }
}

/* The column of an edge where it crosses a height. */
static int64_t crossing(e3d_subpixel top, e3d_subpixel bottom, int64_t y)
{
    return top.x + floor_quotient((y - top.y) * (bottom.x - top.x), bottom.y - top.y);
}

static void trace_edge(const tracer *to, e3d_subpixel a, e3d_subpixel b)
{
    const int64_t sign = a.y < b.y ? 1 : -1;
    const e3d_subpixel top = sign > 0 ? a : b, bottom = sign > 0 ? b : a;
    for (int64_t y = top.y; y < bottom.y;) {
        const int64_t row = y / SUBPIXELS, end = min_i64(bottom.y, (row + 1) * SUBPIXELS);
        const int64_t x0 = crossing(top, bottom, y), x1 = crossing(top, bottom, end);
        trace_row(to->cells + row * to->columns, min_i64(x0, x1), max_i64(x0, x1), end - y, sign);
        y = end;
    }
}

static e3d_subpixel from_corner(const tracer *to, e3d_subpixel at)
{
    e3d_subpixel moved = {at.x - to->corner.x, at.y - to->corner.y};
    return moved;
}

/* How often a curve is halved: until its chords are flat. A curve leaves its chord by a quarter of its second difference. */
static int halvings_of(e3d_subpixel a, e3d_subpixel control, e3d_subpixel b)
{
    const int64_t across = a.x - 2 * control.x + b.x, down = a.y - 2 * control.y + b.y;
    const int64_t bend = max_i64(across < 0 ? -across : across, down < 0 ? -down : down);
    int halvings = 0;
    while (halvings < MOST_HALVINGS && bend > (int64_t)4 * FLATNESS << 2 * halvings) {
        halvings++;
    }
    return halvings;
}

static int64_t on_curve(int64_t a, int64_t control, int64_t b, int64_t step, int64_t steps)
{
    const int64_t rest = steps - step;
    const int64_t sum = rest * rest * a + 2 * step * rest * control + step * step * b;
    return floor_quotient(2 * sum + steps * steps, 2 * steps * steps);
}

static void trace_curve(const tracer *to, e3d_subpixel a, e3d_subpixel control, e3d_subpixel b)
{
    const int64_t steps = (int64_t)1 << halvings_of(a, control, b);
    e3d_subpixel last = a;
    for (int64_t step = 1; step <= steps; step++) {
        e3d_subpixel next = {on_curve(a.x, control.x, b.x, step, steps), on_curve(a.y, control.y, b.y, step, steps)};
        trace_edge(to, last, next);
        last = next;
    }
}

/* Between two control points, there is a point of the curve halfway; a contour may begin with one. */
static void trace_contour(const tracer *to, const e3d_outline *outline, int32_t first, int32_t end)
{
    const e3d_subpixel last = from_corner(to, point_at(outline, end - 1));
    e3d_subpixel control = last, begin = from_corner(to, point_at(outline, first));
    bool bends = false;
    int32_t k = first;
    if (outline->on_curve[first]) {
        k++;
    } else {
        begin = outline->on_curve[end - 1] ? last : middle(last, begin);
    }
    e3d_subpixel at = begin;
    for (; k < end; k++) {
        const e3d_subpixel next = from_corner(to, point_at(outline, k));
        if (outline->on_curve[k]) {
            bends ? trace_curve(to, at, control, next) : trace_edge(to, at, next);
            at = next;
        } else if (bends) {
            const e3d_subpixel between = middle(control, next);
            trace_curve(to, at, control, between);
            at = between;
        }
        bends = !outline->on_curve[k];
        control = next;
    }
    bends ? trace_curve(to, at, control, begin) : trace_edge(to, at, begin);
}

static uint8_t alpha_of(int64_t doubled_area)
{
    const int64_t covered = min_i64(doubled_area < 0 ? -doubled_area : doubled_area, DOUBLED_PIXEL);
    return (uint8_t)((2 * covered * 255 + DOUBLED_PIXEL) / (2 * DOUBLED_PIXEL));
}

void e3d_outline_alphas(const e3d_outline *outline, e3d_glyph_box box, e3d_cell *cells, uint8_t *alphas)
{
    const tracer to = {cells, (int64_t)box.width + 1, {(int64_t)box.left * SUBPIXELS, (int64_t)box.top * SUBPIXELS}};
    int32_t first = 0;
    for (int32_t contour = 0; contour < outline->contours; contour++) {
        trace_contour(&to, outline, first, outline->ends[contour]);
        first = outline->ends[contour];
    }
    for (int64_t row = 0; row < box.height; row++) {
        int64_t cover = 0;
        for (int64_t column = 0; column < box.width; column++) {
            const e3d_cell cell = cells[row * to.columns + column];
            cover += cell.cover;
            *alphas++ = alpha_of(2 * SUBPIXELS * cover - cell.area);
        }
    }
}
