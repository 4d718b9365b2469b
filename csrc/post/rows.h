/* Rows and columns of pictures that are filtered: beyond the edge, the one at the edge counts. */
#pragma once

#include <stdint.h>

static inline int32_t within(int32_t i, int32_t side)
{
    i = i > 0 ? i : 0;
    return i < side - 1 ? i : side - 1;
}
