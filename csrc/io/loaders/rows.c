/* Equal rows of a table, found with a hash table that grows with the rows that differ.
 *
 * In:  rows of words. Out: the number of each row, in the order of their first appearance, and the rows
 *      that differ.
 * Rows are taken in blocks: all of a block are hashed, and their places fetched, before the first is looked for.
 * Always: the numbers do not depend on the hash, which numbers drawn at random start: nobody can write a
 *      file whose rows all fall into one place.
 */
#include "base/large_pages.h"
#include "base/system.h"
#include "io/loaders/row_table.h"
#include "io/loaders/rows.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define BLOCK E3D_ROW_BLOCK
/* Places for each number, when a table begins or grows, and at least (except in tables of MOST_PLACES). */
#define PLENTY 8
#define LEAST 4
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
#define FEWEST_PLACES ((size_t)1024)
#define MOST_TAG_BITS 31
#else /* small, so that a few hundred bytes make it grow, and rows share their tags */
#define FEWEST_PLACES ((size_t)64)
#define MOST_TAG_BITS 2
#endif
#if SIZE_MAX > UINT32_MAX
#define MOST_PLACES ((size_t)1 << 32)
#else /* more than memory has */
#define MOST_PLACES ((size_t)1 << 30)
#endif
/* After so many blocks, numbers are guessed again. */
#define TRY_EVERY 32

typedef e3d_row_numbers table;

/* Whether half of the guesses in the last block were right, and which were wrong in its last two facets. */
typedef struct guesses {
    bool come_true;
    unsigned missed;
} guesses;

e3d_row_seeds e3d_random_seeds(void)
{
    e3d_row_seeds seeds;
    if (!e3d_random_bytes(&seeds, sizeof seeds)) {
        seeds.first = (uint64_t)time(NULL) * UINT64_C(0x9E3779B97F4A7C15) ^ (uintptr_t)&seeds;
        seeds.second = seeds.first * UINT64_C(0xD1342543DE82EF95) + 1;
    }
    return seeds;
}

/* Returns how many bits of a place numbers do not use, in a table of so many places. */
static int tag_bits_of(size_t places)
{
    const int bits = places < MOST_PLACES ? __builtin_clz((uint32_t)(places / LEAST)) : 0;
    return bits < MOST_TAG_BITS ? bits : MOST_TAG_BITS;
}

/* Makes so many empty places; false if memory is out. */
static bool empty_places(table *t, size_t size)
{
    free(t->places);
    t->size = size;
    t->tag_bits = tag_bits_of(size);
    t->places = size > SIZE_MAX / sizeof *t->places ? NULL : e3d_large_memory(size * sizeof *t->places);
    if (t->places)
        memset(t->places, 0, size * sizeof *t->places);
    return t->places;
}

/* Makes room, so that `wanted` numbers leave enough places empty. */
static bool reserve_places(table *t, size_t wanted)
{
    if (t->places && (wanted * LEAST <= t->size || t->size == MOST_PLACES))
        return true;
    const size_t size = wanted * PLENTY < FEWEST_PLACES ? FEWEST_PLACES : wanted * PLENTY;
    if (!empty_places(t, size < MOST_PLACES ? size : MOST_PLACES))
        return false;
    for (size_t number = 0; number < t->count; number++) {
        const uint8_t *const row = t->rows + number * t->width * WORD;
        const uint32_t half = e3d_half_of(e3d_hash_row(row, t->width, t->zero, t->seeds));
        uint32_t *place = e3d_place_of(t, half);
        while (*place)
            place = e3d_next_place(t, place);
        *place = e3d_entry_of(t, number, half);
    }
    return true;
}

static bool reserve_rows(table *t, size_t wanted)
{
    if (wanted <= t->room)
        return true;
    const size_t room = wanted + t->room / 2;
    uint8_t *const rows = e3d_large_memory(room * t->width * WORD);
    if (!rows)
        return false;
    if (t->count)
        memcpy(rows, t->rows, t->count * t->width * WORD);
    free(t->rows);
    t->rows = rows;
    t->room = room;
    return true;
}

/* Numbers the next rows, up to BLOCK; inlined for each width. */
static ALWAYS_INLINE void number_block(table *numbered, e3d_row_reader in, size_t count, size_t width, int32_t *numbers)
{
    uint32_t halves[BLOCK];
    e3d_row_reader again = in;
    table t = *numbered;
    for (size_t k = 0; k < count; k++) {
        halves[k] = e3d_half_of(e3d_hash_row(e3d_next_row(&in, width), width, t.zero, t.seeds));
        __builtin_prefetch(e3d_place_of(&t, halves[k]), 1);
    }
    for (size_t k = 0; k < count; k++)
        numbers[k] = (int32_t)e3d_number_row(&t, e3d_next_row(&again, width), width, halves[k]);
    numbered->count = t.count;
}

/* The same for the corners of facets, of which there are always three. */
static void number_facets(table *numbered, const uint8_t *facets, size_t stride, size_t count, int32_t *numbers)
{
    uint32_t halves[BLOCK];
    table t = *numbered;
    const uint8_t *facet = facets;
    for (size_t k = 0; k < count; k += 3, facet += stride) {
#pragma GCC unroll 3
        for (unsigned j = 0; j < 3; j++) {
            halves[k + j] = e3d_half_of(e3d_hash_row(facet + j * 3 * WORD, 3, t.zero, t.seeds));
            __builtin_prefetch(e3d_place_of(&t, halves[k + j]), 1);
        }
    }
    facet = facets;
    for (size_t k = 0; k < count; k += 3, facet += stride) {
#pragma GCC unroll 3
        for (unsigned j = 0; j < 3; j++)
            numbers[k + j] = (int32_t)e3d_number_row(&t, facet + j * 3 * WORD, 3, halves[k + j]);
    }
    numbered->count = t.count;
}

/* Numbers rows from one on, up to BLOCK; there is room for them. */
static void number_next(table *t, const e3d_rows *rows, size_t row, size_t count, int32_t *numbers)
{
    const e3d_row_reader in = e3d_read_rows_from(rows, row);
    if (t->width == 3 && rows->in_record == 3)
        number_facets(t, in.row, rows->stride, count, numbers);
    else if (t->width == 3)
        number_block(t, in, count, 3, numbers);
    else if (t->width == 1)
        number_block(t, in, count, 1, numbers);
    else
        number_block(t, in, count, t->width, numbers);
}

/* Makes room for so many more; false if memory is out. */
static bool reserve(table *t, size_t more)
{
    return reserve_places(t, t->count + more) && reserve_rows(t, t->count + more);
}

/* Makes a table that can grow, for so many numbers; false if memory is out. */
static bool begin_table(table *t, size_t width, bool are_floats, size_t numbers)
{
    *t = (table){.seeds = e3d_random_seeds(), .width = width, .zero = e3d_zero_of(are_floats)};
    return width <= E3D_ROW_WORDS && reserve_places(t, numbers + BLOCK) &&
           reserve_rows(t, numbers + numbers / 4 + BLOCK);
}

static void free_table(table *t)
{
    free(t->places);
    free(t->rows);
}

static size_t block_at(const e3d_rows *rows, size_t row)
{
    return rows->count - row < BLOCK ? rows->count - row : BLOCK;
}

e3d_row_numbers *e3d_row_numbers_begin(size_t width, bool are_floats, size_t expected)
{
    table *const t = malloc(sizeof *t);
    /* Mostly six triangles meet at a corner. */
    if (t && begin_table(t, width, are_floats, expected / 6))
        return t;
    e3d_row_numbers_free(t);
    return NULL;
}

/* Numbers the next block: by guesses if half of them were right in the last one, or if it is time to try. */
static bool number_regularly(table *t, const e3d_rows *rows, size_t row, size_t count, int32_t *numbers, guesses *g)
{
    if (row / BLOCK % TRY_EVERY == 1)
        g->come_true = true;
    if (!g->come_true || row == 0 || rows->width != 3 || rows->in_record != 3)
        return false;
    const uint8_t *const corners = rows->bytes + row / 3 * rows->stride;
    const size_t right = e3d_number_regular(t, corners, rows->stride, count, numbers + row, &g->missed);
    g->come_true = right >= count / 2;
    return true;
}

bool e3d_row_numbers_add(e3d_row_numbers *taken, const e3d_rows *rows, int32_t *numbers, int32_t *first)
{
    guesses g = {false, 0};
    bool done = true;
    for (size_t row = 0; done && row < rows->count; row += BLOCK) {
        const size_t count = block_at(rows, row);
        size_t next = taken->count;
        done = reserve(taken, count);
        if (done && !number_regularly(taken, rows, row, count, numbers, &g))
            number_next(taken, rows, row, count, numbers + row);
        for (size_t k = 0; first && next < taken->count; k++)
            if ((size_t)numbers[row + k] == next)
                first[next++] = (int32_t)(taken->taken + row + k);
    }
    taken->taken += rows->count;
    return done;
}

size_t e3d_row_numbers_take(e3d_row_numbers *taken, uint32_t **found)
{
    *found = (uint32_t *)taken->rows;
    taken->rows = NULL;
    taken->room = 0;
    return taken->count;
}

void e3d_row_numbers_free(e3d_row_numbers *taken)
{
    if (taken)
        free_table(taken);
    free(taken);
}

size_t e3d_number_rows(const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t **found)
{
    e3d_row_numbers *const all = e3d_row_numbers_begin(rows->width, rows->are_floats, rows->count);
    size_t made = SIZE_MAX;
    if (all && e3d_row_numbers_add(all, rows, numbers, first)) {
        made = all->count;
        if (found)
            e3d_row_numbers_take(all, found);
    }
    e3d_row_numbers_free(all);
    return made;
}

int e3d_few_rows_repeat(const e3d_rows *rows)
{
    table t;
    int32_t numbers[BLOCK];
    bool done = begin_table(&t, rows->width, rows->are_floats, rows->count), repeat = false;
    for (size_t row = 0; done && !repeat && row < rows->count; row += BLOCK) {
        done = reserve(&t, block_at(rows, row));
        if (done)
            number_next(&t, rows, row, block_at(rows, row), numbers);
        repeat = t.count < row + block_at(rows, row);
    }
    free_table(&t);
    return done ? repeat : -1;
}
