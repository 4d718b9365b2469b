/* The pixels of a row that a triangle of the user interface covers. Private to csrc/post/ui. */
#pragma once

#include "kernels/types/ui.h"
#include "post/ui/setup.h"

/* An edge in the rows between its ends: a quotient n / d that is stepped exactly from row to row. */
typedef struct ui_edge {
    int32_t row, end; /* the next row that it bounds, and the end of these rows */
    int64_t column, rest, d; /* n = column * d + rest, 0 <= rest < d */
    int64_t column_step, rest_step;
    int is_left;          /* it bounds columns on the left, from -column on; else on the right */
} ui_edge;

typedef struct ui_edges {
    ui_edge edges[3];
    int count; /* horizontal edges don't count: the first and the last row imply them */
} ui_edges;

/* Begins with the edges of a triangle of positive area, from row `first` on. */
void ui_edges_begin(ui_edges *edges, const ui_corner corners[3], int32_t first);

/* Fills in the columns in [left, right) of the next rows->count rows; the triangle's box holds these rows. */
void ui_edges_rows(ui_edges *edges, int32_t left, int32_t right, e3d_ui_rows *rows);
