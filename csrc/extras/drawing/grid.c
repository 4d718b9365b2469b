/* Builds the grid over a drawing, and finds the cells that lines and triangles touch, row by row. */
#include "extras/drawing/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CELLS_ACROSS = 4096,
       FEW_CELLS = 2 }; /* blocks of so many across are touched as a whole: it costs less than to ask */
#define MOST_ENTRIES_AN_ITEM 12
#define FREE_ENTRIES 65536

static double least(double a, double b) { return b < a ? b : a; }
static double most(double a, double b) { return b > a ? b : a; }

void drw_measure(const double *lines, size_t count, double low[2], double high[2])
{
    low[0] = low[1] = INFINITY;
    high[0] = high[1] = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        const double *line = lines + 4 * i;
        for (int axis = 0; axis < 2 && isfinite(line[2] - line[0]) && isfinite(line[3] - line[1]); axis++) {
            low[axis] = least(low[axis], least(line[axis], line[2 + axis]));
            high[axis] = most(high[axis], most(line[axis], line[2 + axis]));
        }
    }
}

/* The row or column that holds a coordinate; those outside of the grid are -1 or `count`. */
static int32_t cell_of(const drw_grid *grid, int axis, double at, int32_t count)
{
    double cell = (at - grid->low[axis]) * grid->cells_per_unit[axis];
    if (!(cell >= 0))
        return -1;
    return cell < count ? (int32_t)cell : count;
}

static drw_span cells_between(const drw_grid *grid, int axis, double low, double high, int32_t count)
{
    drw_span none = {0, -1};
    if (!(low <= high))
        return none;
    int32_t first = cell_of(grid, axis, low - grid->margin, count);
    int32_t last = cell_of(grid, axis, high + grid->margin, count);
    if (last < 0 || first >= count)
        return none;
    return (drw_span){first < 0 ? 0 : first, last >= count ? count - 1 : last};
}

drw_block drw_block_of(const drw_grid *grid, const double *item, int corners)
{
    double low[2] = {item[0], item[1]}, high[2] = {item[0], item[1]};
    for (int k = 1; k < corners; k++)
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = least(low[axis], item[2 * k + axis]);
            high[axis] = most(high[axis], item[2 * k + axis]);
        }
    return (drw_block){cells_between(grid, 1, low[1], high[1], grid->rows), cells_between(grid, 0, low[0], high[0], grid->columns)};
}

drw_span drw_columns(const drw_grid *grid, const double *item, int corners, drw_block block, int32_t row)
{
    if (block.rows.last - block.rows.first < FEW_CELLS && block.columns.last - block.columns.first < FEW_CELLS)
        return block.columns;
    /* A little more than the row, since its limits are rounded. */
    double height = 1 / grid->cells_per_unit[1], slack = height * 0x1p-20 + grid->margin;
    double top = grid->low[1] + row * height - slack, bottom = grid->low[1] + (row + 1) * height + slack;
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < corners; k++) {
        const double *a = item + 2 * k, *b = item + 2 * ((k + 1) % corners);
        if (most(a[1], b[1]) < top || least(a[1], b[1]) > bottom)
            continue;
        double run = b[0] - a[0], rise = b[1] - a[1];
        double x0 = a[1] < top ? a[0] + run * ((top - a[1]) / rise) : a[1] > bottom ? a[0] + run * ((bottom - a[1]) / rise)
                                                                                    : a[0];
        double x1 = b[1] < top ? a[0] + run * ((top - a[1]) / rise) : b[1] > bottom ? a[0] + run * ((bottom - a[1]) / rise)
                                                                                    : b[0];
        low = least(low, least(x0, x1));
        high = most(high, most(x0, x1));
    }
    double rounding = (fabs(low) + fabs(high)) * 0x1p-40;
    return cells_between(grid, 0, low - rounding, high + rounding, grid->columns);
}

static size_t cell_at(const drw_grid *grid, int32_t row, int32_t column)
{
    return (size_t)row * (size_t)grid->columns + (size_t)column;
}

static int has_list(const drw_grid *grid, size_t cell) { return !grid->asked || grid->asked[cell]; }

/* Marks the cells that lines touch. */
static e3d_status ask(drw_grid *grid, const double *lines, size_t count)
{
    free(grid->asked);
    grid->asked = calloc((size_t)grid->columns * (size_t)grid->rows, 1);
    if (!grid->asked)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < count; i++) {
        drw_block block = drw_block_of(grid, lines + 4 * i, 2);
        for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
            drw_span columns = drw_columns(grid, lines + 4 * i, 2, block, row);
            if (columns.first <= columns.last)
                memset(grid->asked + cell_at(grid, row, columns.first), 1, (size_t)(columns.last - columns.first + 1));
        }
    }
    return E3D_OK;
}

/* Counts the entries of an item in starts[cell + 1]; returns how many there are. */
static size_t count_item(const drw_grid *grid, const double *item, int corners)
{
    size_t entries = 0;
    drw_block block = drw_block_of(grid, item, corners);
    for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
        drw_span columns = drw_columns(grid, item, corners, block, row);
        for (int32_t column = columns.first; column <= columns.last; column++) {
            size_t cell = cell_at(grid, row, column);
            if (has_list(grid, cell)) {
                grid->starts[cell + 1]++;
                entries++;
            }
        }
    }
    return entries;
}

e3d_status drw_grid_fill(drw_grid *grid, drw_items items, size_t count)
{
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    for (size_t cell = 0; cell < cells; cell++)
        grid->starts[cell + 1] += grid->starts[cell];
    grid->items = malloc(((size_t)grid->starts[cells] + 1) * sizeof *grid->items);
    if (!grid->items)
        return E3D_OUT_OF_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const double *item = items.places + 2 * (size_t)items.corners * i;
        drw_block block = drw_block_of(grid, item, items.corners);
        for (int32_t row = block.rows.first; row <= block.rows.last; row++) {
            drw_span columns = drw_columns(grid, item, items.corners, block, row);
            for (int32_t column = columns.first; column <= columns.last; column++) {
                size_t cell = cell_at(grid, row, column);
                if (has_list(grid, cell))
                    grid->items[grid->starts[cell]++] = (int32_t)i;
            }
        }
    }
    memmove(grid->starts + 1, grid->starts, cells * sizeof *grid->starts);
    grid->starts[0] = 0;
    return E3D_OK;
}

static int32_t cells_across(double length, double side)
{
    double cells = ceil(length / side);
    return cells >= 1 ? cells < MOST_CELLS_ACROSS ? (int32_t)cells : MOST_CELLS_ACROSS : 1;
}

static void set_cells(drw_grid *grid, const double size[2], double wanted)
{
    double longer = most(size[0], size[1]), shorter = most(least(size[0], size[1]), longer / wanted);
    double side = sqrt(longer / wanted) * sqrt(shorter); /* no product of lengths, which may be beyond what doubles hold */
    grid->columns = cells_across(size[0], side);
    grid->rows = cells_across(size[1], side);
    grid->cells_per_unit[0] = size[0] > 0 ? grid->columns / size[0] : 1;
    grid->cells_per_unit[1] = size[1] > 0 ? grid->rows / size[1] : 1;
}

/* Counts the entries of all items, at most `limit` and one item's more; keeps those that have any. */
static size_t count_all(drw_grid *grid, drw_items items, int32_t *order, size_t count, size_t limit, size_t *kept)
{
    size_t entries = 0;
    *kept = 0;
    for (size_t i = 0; i < count && entries <= limit; i++) {
        size_t own = count_item(grid, items.places + 2 * (size_t)items.corners * (size_t)order[i], items.corners);
        entries += own;
        if (own && entries <= limit) {
            int32_t item = order[i]; /* the others stay behind, in case all are counted again */
            order[i] = order[*kept];
            order[(*kept)++] = item;
        }
    }
    return entries;
}

e3d_status drw_grid_make(drw_grid *grid, drw_items items, int32_t *order, size_t *count, const double *lines, size_t line_count,
                         const double low[2], const double high[2], double margin, double cells_an_item)
{
    double size[2] = {high[0] - low[0], high[1] - low[1]}, wanted = cells_an_item * (double)(*count + 8);
    size_t limit = MOST_ENTRIES_AN_ITEM * *count + FREE_ENTRIES, entries, kept;
    limit = limit < INT32_MAX / 2 ? limit : INT32_MAX / 2;
    *grid = (drw_grid){{low[0], low[1]}, {1, 1}, margin, 1, 1, NULL, NULL, NULL};
    for (;; wanted /= 4) {
        set_cells(grid, size, wanted);
        free(grid->starts);
        grid->starts = calloc((size_t)grid->columns * (size_t)grid->rows + 1, sizeof *grid->starts);
        if (!grid->starts || (lines && ask(grid, lines, line_count) != E3D_OK))
            return E3D_OUT_OF_MEMORY;
        entries = count_all(grid, items, order, *count, limit, &kept);
        if (entries <= limit || (grid->columns == 1 && grid->rows == 1))
            break;
    }
    *count = kept;
    return E3D_OK;
}

void drw_grid_free(drw_grid *grid)
{
    free(grid->starts);
    free(grid->items);
    free(grid->asked);
    grid->starts = grid->items = NULL;
    grid->asked = NULL;
}
