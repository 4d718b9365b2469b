/* Texts of nothing but numbers and comments: the bodies of PLY and OFF files.
 *
 * In:  bytes, the last of which is a blank or ends a line. Out: all numbers, and how many each line holds.
 * Always: lines end in LF, CR or both; those without a number count for nothing.
 */
#include "e3d_numbers.h"

#include "base/large_pages.h"
#include "number_text.h"

#include <stdlib.h>
#include <string.h>

#define BLOCK 128 /* bytes, few enough that a byte can count their words */

/* Counts words; the text has no more numbers than these. */
static size_t count_words(const uint8_t *bytes, size_t size)
{
    size_t words = 0;
    for (size_t start = 0; start + 1 < size; start += BLOCK) {
        const size_t left = size - 1 - start, length = left < BLOCK ? left : BLOCK;
        const uint8_t *const at = bytes + start;
        uint8_t ends = 0;
        for (size_t i = 0; i < length; i++) {
            const uint8_t byte = at[i], next = at[i + 1];
            ends += ((byte != ' ') & ((uint8_t)(byte - '\t') > 4)) & ((next == ' ') | ((uint8_t)(next - '\t') <= 4));
            ends += byte == '#';
        }
        words += ends;
    }
    return words + 1;
}

static bool begins_with(const uint8_t *at, const uint8_t *end, const char *word)
{
    const size_t length = strlen(word);
    if ((size_t)(end - at) <= length || memcmp(at, word, length) != 0)
        return false;
    const uint8_t next = at[length], letter = next | 0x20;
    return !(e3d_is_digit(next) || next == '_' || (letter >= 'a' && letter <= 'z'));
}

static bool is_comment(const uint8_t *at, const uint8_t *end, e3d_comments comments)
{
    if (comments == E3D_HASH_COMMENTS)
        return *at == '#';
    return comments == E3D_PLY_COMMENTS && (*at == 'c' || *at == 'o') &&
           (begins_with(at, end, "comment") || begins_with(at, end, "obj_info"));
}

/* Reads one line and adds its numbers. Returns its end, or the word that is no number, with *is_sound false. */
static const uint8_t *read_line(const uint8_t *at, const uint8_t *end, e3d_comments comments, e3d_numbers *found,
                                bool *is_sound)
{
    const uint8_t sign = comments == E3D_HASH_COMMENTS ? '#' : ' ';
    at = e3d_skip_blanks(at, end);
    if (at < end && is_comment(at, end, comments))
        return e3d_line_end(at, end);
    while (at < end && !e3d_ends_line(*at)) {
        if (*at == '#' && sign == '#')
            return e3d_line_end(at, end);
        const uint8_t *const next = e3d_read_number(at, sign, &found->values[found->count]);
        if (!next) {
            *is_sound = false;
            return at;
        }
        found->count++;
        at = e3d_skip_blanks(next, end);
    }
    return at;
}

/* Makes room for the widths of as many lines as the text can hold. */
static size_t count_lines(const uint8_t *bytes, size_t size, size_t most)
{
    size_t lines = 0;
    for (size_t i = 0; i < size; i++)
        lines += e3d_ends_line(bytes[i]);
    return lines + 1 < most ? lines + 1 : most;
}

static void *room_for(size_t count, size_t size)
{
    const size_t bytes = (count ? count : 1) * size;
    return bytes >= E3D_LARGE_ROOM ? e3d_large_memory(bytes) : malloc(bytes);
}

e3d_numbers_problem e3d_read_numbers(const uint8_t *bytes, size_t size, e3d_comments comments, size_t most_rows,
                                     bool with_widths, e3d_numbers *found)
{
    const uint8_t *at = bytes, *const end = bytes + size;
    *found = (e3d_numbers){.values = room_for(count_words(bytes, size), sizeof(double))};
    if (with_widths)
        found->widths = room_for(count_lines(bytes, size, most_rows), sizeof(int64_t));
    if (!found->values || (with_widths && !found->widths))
        return E3D_NUMBERS_NO_MEMORY;
    bool is_sound = true;
    while (at < end && found->rows < most_rows) {
        const size_t before = found->count;
        at = read_line(at, end, comments, found, &is_sound);
        if (!is_sound)
            break;
        if (found->count > before) {
            if (with_widths)
                found->widths[found->rows] = (int64_t)(found->count - before);
            found->rows++;
        }
        at += at < end;
    }
    found->place = (size_t)(at - bytes);
    return is_sound ? E3D_NUMBERS_DONE : E3D_NUMBERS_NOT_A_NUMBER;
}

void e3d_numbers_free(e3d_numbers *found)
{
    free(found->values);
    free(found->widths);
    *found = (e3d_numbers){0};
}
