/* Rows of words, read one behind another and hashed.
 *
 * In:  rows (e3d_rows). Out: where each stands, hashes of 64 bits that are the same for equal rows, and whether
 *      two rows are equal: all bits are, but that of floats -0 equals 0.
 * The hash multiplies words by words and folds the product, as wyhash does; two numbers drawn at random begin it.
 */
#pragma once

#include "base/always_inline.h"
#include "e3d_rows.h"

#include <string.h>

#define MINUS_ZERO UINT32_C(0x80000000)
#define WORD sizeof(uint32_t)

typedef uint32_t e3d_words __attribute__((vector_size(16)));
typedef uint64_t e3d_pairs __attribute__((vector_size(16)));

typedef struct e3d_row_seeds {
    uint64_t first, second;
} e3d_row_seeds;

/* The rows that are still to be read. */
typedef struct e3d_row_reader {
    const uint8_t *row;
    size_t in_record; /* how many rows of the record were read */
    const e3d_rows *rows;
} e3d_row_reader;

static inline e3d_row_reader e3d_read_rows_from(const e3d_rows *rows, size_t row)
{
    const size_t record = row / rows->in_record, in_record = row % rows->in_record;
    return (e3d_row_reader){rows->bytes + record * rows->stride + in_record * rows->width * WORD, in_record, rows};
}

static inline const uint8_t *e3d_next_row(e3d_row_reader *in, size_t width)
{
    const uint8_t *const row = in->row;
    in->row += width * WORD;
    if (++in->in_record == in->rows->in_record) {
        in->in_record = 0;
        in->row += in->rows->stride - in->rows->in_record * width * WORD;
    }
    return row;
}

/* Reads up to four words, followed by zeros; words that equal `zero` become 0. */
static inline e3d_pairs e3d_plain_words(const uint8_t *words, size_t count, uint32_t zero)
{
    uint64_t low = 0, high = 0;
    memcpy(&low, words, (count < 2 ? count : 2) * WORD);
    if (count > 2)
        memcpy(&high, words + 2 * WORD, (count - 2) * WORD);
    const e3d_words given = (e3d_words)(e3d_pairs){low, high}, zeros = {zero, zero, zero, zero};
    return (e3d_pairs)(given & ~(e3d_words)(given == zeros));
}

/* The word that counts as equal to 0: -0 for floats, and else 0 itself. */
static inline uint32_t e3d_zero_of(bool are_floats) { return are_floats ? MINUS_ZERO : 0; }

static inline uint64_t e3d_hash_row(const uint8_t *row, size_t width, uint32_t zero, e3d_row_seeds seeds)
{
    uint64_t hash = seeds.first;
    for (size_t i = 0; i < width; i += 4) {
        const e3d_pairs words = e3d_plain_words(row + i * WORD, width - i < 4 ? width - i : 4, zero);
        const unsigned __int128 product = (unsigned __int128)(words[0] ^ hash) * (words[1] ^ seeds.second);
        hash = (uint64_t)product ^ (uint64_t)(product >> 64);
    }
    return hash;
}

/* Whether two rows whose bits differ differ in more than the sign of zeros. */
static inline bool e3d_same_but_zeros(const uint8_t *a, const uint8_t *b, size_t width, uint32_t zero)
{
    uint64_t differs = 0;
    for (size_t i = 0; i < width; i += 4) {
        const size_t count = width - i < 4 ? width - i : 4;
        const e3d_pairs bits = e3d_plain_words(a + i * WORD, count, zero) ^ e3d_plain_words(b + i * WORD, count, zero);
        differs |= bits[0] | bits[1];
    }
    return !differs;
}

/* Most equal rows have equal bits, so that zeros need not be looked at. */
static inline bool e3d_same_rows(const uint8_t *a, const uint8_t *b, size_t width, uint32_t zero)
{
    return !memcmp(a, b, width * WORD) || e3d_same_but_zeros(a, b, width, zero);
}
