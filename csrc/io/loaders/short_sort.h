/* Sorting many short lists: by insertion up to so many items, for which the calls of qsort would take longer. */
#pragma once

#include <stddef.h>
#include <stdlib.h>

/* Defines a function that sorts items of a type, with a comparison as for qsort. */
#define E3D_DEFINE_SHORT_SORT(name, type, compare, most) \
    static void name(type *items, size_t count) \
    { \
        if (count > (most)) { \
            qsort(items, count, sizeof *items, compare); \
            return; \
        } \
        for (size_t i = 1; i < count; i++) { \
            const type one = items[i]; \
            size_t k = i; \
            for (; k > 0 && compare(&items[k - 1], &one) > 0; k--) \
                items[k] = items[k - 1]; \
            items[k] = one; \
        } \
    }
