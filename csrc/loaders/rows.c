/* Equal rows of a table, found with a hash table that grows with the rows that differ.
 *
 * In:  rows of words. Out: the number of each row, in the order of their first appearance.
 * Always: the numbers do not depend on the hash, which a number drawn at random starts: nobody can write
 *      a file whose rows all fall into one place.
 */
#include "e3d_loaders.h"

#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

#define FIRST_ROOM ((size_t)1 << 10)

typedef struct table {
    const uint32_t *rows;
    size_t width;
    uint32_t minus_zero; /* the word that counts as 0; 0 if none does */
    uint64_t seed;
    size_t mask;     /* places - 1 */
    uint32_t *place; /* number + 1; 0 for none */
    size_t count;    /* numbers */
} table;

static inline uint32_t word_of(const table *t, uint32_t word)
{
    return word == t->minus_zero ? 0 : word;
}

static inline uint64_t mixed(uint64_t a, uint64_t b)
{
    const unsigned __int128 product = (unsigned __int128)a * b;
    return (uint64_t)product ^ (uint64_t)(product >> 64);
}

static inline uint64_t hash_of(const table *t, size_t row)
{
    const uint32_t *words = t->rows + row * t->width;
    uint64_t hash = t->seed;
    for (size_t i = 0; i < t->width; i += 2) {
        uint64_t pair = word_of(t, words[i]);
        if (i + 1 < t->width)
            pair |= (uint64_t)word_of(t, words[i + 1]) << 32;
        hash = mixed(hash ^ pair, t->seed | 1) + UINT64_C(0x9E3779B97F4A7C15);
    }
    return mixed(hash, UINT64_C(0xD6E8FEB86659FD93));
}

static inline bool are_equal(const table *t, size_t row, size_t other)
{
    const uint32_t *a = t->rows + row * t->width, *b = t->rows + other * t->width;
    for (size_t i = 0; i < t->width; i++)
        if (word_of(t, a[i]) != word_of(t, b[i]))
            return false;
    return true;
}

static bool grow(table *t, const int32_t *first)
{
    const size_t room = t->place ? 2 * (t->mask + 1) : FIRST_ROOM;
    uint32_t *place = calloc(room, sizeof *place);
    if (!place)
        return false;
    free(t->place);
    t->place = place;
    t->mask = room - 1;
    for (size_t number = 0; number < t->count; number++) {
        size_t at = hash_of(t, (size_t)first[number]) & t->mask;
        while (place[at])
            at = (at + 1) & t->mask;
        place[at] = (uint32_t)number + 1;
    }
    return true;
}

static uint64_t random_seed(void)
{
    uint64_t seed;
    if (getrandom(&seed, sizeof seed, GRND_NONBLOCK) != (ssize_t)sizeof seed)
        seed = (uint64_t)time(NULL) * UINT64_C(0x9E3779B97F4A7C15) ^ (uintptr_t)&seed;
    return seed;
}

size_t e3d_number_rows(const uint32_t *rows, size_t count, size_t width, bool are_floats,
                       int32_t *numbers, int32_t *first)
{
    table t = {.rows = rows, .width = width, .seed = random_seed()};
    t.minus_zero = are_floats ? UINT32_C(0x80000000) : 0;
    bool done = grow(&t, first);
    for (size_t row = 0; done && row < count; row++) {
        size_t at = hash_of(&t, row) & t.mask;
        while (t.place[at] && !are_equal(&t, row, (size_t)first[t.place[at] - 1]))
            at = (at + 1) & t.mask;
        if (!t.place[at]) {
            first[t.count] = (int32_t)row;
            t.place[at] = (uint32_t)++t.count;
        }
        numbers[row] = (int32_t)t.place[at] - 1;
        /* At most half full. */
        if (2 * t.count > t.mask)
            done = grow(&t, first);
    }
    free(t.place);
    return done ? t.count : SIZE_MAX;
}
