/* Prefix codes for DEFLATE: how long each symbol's code is, and its bits. */
#pragma once

#include <stdint.h>

/* The most symbols of an alphabet: literals, the end of a block and lengths of matches. */
#define HUFFMAN_MAX_SYMBOLS 288
#define HUFFMAN_MAX_LENGTH 15

typedef struct huffman_code {
    uint16_t bits[HUFFMAN_MAX_SYMBOLS];  /* first bit lowest, as DEFLATE writes them */
    uint8_t length[HUFFMAN_MAX_SYMBOLS]; /* 0 for symbols that do not occur */
} huffman_code;

/* Makes the code of `count` symbols that occur `frequency` times, none longer than `limit` bits. At least two symbols get a
 * code, because some decoders refuse an alphabet of one. Frequencies add up to less than 2^23. */
void huffman_make(huffman_code *code, const uint32_t *frequency, int32_t count, int32_t limit);
