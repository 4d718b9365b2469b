/* Fuzzes the writing of PNG files: read again, a file gives the pixels, and its checksums are right.
 *
 * In:  a byte each: width, height, gap between rows; then pixels, again and again until all have some.
 * The targets are built with small windows and blocks (io/images/deflate.h), which few pixels fill.
 */
#include "check/fuzz/inflate.h"
#include "check/fuzz/input.h"
#include "e3d_images.h"
#include "io/images/deflate.h"

enum { PIXEL = 4,
       HEADER = 33,
       CHUNK = 12,
       MOST_COLUMNS = 63,
       MOST_PIXELS = 192 };

static uint32_t big_endian(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static uint32_t crc_of(const uint8_t *bytes, size_t count)
{
    static uint32_t table[256];
    for (uint32_t k = 0; k < 256 && !table[255]; k++) {
        table[k] = k;
        for (int bit = 0; bit < 8; bit++)
            table[k] = table[k] >> 1 ^ (table[k] & 1 ? 0xEDB88320u : 0);
    }
    uint32_t rest = 0xFFFFFFFFu;
    for (size_t k = 0; k < count; k++)
        rest = rest >> 8 ^ table[(rest ^ bytes[k]) & 255];
    return ~rest;
}

static uint32_t adler_of(const uint8_t *bytes, size_t count)
{
    uint32_t low = 1, high = 0;
    for (size_t k = 0; k < count; k++) {
        low = (low + bytes[k]) % 65521;
        high = (high + low) % 65521;
    }
    return high << 16 | low;
}

/* Claims that a chunk is sound; returns what is in it, and how much. */
static const uint8_t *open_chunk(const uint8_t *at, const uint8_t *end, const char *name, size_t *length)
{
    CLAIM(end - at >= CHUNK);
    *length = big_endian(at);
    CLAIM((size_t)(end - at) >= CHUNK + *length && memcmp(at + 4, name, 4) == 0);
    CLAIM(big_endian(at + 8 + *length) == crc_of(at + 4, 4 + *length));
    return at + 8;
}

static int distance(int a, int b) { return a < b ? b - a : a - b; }

static uint8_t predicted(int type, int left, int up, int corner)
{
    const int guess = left + up - corner;
    const int a = distance(guess, left), b = distance(guess, up), c = distance(guess, corner);
    switch (type) {
    case 0: return 0;
    case 1: return (uint8_t)left;
    case 2: return (uint8_t)up;
    case 3: return (uint8_t)((left + up) / 2);
    default: return (uint8_t)(a <= b && a <= c ? left : b <= c ? up
                                                               : corner);
    }
}

/* Takes the predictions back, in place; claims that the rows are the pixels. */
static void claim_rows(uint8_t *rows, const uint8_t *pixels, size_t width, size_t height, size_t stride)
{
    const size_t count = PIXEL * width;
    for (size_t y = 0; y < height; y++, rows += 1 + count, pixels += stride) {
        const uint8_t *above = rows - (y ? 1 + count : 0);
        CLAIM(rows[0] <= 4);
        for (size_t k = 1; k <= count; k++) {
            const int left = k > PIXEL ? rows[k - PIXEL] : 0, up = y ? above[k] : 0;
            const int corner = y && k > PIXEL ? above[k - PIXEL] : 0;
            rows[k] = (uint8_t)(rows[k] + predicted(rows[0], left, up, corner));
        }
        CLAIM(memcmp(rows + 1, pixels, count) == 0);
    }
}

static void claim_file(const uint8_t *file, size_t size, const uint8_t *pixels, size_t width, size_t height,
                       size_t stride)
{
    const uint8_t *const end = file + size;
    size_t length;
    const uint8_t *chunk = open_chunk(file + 8, end, "IHDR", &length);
    CLAIM(length == 13 && big_endian(chunk) == width && big_endian(chunk + 4) == height);
    chunk = open_chunk(file + HEADER, end, "IDAT", &length);
    const size_t count = height * (1 + PIXEL * width);
    uint8_t *rows = room_for(count, 1);
    CLAIM(length > 6 && ((unsigned)chunk[0] << 8 | chunk[1]) % 31 == 0);
    CLAIM(inflate_stream(chunk + 2, length - 6, rows, count, DEFLATE_WINDOW) == length - 6);
    CLAIM(big_endian(chunk + length - 4) == adler_of(rows, count));
    claim_rows(rows, pixels, width, height, stride);
    free(rows);
    open_chunk(chunk + length + 4, end, "IEND", &length);
    CLAIM(length == 0 && chunk + big_endian(file + HEADER) + 4 + CHUNK == end);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const size_t width = 1 + (size_t)take_below(&in, MOST_COLUMNS);
    const size_t height = 1 + take_byte(&in) % (MOST_PIXELS / width);
    const size_t row = PIXEL * width, stride = row + (size_t)take_below(&in, 7);
    uint8_t *pixels = room_for(stride * (height - 1) + row, 1), *file = NULL;
    for (size_t k = 0; k < stride * (height - 1) + row; k++)
        pixels[k] = in.left ? in.at[k % in.left] : 0;
    CLAIM(e3d_png_encode(pixels, (int32_t)width, (int32_t)height, (ptrdiff_t)stride, PIXEL, 8, &file, &size));
    claim_file(file, size, pixels, width, height, stride);
    free(file);
    free(pixels);
    return 0;
}
