/* Scan lines of Radiance pictures (.hdr): plain pixels, with runs of the old kind, or channel by channel with the new kind.
 *
 * In:  the bytes behind the header. A line of the new kind begins with 2, 2 and its width, which is 8 to 32767.
 * Out: four bytes a pixel: red, green, blue and a common exponent.
 * Source: Ward, Real Pixels, Graphics Gems II, 1991, and the format as Radiance's color.c reads it.
 */
#include <string.h>

#include "e3d_images.h"

typedef struct reader {
    const uint8_t *data;
    size_t length, at;
    e3d_rgbe_fault fault;
} reader;

static bool fail(reader *r, e3d_rgbe_fault fault)
{
    r->fault = fault;
    return false;
}

static bool has(reader *r, size_t count) { return r->length - r->at >= count || fail(r, E3D_RGBE_CUT_SHORT); }

/* Reads one channel of a line: runs (head > 128) of one byte, and stretches of literal bytes. */
static bool read_channel(reader *r, size_t width, uint8_t *to)
{
    for (size_t x = 0; x < width;) {
        if (!has(r, 2))
            return false;
        size_t head = r->data[r->at], count = head > 128 ? head - 128 : head;
        if (count == 0 || count > width - x)
            return fail(r, E3D_RGBE_RUN_TOO_LONG);
        if (head <= 128 && !has(r, 1 + count))
            return false;
        for (size_t k = 0; k < count; k++)
            to[4 * (x + k)] = r->data[r->at + 1 + (head > 128 ? 0 : k)];
        r->at += head > 128 ? 2 : 1 + count;
        x += count;
    }
    return true;
}

/* Reads literal pixels; 1, 1, 1, n repeats the last pixel n times, and another one right behind it 256 n times, and so on. */
static bool read_pixels(reader *r, size_t width, uint8_t *to)
{
    int shift = 0;
    for (size_t x = 0; x < width; r->at += 4) {
        if (!has(r, 4))
            return false;
        const uint8_t *from = r->data + r->at;
        if (from[0] != 1 || from[1] != 1 || from[2] != 1) {
            memcpy(to + 4 * x++, from, 4);
            shift = 0;
            continue;
        }
        size_t count = shift < 32 ? (size_t)from[3] << shift : width;
        if (x == 0)
            return fail(r, E3D_RGBE_NOTHING_TO_REPEAT);
        if (count > width - x)
            return fail(r, E3D_RGBE_RUN_TOO_LONG);
        for (; count > 0; count--, x++)
            memcpy(to + 4 * x, to + 4 * (x - 1), 4);
        shift += 8;
    }
    return true;
}

static bool read_line(reader *r, size_t width, uint8_t *to)
{
    const uint8_t *head = r->data + r->at;
    bool is_new = r->length - r->at >= 4 && head[0] == 2 && head[1] == 2 && head[2] < 128;
    if (!is_new || width < 8 || width > 0x7FFF)
        return read_pixels(r, width, to);
    if (((size_t)head[2] << 8 | head[3]) != width)
        return fail(r, E3D_RGBE_OTHER_WIDTH);
    r->at += 4;
    for (int channel = 0; channel < 4; channel++)
        if (!read_channel(r, width, to + channel))
            return false;
    return true;
}

size_t e3d_rgbe_unpack(const uint8_t *data, size_t length, int32_t width, size_t lines, uint8_t *pixels, size_t *used,
                       e3d_rgbe_fault *fault)
{
    reader r = {data, length, 0, E3D_RGBE_WHOLE};
    size_t done = 0, row = 4 * (size_t)width;
    while (done < lines && read_line(&r, (size_t)width, pixels + done * row))
        done++;
    *used = r.at;
    *fault = r.fault;
    return done;
}
