/* Spans: the pixels of each row whose centres a triangle covers (R12), by exact division once per edge.
 *
 * In:  snapped corners.
 * Out: the first column and the one after the last, of each row.
 * Always: with D = 256 |a| and K = E at column 0, a left edge (a > 0) admits x >= -K / D, a right one x < K / D. From a row to the next
 *      K grows by 256 b, so that its quotient and its rest are stepped instead of divided again, as Bresenham's are.
 */
#include "ui/spans.h"

static int64_t floor_div(int64_t n, int64_t d) { return n / d - (n % d < 0); }

static ui_edge edge_of(const ui_corner *i, const ui_corner *j, int32_t first)
{
    int64_t a = i->y - j->y, b = j->x - i->x;
    int64_t k = a * (128 - i->x) + b * (256 * (int64_t)first + 128 - i->y);
    ui_edge edge = {.d = 256 * (a < 0 ? -a : a), .is_left = a > 0};
    /* The greatest column below K / D is the greatest one up to (K - 1) / D. */
    int64_t n = edge.is_left ? k : k - 1;
    edge.column = floor_div(n, edge.d);
    edge.rest = n - edge.column * edge.d;
    edge.column_step = floor_div(256 * b, edge.d);
    edge.rest_step = 256 * b - edge.column_step * edge.d;
    return edge;
}

void ui_edges_begin(ui_edges *edges, const ui_corner corners[3], int32_t first)
{
    edges->count = 0;
    for (int k = 0; k < 3; k++) {
        const ui_corner *i = &corners[(k + 1) % 3], *j = &corners[(k + 2) % 3];
        if (i->y != j->y)
            edges->edges[edges->count++] = edge_of(i, j, first);
    }
}

static void step(ui_edge *edge)
{
    edge->column += edge->column_step;
    edge->rest += edge->rest_step;
    if (edge->rest >= edge->d) {
        edge->rest -= edge->d;
        edge->column++;
    }
}

void ui_edges_rows(ui_edges *edges, int32_t left, int32_t right, e3d_ui_rows *rows)
{
    for (int32_t row = 0; row < rows->count; row++) {
        int64_t from = left, to = right;
        for (int k = 0; k < edges->count; k++) {
            ui_edge *edge = &edges->edges[k];
            if (edge->is_left)
                from = from > -edge->column ? from : -edge->column;
            else
                to = to < edge->column + 1 ? to : edge->column + 1;
            step(edge);
        }
        int is_empty = from >= to;
        rows->left[row] = is_empty ? left : (int32_t)from;
        rows->right[row] = is_empty ? left : (int32_t)to;
    }
}
