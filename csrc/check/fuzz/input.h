/* What the fuzz targets share: values taken from the fuzzer's bytes, and claims about what came out.
 *
 * A target is one file with libFuzzer's entry. Where it feeds a parser, the bytes are the file as it is, so that
 * real files are seeds; elsewhere the first bytes choose sizes and options. A claim that fails is a finding.
 */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

#define CLAIM(claim) \
    do { \
        if (!(claim)) { \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #claim); \
            abort(); \
        } \
    } while (0)

typedef struct input {
    const uint8_t *at;
    size_t left;
} input;

/* 0 once nothing is left. */
static inline uint32_t take_byte(input *in)
{
    if (in->left == 0)
        return 0;
    in->left--;
    return *in->at++;
}

static inline uint32_t take_word(input *in)
{
    const uint32_t low = take_byte(in);
    return low | take_byte(in) << 8;
}

/* 0 .. count - 1, of up to 256 */
static inline int32_t take_below(input *in, int32_t count) { return (int32_t)(take_byte(in) % (uint32_t)count); }

/* Small numbers, most of them whole or halves; sometimes any bits at all, which may be NaN. */
static inline double take_number(input *in)
{
    const uint32_t kind = take_byte(in);
    if (kind < 224)
        return ((double)kind - 112.0) * 0.25;
    uint64_t bits = 0;
    for (int k = 0; k < 8; k++)
        bits |= (uint64_t)take_byte(in) << 8 * k;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Fresh memory of exactly that size, so that the sanitizers know its ends; freed by the target. */
static inline void *room_for(size_t count, size_t size)
{
    void *room = malloc(count * size ? count * size : 1);
    CLAIM(room);
    return room;
}

/* Three numbers each, in room_for them. */
static inline void *take_positions(input *in, size_t count, bool are_doubles)
{
    const size_t size = are_doubles ? sizeof(double) : sizeof(float);
    uint8_t *positions = room_for(3 * count, size);
    for (size_t k = 0; k < 3 * count; k++) {
        const double number = take_number(in);
        const float rounded = fabs(number) <= 3e38 ? (float)number : (float)(number > 0 ? INFINITY : NAN);
        memcpy(positions + k * size, are_doubles ? (const void *)&number : (const void *)&rounded, size);
    }
    return positions;
}
