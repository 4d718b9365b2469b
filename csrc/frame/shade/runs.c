/* shade: sorts runs by their owners, so that each primitive is met once, and the primitives of a cluster follow each other. */
#include <string.h>

#include "frame/shade/runs.h"
#include "kernels/types/visible.h"

enum { FEW = 24,
       MOST_BITS = 8,
       PARTS = 4 };

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

/* The lowest digit of the differing bits. These are cut into as few digits as possible, and then as short ones. */
static digit next_digit(uint32_t differ)
{
    int shift = __builtin_ctz(differ), span = 32 - __builtin_clz(differ) - shift;
    int digits = (span + MOST_BITS - 1) / MOST_BITS;
    return (digit){shift, (span + digits - 1) / digits};
}

static inline uint32_t digit_of(const e3d_run *run, digit d) { return (uint32_t)run->owner >> d.shift & ((1u << d.bits) - 1); }

/* Turns counts into places: each is preceded by the sum of those before it. All four counters of a value lie in one word. */
static void place(uint16_t next[][PARTS], uint32_t values)
{
    const uint64_t each = 0x0001000100010001;
    uint64_t first = 0, here;
    _Static_assert(sizeof *next == sizeof here, "a value's counts are a word");
    for (uint32_t v = 0; v < values; v++) {
        memcpy(&here, next[v], sizeof here);
        uint64_t sums = here * each, before = first + (sums - here);
        memcpy(next[v], &before, sizeof before);
        first += (sums >> 48) * each;
    }
}

/* Sorts by one digit. Neighbours often have the same digit, and each would wait for its counter; so four parts of the runs take
 * turns, each with counters of its own. */
static void sort_by_digit(const e3d_run *from, e3d_run *to, int32_t count, digit d)
{
    uint16_t next[1 << MOST_BITS][PARTS];
    uint32_t values = 1u << d.bits;
    int32_t part = count / PARTS;
    memset(next, 0, values * sizeof *next);
    for (int32_t i = 0; i < part; i++)
        for (int p = 0; p < PARTS; p++)
            next[digit_of(&from[p * part + i], d)][p]++;
    for (int32_t i = PARTS * part; i < count; i++)
        next[digit_of(&from[i], d)][PARTS - 1]++;
    place(next, values);
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

/* Turns sorted runs into primitives. The runs of an owner are neighbours. (There is no branch, since where an owner begins is
 * unpredictable.) */
void e3d_show_runs(const e3d_run *runs, int32_t count, e3d_shown *out)
{
    int32_t primitives = 0, before = E3D_NO_SLOT;
    for (int32_t i = 0; i < count; i++) {
        int32_t owner = runs[i].owner;
        out->primitive[primitives] = (e3d_shown_primitive){(uint32_t)owner, i};
        primitives += owner != before;
        before = owner;
        out->sample[i] = runs[i].sample | runs[i].length << E3D_RUN_LENGTH;
        out->of[i] = primitives - 1;
    }
    out->runs = 1;
    out->pattern = NULL;
    out->at_samples = 0;
    out->count = count;
    out->primitives = primitives;
}
