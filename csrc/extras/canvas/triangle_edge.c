/* Edge functions: a triangle filled by testing the pixel centres of its bounding box.
 *
 * In:  three snapped vertices, in either winding.
 * Out: the pixels whose centres are on the inner side of all three edges; a centre on an edge counts if
 *      it is a top or a left edge.
 * Always: exact. E(i, j) = E0 + 256 (a i + b j) is at least 0 exactly when floor(E0 / 256) + a i + b j
 *      is. From one pixel of the canvas to another it changes by at most 2^41 (width + height)
 *      <= 2^60, so that clamping its first value to +-2^61 changes no sign.
 * Source: J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988.
 */
#include "canvas_pixels.h"

/* a and b below are differences of positions within 2^40, so at most 2^41. */
_Static_assert(2 * (int64_t)E3D_CANVAS_MAX_SIDE <= INT64_C(1) << 19, "edge functions overflow");
#define FAR_AWAY (INT64_C(1) << 61)

typedef struct edge_function {
    int64_t value;    /* at the first pixel of the row; >= 0 is inside */
    int64_t per_x;    /* its change from a pixel to the next one on the right */
    int64_t per_y;    /* and to the next one below */
} edge_function;

/* The interior is on the right-hand side of a -> b (clockwise on the screen), so an edge that goes up is a left edge, and a
 * horizontal edge that goes right is a top edge. */
static bool is_top_left(int64_t dx, int64_t dy)
{
    return dy < 0 || (dy == 0 && dx > 0);
}

static int64_t limited(e3d_wide value)
{
    if (value > FAR_AWAY)
        return FAR_AWAY;
    return value < -FAR_AWAY ? -FAR_AWAY : (int64_t)value;
}

static edge_function edge_at(e3d_subpixel a, e3d_subpixel b, int64_t x, int64_t y)
{
    const int64_t dx = b.x - a.x;
    const int64_t dy = b.y - a.y;
    const e3d_subpixel centre = {x * SUBPIXELS + HALF_PIXEL, y * SUBPIXELS + HALF_PIXEL};
    const e3d_wide exact = doubled_area(a, b, centre) - !is_top_left(dx, dy);
    return (edge_function){
        .value = limited(floor_div(exact, SUBPIXELS)),
        .per_x = -dy,
        .per_y = dx,
    };
}

/* Draws the pixels of one row that are inside. They are one run, since a triangle is convex. */
static void fill_row(const e3d_canvas *canvas, const edge_function edges[3], int64_t y, int64_t x0,
                     int64_t x1, e3d_rgba color)
{
    int64_t e0 = edges[0].value, e1 = edges[1].value, e2 = edges[2].value;
    int64_t start = -1;
    int64_t x = x0;
    for (; x < x1; x++) {
        const bool inside = (e0 | e1 | e2) >= 0;
        if (inside && start < 0) {
            start = x;
        }
        if (!inside && start >= 0) {
            break;
        }
        e0 += edges[0].per_x;
        e1 += edges[1].per_x;
        e2 += edges[2].per_x;
    }
    if (start >= 0) {
        e3d_canvas_span(canvas, y, start, x, color);
    }
}

static int64_t min3(int64_t a, int64_t b, int64_t c)
{
    return min_i64(a, min_i64(b, c));
}

static int64_t max3(int64_t a, int64_t b, int64_t c)
{
    return max_i64(a, max_i64(b, c));
}

void e3d_canvas_fill_edge(const e3d_canvas *canvas, const e3d_subpixel vertices[3], e3d_rgba color)
{
    const e3d_wide area = doubled_area(vertices[0], vertices[1], vertices[2]);
    if (area == 0) {
        return;
    }
    const e3d_subpixel a = vertices[0];
    const e3d_subpixel b = area > 0 ? vertices[1] : vertices[2];
    const e3d_subpixel c = area > 0 ? vertices[2] : vertices[1];

    const int64_t x0 = max_i64(first_centre_subpixel(min3(a.x, b.x, c.x)), 0);
    const int64_t y0 = max_i64(first_centre_subpixel(min3(a.y, b.y, c.y)), 0);
    const int64_t x1 = min_i64(first_centre_subpixel(max3(a.x, b.x, c.x)), canvas->width);
    const int64_t y1 = min_i64(first_centre_subpixel(max3(a.y, b.y, c.y)), canvas->height);
    if (x0 >= x1) {
        return;
    }
    edge_function edges[3] = {edge_at(a, b, x0, y0), edge_at(b, c, x0, y0), edge_at(c, a, x0, y0)};
    for (int64_t y = y0; y < y1; y++) {
        fill_row(canvas, edges, y, x0, x1, color);
        for (int i = 0; i < 3; i++) {
            edges[i].value += edges[i].per_y;
        }
    }
}
