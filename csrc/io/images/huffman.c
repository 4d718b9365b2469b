/* Prefix codes of least length, limited to a number of bits.
 * In: how often each symbol occurs. Out: lengths and bits of the canonical code.
 * Always: integers; ties go by the symbol's number, so that the same frequencies give the same code.
 * Sources: van Leeuwen 1976 (two queues); ITU-T T.81, K.2 (limiting the length); RFC 1951, 3.2.2. */
#include "huffman.h"

#include <stdlib.h>
#include <string.h>

#define SYMBOL_BITS 9
#define SYMBOL_MASK ((1u << SYMBOL_BITS) - 1u)

static int compare(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a;
    const uint32_t y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Sorts the symbols that occur, the rarest first; a word holds frequency and symbol. */
static int32_t sort_symbols(uint32_t *sorted, const uint32_t *frequency, int32_t count)
{
    int32_t used = 0;
    for (int32_t symbol = 0; symbol < count; symbol++) {
        if (frequency[symbol] > 0) {
            sorted[used++] = frequency[symbol] << SYMBOL_BITS | (uint32_t)symbol;
        }
    }
    for (int32_t symbol = 0; used < 2; symbol++) {
        if (frequency[symbol] == 0) {
            sorted[used++] = 1u << SYMBOL_BITS | (uint32_t)symbol;
        }
    }
    qsort(sorted, (size_t)used, sizeof *sorted, compare);
    return used;
}

/* Joins the two rarest trees until one is left; then counts the leaves at each depth. */
static void count_depths(const uint32_t *sorted, int32_t used, int32_t *at_depth)
{
    uint32_t weight[HUFFMAN_MAX_SYMBOLS];
    int32_t parent[2 * HUFFMAN_MAX_SYMBOLS]; /* leaves, and then the trees in the order in which they are made */
    int32_t depth[HUFFMAN_MAX_SYMBOLS];
    int32_t leaf = 0;
    int32_t tree = 0;
    for (int32_t made = 0; made < used - 1; made++) {
        weight[made] = 0;
        for (int32_t child = 0; child < 2; child++) {
            const uint32_t leaf_weight = leaf < used ? sorted[leaf] >> SYMBOL_BITS : UINT32_MAX;
            if (tree == made || leaf_weight <= weight[tree]) {
                weight[made] += leaf_weight;
                parent[leaf++] = made;
            } else {
                weight[made] += weight[tree];
                parent[used + tree++] = made;
            }
        }
    }
    memset(at_depth, 0, HUFFMAN_MAX_SYMBOLS * sizeof *at_depth);
    depth[used - 2] = 0;
    for (int32_t k = used - 3; k >= 0; k--) {
        depth[k] = depth[parent[used + k]] + 1;
    }
    for (int32_t k = 0; k < used; k++) {
        at_depth[depth[parent[k]] + 1]++;
    }
}

/* Lifts leaves that lie too deep: a pair's sibling takes the pair's place one level up, and the other one goes beside a leaf,
 * which moves one level down. */
static void limit_depths(int32_t *at_depth, int32_t limit)
{
    for (int32_t deep = HUFFMAN_MAX_SYMBOLS - 1; deep > limit; deep--) {
        while (at_depth[deep] > 0) {
            int32_t shallow = deep - 2;
            while (at_depth[shallow] == 0) {
                shallow--;
            }
            at_depth[deep] -= 2;
            at_depth[deep - 1]++;
            at_depth[shallow + 1] += 2;
            at_depth[shallow]--;
        }
    }
}

static uint16_t reversed(uint32_t bits, int32_t length)
{
    uint32_t result = 0;
    for (int32_t k = 0; k < length; k++) {
        result = result << 1 | (bits >> k & 1u);
    }
    return (uint16_t)result;
}

/* Numbers the codes of each length in the order of their symbols. */
static void number_codes(huffman_code *code, const int32_t *at_depth, int32_t count)
{
    uint32_t next[HUFFMAN_MAX_LENGTH + 1] = {0};
    for (int32_t length = 1; length <= HUFFMAN_MAX_LENGTH; length++) {
        const uint32_t shorter = length > 1 ? (uint32_t)at_depth[length - 1] : 0u;
        next[length] = (next[length - 1] + shorter) << 1;
    }
    for (int32_t symbol = 0; symbol < count; symbol++) {
        const int32_t length = code->length[symbol];
        code->bits[symbol] = length ? reversed(next[length]++, length) : 0;
    }
}

void huffman_make(huffman_code *code, const uint32_t *frequency, int32_t count, int32_t limit)
{
    uint32_t sorted[HUFFMAN_MAX_SYMBOLS];
    int32_t at_depth[HUFFMAN_MAX_SYMBOLS];
    const int32_t used = sort_symbols(sorted, frequency, count);
    count_depths(sorted, used, at_depth);
    limit_depths(at_depth, limit);
    memset(code, 0, sizeof *code);
    int32_t next = used;
    for (int32_t length = 1; length <= limit; length++) {
        for (int32_t k = 0; k < at_depth[length]; k++) {
            code->length[sorted[--next] & SYMBOL_MASK] = (uint8_t)length;
        }
    }
    number_codes(code, at_depth, count);
}
