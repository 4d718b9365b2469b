/* Words and numbers of a text whose last byte is a blank or ends a line, so that reading a number needs no test for the end
 * of the text. */
#pragma once

#include "decimal.h"

/* Whether a byte is a blank or ends a line. */
static inline bool e3d_is_gap(uint8_t byte) { return byte <= ' ' && (UINT64_C(0x100003E00) >> byte & 1); }

static inline bool e3d_ends_line(uint8_t byte) { return byte == '\n' || byte == '\r'; }

/* Skips the blanks of a line. */
static inline const uint8_t *e3d_skip_blanks(const uint8_t *at, const uint8_t *end)
{
    while (at < end && e3d_is_gap(*at) && !e3d_ends_line(*at))
        at++;
    return at;
}

static inline const uint8_t *e3d_line_end(const uint8_t *at, const uint8_t *end)
{
    while (at < end && !e3d_ends_line(*at))
        at++;
    return at;
}

/* Reads a number that a gap or `other` ends (`other` is a gap if there is none); returns what follows it, or NULL if there is
 * no such number. */
static inline const uint8_t *e3d_read_number(const uint8_t *at, uint8_t other, double *value)
{
    const uint8_t *last = e3d_decimal_read(at, value);
    if (last && (e3d_is_gap(*last) || *last == other))
        return last;
    for (last = at; !e3d_is_gap(*last) && *last != other;)
        last++;
    return e3d_decimal_word(at, (size_t)(last - at), value) ? last : NULL;
}
