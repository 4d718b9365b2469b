/* Rows of numbers as lines of text.
 * In: arrays of numbers, and the text between them. Out: bytes, and where lines end. */
#include "e3d_writers.h"

#include <string.h>

/* Copies a few bytes, most often one. */
static inline uint8_t *put(uint8_t *at, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        at[i] = bytes[i];
    return at + count;
}

size_t e3d_write_float_rows(const float *numbers, size_t rows, size_t width,
                            const uint8_t *const *between, const size_t *lengths, uint8_t *text)
{
    uint8_t *at = text;
    for (size_t row = 0; row < rows; row++) {
        for (size_t k = 0; k < width; k++) {
            at = put(at, between[k], lengths[k]);
            at += e3d_write_float(numbers[row * width + k], at);
        }
        at = put(at, between[width], lengths[width]);
    }
    return (size_t)(at - text);
}

static inline uint8_t *put_integer(uint8_t *at, int32_t number)
{
    uint8_t letters[E3D_INTEGER_LETTERS];
    size_t first = sizeof letters;
    uint32_t rest = number < 0 ? 0u - (uint32_t)number : (uint32_t)number;
    do {
        letters[--first] = (uint8_t)('0' + rest % 10);
        rest /= 10;
    } while (rest);
    if (number < 0)
        *at++ = '-';
    return put(at, letters + first, sizeof letters - first);
}

size_t e3d_write_faces(const int32_t *sizes, size_t faces, const int32_t *positions,
                       const int32_t *others, e3d_corner_form form, uint8_t *text, int64_t *ends)
{
    uint8_t *at = text;
    size_t corner = 0;
    for (size_t face = 0; face < faces; face++) {
        *at++ = 'f';
        for (int32_t k = 0; k < sizes[face]; k++, corner++) {
            *at++ = ' ';
            at = put_integer(at, positions[corner]);
            if (form == E3D_CORNER_V)
                continue;
            const uint8_t *const start = at;
            *at++ = '/';
            if (form == E3D_CORNER_V_VN)
                *at++ = '/';
            at = put_integer(at, others[corner]);
            if (form == E3D_CORNER_V_VT_VN)
                at = put(at, start, (size_t)(at - start));
        }
        *at++ = '\n';
        ends[face] = at - text;
    }
    return (size_t)(at - text);
}
