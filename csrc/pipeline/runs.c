/* shade: runs sorted by what they are of, so that each piece is met once, and pieces of a cluster one after the other. */
#include <string.h>

#include "pipeline/frame.h"

enum { FEW = 24, MOST_BITS = 8, PARTS = 4 };

typedef struct digit {
    int shift, bits;
} digit;

static uint32_t bits_that_differ(const e3d_run *runs, int32_t count)
{
    uint32_t differ = 0;
    for (int32_t i = 1; i < count; i++)
        differ |= (uint32_t)(runs[i].owner ^ runs[0].owner);
    return differ;
}

static void sort_few(e3d_run *runs, int32_t count)
{
    for (int32_t i = 1; i < count; i++) {
        e3d_run run = runs[i];
        int32_t at = i;
        for (; at > 0 && runs[at - 1].owner > run.owner; at--)
            runs[at] = runs[at - 1];
        runs[at] = run;
    }
}

/* The lowest digit of those, as few and then as short as will do, that the bits are cut into. */
static digit next_digit(uint32_t differ)
{
    int shift = __builtin_ctz(differ), span = 32 - __builtin_clz(differ) - shift;
    int digits = (span + MOST_BITS - 1) / MOST_BITS;
    return (digit){shift, (span + digits - 1) / digits};
}

static inline uint32_t digit_of(const e3d_run *run, digit d) { return (uint32_t)run->owner >> d.shift & ((1u << d.bits) - 1); }

/* Neighbours often have the same digit, whose counter then is waited for: so parts of the runs take turns, each with
 * counters of its own. */
static void sort_by_digit(const e3d_run *from, e3d_run *to, int32_t count, digit d)
{
    uint16_t next[1 << MOST_BITS][PARTS];
    uint32_t first = 0, values = 1u << d.bits;
    int32_t part = count / PARTS;
    memset(next, 0, values * sizeof *next);
    for (int32_t i = 0; i < part; i++)
        for (int p = 0; p < PARTS; p++)
            next[digit_of(&from[p * part + i], d)][p]++;
    for (int32_t i = PARTS * part; i < count; i++)
        next[digit_of(&from[i], d)][PARTS - 1]++;
    for (uint32_t v = 0; v < values; v++)
        for (int p = 0; p < PARTS; p++) {
            uint32_t here = next[v][p];
            next[v][p] = (uint16_t)first;
            first += here;
        }
    for (int32_t i = 0; i < part; i++)
        for (int p = 0; p < PARTS; p++)
            to[next[digit_of(&from[p * part + i], d)][p]++] = from[p * part + i];
    for (int32_t i = PARTS * part; i < count; i++)
        to[next[digit_of(&from[i], d)][PARTS - 1]++] = from[i];
}

e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count)
{
    uint32_t differ = bits_that_differ(runs, count);
    if (differ && count <= FEW) {
        sort_few(runs, count);
        return runs;
    }
    while (differ) {
        digit d = next_digit(differ);
        sort_by_digit(runs, spare, count, d);
        e3d_run *sorted = spare;
        spare = runs;
        runs = sorted;
        differ &= ~(((1u << d.bits) - 1) << d.shift);
    }
    return runs;
}
