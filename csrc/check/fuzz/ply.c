/* Fuzzes the walk along the rows of a binary PLY body, and the copying of the numbers in them.
 *
 * In:  a byte each: byte order, lists in a row, bytes behind them, rows; three bytes a list; then the body.
 * Claims: a walk that cannot overflow finds the same; lists of one length are told from others; copies are the
 *      body's bytes, in this machine's order.
 */
#include "e3d_ply.h"
#include "check/fuzz/input.h"

enum { MOST_LISTS = 3 };

typedef struct element {
    e3d_ply_body body;
    e3d_ply_list lists[MOST_LISTS];
    size_t list_count, tail, rows;
} element;

typedef unsigned __int128 wide;

static wide integer_at(const element *e, size_t size, size_t place)
{
    wide integer = 0;
    for (size_t k = 0; k < size; k++)
        integer = integer << 8 | e->body.bytes[place + (e->body.is_big_endian ? k : size - 1 - k)];
    return integer;
}

/* Walks as far as the rows are sound, and claims that what was found is that. */
static void claim_walk(const element *e, e3d_ply_problem problem, const e3d_ply_rows *found)
{
    const wide end = e->body.end;
    wide place = e->body.start;
    for (size_t row = 0; row < e->rows; row++) {
        CLAIM(found->places[row] == (int64_t)place);
        for (size_t k = 0; k < e->list_count; k++) {
            const e3d_ply_list *const list = &e->lists[k];
            place += list->skip;
            if (place + list->count_size > end) {
                CLAIM(problem == E3D_PLY_SHORT);
                return;
            }
            const wide length = integer_at(e, list->count_size, (size_t)place);
            if (list->is_signed && length >> (8 * list->count_size - 1)) {
                CLAIM(problem == E3D_PLY_BAD_LIST && found->row == row && found->end == place);
                return;
            }
            place += list->count_size;
            if (place + length * list->item_size > end) {
                CLAIM(problem == E3D_PLY_SHORT);
                return;
            }
            CLAIM(found->starts[row * e->list_count + k] == (int64_t)place);
            CLAIM(found->sizes[row * e->list_count + k] == (int64_t)length);
            place += length * list->item_size;
        }
        place += e->tail;
        if (place > end) {
            CLAIM(problem == E3D_PLY_SHORT);
            return;
        }
    }
    CLAIM(problem == E3D_PLY_DONE && found->end == place);
}

/* Claims that the items at `from` were copied; returns what stands behind the copies. */
static const uint8_t *claim_items(const element *e, const uint8_t *from, size_t count, size_t size,
                                  const uint8_t *copied)
{
    const int swapped = e->body.is_big_endian != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    for (size_t i = 0; i < count * size; i++)
        CLAIM(copied[i] == from[swapped ? i / size * size + size - 1 - i % size : i]);
    return copied + count * size;
}

static void claim_lists(const element *e, size_t k, const e3d_ply_rows *found)
{
    const size_t step = e->list_count, size = e->lists[k].item_size;
    size_t total = 0;
    for (size_t row = 0; row < e->rows; row++)
        total += (size_t)found->sizes[row * step + k];
    uint8_t *items = room_for(total, size);
    const uint8_t *copied = items;
    if (total)
        e3d_ply_copy_lists(&e->body, found->starts + k, found->sizes + k, step, e->rows, size, items);
    for (size_t row = 0; row < e->rows; row++)
        copied = claim_items(e, e->body.bytes + found->starts[row * step + k], (size_t)found->sizes[row * step + k],
                             size, copied);
    free(items);
}

/* Claims that rows of lists as long as the first are told from others; here their length ends each row. */
static void claim_lengths(const element *e, size_t stride, size_t rows, size_t count_size)
{
    e3d_ply_body body = e->body;
    body.start += stride - count_size;
    const wide first = integer_at(e, count_size, body.start);
    bool are_same = true;
    for (size_t row = 0; row < rows; row++)
        are_same &= integer_at(e, count_size, body.start + row * stride) == first;
    CLAIM(e3d_ply_lengths_are(&body, stride, rows, count_size, (uint64_t)first) == are_same);
}

/* The lists' own sizes choose how wide the rows are that are copied as they lie. */
static void claim_rows(const element *e)
{
    const size_t width = 1 + e->lists[0].skip % 5, size = 1 + e->lists[1].skip % 8, stride = e->tail + width * size;
    const size_t held = e->body.end - e->body.start, rows = held / stride < e->rows ? held / stride : e->rows;
    if (rows == 0)
        return;
    claim_lengths(e, stride, rows, size);
    uint8_t *items = room_for(rows * width, size);
    const uint8_t *copied = items;
    e3d_ply_copy_rows(&e->body, stride, rows, width, size, items);
    for (size_t row = 0; row < rows; row++)
        copied = claim_items(e, e->body.bytes + e->body.start + row * stride, width, size, copied);
    free(items);
}

/* The bytes as rows of one list: as long as the first says, up to ten. */
static void claim_even_lists(const element *e)
{
    const size_t count_size = 1 + e->lists[0].skip % 8, size = 1 + e->lists[1].skip % 8;
    const size_t held = e->body.end - e->body.start;
    if (held < count_size)
        return;
    const uint64_t length = integer_at(e, count_size, e->body.start) % 11;
    const size_t stride = count_size + (size_t)length * size, rows = held / stride < e->rows ? held / stride : e->rows;
    uint8_t *items = length ? room_for(rows * (size_t)length, size) : NULL;
    const uint8_t *copied = items;
    bool are_even = true;
    for (size_t row = 0; row < rows; row++)
        are_even &= integer_at(e, count_size, e->body.start + row * stride) == length;
    CLAIM(e3d_ply_copy_even_lists(&e->body, rows, count_size, length, size, items) == are_even);
    for (size_t row = 0; row < rows && length; row++)
        copied = claim_items(e, e->body.bytes + e->body.start + row * stride + count_size, (size_t)length, size, copied);
    free(items);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    element e = {.body.is_big_endian = take_byte(&in) & 1};
    e.list_count = (size_t)take_below(&in, MOST_LISTS + 1);
    e.tail = (size_t)take_below(&in, 24);
    e.rows = take_byte(&in);
    for (size_t k = 0; k < MOST_LISTS; k++) {
        const uint32_t skip = take_byte(&in), count = take_byte(&in);
        e.lists[k] = (e3d_ply_list){skip % 32, 1 + count % 8, 1 + (size_t)take_below(&in, 8), count >> 7};
    }
    e.body.bytes = in.at;
    e.body.end = in.left;
    e.body.start = in.left && e.tail > 16 ? e.tail % in.left : 0;
    e3d_ply_rows found = {.places = room_for(e.rows, sizeof(int64_t)), .end = e.body.start};
    found.starts = room_for(e.rows * e.list_count, sizeof(int64_t));
    found.sizes = room_for(e.rows * e.list_count, sizeof(int64_t));
    const e3d_ply_problem problem = e3d_ply_walk(&e.body, e.lists, e.list_count, e.tail, e.rows, &found);
    claim_walk(&e, problem, &found);
    for (size_t k = 0; problem == E3D_PLY_DONE && k < e.list_count; k++)
        claim_lists(&e, k, &found);
    claim_rows(&e);
    claim_even_lists(&e);
    free(found.places);
    free(found.starts);
    free(found.sizes);
    return 0;
}
