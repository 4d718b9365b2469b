/* Sets of numbers that grow by joining, as an array: each number names one above it, and a root names itself. At first, all do.
 * The method is union-find with path halving (Tarjan and van Leeuwen, 1984), the lesser root staying one. */
#pragma once

#include <stdint.h>

static inline uint32_t e3d_set_of(uint32_t *above, uint32_t number)
{
    while (above[number] != number) {
        above[number] = above[above[number]];
        number = above[number];
    }
    return number;
}

static inline void e3d_join_sets(uint32_t *above, uint32_t a, uint32_t b)
{
    a = e3d_set_of(above, a);
    b = e3d_set_of(above, b);
    above[a < b ? b : a] = a < b ? a : b;
}
