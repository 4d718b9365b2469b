/* Reads texts whose lines follow a few patterns. The last byte of a text is a blank or ends a line; LF, CR or both end a line. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The pattern of a line, and what reading it keeps. A character of a pattern stands for itself, but for these:
 * %  a number, with a blank or the end of the line behind it
 * @  the same, a whole number below the count of rows of the first form
 * ?  the same, 0 or 1
 * #  a whole number that equals the count of this form's rows so far
 * _  any number of blanks
 * (a blank)  at least one blank, or the end of the line
 * |  the rest of the pattern may be missing as a whole
 * Whole numbers have no leading zeros. */
typedef enum e3d_form_kind {
    E3D_FORM_ROW,     /* the numbers of %, @ and ? are kept; nothing may follow the pattern */
    E3D_FORM_MARK,    /* the position behind the pattern is kept */
    E3D_FORM_SKIPPED, /* nothing is kept */
} e3d_form_kind;

typedef struct e3d_form {
    const char *pattern;
    e3d_form_kind kind;
    size_t width;   /* ROW: how many numbers a row has, at most E3D_FORM_WIDTH */
    size_t most;    /* ROW: how many rows may be read; the next one is of another form */
    double missing; /* the number that stands for each one missing behind | */
    size_t of;      /* MARK: the form whose row count is kept with the mark */
} e3d_form;

#define E3D_FORM_WIDTH 8

typedef struct e3d_mark {
    size_t form, rows, start, end; /* start, end: where the bytes behind the pattern are */
} e3d_mark;

typedef struct e3d_form_rows {
    double *values;      /* [rows * width] */
    size_t rows, whole; /* how many rows there are, and how many of them have all their numbers */
    size_t room;
    size_t lines; /* how many lines were read, of whatever kind of form */
} e3d_form_rows;

/* The state of reading a text whose lines are of some forms. */
typedef struct e3d_form_text {
    const e3d_form *forms;
    size_t form_count;
    bool any_case;       /* lower-case letters of patterns match capitals, too */
    e3d_form_rows *rows; /* [form_count] zeros, to begin with */
    e3d_mark *marks;     /* NULL, to begin with */
    size_t mark_count, mark_room;
} e3d_form_text;

/* Reads lines from *place on, up to the first one that has none of the forms, and moves *place there. False if memory is out.
 * The caller frees rows[].values and marks. */
bool e3d_read_forms(e3d_form_text *text, const uint8_t *bytes, size_t size, size_t *place);
/* Adds a row; false if memory is out. */
bool e3d_add_form_row(e3d_form_text *text, size_t form, const double *numbers, bool is_whole);
