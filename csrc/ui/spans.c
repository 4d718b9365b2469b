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

static int64_t between(int64_t column, int64_t left, int64_t right)
{
    int64_t from = column > left ? column : left;
    return from < right ? from : right;
}

/* Takes away what an edge doesn't admit of each row. Which rows carry can't be predicted, so that no branch decides it. */
static void cut(ui_edge *edge, int32_t left, int32_t right, e3d_ui_rows *rows)
{
    ui_edge e = *edge;
    for (int32_t row = 0; row < rows->count; row++) {
        int32_t side = (int32_t)between(e.is_left ? -e.column : e.column + 1, left, right);
        if (e.is_left)
            rows->left[row] = side > rows->left[row] ? side : rows->left[row];
        else
            rows->right[row] = side < rows->right[row] ? side : rows->right[row];
        e.rest += e.rest_step;
        int64_t carry = e.rest >= e.d;
        e.rest -= e.d & -carry;
        e.column += e.column_step + carry;
    }
    *edge = e;
}

void ui_edges_rows(ui_edges *edges, int32_t left, int32_t right, e3d_ui_rows *rows)
{
    for (int32_t row = 0; row < rows->count; row++)
        rows->left[row] = left, rows->right[row] = right;
    for (int k = 0; k < edges->count; k++)
        cut(&edges->edges[k], left, right, rows);
}
