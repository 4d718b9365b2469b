/* Spans: the pixels of each row whose centres a triangle covers (R12), by exact division once per edge.
 *
 * In:  snapped corners.
 * Out: the first column and the one after the last, of each row.
 * Always: with D = 256 |a| and K = E at column 0, a left edge (a > 0) admits x >= -K / D, a right one x < K / D. From a row to the next
 *      K grows by 256 b, so that its quotient and its rest are stepped instead of divided again, as Bresenham's are. A triangle is
 *      convex: of a row, the left and the right edge whose ends it lies between bound it, and the third one beyond them.
 */
#include "post/ui/spans.h"

static int64_t floor_div(int64_t n, int64_t d) { return n / d - (n % d < 0); }

static ui_edge edge_of(const ui_corner *i, const ui_corner *j, int32_t first)
{
    int64_t a = i->y - j->y, b = j->x - i->x;
    ui_edge edge = {.d = 256 * (a < 0 ? -a : a), .is_left = a > 0};
    int32_t top = ui_first_centre(edge.is_left ? j->y : i->y);
    edge.row = top > first ? top : first;
    edge.end = ui_first_centre(edge.is_left ? i->y : j->y);
    int64_t k = a * (128 - i->x) + b * (256 * (int64_t)edge.row + 128 - i->y);
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

/* Fills in one side of the rows that the edge bounds. Which rows carry is unpredictable, so there is no branch on it. */
static void follow(ui_edge *edge, int64_t left, int64_t right, e3d_ui_rows *rows)
{
    ui_edge e = *edge;
    int32_t *side = e.is_left ? rows->left : rows->right, end = rows->first + rows->count;
    for (; e.row < e.end && e.row < end; e.row++) {
        int64_t column = e.is_left ? -e.column : e.column + 1;
        column = column > left ? column : left;
        side[e.row - rows->first] = (int32_t)(column < right ? column : right);
        e.rest += e.rest_step;
        int64_t carry = e.rest >= e.d;
        e.rest -= e.d & -carry;
        e.column += e.column_step + carry;
    }
    *edge = e;
}

void ui_edges_rows(ui_edges *edges, int32_t left, int32_t right, e3d_ui_rows *rows)
{
    for (int k = 0; k < edges->count; k++)
        follow(&edges->edges[k], left, right, rows);
}
