/* Corners of facets that stand in a regular order: strips, fans, the two halves of quads.
 *
 * In:  facets, and the numbers of the corners before them. Out: their corners' numbers, the same as without guessing.
 * From a corner to the one two facets later, six places on, the number mostly grows by as much as it did the last
 * time. A look at that point tells whether it did, without a hash. Corners of two facets that were new points the
 * last time are mostly new again: their places in the table are fetched ahead.
 */
#include "io/loaders/row_table.h"

enum { PERIOD = 6,
       WIDTH = 3 };

static inline const uint8_t *corner_at(const uint8_t *corners, size_t stride, unsigned k)
{
    return corners + k / 3 * stride + k % 3 * WIDTH * WORD;
}

static inline uint32_t half_hash(const e3d_row_numbers *t, const uint8_t *corner)
{
    return e3d_half_of(e3d_hash_row(corner, WIDTH, t->zero, t->seeds));
}

/* Hashes the corners that were not guessed in the two facets before. */
static ALWAYS_INLINE void hash_missed(const e3d_row_numbers *t, const uint8_t *corners, size_t stride, size_t count,
                                      unsigned missed, uint32_t *halves)
{
    for (unsigned j = 0; j < PERIOD; j++) {
        const uint8_t *corner = corner_at(corners, stride, j);
        for (size_t k = j; (missed >> j & 1) && k < count; k += PERIOD, corner += 2 * stride) {
            halves[k] = half_hash(t, corner);
            __builtin_prefetch(e3d_place_of(t, halves[k]), 1);
        }
    }
}

static inline bool same_bits(const uint8_t *a, const uint8_t *b)
{
    uint64_t two[2];
    uint32_t third[2];
    memcpy(&two[0], a, 2 * WORD), memcpy(&two[1], b, 2 * WORD);
    memcpy(&third[0], a + 2 * WORD, WORD), memcpy(&third[1], b + 2 * WORD, WORD);
    return !((two[0] ^ two[1]) | (third[0] ^ third[1]));
}

/* Guesses a corner's number: it grew as much from the corner two facets before as that one's did. Returns -1 if the guess is
 * wrong. */
static ALWAYS_INLINE int32_t guess(const uint8_t *rows, size_t known, const uint8_t *corner, const int32_t *number)
{
    const uint32_t next = 2 * (uint32_t)number[-PERIOD] - (uint32_t)number[-2 * PERIOD];
    return next < known && same_bits(rows + (size_t)next * WIDTH * WORD, corner) ? (int32_t)next : -1;
}

static ALWAYS_INLINE int32_t find(e3d_row_numbers *t, const uint8_t *corner, const uint32_t *half)
{
    return (int32_t)e3d_number_row(t, corner, WIDTH, half ? *half : half_hash(t, corner));
}

size_t e3d_number_regular(e3d_row_numbers *numbered, const uint8_t *corners, size_t stride, size_t count,
                          int32_t *numbers, unsigned *missed)
{
    uint32_t halves[E3D_ROW_BLOCK];
    e3d_row_numbers here = *numbered, *const t = &here;
    const uint8_t *const rows = t->rows; /* the rows do not move, since there is room */
    const unsigned hashed = *missed;
    size_t known = t->count, misses = 0, k = 0;
    hash_missed(t, corners, stride, count, hashed, halves);
    for (; k + PERIOD <= count; k += PERIOD, corners += 2 * stride) {
        *missed = 0;
#pragma GCC unroll 6
        for (unsigned j = 0; j < PERIOD; j++) {
            const uint8_t *const corner = corner_at(corners, stride, j);
            int32_t number = guess(rows, known, corner, numbers + k + j);
            if (__builtin_expect(number < 0, 0)) {
                *missed |= 1u << j;
                misses++;
                number = find(t, corner, hashed >> j & 1 ? &halves[k + j] : NULL);
                known = t->count;
            }
            numbers[k + j] = number;
        }
    }
    for (unsigned j = 0; k + j < count; j++)
        numbers[k + j] = find(t, corner_at(corners, stride, j), NULL);
    numbered->count = t->count;
    return count - misses;
}
