/* The hash table of rows that differ: where a row's number stands, and a new row's is put.
 *
 * A place is four bytes, most of them empty: lines of the cache hold sixteen, and a row is mostly found, or missed, in
 * the first that is looked at. Below its number a place has bits of the row's hash, so that other rows are hardly ever
 * read for nothing.
 */
#pragma once

#include "io/loaders/row_hash.h"

/* So many rows are looked up together: at least twice those of two facets. */
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
#define E3D_ROW_BLOCK 192
#else
#define E3D_ROW_BLOCK 12 /* small, so that a few hundred bytes fill several blocks */
#endif

/* A place is 0 if it is empty; else a number + 1, and in the `tag_bits` below it the lowest of half a hash, whose highest
 * bits choose the place. Whoever numbers many rows does so with a copy of this: nothing that is written can be part of
 * it, and it stays in registers. */
struct e3d_row_numbers {
    uint32_t *places;
    size_t size; /* places */
    int tag_bits;
    uint8_t *rows; /* [count * width] the words of the distinct rows */
    size_t room;   /* rows */
    size_t width;  /* words of a row */
    size_t count;  /* numbers */
    size_t taken;  /* how many rows were numbered */
    uint32_t zero;
    e3d_row_seeds seeds;
};

static inline uint32_t e3d_half_of(uint64_t hash) { return (uint32_t)(hash >> 32); }

static inline uint32_t *e3d_place_of(const e3d_row_numbers *t, uint32_t half)
{
    return &t->places[(uint64_t)half * t->size >> 32];
}

static inline uint32_t *e3d_next_place(const e3d_row_numbers *t, uint32_t *place)
{
    return place + 1 == t->places + t->size ? t->places : place + 1;
}

static inline uint32_t e3d_tag_of(const e3d_row_numbers *t, uint32_t half)
{
    return half & ((UINT32_C(1) << t->tag_bits) - 1);
}

static inline uint32_t e3d_entry_of(const e3d_row_numbers *t, size_t number, uint32_t half)
{
    return (uint32_t)(number + 1) << t->tag_bits | e3d_tag_of(t, half);
}

/* Returns the number of a row, which may be new. */
static ALWAYS_INLINE uint32_t e3d_number_row(e3d_row_numbers *t, const uint8_t *row, size_t width, uint32_t half)
{
    for (uint32_t *place = e3d_place_of(t, half);; place = e3d_next_place(t, place)) {
        const uint32_t entry = *place, number = (entry >> t->tag_bits) - 1;
        if (!entry) {
            memcpy(t->rows + t->count * width * WORD, row, width * WORD);
            *place = e3d_entry_of(t, t->count, half);
            return (uint32_t)t->count++;
        }
        if (__builtin_expect(e3d_tag_of(t, entry ^ half) == 0, 1) &&
            __builtin_expect(e3d_same_rows(t->rows + (size_t)number * width * WORD, row, width, t->zero), 1))
            return number;
    }
}

/* Numbers the corners of facets, three floats each, that continue regularly: regular_facets.c. The numbers of at least four
 * facets precede `numbers`; there is room for `count` new ones, up to E3D_ROW_BLOCK. Returns how many corners continued
 * regularly. `missed`: a bit for each corner of two facets that did not; 0 at first. */
size_t e3d_number_regular(e3d_row_numbers *numbered, const uint8_t *corners, size_t stride, size_t count,
                          int32_t *numbers, unsigned *missed);
