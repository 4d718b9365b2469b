/* PNG files of RGBA, RGB or grey pixels, of 8 or 16 bits a channel.
 *
 * In:  rows of pixels.
 * Out: signature, header, one chunk of compressed rows, end.
 * Method: each row is stored as differences from what its neighbours predict, with whichever of the
 * predictions leaves the smallest differences in sum.
 * Source: Portable Network Graphics (PNG) Specification, W3C, sections 5, 9 and 12.7.
 */
#include <stdlib.h>
#include <string.h>

#include "base/always_inline.h"
#include "deflate.h"
#include "e3d_images.h"

#define RGBA 4 /* bytes of a pixel of 8 bits a channel */
#define ADLER_MODULUS 65521u
#define ADLER_SUMMANDS 5552 /* the most bytes before the sums could overflow 32 bits */
#define CRC_POLYNOMIAL 0xEDB88320u

typedef enum filter { SUB = 1,
                      UP = 2,
                      AVERAGE = 3,
                      PAETH = 4 } filter;

/* Filters. A pixel has 1 to 8 bytes, a constant for the compiler where that matters. So many zeros precede a row, so that
 * every byte has a left neighbour. */

static inline uint8_t paeth(int16_t left, int16_t up, int16_t corner)
{
    const int16_t toward_up = (int16_t)(up - corner);
    const int16_t toward_left = (int16_t)(left - corner);
    const int16_t toward_both = (int16_t)(toward_up + toward_left);
    const int16_t from_left = toward_up < 0 ? (int16_t)-toward_up : toward_up;
    const int16_t from_up = toward_left < 0 ? (int16_t)-toward_left : toward_left;
    const int16_t from_corner = toward_both < 0 ? (int16_t)-toward_both : toward_both;
    const int16_t other = from_up <= from_corner ? up : corner;
    const int16_t least = from_up <= from_corner ? from_up : from_corner;
    return (uint8_t)(from_left <= least ? left : other);
}

static ALWAYS_INLINE uint8_t difference(const uint8_t *row, const uint8_t *above, int pixel, filter type)
{
    const uint8_t left = row[-pixel];
    switch (type) {
    case SUB:
        return (uint8_t)(*row - left);
    case UP:
        return (uint8_t)(*row - *above);
    case AVERAGE:
        return (uint8_t)(*row - ((left + *above) >> 1));
    default:
        return (uint8_t)(*row - paeth(left, *above, above[-pixel]));
    }
}

/* The sum of the differences' magnitudes, each as a signed byte. */
static ALWAYS_INLINE uint32_t cost_of(const uint8_t *row, const uint8_t *above, size_t count, int pixel, filter type)
{
    uint32_t sum = 0;
    for (size_t k = 0; k < count; k++) {
        const uint8_t up = difference(row + k, above + k, pixel, type);
        const uint8_t down = (uint8_t)-up;
        sum += up < down ? up : down;
    }
    return sum;
}

static ALWAYS_INLINE filter cheapest_filter(const uint8_t *row, const uint8_t *above, size_t count, int pixel)
{
    const uint32_t cost[] = {
        cost_of(row, above, count, pixel, SUB),
        cost_of(row, above, count, pixel, UP),
        cost_of(row, above, count, pixel, AVERAGE),
        cost_of(row, above, count, pixel, PAETH),
    };
    filter best = SUB;
    for (filter type = UP; type <= PAETH; type++) {
        if (cost[type - SUB] < cost[best - SUB]) {
            best = type;
        }
    }
    return best;
}

static ALWAYS_INLINE void store(uint8_t *restrict to, const uint8_t *row, const uint8_t *above, size_t count, int pixel, filter type)
{
    for (size_t k = 0; k < count; k++) {
        to[k] = difference(row + k, above + k, pixel, type);
    }
}

static ALWAYS_INLINE void filter_as(uint8_t *to, const uint8_t *row, const uint8_t *above, size_t count, int pixel)
{
    const filter type = cheapest_filter(row, above, count, pixel);
    *to++ = (uint8_t)type;
    switch (type) {
    case SUB:
        store(to, row, above, count, pixel, SUB);
        break;
    case UP:
        store(to, row, above, count, pixel, UP);
        break;
    case AVERAGE:
        store(to, row, above, count, pixel, AVERAGE);
        break;
    default:
        store(to, row, above, count, pixel, PAETH);
    }
}

static void filter_row(uint8_t *to, const uint8_t *row, const uint8_t *above, size_t count, int pixel)
{
    if (pixel == RGBA) {
        filter_as(to, row, above, count, RGBA);
    } else {
        filter_as(to, row, above, count, pixel);
    }
}

/* Checksums */

static uint32_t adler(uint32_t sums, const uint8_t *bytes, size_t count)
{
    uint32_t low = sums & 0xFFFFu;
    uint32_t high = sums >> 16;
    while (count > 0) {
        const size_t part = count < ADLER_SUMMANDS ? count : ADLER_SUMMANDS;
        uint32_t sum = 0;
        uint32_t weighted = 0;
        for (size_t k = 0; k < part; k++) {
            sum += bytes[k];
            weighted += bytes[k] * (uint32_t)(part - k);
        }
        high = (uint32_t)((high + (uint64_t)part * low + weighted) % ADLER_MODULUS);
        low = (low + sum) % ADLER_MODULUS;
        bytes += part;
        count -= part;
    }
    return high << 16 | low;
}

typedef struct crc_table {
    uint32_t of_byte[4][256]; /* the checksum of a byte followed by no, one, two or three zeros */
} crc_table;

static void make_crc_table(crc_table *table)
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t rest = byte;
        for (int bit = 0; bit < 8; bit++) {
            rest = rest >> 1 ^ (CRC_POLYNOMIAL & (0u - (rest & 1u)));
        }
        table->of_byte[0][byte] = rest;
    }
    for (uint32_t zeros = 1; zeros < 4; zeros++) {
        for (uint32_t byte = 0; byte < 256; byte++) {
            const uint32_t rest = table->of_byte[zeros - 1][byte];
            table->of_byte[zeros][byte] = rest >> 8 ^ table->of_byte[0][rest & 255u];
        }
    }
}

static uint32_t crc(const crc_table *table, const uint8_t *bytes, size_t count)
{
    uint32_t rest = 0xFFFFFFFFu;
    for (; count >= 4; count -= 4, bytes += 4) {
        rest ^= bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                (uint32_t)bytes[3] << 24;
        rest = table->of_byte[3][rest & 255u] ^ table->of_byte[2][rest >> 8 & 255u] ^
               table->of_byte[1][rest >> 16 & 255u] ^ table->of_byte[0][rest >> 24];
    }
    for (; count > 0; count--, bytes++) {
        rest = rest >> 8 ^ table->of_byte[0][(rest ^ *bytes) & 255u];
    }
    return ~rest;
}

/* The file */

static void put_u32(uint8_t *to, uint32_t value)
{
    for (int k = 0; k < 4; k++) {
        to[k] = (uint8_t)(value >> (24 - 8 * k));
    }
}

static void write_u32(bit_writer *out, uint32_t value)
{
    uint8_t bytes[4];
    put_u32(bytes, value);
    writer_bytes(out, bytes, sizeof bytes);
}

/* Begins a chunk; returns where it begins. */
static size_t begin_chunk(bit_writer *out, const char *name)
{
    const size_t start = out->size;
    write_u32(out, 0);
    writer_bytes(out, (const uint8_t *)name, 4);
    return start;
}

static void end_chunk(bit_writer *out, size_t start, const crc_table *table)
{
    if (out->failed) {
        return;
    }
    put_u32(out->bytes + start, (uint32_t)(out->size - start - 8));
    write_u32(out, crc(table, out->bytes + start + 4, out->size - start - 4));
}

static void write_header(bit_writer *out, int32_t width, int32_t height, int channels, int bits, const crc_table *table)
{
    static const uint8_t signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    static const uint8_t color_types[] = {0, 4, 2, 6}; /* by channels: grey, grey with alpha, RGB, RGBA */
    /* compression and filter of the only kind there is; not interlaced */
    const uint8_t form[] = {(uint8_t)bits, color_types[channels - 1], 0, 0, 0};
    writer_bytes(out, signature, sizeof signature);
    const size_t start = begin_chunk(out, "IHDR");
    write_u32(out, (uint32_t)width);
    write_u32(out, (uint32_t)height);
    writer_bytes(out, form, sizeof form);
    end_chunk(out, start, table);
}

/* Writes the filtered rows, compressed; `rows` has room for two rows that begin with a pixel of zero. */
static void write_rows(bit_writer *out, const uint8_t *pixels, size_t count, int32_t height,
                       ptrdiff_t stride, int pixel, uint8_t *rows)
{
    static const uint8_t zlib_header[] = {0x78, 0x01};
    uint8_t *row = rows + pixel;
    uint8_t *above = rows + pixel + count + pixel;
    uint32_t sums = 1;
    writer_bytes(out, zlib_header, sizeof zlib_header);
    deflater *d = deflate_begin(out);
    if (d == NULL) {
        return;
    }
    for (int32_t y = 0; y < height; y++) {
        memcpy(row, pixels + y * stride, count);
        uint8_t *room = deflate_room(d, 1 + count);
        filter_row(room, row, above, count, pixel);
        sums = adler(sums, room, 1 + count);
        uint8_t *drawn = row;
        row = above;
        above = drawn;
    }
    deflate_end(d);
    write_u32(out, sums);
}

bool e3d_png_encode(const uint8_t *pixels, int32_t width, int32_t height, ptrdiff_t stride,
                    int32_t channels, int32_t bits, uint8_t **file, size_t *size)
{
    const int pixel = channels * bits / 8;
    bit_writer out = {0};
    crc_table table;
    const size_t count = (size_t)pixel * (size_t)width;
    uint8_t *rows = calloc(2, (size_t)pixel + count);
    out.failed = rows == NULL;
    make_crc_table(&table);
    write_header(&out, width, height, channels, bits, &table);
    size_t start = begin_chunk(&out, "IDAT");
    if (rows != NULL) {
        write_rows(&out, pixels, count, height, stride, pixel, rows);
    }
    end_chunk(&out, start, &table);
    start = begin_chunk(&out, "IEND");
    end_chunk(&out, start, &table);
    free(rows);
    if (out.failed) {
        free(out.bytes);
        return false;
    }
    *file = out.bytes;
    *size = out.size;
    return true;
}
