/* Equal rows of a table, found with a hash table that grows with the rows that differ.
 *
 * In:  rows of words. Out: the number of each row, in the order of their first appearance, and the rows
 *      that differ.
 * Rows are taken in blocks: the places of a whole block are fetched before the first is looked at. A place
 * holds the row itself, so that finding it is one access to memory.
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
/* Places for each number. */
#define LOAD 2
/* Rows whose bit is fetched before theirs. */
#define AHEAD 32
#define FEWEST_PLACES 1024
/* Two hashes that differ in 32 bits tell as many places apart. */
#define MOST_PLACES ((size_t)UINT32_MAX)
#define LARGE_PAGE ((size_t)2 << 20)
#define MINUS_ZERO UINT32_C(0x80000000)

/* Words in pairs, and the most of them a row has; the last one has room for a number in its upper half. */
#define PAIRS(width) ((width) / 2 + 1)
#define MOST_PAIRS PAIRS(E3D_ROW_WORDS)

/* A place is a row in pairs of words, -0 as 0, and its number + 1; 0 for none. */
typedef struct table {
    uint64_t *places;
    size_t size;   /* places */
    size_t width;  /* words of a row */
    size_t count;  /* numbers */
    uint64_t seed;
} table;

/* Zeros, in large pages where they are many, since they are reached at random. */
static void *new_zeros(size_t size)
{
    if (size < LARGE_PAGE)
        return calloc(1, size);
    void *const zeros = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (zeros == MAP_FAILED)
        return NULL;
    madvise(zeros, size, MADV_HUGEPAGE);
    return zeros;
}

static void free_zeros(void *zeros, size_t size)
{
    if (size < LARGE_PAGE)
        free(zeros);
    else if (zeros)
        munmap(zeros, size);
}

static inline uint64_t mixed(uint64_t a, uint64_t b)
{
    const unsigned __int128 product = (unsigned __int128)a * b;
    return (uint64_t)product ^ (uint64_t)(product >> 64);
}

static inline uint32_t number_of(uint64_t last) { return (uint32_t)(last >> 32); }

static inline uint32_t hash_of(const uint64_t *row, size_t width, uint64_t seed)
{
    uint64_t hash = seed;
    for (size_t i = 0; i < PAIRS(width); i += 2) {
        const bool has_two = i + 1 < PAIRS(width);
        hash = mixed(hash ^ (has_two ? row[i] : (uint32_t)row[i]),
                     (has_two ? (i + 2 < PAIRS(width) ? row[i + 1] : (uint32_t)row[i + 1]) : 0) ^
                         (seed << 32 | seed >> 32));
    }
    return (uint32_t)(mixed(hash, UINT64_C(0x9E3779B97F4A7C15)) >> 32);
}

/* The first place that a row of this hash may have. */
static inline size_t own_place(const table *t, uint32_t hash)
{
    return (size_t)((uint64_t)hash * t->size >> 32);
}

static size_t bytes_of(size_t places, size_t width) { return places * PAIRS(width) * sizeof(uint64_t); }


static void free_places(table *t) { free_zeros(t->places, bytes_of(t->size, t->width)); }

/* The place of a row, or the empty one that it would take. */
static inline uint64_t *find_place(const table *t, const uint64_t *row, size_t width, uint32_t hash)
{
    const size_t last = PAIRS(width) - 1;
    uint64_t *place = t->places + own_place(t, hash) * (last + 1);
    for (;;) {
        uint64_t differs = (uint32_t)(place[last] ^ row[last]);
        for (size_t i = 0; i < last; i++)
            differs |= place[i] ^ row[i];
        /* One branch, which is right most often. */
        if (!differs | !number_of(place[last]))
            return place;
        place += last + 1;
        if (place == t->places + t->size * (last + 1))
            place = t->places;
    }
}

/* Makes room so that `wanted` numbers fill no more than half. */
static bool reserve(table *t, size_t wanted)
{
    if (t->places && wanted <= t->size / LOAD)
        return true;
    table grown = *t;
    grown.size = wanted * LOAD;
    if (grown.size < 2 * t->size)
        grown.size = 2 * t->size;
    if (grown.size < FEWEST_PLACES)
        grown.size = FEWEST_PLACES;
    if (grown.size > MOST_PLACES)
        grown.size = MOST_PLACES;
    grown.places = wanted < grown.size ? new_zeros(bytes_of(grown.size, t->width)) : NULL;
    if (!grown.places)
        return false;
    const size_t last = PAIRS(t->width) - 1;
    for (size_t i = 0; t->places && i < t->size; i++) {
        const uint64_t *const row = t->places + i * (last + 1);
        if (number_of(row[last]))
            memcpy(find_place(&grown, row, t->width, hash_of(row, t->width, t->seed)), row,
                   (last + 1) * sizeof *row);
    }
    free_places(t);
    *t = grown;
    return true;
}

/* The rows that are still to be read. */
typedef struct input {
    const uint8_t *record;
    size_t in_record; /* rows of it that were read */
    const e3d_rows *rows;
} input;

static inline const uint8_t *next_row(input *in, size_t width)
{
    const uint8_t *const row = in->record + in->in_record * width * sizeof(uint32_t);
    if (++in->in_record == in->rows->in_record) {
        in->in_record = 0;
        in->record += in->rows->stride;
    }
    return row;
}

/* -0 counts as 0, if zero is -0. */
static inline uint64_t plain(uint32_t word, uint32_t zero) { return word == zero ? 0 : word; }

/* The next row in pairs. */
static inline const uint8_t *take_row(input *in, size_t width, uint32_t zero, uint64_t *pairs)
{
    const uint8_t *const row = next_row(in, width);
    for (size_t i = 0; i + 1 < width; i += 2) {
        uint32_t two[2];
        memcpy(two, row + i * sizeof *two, sizeof two);
        pairs[i / 2] = plain(two[0], zero) | plain(two[1], zero) << 32;
    }
    uint32_t odd = 0;
    if (width % 2)
        memcpy(&odd, row + (width - 1) * sizeof odd, sizeof odd);
    pairs[width / 2] = plain(odd, zero);
    return row;
}

/* Numbers the next rows, up to BLOCK; inlined for each width. */
static inline void number_block(table *t, input *in, size_t count, size_t width, int32_t *numbers,
                                uint32_t *found)
{
    const size_t last = PAIRS(width) - 1;
    const uint32_t zero = in->rows->are_floats ? MINUS_ZERO : 0;
    uint64_t rows[BLOCK * MOST_PAIRS];
    uint32_t hashes[BLOCK];
    const uint8_t *bytes[BLOCK];
    for (size_t k = 0; k < count; k++) {
        uint64_t *const row = rows + k * (last + 1);
        bytes[k] = take_row(in, width, zero, row);
        hashes[k] = hash_of(row, width, t->seed);
        __builtin_prefetch(t->places + own_place(t, hashes[k]) * (last + 1), 1);
    }
    for (size_t k = 0; k < count; k++) {
        const uint64_t *const row = rows + k * (last + 1);
        uint64_t *const place = find_place(t, row, width, hashes[k]);
        uint32_t number = number_of(place[last]);
        if (!number) {
            if (found)
                memcpy(found + t->count * width, bytes[k], width * sizeof *found);
            memcpy(place, row, last * sizeof *place);
            number = (uint32_t)++t->count;
            place[last] = row[last] | (uint64_t)number << 32;
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

/* Numbers the next rows, up to BLOCK; false if memory is out. */
static bool number_next(table *t, input *in, size_t count, int32_t *numbers, uint32_t *found)
{
    if (!reserve(t, t->count + count))
        return false;
    switch (t->width) {
    case 1: number_block(t, in, count, 1, numbers, found); break;
    case 3: number_block(t, in, count, 3, numbers, found); break;
    default: number_block(t, in, count, t->width, numbers, found);
    }
    return true;
}

/* A table for so many numbers, which grows; false if memory is out. */
static bool begin_table(table *t, const e3d_rows *rows, size_t numbers)
{
    *t = (table){.seed = random_seed(), .width = rows->width};
    return rows->width <= E3D_ROW_WORDS && reserve(t, numbers + BLOCK);
}

static size_t block_at(const e3d_rows *rows, size_t row)
{
    return rows->count - row < BLOCK ? rows->count - row : BLOCK;
}

size_t e3d_number_rows(const e3d_rows *rows, int32_t *numbers, int32_t *first, uint32_t *found)
{
    table t;
    input in = {rows->bytes, 0, rows};
    /* Corners of triangles meet in six, most often. */
    bool done = begin_table(&t, rows, rows->count / 5);
    for (size_t row = 0; done && row < rows->count; row += BLOCK) {
        size_t next = t.count;
        done = number_next(&t, &in, block_at(rows, row), numbers + row, found);
        for (size_t k = 0; first && next < t.count; k++)
            if ((size_t)numbers[row + k] == next)
                first[next++] = (int32_t)(row + k);
    }
    free_places(&t);
    return done ? t.count : SIZE_MAX;
}

/* Whether two rows are equal; for few rows, since it has a place for each. */
static int few_rows_repeat(const e3d_rows *rows)
{
    table t;
    input in = {rows->bytes, 0, rows};
    int32_t numbers[BLOCK];
    bool done = begin_table(&t, rows, rows->count), repeat = false;
    for (size_t row = 0; done && !repeat && row < rows->count; row += BLOCK) {
        done = number_next(&t, &in, block_at(rows, row), numbers, NULL);
        repeat = t.count < row + block_at(rows, row);
    }
    free_places(&t);
    return done ? repeat : -1;
}

/* A map of 16 bits a row: about one row of sixteen shares its bit with an unequal one. */
typedef struct map {
    size_t words, bits;
    uint64_t *seen, *again; /* [words] whether any row has the bit, and whether several have */
    uint32_t *hashes;       /* [rows] */
} map;

static inline size_t bit_of(const map *m, uint32_t hash)
{
    return (size_t)((uint64_t)hash * m->bits >> 32);
}

/* Inlined for each width. */
static inline void hash_rows(const e3d_rows *rows, size_t width, uint32_t *hashes)
{
    const uint64_t seed = random_seed();
    const uint32_t zero = rows->are_floats ? MINUS_ZERO : 0;
    uint64_t row[MOST_PAIRS];
    input in = {rows->bytes, 0, rows};
    for (size_t i = 0; i < rows->count; i++) {
        take_row(&in, width, zero, row);
        hashes[i] = hash_of(row, width, seed);
    }
}

static size_t count_suspects(const map *m, size_t rows)
{
    for (size_t i = 0; i < rows; i++) {
        __builtin_prefetch(&m->seen[bit_of(m, m->hashes[i + AHEAD < rows ? i + AHEAD : i]) / 64], 1);
        const size_t bit = bit_of(m, m->hashes[i]);
        const uint64_t mark = UINT64_C(1) << bit % 64, was = m->seen[bit / 64];
        if (was & mark)
            m->again[bit / 64] |= mark;
        m->seen[bit / 64] = was | mark;
    }
    size_t count = 0;
    for (size_t i = 0; i < rows; i++) {
        const size_t bit = bit_of(m, m->hashes[i]);
        m->hashes[count] = (uint32_t)i;
        count += m->again[bit / 64] >> bit % 64 & 1;
    }
    return count;
}

/* Whether two are equal of the rows that share their bit. */
static int suspects_repeat(const e3d_rows *rows, const uint32_t *numbers, size_t count)
{
    const size_t size = rows->width * sizeof(uint32_t);
    uint8_t *const copies = malloc((count + 1) * size);
    if (!copies)
        return -1;
    for (size_t i = 0; i < count; i++)
        memcpy(copies + i * size,
               rows->bytes + numbers[i] / rows->in_record * rows->stride +
                   numbers[i] % rows->in_record * size,
               size);
    const e3d_rows few = {copies, count, rows->width, 1, size, rows->are_floats};
    const int repeat = few_rows_repeat(&few);
    free(copies);
    return repeat;
}

int e3d_rows_repeat(const e3d_rows *rows)
{
    map m = {.words = rows->count / 4 + 1};
    m.bits = 64 * m.words;
    const size_t size = 2 * m.words * sizeof *m.seen + rows->count * sizeof *m.hashes;
    m.seen = new_zeros(size);
    if (!m.seen)
        return -1;
    m.again = m.seen + m.words;
    m.hashes = (uint32_t *)(m.again + m.words);
    if (rows->width == 3)
        hash_rows(rows, 3, m.hashes);
    else
        hash_rows(rows, rows->width, m.hashes);
    /* The numbers of the suspects take the place of the hashes. */
    const int repeat = suspects_repeat(rows, m.hashes, count_suspects(&m, rows->count));
    free_zeros(m.seen, size);
    return repeat;
}
