/* A grid over the drawing: which items may touch a cell.
 * In: the corners of items, two or three each. Out: for each cell a list, in the order in which the items were given.
 * Always: lists hold more rather than fewer items; their total length is limited, by larger cells. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_status.h"

typedef struct drw_grid {
    double low[2], cells_per_unit[2], margin;
    int32_t columns, rows;
    int32_t *starts; /* (rows * columns + 1,) */
    int32_t *items;
} drw_grid;

/* Columns first .. last of a row; none if first > last. */
typedef struct drw_span {
    int32_t first, last;
} drw_span;

/* Items (any number, corners, 2); `order` (count,) lists those that are meant. The grid covers a box: items beyond it are left out.
 * Items reach `margin` beyond their corners. */
e3d_status drw_grid_build(drw_grid *grid, const double *items, int corners, const int32_t *order, size_t count,
                          const double low[2], const double high[2], double margin);
void drw_grid_free(drw_grid *grid);

/* The rows that an item touches. */
drw_span drw_rows(const drw_grid *grid, const double *item, int corners);
/* The columns that it touches in one of these. */
drw_span drw_columns(const drw_grid *grid, const double *item, int corners, int32_t row);
