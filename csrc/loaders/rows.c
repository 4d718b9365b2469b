/* Equal rows of a table, found with a hash table that grows with the rows that differ.
 *
 * In:  rows of words. Out: the number of each row, in the order of their first appearance, and the rows
 *      that differ.
 * Rows are taken in blocks: all of a block are hashed, and their places fetched, before the first is looked for.
 * A place is eight bytes: a number, and the upper half of its row's hash, whose first bits choose the place. So other
 * rows are hardly ever read for nothing, and a table grows without a look at its rows.
 * Always: the numbers do not depend on the hash, which numbers drawn at random start: nobody can write a
 *      file whose rows all fall into one place.
 */
#include "loaders/rows.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <time.h>

#define BLOCK 192
/* Places for each number: in the beginning at least, and always. */
#define PLENTY 3
#define LEAST 2
#define FEWEST_BITS 10
#define MOST_BITS 32
#define LARGE_PAGE ((size_t)2 << 20)

/* A place is half a hash, never 0, and above it the number; 0 if it is empty. */
typedef struct e3d_row_numbers {
    uint64_t *places;
    size_t size;   /* places, a power of two */
    int shift;     /* of half a hash, to the first place for it */
    uint8_t *rows; /* [count * width] words of those that differ */
    size_t room;   /* rows */
    size_t width;  /* words of a row */
    size_t count;  /* numbers */
    size_t taken;  /* rows that were numbered */
    uint32_t zero;
    e3d_row_seeds seeds;
} table;

void *e3d_large_room(size_t size)
{
    if (size < LARGE_PAGE / 2)
        return malloc(size ? size : 1);
    const size_t pages = (size + LARGE_PAGE - 1) / LARGE_PAGE * LARGE_PAGE;
    void *const room = aligned_alloc(LARGE_PAGE, pages);
    if (room)
        madvise(room, pages, MADV_HUGEPAGE);
    return room;
}

void *e3d_large_zeros(size_t size)
{
    void *const room = e3d_large_room(size);
    return room ? memset(room, 0, size) : NULL;
}

e3d_row_seeds e3d_random_seeds(void)
{
    e3d_row_seeds seeds;
    if (getrandom(&seeds, sizeof seeds, GRND_NONBLOCK) != (ssize_t)sizeof seeds) {
        seeds.first = (uint64_t)time(NULL) * UINT64_C(0x9E3779B97F4A7C15) ^ (uintptr_t)&seeds;
        seeds.second = seeds.first * UINT64_C(0xD1342543DE82EF95) + 1;
    }
    return seeds;
}

static inline uint32_t half_of(uint64_t hash) { return (uint32_t)(hash >> 32) | 1; }

static inline size_t place_of(const table *t, uint32_t half) { return (size_t)half >> t->shift; }

static inline size_t next_place(const table *t, size_t place) { return (place + 1) & (t->size - 1); }

/* Makes room so that `wanted` numbers leave enough places empty. */
static bool reserve_places(table *t, size_t wanted)
{
    if (t->places && wanted * LEAST <= t->size)
        return true;
    table grown = *t;
    int bits = FEWEST_BITS;
    while (bits < MOST_BITS && (size_t)1 << bits < wanted * PLENTY)
        bits++;
    grown.size = (size_t)1 << bits;
    grown.shift = 32 - bits;
    grown.places = e3d_large_zeros(grown.size * sizeof *grown.places);
    if (!grown.places)
        return false;
    for (size_t i = 0; t->places && i < t->size; i++) {
        if (!t->places[i])
            continue;
        size_t place = place_of(&grown, (uint32_t)t->places[i]);
        while (grown.places[place])
            place = next_place(&grown, place);
        grown.places[place] = t->places[i];
    }
    free(t->places);
    *t = grown;
    return true;
}

static bool reserve_rows(table *t, size_t wanted)
{
    if (wanted <= t->room)
        return true;
    const size_t room = wanted + t->room / 2;
    uint8_t *const rows = e3d_large_room(room * t->width * WORD);
    if (!rows)
        return false;
    if (t->count)
        memcpy(rows, t->rows, t->count * t->width * WORD);
    free(t->rows);
    t->rows = rows;
    t->room = room;
    return true;
}

/* The number of a row, which may be new. */
static ALWAYS_INLINE uint32_t number_row(table *t, const uint8_t *row, size_t width, uint32_t half)
{
    for (size_t place = place_of(t, half);; place = next_place(t, place)) {
        const uint64_t entry = t->places[place];
        const uint32_t number = (uint32_t)(entry >> 32);
        if ((uint32_t)entry == half && e3d_same_rows(t->rows + number * width * WORD, row, width, t->zero))
            return number;
        if (!entry) {
            memcpy(t->rows + t->count * width * WORD, row, width * WORD);
            t->places[place] = (uint64_t)t->count << 32 | half;
            return (uint32_t)t->count++;
        }
    }
}

/* Numbers the next rows, up to BLOCK; inlined for each width. */
static ALWAYS_INLINE void number_block(table *t, e3d_row_reader *in, size_t count, size_t width, int32_t *numbers)
{
    uint32_t halves[BLOCK];
    e3d_row_reader again = *in;
    for (size_t k = 0; k < count; k++) {
        halves[k] = half_of(e3d_hash_row(e3d_next_row(in, width), width, t->zero, t->seeds));
        __builtin_prefetch(&t->places[place_of(t, halves[k])], 1);
    }
    for (size_t k = 0; k < count; k++)
        numbers[k] = (int32_t)number_row(t, e3d_next_row(&again, width), width, halves[k]);
}

/* Numbers the next rows, up to BLOCK; false if memory is out. */
static bool number_next(table *t, e3d_row_reader *in, size_t count, int32_t *numbers)
{
    if (!reserve_places(t, t->count + count) || !reserve_rows(t, t->count + count))
        return false;
    switch (t->width) {
    case 1: number_block(t, in, count, 1, numbers); break;
    case 3: number_block(t, in, count, 3, numbers); break;
    default: number_block(t, in, count, t->width, numbers);
    }
    return true;
}

/* A table for so many numbers, which grows; false if memory is out. */
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
    /* Corners of triangles meet in six, most often. */
    if (t && begin_table(t, width, are_floats, expected / 6))
        return t;
    e3d_row_numbers_free(t);
    return NULL;
}

bool e3d_row_numbers_add(e3d_row_numbers *taken, const e3d_rows *rows, int32_t *numbers, int32_t *first)
{
    e3d_row_reader in = e3d_read_rows(rows);
    bool done = true;
    for (size_t row = 0; done && row < rows->count; row += BLOCK) {
        size_t next = taken->count;
        done = number_next(taken, &in, block_at(rows, row), numbers + row);
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
    e3d_row_reader in = e3d_read_rows(rows);
    int32_t numbers[BLOCK];
    bool done = begin_table(&t, rows->width, rows->are_floats, rows->count), repeat = false;
    for (size_t row = 0; done && !repeat && row < rows->count; row += BLOCK) {
        done = number_next(&t, &in, block_at(rows, row), numbers);
        repeat = t.count < row + block_at(rows, row);
    }
    free_table(&t);
    return done ? repeat : -1;
}
