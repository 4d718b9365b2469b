/* Reading model files: bytes in, arrays out. No files, no Python, no renderer.
 *
 * Always: nothing outside the bytes given is read, whatever they hold; time and memory grow with their
 *      number (sorting apart); no locale; the same arrays on every machine.
 *
 * Wavefront OBJ, in one call:
 *
 *     e3d_obj obj;
 *     if (e3d_obj_parse(bytes, size, &obj) == E3D_OBJ_DONE)
 *         ... obj.positions, obj.faces ...
 *     e3d_obj_free(&obj);       (always, also after an error)
 *
 * or piece by piece, where somebody wants to watch: e3d_obj_begin, e3d_obj_read until nothing is left,
 * e3d_obj_end, e3d_obj_free. The bytes must stay until e3d_obj_end has returned.
 */
#ifndef E3D_LOADERS_H
#define E3D_LOADERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum e3d_obj_problem {
    E3D_OBJ_DONE,
    E3D_OBJ_NO_MEMORY,
    E3D_OBJ_TOO_LARGE,     /* 2^31 - 1 of anything, or 2^32 lines */
    E3D_OBJ_NO_VERTICES,   /* no `v` at all */
    E3D_OBJ_FEW_NUMBERS,   /* a `v`, `vt` or `vn` with `count` numbers */
    E3D_OBJ_NOT_A_NUMBER,  /* the word in a `v`, `vt` or `vn` */
    E3D_OBJ_NOT_AN_INDEX,  /* the word of a corner, in its part for the list */
    E3D_OBJ_NO_INDEX,      /* a corner without a vertex */
    E3D_OBJ_MANY_INDICES,  /* a corner with more than three parts */
    E3D_OBJ_OUT_OF_RANGE,  /* a corner with a vertex beyond the `count` that there are */
} e3d_obj_problem;

typedef enum e3d_obj_list { E3D_OBJ_V, E3D_OBJ_VT, E3D_OBJ_VN, E3D_OBJ_LISTS } e3d_obj_list;

/* Where something stands: the line, from 1, and a word that `names` holds. */
typedef struct e3d_obj_place {
    size_t line, word, word_length;
} e3d_obj_place;

typedef struct e3d_obj_error {
    e3d_obj_problem problem;
    e3d_obj_list list;
    size_t count;
    e3d_obj_place place;
} e3d_obj_error;

/* How often something was left out, and where first. */
typedef struct e3d_obj_note {
    size_t count;
    e3d_obj_place first;
} e3d_obj_note;

/* Faces (`f`, `fo`), lines (`l`) or points (`p`) in the order of the file. */
typedef struct e3d_obj_elements {
    int32_t *sizes;     /* [count] corners of each, also 0 */
    int32_t *indices[E3D_OBJ_LISTS]; /* [corners] from 0; -1 for none; VT, VN: NULL if no corner has any */
    size_t count, corners;
    bool are_triangles; /* each has three corners; true if there are none */
    e3d_obj_note small; /* those of fewer than three corners */
    e3d_obj_note outside[E3D_OBJ_LISTS]; /* VT, VN: corners whose index was out of range: now -1 */
} e3d_obj_elements;

typedef enum e3d_obj_setter_kind {
    E3D_OBJ_OBJECT,    /* o */
    E3D_OBJ_GROUP,     /* g */
    E3D_OBJ_SMOOTHING, /* s: `value`, 0 for off; -1, and the name, for what is no number */
    E3D_OBJ_MATERIAL,  /* usemtl */
    E3D_OBJ_LIBRARY,   /* mtllib */
    E3D_OBJ_UNKNOWN,   /* anything else: the name is the keyword */
} e3d_obj_setter_kind;

/* A statement that sets something for the elements behind it. */
typedef struct e3d_obj_setter {
    uint32_t kind;
    uint32_t line;                 /* from 1 */
    uint32_t faces, lines, points; /* how many stand before it */
    uint32_t name, name_length;    /* what follows the keyword, without the blanks around: in `names` */
    int32_t value;
} e3d_obj_setter;

/* What a file holds. Arrays are NULL where they would be empty; whoever takes one over (and frees it with
 * free()) puts NULL in its place. */
typedef struct e3d_obj {
    double *positions; /* [3 * counts[V]] */
    double *uvs;       /* [2 * counts[VT]] zero where the file leaves one out */
    double *normals;   /* [3 * counts[VN]] */
    uint8_t *colors;   /* [4 * counts[V]] sRGB, white where a vertex has none; NULL if none has any */
    size_t counts[E3D_OBJ_LISTS];
    e3d_obj_elements faces, lines, points;
    e3d_obj_setter *setters;
    size_t setter_count;
    uint8_t *names;
    size_t name_bytes;
    e3d_obj_error error;
    size_t consumed; /* bytes read so far */
    struct e3d_obj_reader *reader;
} e3d_obj;

/* Returns the problem, which `obj->error` tells more of. Whatever it is, e3d_obj_free() frees all. */
e3d_obj_problem e3d_obj_parse(const uint8_t *bytes, size_t size, e3d_obj *obj);

/* Begins; false if memory is out. */
bool e3d_obj_begin(e3d_obj *obj, const uint8_t *bytes, size_t size);
/* Reads `bytes` more or less; returns whether there is more to read (false after an error, too). */
bool e3d_obj_read(e3d_obj *obj, size_t bytes);
/* Checks the indices, and fills in what `e3d_obj` says. */
e3d_obj_problem e3d_obj_end(e3d_obj *obj);
void e3d_obj_free(e3d_obj *obj);

/* Welds corners into vertices: one for each combination of indices that occurs, in the order of positions,
 * then uvs, then normals. Positions that no corner has get none.
 *
 * In:  for each corner an index below position_count, and uvs and normals from -1 on, or NULL.
 * Out: faces[corners], the vertex of each; and of each vertex the indices: of_*[corners] is room enough,
 *      NULL where the list is. Returns the number of vertices; SIZE_MAX if memory is out or a position is
 *      out of range. */
size_t e3d_weld_corners(const int32_t *positions, const int32_t *uvs, const int32_t *normals,
                        size_t corners, size_t position_count, int32_t *faces, int32_t *of_position,
                        int32_t *of_uv, int32_t *of_normal);

/* Sets used[i], of `total` zeros, to 1 for each index i below `total`, which is below 2^31. Returns how many it set. */
size_t e3d_mark_used(const int32_t *indices, size_t count, uint8_t *used, size_t total);

#define E3D_ROW_WORDS 8

/* Rows of words: `in_record` rows lie beside each other, `stride` bytes behind them the next. */
typedef struct e3d_rows {
    const uint8_t *bytes; /* of any alignment */
    size_t count;         /* rows, fewer than 2^31 */
    size_t width;         /* words a row, up to E3D_ROW_WORDS */
    size_t in_record, stride;
    bool are_floats;      /* -0 equals 0 */
} e3d_rows;

/* Numbers rows, equal ones alike, in the order of their first appearance.
 *
 * Out: numbers[count]; first[count]: the first row of each number, or NULL; *found: the first rows themselves,
 *      to be freed with free(), unless it is NULL. Returns how many numbers there are; SIZE_MAX, and nothing to
 *      free, if memory is out. */
size_t e3d_number_rows(const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t **found);

/* The same piece by piece: begin, for rows of so many words of which so many are expected (NULL if memory is out);
 * add; take the first rows, which are to be freed with free(); free. Adding continues the numbers; `first` counts
 * from the first row of all; false if memory is out. Taking returns how many numbers there are. */
typedef struct e3d_row_numbers e3d_row_numbers;
e3d_row_numbers *e3d_row_numbers_begin(size_t width, bool are_floats, size_t expected);
bool e3d_row_numbers_add(e3d_row_numbers *taken, const e3d_rows *rows, int32_t *numbers, int32_t *first);
size_t e3d_row_numbers_take(e3d_row_numbers *taken, uint32_t **found);
void e3d_row_numbers_free(e3d_row_numbers *taken);

/* Whether any two rows are equal, of one in each record: 1 or 0; -1 if memory is out. Faster than numbering where none
 * are. */
int e3d_rows_repeat(const e3d_rows *rows);

typedef enum e3d_sums_problem {
    E3D_SUMS_DONE,
    E3D_SUMS_NO_MEMORY,
    E3D_SUMS_OUT_OF_RANGE, /* an index of a position or of a group */
} e3d_sums_problem;

/* Triangles whose corners are in groups. */
typedef struct e3d_surface {
    const void *positions; /* [3 * position_count] doubles or floats */
    bool are_doubles;
    const int32_t *faces, *groups; /* [3 * face_count] of each corner its position and its group */
    size_t position_count, face_count, group_count;
} e3d_surface;

/* Adds to sums[3 * group_count] the unit normals of all triangles, times the angle at the corner that is in
 * the group; `block_faces` triangles are added up at a time, and their sums to the others. */
e3d_sums_problem e3d_smooth_sums(const e3d_surface *surface, size_t block_faces, double *sums);

/* The sides of triangles: side k of a face is from its vertex k to the next one. */
typedef struct e3d_sides {
    const int32_t *faces;  /* [3 * face_count] */
    const int32_t *points; /* of each vertex the point that it is, less than point_count; NULL: each is its own */
    const uint8_t *wanted; /* [3 * face_count]; NULL: all are */
    size_t face_count, point_count;
} e3d_sides;

/* Marks each side that is the first between its two points, of those that are wanted and join two. first[3 * face_count] is
 * zeros to begin with. False if memory is out; fewer than 2^32 sides. */
bool e3d_find_edges(const e3d_sides *sides, uint8_t *first);

typedef enum e3d_cut_problem {
    E3D_CUT_DONE,
    E3D_CUT_NO_MEMORY,
    E3D_CUT_OUT_OF_RANGE, /* an index of a position, a size, or the number of all corners */
} e3d_cut_problem;

/* Polygons, whose corners stand one behind another. */
typedef struct e3d_polygons {
    const int32_t *sizes;   /* [count] corners of each; those of fewer than three give no triangle */
    const int32_t *indices; /* [corner_count] of each corner its position; NULL if it has the corner's number */
    const void *positions;  /* [3 * position_count] doubles or floats */
    bool are_doubles;
    size_t count, corner_count, position_count;
} e3d_polygons;

/* n - 2 triangles for a polygon of n corners. */
typedef struct e3d_cut {
    int32_t *corners;  /* [3 * triangles] corner numbers, counted over all polygons */
    int32_t *polygons; /* [triangles] the polygon that each is part of */
    uint8_t *visible;  /* [3 * triangles] whether the edge behind a corner is the polygon's */
    bool all_visible;
    bool is_complete;  /* false if concave polygons were cut as fans, since no tests were left or they are too large */
} e3d_cut;

/* Cuts polygons into triangles; what is tested to find the ears of concave ones is taken from *tests. */
e3d_cut_problem e3d_cut_polygons(const e3d_polygons *polygons, int64_t *tests, e3d_cut *made);

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

/* Texts whose last byte is a blank or ends a line, as LF, CR or both do. */

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

/* The numbers of a text, and of its rows: the lines that hold any. */
typedef struct e3d_numbers {
    double *values;  /* [count] */
    int64_t *widths; /* [rows] how many numbers each holds; NULL if nobody asked */
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

/* What lines of some form look like, and what is kept of them. A pattern stands for itself, but for
 *
 *     %  a number, which a blank or the end of the line follows
 *     @  likewise, and a whole one, below the number of rows of the first form
 *     ?  likewise, 0 or 1
 *     #  a whole number: how many rows of this form came before
 *     _  blanks, or none
 *     (a blank)  one at least, or the end of the line
 *     |  what follows may be missing, all of it
 *
 * Whole numbers have no zeros in front. */
typedef enum e3d_form_kind {
    E3D_FORM_ROW,     /* the numbers for %, @ and ? are kept; nothing stands behind them */
    E3D_FORM_MARK,    /* the place is */
    E3D_FORM_SKIPPED, /* nothing is */
} e3d_form_kind;

typedef struct e3d_form {
    const char *pattern;
    e3d_form_kind kind;
    size_t width;   /* of a row: its numbers; up to E3D_FORM_WIDTH */
    size_t most;    /* of rows: a further one has another form */
    double missing; /* for what is missing behind | */
    size_t of;      /* of a mark: the form whose rows before it are counted */
} e3d_form;

#define E3D_FORM_WIDTH 8

typedef struct e3d_mark {
    size_t form, rows, start, end; /* the bytes behind the pattern */
} e3d_mark;

typedef struct e3d_form_rows {
    double *values;      /* [rows * width] */
    size_t rows, whole; /* those that lack nothing */
    size_t room;
} e3d_form_rows;

/* What was read of a text whose lines are of some forms. */
typedef struct e3d_form_text {
    const e3d_form *forms;
    size_t form_count;
    bool any_case;       /* letters of patterns, which are small ones, stand for capitals too */
    e3d_form_rows *rows; /* [form_count] zeros, to begin with */
    e3d_mark *marks;     /* NULL, to begin with */
    size_t mark_count, mark_room;
} e3d_form_text;

/* Reads lines from *place on until one has none of the forms, or all; puts its place there. False if memory is
 * out. Whoever begins frees rows[].values and marks. */
bool e3d_read_forms(e3d_form_text *text, const uint8_t *bytes, size_t size, size_t *place);
/* Adds a row; false if memory is out. */
bool e3d_add_form_row(e3d_form_text *text, size_t form, const double *numbers, bool is_whole);

#endif
