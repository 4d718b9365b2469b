/* Compression to the DEFLATE format, fast, for pictures. */
#ifndef E3D_DEFLATE_H
#define E3D_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define DEFLATE_WINDOW 32768 /* how far back a match may lie */
#define DEFLATE_CHUNK 262144 /* bytes that are compressed at a time */
#define DEFLATE_ROOM (DEFLATE_WINDOW + DEFLATE_CHUNK)

/* Bytes that grow, and the bits that do not fill one yet. */
typedef struct bit_writer {
    uint8_t *bytes;
    size_t size;
    size_t capacity;
    uint64_t bits;
    uint32_t bit_count;
    bool failed; /* memory ran out: what is written from then on is lost */
} bit_writer;

typedef struct deflater deflater;

/* Returns NULL if memory runs out. The compressed bytes are appended to `out`. */
deflater *deflate_begin(bit_writer *out);

/* Room for `count` bytes, at most DEFLATE_CHUNK, that are to be written before the next call. */
uint8_t *deflate_room(deflater *d, size_t count);

/* Compresses the rest and ends the stream at a whole byte. Frees `d`. */
void deflate_end(deflater *d);

void writer_bits(bit_writer *out, uint64_t bits, uint32_t count); /* at most 32, first bit lowest */
void writer_align(bit_writer *out);                               /* fills the last byte with 0 */
void writer_bytes(bit_writer *out, const uint8_t *bytes, size_t count); /* at a whole byte only */

#endif
