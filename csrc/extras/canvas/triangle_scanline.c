/* The sweep: a triangle filled row by row, between the two edges that cross the row.
 *
 * In:  three snapped vertices, in either winding.
 * Out: for each row of pixel centres, the pixels from the first centre at or right of the left edge
 *      up to, and without, the first centre at or right of the right edge; rows from the first centre
 *      at or below the top vertex up to, and without, the first at or below the bottom one. That is
 *      the top-left rule.
 * Always: the crossings are exact. Each is a quotient rounded up by integer division, carried from
 *      row to row with its remainder, so that nothing accumulates.
 */
#include "canvas_pixels.h"

/* The first pixel centre at or right of an edge, along rows j, j+1, ...
 * On row j the edge crosses at x = x0 + (256 j + 128 - y0) dx / dy, in 1/256 pixel, and the centre of
 * pixel i is at 256 i + 128, so i = ceil(((x0 - 128) dy + (256 j + 128 - y0) dx) / (256 dy)). */
typedef struct edge_walk {
    int64_t pixel;       /* the quotient, rounded up */
    int64_t remainder;   /* pixel * denominator - numerator, in [0, denominator) */
    int64_t denominator; /* 256 dy > 0 */
    int64_t pixel_step, remainder_step;
} edge_walk;

static edge_walk walk_edge(e3d_subpixel top, e3d_subpixel bottom, int64_t row)
{
    const int64_t dx = bottom.x - top.x;
    const int64_t dy = bottom.y - top.y;
    const int64_t denominator = dy * SUBPIXELS;
    const e3d_wide numerator = (e3d_wide)(top.x - HALF_PIXEL) * dy +
                               (e3d_wide)(row * SUBPIXELS + HALF_PIXEL - top.y) * dx;
    const e3d_wide pixel = ceil_div(numerator, denominator);
    const int64_t pixel_step = (int64_t)floor_div(dx, dy);
    return (edge_walk){
        .pixel = (int64_t)pixel,
        .remainder = (int64_t)(pixel * denominator - numerator),
        .denominator = denominator,
        .pixel_step = pixel_step,
        .remainder_step = (dx - pixel_step * dy) * SUBPIXELS,
    };
}

static inline void next_row(edge_walk *edge)
{
    edge->pixel += edge->pixel_step;
    edge->remainder -= edge->remainder_step;
    if (edge->remainder < 0) {
        edge->remainder += edge->denominator;
        edge->pixel++;
    }
}

/* The rows between `top` and `bottom` that are on the canvas; false if there are none. */
static bool rows_between(const e3d_canvas *canvas, int64_t top, int64_t bottom, int64_t *first,
                         int64_t *end)
{
    *first = max_i64(first_centre_subpixel(top), 0);
    *end = min_i64(first_centre_subpixel(bottom), canvas->height);
    return *first < *end;
}

/* Fills from row `first` to row `end` between two edges, both of which span those rows. */
static void fill_rows(const e3d_canvas *canvas, int64_t first, int64_t end, edge_walk left,
                      edge_walk right, e3d_rgba color)
{
    for (int64_t row = first; row < end; row++) {
        const int64_t x0 = max_i64(left.pixel, 0);
        const int64_t x1 = min_i64(right.pixel, canvas->width);
        if (x0 < x1) {
            e3d_canvas_span(canvas, row, x0, x1, color);
        }
        next_row(&left);
        next_row(&right);
    }
}

static void swap_if_below(e3d_subpixel *upper, e3d_subpixel *lower)
{
    if (upper->y > lower->y) {
        const e3d_subpixel vertex = *upper;
        *upper = *lower;
        *lower = vertex;
    }
}

void e3d_canvas_fill_scanline(const e3d_canvas *canvas, const e3d_subpixel vertices[3],
                              e3d_rgba color)
{
    e3d_subpixel top = vertices[0], middle = vertices[1], bottom = vertices[2];
    swap_if_below(&top, &middle);
    swap_if_below(&middle, &bottom);
    swap_if_below(&top, &middle);

    const e3d_wide area = doubled_area(top, middle, bottom);
    if (area == 0) {
        return;
    }
    const bool long_edge_is_left = area > 0; /* top, middle, bottom turn clockwise */
    const e3d_subpixel parts[2][2] = {{top, middle}, {middle, bottom}};
    for (int part = 0; part < 2; part++) {
        int64_t first, end;
        if (!rows_between(canvas, parts[part][0].y, parts[part][1].y, &first, &end)) {
            continue;
        }
        const edge_walk long_edge = walk_edge(top, bottom, first);
        const edge_walk short_edge = walk_edge(parts[part][0], parts[part][1], first);
        if (long_edge_is_left) {
            fill_rows(canvas, first, end, long_edge, short_edge, color);
        } else {
            fill_rows(canvas, first, end, short_edge, long_edge, color);
        }
    }
}
