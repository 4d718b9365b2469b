/* Lines of an OBJ file: see obj_lines.h. A '\' at the end of a line continues it; but not in a comment (it may end a path),
 * nor as the second byte of a two-byte character. A '#' begins a comment where a word would begin. In statements of numbers
 * it does so within a word, too, except in numbers such as 1.#QNAN; names may hold one. */
#include "obj_lines.h"

#include <string.h>

typedef uint8_t bytes16 __attribute__((vector_size(16)));

void obj_lines_begin(obj_lines *lines, const uint8_t *bytes, size_t size)
{
    static const uint8_t mark[3] = {0xEF, 0xBB, 0xBF};
    *lines = (obj_lines){.number = 1};
    if (size == 0)
        return;
    lines->next = bytes;
    lines->end = bytes + size;
    if (size >= sizeof mark && memcmp(bytes, mark, sizeof mark) == 0)
        lines->next += sizeof mark;
}

static bool is_special(uint8_t byte)
{
    return byte == '\n' || byte == '\r' || byte == '#' || byte == '\\';
}

/* Finds the first byte that ends a line or needs a closer look. */
static const uint8_t *find_special(const uint8_t *at, const uint8_t *end)
{
    for (; end - at >= 16; at += 16) {
        bytes16 bytes;
        memcpy(&bytes, at, sizeof bytes);
        bytes = (bytes16)((bytes == '\n') | (bytes == '\r') | (bytes == '#') | (bytes == '\\'));
        uint64_t half[2];
        memcpy(half, &bytes, sizeof half);
        if (half[0] | half[1])
            break;
    }
    while (at < end && !is_special(*at))
        at++;
    return at;
}

static const uint8_t *find_line_end(const uint8_t *at, const uint8_t *end)
{
    while (at < end && *at != '\n' && *at != '\r')
        at++;
    return at;
}

static const uint8_t *behind_line_end(const uint8_t *at, const uint8_t *end)
{
    if (at == end)
        return at;
    return at + (at[0] == '\r' && end - at > 1 && at[1] == '\n' ? 2 : 1);
}

/* Finds the comment of a joined line, or the end of the line. */
static const uint8_t *find_comment(const uint8_t *start, const uint8_t *end)
{
    const uint8_t *sign = memchr(start, '#', (size_t)(end - start));
    if (!sign)
        return end;
    const uint8_t *first = obj_skip_gaps(start, end);
    const bool has_numbers = memchr("vflps", *first, 5) != NULL;
    if (sign == start || e3d_is_gap(sign[-1]) || (has_numbers && sign[-1] != '.'))
        return sign;
    for (sign++; sign < end; sign++)
        if (*sign == '#' && e3d_is_gap(sign[-1]))
            return sign;
    return end;
}

static bool append(e3d_array *scratch, const uint8_t *bytes, size_t size)
{
    /* Room for the byte that ends the line, too. */
    if (!e3d_array_reserve(scratch, scratch->count + size + 1, 1))
        return false;
    memcpy((uint8_t *)scratch->data + scratch->count, bytes, size);
    scratch->count += size;
    return true;
}

/* The length of the UTF-8 character that begins with a byte beyond ASCII; 0 if none does. */
static size_t utf8_length(uint8_t byte)
{
    if (byte >= 0xF0)
        return byte < 0xF5 ? 4 : 0;
    if (byte >= 0xE0)
        return 3;
    return byte >= 0xC2 ? 2 : 0;
}

/* Whether the byte at `at` is the second one of a character: in Shift-JIS, GBK and Big5 that may be a '\'. The bytes beyond
 * ASCII before it are then not UTF-8. */
static bool ends_character(const uint8_t *start, const uint8_t *at)
{
    const uint8_t *first = at;
    while (first > start && first[-1] >= 0x80)
        first--;
    while (first < at) {
        const size_t length = utf8_length(*first);
        if (length == 0 || (size_t)(at - first) < length)
            return true;
        for (size_t i = 1; i < length; i++)
            if ((first[i] & 0xC0) != 0x80)
                return true;
        first += length;
    }
    return false;
}

/* Copies a line, and the lines that continue it, to `scratch`. */
static obj_step join_line(obj_lines *lines, obj_line *line)
{
    e3d_array *scratch = &lines->scratch;
    scratch->count = 0;
    bool is_empty = true, continues;
    do {
        const uint8_t *start = lines->next, *end = find_line_end(start, lines->end);
        const uint8_t *first = obj_skip_gaps(start, end), *last = end;
        lines->next = behind_line_end(end, lines->end);
        while (last > start && (last[-1] == ' ' || last[-1] == '\t'))
            last--;
        continues = last > start && last[-1] == '\\' && *first != '#' && !ends_character(start, last - 1);
        if (continues)
            end = last - 1;
        if (is_empty)
            line->number = lines->number;
        is_empty = is_empty && first >= end;
        if (!append(scratch, start, (size_t)(end - start)) ||
            (continues && !append(scratch, (const uint8_t *)" ", 1)))
            return OBJ_LINES_NO_MEMORY;
        lines->number++;
    } while (continues && lines->next < lines->end);
    uint8_t *bytes = scratch->data;
    line->at = bytes;
    line->end = find_comment(bytes, bytes + scratch->count);
    bytes[line->end - line->at] = '\n';
    return OBJ_LINE;
}

obj_step obj_next_line(obj_lines *lines, obj_line *line)
{
    if (lines->next == lines->end)
        return OBJ_NO_MORE_LINES;
    const uint8_t *special = find_special(lines->next, lines->end);
    if (special == lines->end || *special == '#' || *special == '\\')
        return join_line(lines, line);
    *line = (obj_line){lines->next, special, lines->number++};
    lines->next = behind_line_end(special, lines->end);
    return OBJ_LINE;
}
