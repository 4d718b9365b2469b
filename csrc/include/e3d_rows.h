/* Equal rows and combinations of indices: numbered, welded, found. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Welds corners into vertices: one vertex for each combination of indices that occurs, sorted by position, then uv, then normal.
 * A position that no corner has gets no vertex.
 * In: for each corner an index below position_count, and uvs and normals from -1 on, or NULL.
 * Out: faces[corners], the vertex of each corner, and of_*[corners], the indices of each vertex (NULL where the list is).
 * Returns the number of vertices; SIZE_MAX if memory is out or a position is out of range. */
size_t e3d_weld_corners(const int32_t *positions, const int32_t *uvs, const int32_t *normals,
                        size_t corners, size_t position_count, int32_t *faces, int32_t *of_position,
                        int32_t *of_uv, int32_t *of_normal);

/* Sets used[i], of `total` zeros, to 1 for each index i below `total`, which is below 2^31. Returns how many it set. */
size_t e3d_mark_used(const int32_t *indices, size_t count, uint8_t *used, size_t total);

#define E3D_ROW_WORDS 8

/* Rows of words. A record holds `in_record` rows side by side; the next record is `stride` bytes behind. */
typedef struct e3d_rows {
    const uint8_t *bytes; /* of any alignment */
    size_t count;         /* rows, fewer than 2^31 */
    size_t width;         /* words a row, up to E3D_ROW_WORDS */
    size_t in_record, stride;
    bool are_floats;      /* -0 equals 0 */
} e3d_rows;

/* Numbers rows in the order of their first appearance; equal rows get the same number.
 * Out: numbers[count]; first[count], the first row of each number, or NULL; *found, the distinct rows, which the caller frees
 * with free(), unless it is NULL. Returns how many numbers there are; SIZE_MAX, and nothing to free, if memory is out. */
size_t e3d_number_rows(const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t **found);

/* The same piece by piece. Begin, with the words of a row and the number of rows that are expected (NULL if memory is out). Add:
 * numbers continue, and `first` counts from the first row of all; false if memory is out. Take the distinct rows, which the
 * caller frees with free(); returns how many there are. Free. */
typedef struct e3d_row_numbers e3d_row_numbers;
e3d_row_numbers *e3d_row_numbers_begin(size_t width, bool are_floats, size_t expected);
bool e3d_row_numbers_add(e3d_row_numbers *taken, const e3d_rows *rows, int32_t *numbers, int32_t *first);
size_t e3d_row_numbers_take(e3d_row_numbers *taken, uint32_t **found);
void e3d_row_numbers_free(e3d_row_numbers *taken);

/* Whether any two rows are equal, with one row in each record: 1 or 0; -1 if memory is out. It is faster than numbering if there
 * are none. */
int e3d_rows_repeat(const e3d_rows *rows);
