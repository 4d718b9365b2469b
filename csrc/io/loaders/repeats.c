/* Whether any two rows of a table are equal; faster than numbering them where none are.
 *
 * In:  rows of words. Out: yes or no.
 * Each row marks two bits of a map that its hash chooses. Rows that share both with others are few, and only they are
 * numbered.
 */
#include "base/large_pages.h"
#include "io/loaders/rows.h"

#include <stdlib.h>

#define BLOCK 256
/* Bits of the map for each row: about one row of thirty shares its bits with unequal ones. */
#define BITS 8

typedef struct word {
    /* Seen: Bloom-filter bits that any row has set; again: bits of rows that found all of theirs set, and may be repeats */
    uint64_t seen, again;
} word;

typedef struct map {
    word *words;
    size_t count;     /* words */
    uint32_t *hashes; /* [rows] */
} map;

/* The upper bits of a hash choose the word, the lower ones the two bits. */
static inline word *word_of(const map *m, uint32_t hash) { return &m->words[(uint64_t)hash * m->count >> 32]; }

static inline uint64_t bits_of(uint32_t hash) { return UINT64_C(1) << hash % 64 | UINT64_C(1) << hash / 64 % 64; }

/* Hashes consecutive rows, and marks them; inlined for each width. */
static ALWAYS_INLINE void mark_block(map *m, const uint8_t *row, size_t stride, size_t count, size_t width,
                                     uint32_t zero, e3d_row_seeds seeds, uint32_t *hashes)
{
    for (size_t k = 0; k < count; k++) {
        hashes[k] = (uint32_t)(e3d_hash_row(row + k * stride, width, zero, seeds) >> 16);
        __builtin_prefetch(word_of(m, hashes[k]), 1);
    }
    for (size_t k = 0; k < count; k++) {
        word *const w = word_of(m, hashes[k]);
        const uint64_t bits = bits_of(hashes[k]);
        w->again |= (~w->seen & bits) == 0 ? bits : 0;
        w->seen |= bits;
    }
}

static void mark_rows(map *m, const e3d_rows *rows)
{
    const e3d_row_seeds seeds = e3d_random_seeds();
    const uint32_t zero = e3d_zero_of(rows->are_floats);
    for (size_t row = 0; row < rows->count; row += BLOCK) {
        const size_t left = rows->count - row, count = left < BLOCK ? left : BLOCK;
        const uint8_t *const at = rows->bytes + row * rows->stride;
        if (rows->width == 3)
            mark_block(m, at, rows->stride, count, 3, zero, seeds, m->hashes + row);
        else
            mark_block(m, at, rows->stride, count, rows->width, zero, seeds, m->hashes + row);
    }
}

/* Replaces the hashes by the numbers of the rows that share their bits; returns how many there are. */
static size_t find_suspects(const map *m, size_t rows)
{
    size_t count = 0;
    for (size_t i = 0; i < rows; i++) {
        const uint32_t hash = m->hashes[i];
        m->hashes[count] = (uint32_t)i;
        count += (~word_of(m, hash)->again & bits_of(hash)) == 0;
    }
    return count;
}

/* Whether two of the suspects are equal. */
static int suspects_repeat(const e3d_rows *rows, const uint32_t *suspects, size_t count)
{
    const size_t size = rows->width * WORD;
    uint8_t *const copies = malloc((count + 1) * size);
    if (!copies)
        return -1;
    for (size_t i = 0; i < count; i++)
        memcpy(copies + i * size, rows->bytes + suspects[i] * rows->stride, size);
    const e3d_rows few = {copies, count, rows->width, 1, size, rows->are_floats};
    const int repeat = e3d_few_rows_repeat(&few);
    free(copies);
    return repeat;
}

int e3d_rows_repeat(const e3d_rows *rows)
{
    map m = {.count = rows->count * BITS / 64 + 1};
    const size_t size = m.count * sizeof *m.words;
    m.words = e3d_large_memory(size + rows->count * sizeof *m.hashes);
    if (!m.words)
        return -1;
    memset(m.words, 0, size);
    m.hashes = (uint32_t *)(m.words + m.count);
    mark_rows(&m, rows);
    const int repeat = suspects_repeat(rows, m.hashes, find_suspects(&m, rows->count));
    free(m.words);
    return repeat;
}
