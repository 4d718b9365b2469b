/* Arrays that grow: room is doubled, and not given back before the owner dies, so that a steady frame allocates nothing. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/large_pages.h"

typedef struct e3d_array {
    void *data;
    size_t count, room; /* elements */
} e3d_array;

/* Makes room for `wanted` elements; 0 when memory is out, and then the array stays as it was. */
static inline int e3d_array_reserve(e3d_array *array, size_t wanted, size_t size)
{
    if (wanted <= array->room)
        return 1;
    size_t room = array->room ? array->room : 64;
    while (room < wanted && room <= SIZE_MAX / 2)
        room *= 2;
    if (room < wanted || room > SIZE_MAX / size)
        return 0;
    void *data;
    if (room * size < E3D_LARGE_ROOM) {
        data = realloc(array->data, room * size);
    } else if ((data = e3d_large_memory(room * size)) && array->data) {
        memcpy(data, array->data, array->room * size);
        free(array->data);
    }
    if (!data)
        return 0;
    array->data = data;
    array->room = room;
    return 1;
}

static inline void e3d_array_swap(e3d_array *a, e3d_array *b)
{
    e3d_array kept = *a;
    *a = *b;
    *b = kept;
}

static inline void e3d_array_free(e3d_array *array)
{
    free(array->data);
    array->data = NULL;
    array->count = array->room = 0;
}
