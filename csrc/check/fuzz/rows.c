/* Fuzzes the numbering of equal rows, which welds STL and PLY.
 *
 * In:  a byte each: columns, rows a record, gap behind a record, whether floats; then the records.
 * Claims: a row's number is that of an equal row; no two numbers' rows are equal; numbers come in order.
 */
#include "e3d_rows.h"
#include "check/fuzz/input.h"

static size_t row_size;

static int compare(const void *a, const void *b) { return memcmp(a, b, row_size); }

static void copy_plain(uint32_t *to, const void *from, const e3d_rows *rows)
{
    memcpy(to, from, row_size);
    for (size_t k = 0; rows->are_floats && k < rows->width; k++)
        to[k] = to[k] == UINT32_C(0x80000000) ? 0 : to[k];
}

static const uint8_t *row_at(const e3d_rows *rows, size_t i)
{
    return rows->bytes + i / rows->in_record * rows->stride + i % rows->in_record * row_size;
}

static void claim_numbers(const e3d_rows *rows, const int32_t *numbers, const int32_t *first,
                          const uint32_t *found, size_t made)
{
    uint32_t *plain = room_for(made, row_size), row[E3D_ROW_WORDS];
    for (size_t k = 0; k < made; k++) {
        copy_plain(plain + k * rows->width, found + k * rows->width, rows);
        CLAIM(numbers[first[k]] == (int32_t)k);
        CLAIM(memcmp(row_at(rows, (size_t)first[k]), found + k * rows->width, row_size) == 0);
    }
    int32_t next = 0;
    for (size_t i = 0; i < rows->count; i++) {
        CLAIM(numbers[i] >= 0 && numbers[i] <= next && (size_t)numbers[i] < made);
        next += numbers[i] == next;
        copy_plain(row, row_at(rows, i), rows);
        CLAIM(memcmp(row, plain + (size_t)numbers[i] * rows->width, row_size) == 0);
    }
    qsort(plain, made, row_size, compare);
    for (size_t k = 1; k < made; k++)
        CLAIM(memcmp(plain + (k - 1) * rows->width, plain + k * rows->width, row_size) != 0);
    free(plain);
}

/* Claims that the records give the same in two pieces. */
static void claim_pieces(const e3d_rows *rows, const int32_t *expected, const int32_t *expected_first, size_t made)
{
    const size_t records = rows->count / rows->in_record, half = records / 2 * rows->in_record;
    int32_t *numbers = room_for(rows->count, sizeof *numbers), *first = room_for(rows->count, sizeof *first);
    e3d_row_numbers *all = e3d_row_numbers_begin(rows->width, rows->are_floats, rows->count);
    e3d_rows before = *rows, behind = *rows;
    before.count = half;
    behind.count = rows->count - half;
    behind.bytes += records / 2 * rows->stride;
    CLAIM(all && e3d_row_numbers_add(all, &before, numbers, first));
    CLAIM(e3d_row_numbers_add(all, &behind, numbers + half, first));
    uint32_t *found;
    CLAIM(e3d_row_numbers_take(all, &found) == made);
    CLAIM(memcmp(numbers, expected, rows->count * sizeof *numbers) == 0);
    CLAIM(memcmp(first, expected_first, made * sizeof *first) == 0);
    e3d_row_numbers_free(all);
    free(found);
    free(numbers);
    free(first);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    e3d_rows rows = {.width = 1 + (size_t)take_below(&in, E3D_ROW_WORDS)};
    rows.in_record = 1 + (size_t)take_below(&in, 4);
    row_size = rows.width * sizeof(uint32_t);
    const size_t record = rows.in_record * row_size;
    rows.stride = record + (size_t)take_below(&in, 16);
    rows.are_floats = take_byte(&in) & 1;
    rows.bytes = in.at;
    if (in.left < record)
        return 0;
    rows.count = (1 + (in.left - record) / rows.stride) * rows.in_record;
    int32_t *numbers = room_for(rows.count, sizeof *numbers), *first = room_for(rows.count, sizeof *first);
    uint32_t *found = NULL;
    const size_t made = e3d_number_rows(&rows, numbers, first, &found);
    claim_numbers(&rows, numbers, first, found, made);
    claim_pieces(&rows, numbers, first, made);
    CLAIM(rows.in_record > 1 || e3d_rows_repeat(&rows) == (made < rows.count));
    free(numbers);
    free(first);
    free(found);
    return 0;
}
