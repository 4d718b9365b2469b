/* The hash table of rows that differ: where a row's number stands, and a new row's is put.
 *
 * A place is eight bytes: a number, and the upper half of its row's hash, whose first bits choose the place. So other
 * rows are hardly ever read for nothing, and a table grows without a look at its rows.
 */
#ifndef E3D_LOADERS_ROW_TABLE_H
#define E3D_LOADERS_ROW_TABLE_H

#include "loaders/rows.h"

/* Rows that are looked for together; those of two facets twice at least. */
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
#define E3D_ROW_BLOCK 192
#else
#define E3D_ROW_BLOCK 12 /* a few hundred bytes fill several */
#endif

/* A place is half a hash, never 0, and above it the number; 0 if it is empty. */
struct e3d_row_numbers {
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
};

static inline uint32_t e3d_half_of(uint64_t hash) { return (uint32_t)(hash >> 32) | 1; }

static inline size_t e3d_place_of(const e3d_row_numbers *t, uint32_t half) { return (size_t)half >> t->shift; }

static inline size_t e3d_next_place(const e3d_row_numbers *t, size_t place) { return (place + 1) & (t->size - 1); }

/* The number of a row, which may be new. */
static ALWAYS_INLINE uint32_t e3d_number_row(e3d_row_numbers *t, const uint8_t *row, size_t width, uint32_t half)
{
    for (size_t place = e3d_place_of(t, half);; place = e3d_next_place(t, place)) {
        const uint64_t entry = t->places[place];
        const uint32_t number = (uint32_t)(entry >> 32);
        if ((uint32_t)entry == half && e3d_same_rows(t->rows + (size_t)number * width * WORD, row, width, t->zero))
            return number;
        if (!entry) {
            memcpy(t->rows + t->count * width * WORD, row, width * WORD);
            t->places[place] = (uint64_t)t->count << 32 | half;
            return (uint32_t)t->count++;
        }
    }
}

/* Numbers the corners of facets, three floats each, that go on as those before them: regular_facets.c. `numbers` follow
 * those of four facets at least; there is room for `count` new ones, up to E3D_ROW_BLOCK. Returns how many went on so.
 * `missed`: a bit for each corner of two facets that did not, 0 in the beginning. */
size_t e3d_number_regular(e3d_row_numbers *t, const uint8_t *corners, size_t stride, size_t count, int32_t *numbers,
                          unsigned *missed);

#endif
