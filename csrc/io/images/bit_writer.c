/* A growing list of bytes to which bits are written, the first bit lowest.
 * Always: after an allocation failed, nothing more is written, and `failed` is set. */
#include <stdlib.h>
#include <string.h>

#include "deflate.h"

static bool has_room(bit_writer *out, size_t count)
{
    if (count <= out->capacity - out->size) {
        return true;
    }
    size_t capacity = out->capacity ? out->capacity : 65536;
    while (capacity - out->size < count && capacity <= SIZE_MAX / 2) {
        capacity *= 2;
    }
    uint8_t *bytes = out->failed ? NULL : realloc(out->bytes, capacity);
    if (bytes == NULL || capacity - out->size < count) {
        out->failed = true;
        return false;
    }
    out->bytes = bytes;
    out->capacity = capacity;
    return true;
}

void writer_bits(bit_writer *out, uint64_t bits, uint32_t count)
{
    out->bits |= bits << out->bit_count;
    out->bit_count += count;
    if (out->bit_count < 32) {
        return;
    }
    if (has_room(out, 4)) {
        for (uint32_t k = 0; k < 4; k++) {
            out->bytes[out->size + k] = (uint8_t)(out->bits >> 8 * k);
        }
        out->size += 4;
    }
    out->bits >>= 32;
    out->bit_count -= 32;
}

void writer_align(bit_writer *out)
{
    while (out->bit_count > 0) {
        if (has_room(out, 1)) {
            out->bytes[out->size++] = (uint8_t)out->bits;
        }
        out->bits >>= 8;
        out->bit_count -= out->bit_count < 8 ? out->bit_count : 8;
    }
}

void writer_bytes(bit_writer *out, const uint8_t *bytes, size_t count)
{
    if (has_room(out, count)) {
        memcpy(out->bytes + out->size, bytes, count);
        out->size += count;
    }
}
