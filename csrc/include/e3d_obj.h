/* Wavefront OBJ, in one call:
 *
 *     e3d_obj obj;
 *     if (e3d_obj_parse(bytes, size, &obj) == E3D_OBJ_DONE)
 *         ... obj.positions, obj.faces ...
 *     e3d_obj_free(&obj);       (always, also after an error)
 *
 * or piece by piece, where somebody wants to watch: e3d_obj_begin, e3d_obj_read until nothing is left,
 * e3d_obj_end, e3d_obj_free. The bytes must stay until e3d_obj_end has returned.
 */
#pragma once

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

typedef enum e3d_obj_list { E3D_OBJ_V,
                            E3D_OBJ_VT,
                            E3D_OBJ_VN,
                            E3D_OBJ_LISTS } e3d_obj_list;

/* Where a problem is: the line, from 1, and a word in `names`. */
typedef struct e3d_obj_place {
    size_t line, word, word_length;
} e3d_obj_place;

typedef struct e3d_obj_error {
    e3d_obj_problem problem;
    e3d_obj_list list;
    size_t count;
    e3d_obj_place place;
} e3d_obj_error;

/* How often something was left out, and where it was first. */
typedef struct e3d_obj_note {
    size_t count;
    e3d_obj_place first;
} e3d_obj_note;

/* Faces (`f`, `fo`), lines (`l`) or points (`p`) in the order of the file. */
typedef struct e3d_obj_elements {
    int32_t *sizes;     /* [count] the corners of each element, perhaps 0 */
    int32_t *indices[E3D_OBJ_LISTS]; /* [corners] from 0; -1 for none; VT, VN: NULL if no corner has any */
    size_t count, corners;
    bool are_triangles; /* all have three corners, or there are none */
    e3d_obj_note small; /* elements of fewer than three corners */
    e3d_obj_note outside[E3D_OBJ_LISTS]; /* VT, VN: corners whose index was out of range and became -1 */
} e3d_obj_elements;

typedef enum e3d_obj_setter_kind {
    E3D_OBJ_OBJECT,    /* o */
    E3D_OBJ_GROUP,     /* g */
    E3D_OBJ_SMOOTHING, /* s: `value`, 0 for off; -1 and the name if it is no number */
    E3D_OBJ_MATERIAL,  /* usemtl */
    E3D_OBJ_LIBRARY,   /* mtllib */
    E3D_OBJ_UNKNOWN,   /* anything else: the name is the keyword */
} e3d_obj_setter_kind;

/* A statement that changes the state for the elements behind it. */
typedef struct e3d_obj_setter {
    uint32_t kind;
    uint32_t line;                 /* from 1 */
    uint32_t faces, lines, points; /* how many elements stand before it */
    uint32_t name, name_length;    /* the rest of the line without blanks around it, in `names` */
    int32_t value;
} e3d_obj_setter;

/* The contents of a file. An array is NULL where it would be empty. Whoever takes one over puts NULL in its place, and frees it
 * with free(). */
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

/* Returns the problem; `obj->error` tells where it is. In any case e3d_obj_free() frees all. */
e3d_obj_problem e3d_obj_parse(const uint8_t *bytes, size_t size, e3d_obj *obj);

/* Begins; false if memory is out. */
bool e3d_obj_begin(e3d_obj *obj, const uint8_t *bytes, size_t size);
/* Reads about `bytes` more. Returns whether there is more to read; false after an error. */
bool e3d_obj_read(e3d_obj *obj, size_t bytes);
/* Checks the indices, and fills in the members of `e3d_obj`. */
e3d_obj_problem e3d_obj_end(e3d_obj *obj);
void e3d_obj_free(e3d_obj *obj);
