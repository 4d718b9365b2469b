/* shade: runs sorted by what they are of, so that each piece is met once, and pieces of a cluster one after the other. */
#include "pipeline/frame.h"

enum { FEW = 24, DIGIT = 8, DIGITS = 1 << DIGIT, PARTS = 4 };

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

static inline uint32_t digit_of(const e3d_run *run, int shift) { return (uint32_t)run->owner >> shift & (DIGITS - 1); }

/* Neighbours often have the same digit, whose counter then is waited for: so parts of the runs take turns, each with
 * counters of its own. */
static void sort_by_digit(const e3d_run *from, e3d_run *to, int32_t count, int shift)
{
    uint16_t next[PARTS][DIGITS] = {{0}};
    int32_t part = count / PARTS;
    for (int32_t i = 0; i < part; i++)
        for (int p = 0; p < PARTS; p++)
            next[p][digit_of(&from[p * part + i], shift)]++;
    for (int32_t i = PARTS * part; i < count; i++)
        next[PARTS - 1][digit_of(&from[i], shift)]++;
    for (uint32_t d = 0, first = 0; d < DIGITS; d++)
        for (int p = 0; p < PARTS; p++) {
            uint32_t here = next[p][d];
            next[p][d] = (uint16_t)first;
            first += here;
        }
    for (int32_t i = 0; i < part; i++)
        for (int p = 0; p < PARTS; p++)
            to[next[p][digit_of(&from[p * part + i], shift)]++] = from[p * part + i];
    for (int32_t i = PARTS * part; i < count; i++)
        to[next[PARTS - 1][digit_of(&from[i], shift)]++] = from[i];
}

const e3d_run *e3d_sort_runs(e3d_run *runs, e3d_run *spare, int32_t count)
{
    uint32_t differ = bits_that_differ(runs, count);
    if (differ && count <= FEW) {
        sort_few(runs, count);
        return runs;
    }
    while (differ) {
        int shift = __builtin_ctz(differ);
        sort_by_digit(runs, spare, count, shift);
        e3d_run *sorted = spare;
        spare = runs;
        runs = sorted;
        differ &= ~((uint32_t)(DIGITS - 1) << shift);
    }
    return runs;
}
