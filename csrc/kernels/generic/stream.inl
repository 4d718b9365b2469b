/* stream: writes rows of pixels to the picture, which this core won't read again. */
#pragma once

#include "base/machine.h"
#include "kernels/types/samples.h"

/* Uses non-temporal stores: plain ones would first read each line from memory, which took 0.4 to 0.7 ms of a frame of 1920 x
 * 1080. Rows that aren't whole vectors are written 16 bytes at a time, or through the caches. */
static void kernel_stream(const e3d_pixel_rows *rows)
{
    char *to = rows->to;
    const char *from = rows->from;
    int whole = !(((uintptr_t)to | rows->pitch | rows->bytes) % sizeof(vi32));
    for (int y = 0; y < rows->count; y++, to += rows->pitch, from += rows->step) {
        if (!whole)
            e3d_stream(to, from, rows->bytes);
        for (size_t at = 0; whole && at < rows->bytes; at += sizeof(vi32))
            v_streami(to + at, v_loadi(from + at));
    }
}
