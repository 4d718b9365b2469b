/* The state of reading an OBJ file, and the functions that do it. obj.c takes line after line; obj_rows.c reads lists of
 * numbers, obj_corners.c faces, lines and points; at the end obj_check.c checks what needs all lists; obj_errors.c keeps
 * errors. */
#pragma once

#include "e3d_obj.h"
#include "obj_lines.h"

/* The most items that int32_t can number. */
#define OBJ_MOST INT32_MAX
/* An index that is 0, or negative and too large. A positive one beyond all lists becomes OBJ_MOST. */
#define OBJ_OUTSIDE (-2)
#define OBJ_NONE (-1)

typedef struct obj_elements {
    e3d_array sizes, indices[E3D_OBJ_LISTS];
    size_t corners;
    int32_t largest[E3D_OBJ_LISTS];
    bool has_outside[E3D_OBJ_LISTS];
    bool has_others; /* than triangles */
    e3d_obj_note small;
} obj_elements;

struct e3d_obj_reader {
    const uint8_t *bytes;
    size_t size;
    obj_lines lines;
    e3d_array rows[E3D_OBJ_LISTS]; /* doubles: 3, 2, 3 a row */
    e3d_array colors;              /* 4 doubles a vertex, once any vertex has a colour: see obj_rows.c */
    obj_elements elements[OBJ_ELEMENT_KINDS];
    e3d_array setters, names;
};

/* All return false after putting an error into `obj`. */
bool obj_read_row(e3d_obj *obj, e3d_obj_list list, const obj_line *line);
bool obj_read_corners(e3d_obj *obj, obj_element_kind kind, const obj_line *line);
bool obj_check(e3d_obj *obj, obj_element_kind kind, e3d_obj_elements *elements);
bool obj_convert_colors(e3d_obj *obj);

/* Copies a word to `names`; *start is its place there. */
bool obj_keep_name(e3d_obj *obj, const uint8_t *word, const uint8_t *end, size_t *start);
/* Sets an error; always returns false. */
bool obj_fail(e3d_obj *obj, e3d_obj_problem problem);
bool obj_fail_at(e3d_obj *obj, e3d_obj_error error, const uint8_t *word, const uint8_t *end);
