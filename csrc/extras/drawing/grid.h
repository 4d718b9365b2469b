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
    uint8_t *asked; /* (rows * columns,): which cells have lists; NULL: all */
} drw_grid;

/* Columns first .. last of a row; none if first > last. */
typedef struct drw_span {
    int32_t first, last;
} drw_span;

typedef struct drw_block {
    drw_span rows, columns;
} drw_block;

/* Items or lines: (any number, corners, 2). */
typedef struct drw_items {
    const double *places;
    int corners;
} drw_items;

/* Finds the box of lines; those whose length is not finite have no pieces, and do not count. */
void drw_measure(const double *lines, size_t count, double low[2], double high[2]);
/* Makes a grid over a box for items, of which `order` lists *count. Items reach `margin` beyond their corners. Only cells that
 * some of `lines` touch get lists (all if there are no lines, NULL). Items in no list are taken out of `order`. There are about
 * `cells_an_item` cells for each item, fewer if lists become long. */
e3d_status drw_grid_make(drw_grid *grid, drw_items items, int32_t *order, size_t *count, const double *lines, size_t line_count,
                         const double low[2], const double high[2], double margin, double cells_an_item);
/* Makes the lists, of items 0 .. count - 1, each in ascending order. */
e3d_status drw_grid_fill(drw_grid *grid, drw_items items, size_t count);
void drw_grid_free(drw_grid *grid);

/* The rows and columns of an item's box. */
drw_block drw_block_of(const drw_grid *grid, const double *item, int corners);
/* The columns that it touches in a row of its block. */
drw_span drw_columns(const drw_grid *grid, const double *item, int corners, drw_block block, int32_t row);
