/* The rows of binary PLY files. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum e3d_ply_problem {
    E3D_PLY_DONE,
    E3D_PLY_SHORT,    /* the body ends within a row */
    E3D_PLY_BAD_LIST, /* a list of negative length */
} e3d_ply_problem;

/* The rows between `start` and `end` in the bytes of a binary PLY file. */
typedef struct e3d_ply_body {
    const uint8_t *bytes;
    size_t start, end;
    bool is_big_endian;
} e3d_ply_body;

/* A list in each row. */
typedef struct e3d_ply_list {
    size_t skip;       /* the bytes of single numbers before the list */
    size_t count_size; /* the bytes of the list's length, up to 8 */
    size_t item_size;  /* not 0 */
    bool is_signed;    /* its length */
} e3d_ply_list;

/* All offsets count from the first byte of the file. */
typedef struct e3d_ply_rows {
    int64_t *places;         /* [rows] the offset of each row */
    int64_t *starts, *sizes; /* [rows * lists] the offset of each list's first item, and the list's length */
    size_t end;              /* the offset behind the last row, or of a bad length */
    size_t row;              /* ... and its row */
} e3d_ply_rows;

/* Finds the lists of all rows; `tail` bytes follow the last list of a row. */
e3d_ply_problem e3d_ply_walk(const e3d_ply_body *body, const e3d_ply_list *lists, size_t list_count,
                             size_t tail, size_t rows, e3d_ply_rows *found);

/* Whether a list has `length` items in each row. The first length is at body->start, the others `stride` bytes apart; all are
 * inside the bytes. */
bool e3d_ply_lengths_are(const e3d_ply_body *body, size_t stride, size_t rows, size_t count_size, uint64_t length);

/* Copies the items of a list, row after row; they are inside the bytes. `step` is the distance from one row's element of starts
 * and sizes to the next one's. */
void e3d_ply_copy_lists(const e3d_ply_body *body, const int64_t *starts, const int64_t *sizes,
                        size_t step, size_t rows, size_t item_size, void *items);
/* The same for rows of nothing but a list of `length` items, from body->start on and all inside the bytes. Returns false if a
 * row gives another length; the copied items then mean nothing. */
bool e3d_ply_copy_even_lists(const e3d_ply_body *body, size_t rows, size_t count_size, uint64_t length,
                             size_t item_size, void *items);
/* Copies `width` items of each row; the first row is at body->start, the others `stride` bytes apart. */
void e3d_ply_copy_rows(const e3d_ply_body *body, size_t stride, size_t rows, size_t width,
                       size_t item_size, void *items);
