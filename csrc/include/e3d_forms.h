/* Texts whose lines have some form. The last byte of a text is a blank or ends a line, as LF, CR or both do. */
#ifndef E3D_FORMS_H
#define E3D_FORMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
    size_t lines; /* that were read, of whatever kind the form is */
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
