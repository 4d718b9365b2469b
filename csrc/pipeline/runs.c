/* shade: runs sorted by what they are of, so that each piece is met once, and pieces of a cluster one after the other. */
#include "pipeline/frame.h"

enum { FEW = 24, DIGIT = 8, DIGITS = 1 << DIGIT };

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

static void sort_by_digit(const e3d_run *from, e3d_run *to, int32_t count, int shift)
{
    uint16_t next[DIGITS] = {0};
    for (int32_t i = 0; i < count; i++)
        next[(uint32_t)from[i].owner >> shift & (DIGITS - 1)]++;
    for (uint32_t d = 0, first = 0; d < DIGITS; d++) {
        uint32_t here = next[d];
        next[d] = (uint16_t)first;
        first += here;
    }
    for (int32_t i = 0; i < count; i++)
        to[next[(uint32_t)from[i].owner >> shift & (DIGITS - 1)]++] = from[i];
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
