/* Equal rows of a table, found with a hash table that grows with the rows that differ.
 *
 * In:  rows of words. Out: the number of each row, in the order of their first appearance, and the rows
 *      that differ.
 * Rows are taken in blocks: the places of a whole block are fetched before the first is looked at.
 * Always: the numbers do not depend on the hash, which a number drawn at random starts: nobody can write
 *      a file whose rows all fall into one place.
 */
#include "e3d_loaders.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <time.h>

#define BLOCK 64
#define FIRST_BITS 10
#define LARGE_PAGE ((size_t)2 << 20)
#define MINUS_ZERO UINT32_C(0x80000000)

/* A place of the table: a hash, and the number with that hash + 1; 0 for none. */
typedef struct place {
    uint32_t hash, number;
} place;

typedef struct table {
    place *places;
    int bits;        /* 2^bits places; the first bits of a hash say which one is its own */
    size_t count;    /* numbers */
    uint64_t seed;
    uint32_t *found; /* the rows that differ */
} table;

static inline uint64_t mixed(uint64_t a, uint64_t b)
{
    const unsigned __int128 product = (unsigned __int128)a * b;
    return (uint64_t)product ^ (uint64_t)(product >> 64);
}

/* -0 counts as 0, if zero is -0. */
static inline uint32_t plain(uint32_t word, uint32_t zero) { return word == zero ? 0 : word; }

static inline uint64_t pair_of(const uint32_t *row, size_t at, size_t width, uint32_t zero)
{
    const uint64_t low = at < width ? plain(row[at], zero) : 0;
    return at + 1 < width ? low | (uint64_t)plain(row[at + 1], zero) << 32 : low;
}

static inline uint32_t hash_of(const uint32_t *row, size_t width, uint32_t zero, uint64_t seed)
{
    uint64_t hash = seed;
    for (size_t i = 0; i < width; i += 4)
        hash = mixed(hash ^ pair_of(row, i, width, zero),
                     pair_of(row, i + 2, width, zero) ^ (seed << 32 | seed >> 32));
    return (uint32_t)(mixed(hash, UINT64_C(0x9E3779B97F4A7C15)) >> 32);
}

static inline size_t own_place(const table *t, uint32_t hash) { return hash >> (32 - t->bits); }

static inline size_t next_place(const table *t, size_t at)
{
    return (at + 1) & (((size_t)1 << t->bits) - 1);
}

/* Empty places; in large pages where there are many, since they are reached at random. */
static place *new_places(size_t count)
{
    const size_t size = count * sizeof(place);
    if (size < LARGE_PAGE)
        return calloc(count, sizeof(place));
    place *places = aligned_alloc(LARGE_PAGE, size);
    if (places) {
        madvise(places, size, MADV_HUGEPAGE);
        memset(places, 0, size);
    }
    return places;
}

/* Doubles the room until `wanted` numbers fill no more than half. */
static bool reserve(table *t, size_t wanted)
{
    int bits = t->places ? t->bits : FIRST_BITS;
    while (bits < 32 && (size_t)1 << (bits - 1) < wanted)
        bits++;
    if (t->places && bits == t->bits)
        return true;
    table grown = *t;
    grown.bits = bits;
    grown.places = new_places((size_t)1 << bits);
    if (!grown.places)
        return false;
    for (size_t i = 0; t->places && i < (size_t)1 << t->bits; i++) {
        if (!t->places[i].number)
            continue;
        size_t at = own_place(&grown, t->places[i].hash);
        while (grown.places[at].number)
            at = next_place(&grown, at);
        grown.places[at] = t->places[i];
    }
    free(t->places);
    *t = grown;
    return true;
}

static inline bool are_equal(const uint32_t *a, const uint32_t *b, size_t width, uint32_t zero)
{
    uint32_t differs = 0;
    for (size_t i = 0; i < width; i++)
        differs |= plain(a[i], zero) ^ plain(b[i], zero);
    return differs == 0;
}

/* The rows that are still to be read. */
typedef struct input {
    const uint8_t *record;
    size_t in_record; /* rows of it that were read */
    const e3d_rows *rows;
} input;

static inline void take_row(input *in, size_t width, uint32_t *words)
{
    memcpy(words, in->record + in->in_record * width * sizeof *words, width * sizeof *words);
    if (++in->in_record == in->rows->in_record) {
        in->in_record = 0;
        in->record += in->rows->stride;
    }
}

/* Numbers the next rows, up to BLOCK; inlined for each width. */
static inline void number_block(table *t, input *in, size_t count, size_t width, int32_t *numbers)
{
    const uint32_t zero = in->rows->are_floats ? MINUS_ZERO : 0;
    uint32_t words[BLOCK * E3D_ROW_WORDS], hashes[BLOCK];
    for (size_t k = 0; k < count; k++) {
        take_row(in, width, words + k * width);
        hashes[k] = hash_of(words + k * width, width, zero, t->seed);
        __builtin_prefetch(&t->places[own_place(t, hashes[k])]);
    }
    for (size_t k = 0; k < count; k++) {
        const uint32_t *const row = words + k * width;
        size_t at = own_place(t, hashes[k]);
        uint32_t number;
        while ((number = t->places[at].number) != 0 &&
               !(t->places[at].hash == hashes[k] &&
                 are_equal(t->found + (number - 1) * width, row, width, zero)))
            at = next_place(t, at);
        if (!number) {
            memcpy(t->found + t->count * width, row, width * sizeof *row);
            number = (uint32_t)++t->count;
            t->places[at] = (place){hashes[k], number};
        }
        numbers[k] = (int32_t)number - 1;
    }
}

static uint64_t random_seed(void)
{
    uint64_t seed;
    if (getrandom(&seed, sizeof seed, GRND_NONBLOCK) != (ssize_t)sizeof seed)
        seed = (uint64_t)time(NULL) * UINT64_C(0x9E3779B97F4A7C15) ^ (uintptr_t)&seed;
    return seed;
}

size_t e3d_number_rows(const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t *found)
{
    table t = {.seed = random_seed(), .found = found};
    input in = {rows->bytes, 0, rows};
    /* Corners of triangles meet in six, most often. */
    bool done = rows->width <= E3D_ROW_WORDS && reserve(&t, rows->count / 8);
    for (size_t row = 0; done && row < rows->count; row += BLOCK) {
        const size_t count = rows->count - row < BLOCK ? rows->count - row : BLOCK;
        const size_t before = t.count;
        done = reserve(&t, t.count + count);
        if (!done)
            break;
        switch (rows->width) {
        case 1: number_block(&t, &in, count, 1, numbers + row); break;
        case 3: number_block(&t, &in, count, 3, numbers + row); break;
        default: number_block(&t, &in, count, rows->width, numbers + row);
        }
        size_t next = before;
        for (size_t k = 0; first && next < t.count; k++)
            if ((size_t)numbers[row + k] == next)
                first[next++] = (int32_t)(row + k);
    }
    free(t.places);
    return done ? t.count : SIZE_MAX;
}

/* Copies the rows whose hash some other row has in common, in a map of 16 bits a row; returns how many. */
static size_t find_suspects(const e3d_rows *rows, uint64_t *seen, uint64_t *again, int bits,
                            uint32_t *suspects)
{
    const uint64_t seed = random_seed();
    const uint32_t zero = rows->are_floats ? MINUS_ZERO : 0;
    const size_t width = rows->width;
    uint32_t row[E3D_ROW_WORDS];
    input in = {rows->bytes, 0, rows};
    for (size_t i = 0; i < rows->count; i++) {
        take_row(&in, width, row);
        const uint32_t bit = hash_of(row, width, zero, seed) >> (32 - bits);
        again[bit / 64] |= seen[bit / 64] & UINT64_C(1) << bit % 64;
        seen[bit / 64] |= UINT64_C(1) << bit % 64;
    }
    in = (input){rows->bytes, 0, rows};
    size_t count = 0;
    for (size_t i = 0; i < rows->count; i++) {
        take_row(&in, width, row);
        const uint32_t bit = hash_of(row, width, zero, seed) >> (32 - bits);
        if (again[bit / 64] >> bit % 64 & 1)
            memcpy(suspects + width * count++, row, width * sizeof *row);
    }
    return count;
}

int e3d_rows_repeat(const e3d_rows *rows)
{
    int bits = 6;
    while (bits < 32 && (size_t)1 << bits < 16 * rows->count)
        bits++;
    uint64_t *seen = calloc((size_t)1 << (bits - 6), sizeof *seen);
    uint64_t *again = calloc((size_t)1 << (bits - 6), sizeof *again);
    /* Of these only as much is ever touched as there are suspects. */
    uint32_t *suspects = malloc((rows->count + 1) * rows->width * sizeof *suspects);
    uint32_t *found = malloc((rows->count + 1) * rows->width * sizeof *found);
    int32_t *numbers = malloc((rows->count + 1) * sizeof *numbers);
    int repeat = -1;
    if (seen && again && suspects && found && numbers) {
        e3d_rows few = *rows;
        few.count = find_suspects(rows, seen, again, bits, suspects);
        few.bytes = (const uint8_t *)suspects;
        few.in_record = 1;
        few.stride = few.width * sizeof *suspects;
        const size_t made = e3d_number_rows(&few, numbers, NULL, found);
        repeat = made == SIZE_MAX ? -1 : made < few.count;
    }
    free(seen);
    free(again);
    free(suspects);
    free(found);
    free(numbers);
    return repeat;
}
