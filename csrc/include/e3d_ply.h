/* The rows of binary PLY files. */
#ifndef E3D_PLY_H
#define E3D_PLY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum e3d_ply_problem {
    E3D_PLY_DONE,
    E3D_PLY_SHORT,    /* the body ends within a row */
    E3D_PLY_BAD_LIST, /* a list of negative length */
} e3d_ply_problem;

/* Rows in the bytes of a binary PLY file, from `start` on and before `end`. */
typedef struct e3d_ply_body {
    const uint8_t *bytes;
    size_t start, end;
    bool is_big_endian;
} e3d_ply_body;

/* A list in each row. */
typedef struct e3d_ply_list {
    size_t skip;       /* bytes of single numbers before it */
    size_t count_size; /* bytes of its length, up to 8 */
    size_t item_size;  /* not 0 */
    bool is_signed;    /* its length */
} e3d_ply_list;

/* Offsets from the first of the bytes on. */
typedef struct e3d_ply_rows {
    int64_t *places;         /* [rows] where each begins */
    int64_t *starts, *sizes; /* [rows * lists] the first item and the length of each list */
    size_t end;              /* behind the last row; or the length that is bad ... */
    size_t row;              /* ... and its row */
} e3d_ply_rows;

/* Goes along rows of lists, with `tail` bytes behind the last list of each. */
e3d_ply_problem e3d_ply_walk(const e3d_ply_body *body, const e3d_ply_list *lists, size_t list_count,
                             size_t tail, size_t rows, e3d_ply_rows *found);

/* Whether a list has `length` items in each row; from body->start on, all inside the bytes, the lengths themselves
 * are `stride` bytes apart. */
bool e3d_ply_lengths_are(const e3d_ply_body *body, size_t stride, size_t rows, size_t count_size, uint64_t length);

/* Copies the items of a list of each row, which stand inside the bytes, row after row; from one row's
 * start and size to the next one's are `step`. */
void e3d_ply_copy_lists(const e3d_ply_body *body, const int64_t *starts, const int64_t *sizes,
                        size_t step, size_t rows, size_t item_size, void *items);
/* The same where rows are nothing but a list, of `length` items in each row, from body->start on and all inside the
 * bytes; false if one says another length: then the items mean nothing. */
bool e3d_ply_copy_even_lists(const e3d_ply_body *body, size_t rows, size_t count_size, uint64_t length,
                             size_t item_size, void *items);
/* Copies `width` items of each row, from body->start on and `stride` bytes apart. */
void e3d_ply_copy_rows(const e3d_ply_body *body, size_t stride, size_t rows, size_t width,
                       size_t item_size, void *items);

#endif
