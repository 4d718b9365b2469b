/* The rows of a binary PLY body: where their lists stand, and the numbers in them.
 *
 * In:  bytes, and what a header says of a row. Out: places of rows and lists; the items of lists, one
 *      behind another, in this machine's byte order.
 * Always: e3d_ply_walk() reads nothing outside the bytes, whatever the lengths of lists say; what copies
 *      believes the places that it found.
 */
#include "base/always_inline.h"
#include "e3d_ply.h"

#include <string.h>

#define IS_BIG_ENDIAN_HERE (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)

static inline uint64_t read_integer(const uint8_t *bytes, size_t size, bool is_big_endian)
{
    uint64_t integer = 0;
    for (size_t k = 0; k < size; k++)
        integer |= (uint64_t)bytes[is_big_endian ? size - 1 - k : k] << 8 * k;
    return integer;
}

/* Reads the length of a list; false if it is negative. */
static inline bool read_length(const uint8_t *bytes, const e3d_ply_list *list, bool is_big_endian,
                               uint64_t *length)
{
    *length = read_integer(bytes, list->count_size, is_big_endian);
    return !(list->is_signed && *length >> (8 * list->count_size - 1));
}

e3d_ply_problem e3d_ply_walk(const e3d_ply_body *body, const e3d_ply_list *lists, size_t list_count,
                             size_t tail, size_t rows, e3d_ply_rows *found)
{
    size_t place = body->start;
    for (size_t row = 0; row < rows; row++) {
        found->places[row] = (int64_t)place;
        found->row = row;
        for (size_t k = 0; k < list_count; k++) {
            const e3d_ply_list *const list = &lists[k];
            uint64_t length;
            if (body->end - place < list->skip + list->count_size)
                return E3D_PLY_SHORT;
            place += list->skip;
            found->end = place;
            if (!read_length(body->bytes + place, list, body->is_big_endian, &length))
                return E3D_PLY_BAD_LIST;
            place += list->count_size;
            if (length > (body->end - place) / list->item_size)
                return E3D_PLY_SHORT;
            found->starts[row * list_count + k] = (int64_t)place;
            found->sizes[row * list_count + k] = (int64_t)length;
            place += (size_t)length * list->item_size;
        }
        if (body->end - place < tail)
            return E3D_PLY_SHORT;
        place += tail;
    }
    found->end = place;
    return E3D_PLY_DONE;
}

bool e3d_ply_lengths_are(const e3d_ply_body *body, size_t stride, size_t rows, size_t count_size, uint64_t length)
{
    const uint8_t *at = body->bytes + body->start;
    uint64_t differs = 0;
    if (count_size == 1)
        for (size_t row = 0; row < rows; row++)
            differs |= at[row * stride] ^ length;
    else
        for (size_t row = 0; row < rows; row++)
            differs |= read_integer(at + row * stride, count_size, body->is_big_endian) ^ length;
    return !differs;
}

/* Inlined for sizes that are constants. */
static inline void copy_items(const uint8_t *from, size_t count, size_t size, bool is_swapped,
                              uint8_t *to)
{
    if (!is_swapped || size == 1) {
        memcpy(to, from, count * size);
        return;
    }
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < size; k++)
            to[i * size + k] = from[i * size + size - 1 - k];
}

static bool is_swapped(const e3d_ply_body *body) { return body->is_big_endian != IS_BIG_ENDIAN_HERE; }

void e3d_ply_copy_lists(const e3d_ply_body *body, const int64_t *starts, const int64_t *sizes,
                        size_t step, size_t rows, size_t item_size, void *items)
{
    const bool swap = is_swapped(body);
    uint8_t *to = items;
    for (size_t row = 0; row < rows; row++) {
        const uint8_t *const from = body->bytes + starts[row * step];
        const size_t count = (size_t)sizes[row * step];
        if (item_size == 4)
            copy_items(from, count, 4, swap, to);
        else
            copy_items(from, count, item_size, swap, to);
        to += count * item_size;
    }
}

void e3d_ply_copy_rows(const e3d_ply_body *body, size_t stride, size_t rows, size_t width,
                       size_t item_size, void *items)
{
    const bool swap = is_swapped(body);
    const uint8_t *from = body->bytes + body->start;
    uint8_t *to = items;
    for (size_t row = 0; row < rows; row++) {
        if (width == 3 && item_size == 4)
            copy_items(from, 3, 4, swap, to);
        else
            copy_items(from, width, item_size, swap, to);
        from += stride;
        to += width * item_size;
    }
}

/* Inlined for sizes that are constants. */
static ALWAYS_INLINE bool copy_even(const uint8_t *from, size_t rows, size_t count_size, uint64_t length,
                                    size_t item_size, bool is_big_endian, uint8_t *to)
{
    const size_t bytes = (size_t)length * item_size;
    const bool swap = is_big_endian != IS_BIG_ENDIAN_HERE;
    uint64_t differs = 0;
    for (size_t row = 0; row < rows; row++, from += count_size + bytes) {
        differs |= read_integer(from, count_size, is_big_endian) ^ length;
        if (!length) /* there may be nothing to copy to */
            continue;
        copy_items(from + count_size, (size_t)length, item_size, swap, to);
        to += bytes;
    }
    return !differs;
}

bool e3d_ply_copy_even_lists(const e3d_ply_body *body, size_t rows, size_t count_size, uint64_t length,
                             size_t item_size, void *items)
{
    const uint8_t *const from = body->bytes + body->start;
    const bool is_big_endian = body->is_big_endian;
    if (count_size == 1 && length == 3 && item_size == 4)
        return is_swapped(body) ? copy_even(from, rows, 1, 3, 4, is_big_endian, items)
                                : copy_even(from, rows, 1, 3, 4, IS_BIG_ENDIAN_HERE, items);
    return copy_even(from, rows, count_size, length, item_size, is_big_endian, items);
}
