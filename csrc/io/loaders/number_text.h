/* Words and numbers of a text whose last byte is a blank or ends a line, so that no number has to ask where the text
 * ends.
 */
#ifndef E3D_NUMBER_TEXT_H
#define E3D_NUMBER_TEXT_H

#include "decimal.h"

/* Whether a byte is a blank or ends a line. */
static inline bool e3d_is_gap(uint8_t byte) { return byte <= ' ' && (UINT64_C(0x100003E00) >> byte & 1); }

static inline bool e3d_ends_line(uint8_t byte) { return byte == '\n' || byte == '\r'; }

/* Returns what stands behind the blanks of a line. */
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

/* Returns what stands behind a number that a gap ends, or `other` (a gap, if there is none); NULL if there is no
 * such number. */
static inline const uint8_t *e3d_read_number(const uint8_t *at, uint8_t other, double *value)
{
    const uint8_t *last = e3d_decimal_read(at, value);
    if (last && (e3d_is_gap(*last) || *last == other))
        return last;
    for (last = at; !e3d_is_gap(*last) && *last != other;)
        last++;
    return e3d_decimal_word(at, (size_t)(last - at), value) ? last : NULL;
}

#endif
