/* Reads texts of numbers: lines of them, and rows of lists among these. The last byte of a text is a blank or ends a line; LF,
 * CR or both end a line. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "e3d_ply.h"

typedef enum e3d_comments {
    E3D_NO_COMMENTS,
    E3D_HASH_COMMENTS, /* from '#' to the end of a line */
    E3D_PLY_COMMENTS,  /* lines that begin with `comment` or `obj_info` */
} e3d_comments;

typedef enum e3d_numbers_problem {
    E3D_NUMBERS_DONE,
    E3D_NUMBERS_NO_MEMORY,
    E3D_NUMBERS_NOT_A_NUMBER,
} e3d_numbers_problem;

/* The numbers of a text, and of its rows: a row is a line that holds any. */
typedef struct e3d_numbers {
    double *values;  /* [count] */
    int64_t *widths; /* [rows] how many numbers each row holds; NULL if nobody asked */
    size_t count, rows;
    size_t place;    /* behind the last line read; or the word that is no number */
} e3d_numbers;

/* Reads as many rows, or all. Whatever it returns, e3d_numbers_free() frees what `found` holds. */
e3d_numbers_problem e3d_read_numbers(const uint8_t *bytes, size_t size, e3d_comments comments, size_t most_rows,
                                     bool with_widths, e3d_numbers *found);
void e3d_numbers_free(e3d_numbers *found);

/* Numbers from `start` on and before `end`. */
typedef struct e3d_number_body {
    const double *values;
    size_t start, end;
} e3d_number_body;

/* Goes along rows of lists as e3d_ply_walk() does: skips[k] numbers stand before the length of a list, `tail` behind
 * the last list of a row. Offsets are those of numbers. */
e3d_ply_problem e3d_walk_numbers(const e3d_number_body *body, const size_t *skips, size_t list_count, size_t tail,
                                 size_t rows, e3d_ply_rows *found);
/* Copies the items of a list of each row, row after row; from one row's start and size to the next one's are `step`. */
void e3d_copy_numbers(const double *values, const int64_t *starts, const int64_t *sizes, size_t step, size_t rows,
                      double *items);
/* Writes `width` numbers of each row, rows being `stride` apart, as indices; returns how many it wrote before one
 * that is not whole, or not from 0 on and below `limit`. */
size_t e3d_numbers_to_indices(const double *values, size_t width, size_t stride, size_t rows, size_t limit,
                              int32_t *indices);
