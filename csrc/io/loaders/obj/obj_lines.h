/* The lines of an OBJ file, as its statements see them: continued ones joined, without comments.
 *
 * In:  bytes. Out: line after line; each ends with a readable byte that is a line feed or a carriage
 *      return, so that numbers need not ask where the line ends.
 * Always: a plain line is given where it stands. A '\' or a '#', and a last line that nothing ends, are
 *      copied to `scratch`, which holds one line at a time.
 */
#pragma once

#include "base/grow.h"
#include "io/loaders/number_text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct obj_lines {
    const uint8_t *next, *end;
    size_t number; /* the number of the line at `next`, from 1 */
    e3d_array scratch;
} obj_lines;

typedef struct obj_line {
    const uint8_t *at, *end;
    size_t number; /* the number of the line that holds its first word */
} obj_line;

typedef enum obj_step { OBJ_LINE,
                        OBJ_NO_MORE_LINES,
                        OBJ_LINES_NO_MEMORY } obj_step;

typedef enum obj_element_kind { OBJ_FACES,
                                OBJ_LINES,
                                OBJ_POINTS,
                                OBJ_ELEMENT_KINDS } obj_element_kind;

void obj_lines_begin(obj_lines *lines, const uint8_t *bytes, size_t size);
obj_step obj_next_line(obj_lines *lines, obj_line *line);

static inline const uint8_t *obj_skip_gaps(const uint8_t *at, const uint8_t *end)
{
    while (at < end && e3d_is_gap(*at))
        at++;
    return at;
}

static inline const uint8_t *obj_word_end(const uint8_t *at, const uint8_t *end)
{
    while (at < end && !e3d_is_gap(*at))
        at++;
    return at;
}

/* Whether a line, behind its blanks, begins with a keyword of two letters, or of one if `second` is 0. */
static inline bool obj_begins(const obj_line *line, char first, char second)
{
    const uint8_t *at = line->at;
    return at[0] == (uint8_t)first && (second ? at[1] == (uint8_t)second && e3d_is_gap(at[2])
                                              : e3d_is_gap(at[1]));
}

/* The kind of elements on a line, with line->at moved behind the keyword; OBJ_ELEMENT_KINDS for none. */
static inline obj_element_kind obj_elements_of(obj_line *line)
{
    line->at = obj_skip_gaps(line->at, line->end);
    if (line->at == line->end)
        return OBJ_ELEMENT_KINDS;
    obj_element_kind kind = OBJ_ELEMENT_KINDS;
    if (obj_begins(line, 'f', 0) || obj_begins(line, 'f', 'o'))
        kind = OBJ_FACES;
    else if (obj_begins(line, 'l', 0))
        kind = OBJ_LINES;
    else if (obj_begins(line, 'p', 0))
        kind = OBJ_POINTS;
    if (kind != OBJ_ELEMENT_KINDS)
        line->at = obj_word_end(line->at, line->end);
    return kind;
}
