/* The levels of the picture behind glass: their number, sizes and places in memory (R162). */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { E3D_BEHIND_LEVELS = 12,  /* at most */
       E3D_BEHIND_LEAST = 4,    /* a level this small is the last */
       E3D_BEHIND_CHANNELS = 4 }; /* of a texel: red, green, blue, and a share */

typedef struct e3d_behind_level {
    int32_t width, height;
    size_t first; /* its first float */
} e3d_behind_level;

/* Finds the levels of a picture; returns how many there are. */
static inline int e3d_behind_levels(int32_t width, int32_t height, e3d_behind_level out[E3D_BEHIND_LEVELS])
{
    int count = 1;
    out[0] = (e3d_behind_level){width, height, 0};
    for (; count < E3D_BEHIND_LEVELS && (width > E3D_BEHIND_LEAST || height > E3D_BEHIND_LEAST); count++) {
        size_t before = out[count - 1].first + E3D_BEHIND_CHANNELS * (size_t)width * (size_t)height;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
        out[count] = (e3d_behind_level){width, height, before};
    }
    return count;
}

/* How many floats all levels have. */
static inline size_t e3d_behind_size(int32_t width, int32_t height)
{
    e3d_behind_level levels[E3D_BEHIND_LEVELS];
    const e3d_behind_level *last = &levels[e3d_behind_levels(width, height, levels) - 1];
    return last->first + E3D_BEHIND_CHANNELS * (size_t)last->width * (size_t)last->height;
}
