/* Compression to the DEFLATE format, fast, for pictures. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
#define DEFLATE_WINDOW 32768     /* how far back a match may lie */
#define DEFLATE_CHUNK 262144     /* bytes that are compressed at a time */
#define DEFLATE_HASH_BITS 15     /* the table remembers 2^15 places */
#define DEFLATE_MAX_TOKENS 32768 /* of a block */
#define DEFLATE_MAX_STORED 65535 /* bytes of a block that is not compressed */
#else
/* So little that a picture of a few pixels fills everything several times, since a fuzzer makes thousands a second. */
#define DEFLATE_WINDOW 128
#define DEFLATE_CHUNK 256
#define DEFLATE_HASH_BITS 7
#define DEFLATE_MAX_TOKENS 96
#define DEFLATE_MAX_STORED 60
#endif
#define DEFLATE_ROOM (DEFLATE_WINDOW + DEFLATE_CHUNK)

/* Bytes that grow, and the bits that do not fill a byte yet. */
typedef struct bit_writer {
    uint8_t *bytes;
    size_t size;
    size_t capacity;
    uint64_t bits;
    uint32_t bit_count;
    bool failed; /* memory ran out: everything written from then on is lost */
} bit_writer;

typedef struct deflater deflater;

/* Returns NULL if memory runs out. The compressed bytes are appended to `out`. */
deflater *deflate_begin(bit_writer *out);

/* Returns room for `count` bytes, at most DEFLATE_CHUNK. They must be written before the next call. */
uint8_t *deflate_room(deflater *d, size_t count);

/* Compresses the rest and ends the stream at a whole byte. Frees `d`. */
void deflate_end(deflater *d);

void writer_bits(bit_writer *out, uint64_t bits, uint32_t count); /* at most 32, first bit lowest */
void writer_align(bit_writer *out);                               /* fills the last byte with 0 */
void writer_bytes(bit_writer *out, const uint8_t *bytes, size_t count); /* only at a whole byte */
