/* Attributes of meshopt: elements as deltas, byte by byte, in groups of 16.
 *
 * In:  a stream, the count and size of its elements. Out: the elements.
 * A block of up to 256 elements holds, for each byte of an element, the deltas of that byte: 0, 1, 2, 4 or 8 bits each,
 * as its group says. The largest value of 1, 2 or 4 bits says that the delta stands behind them as a byte.
 */
#include "e3d_meshopt.h"

#include <string.h>

enum { GROUP = 16,
       MAX_BLOCK = 256,
       BLOCK_BYTES = 8192,
       CHANNEL = 4 };
enum { CONTROL_ZERO = 2,
       CONTROL_BYTES = 3 };
enum { BYTE_DELTAS,
       WORD_DELTAS,
       XOR_DELTAS };
enum { TAIL_OF_0 = 32,
       TAIL_OF_1 = 24 };

typedef struct stream {
    const uint8_t *at, *end;
    size_t stride;
    int version;
    const uint8_t *modes; /* [stride / CHANNEL], in version 1 */
    uint8_t last[E3D_MESHOPT_MAX_STRIDE]; /* the previous element */
} stream;

/* The bits of a delta, by the mode of its group: for version 0, and for control modes 0 and 1. */
static const uint8_t bits_of[3][4] = {{0, 2, 4, 8}, {0, 1, 2, 4}, {1, 2, 4, 8}};

static inline size_t left(const stream *s) { return (size_t)(s->end - s->at); }

static uint8_t packed_delta(const uint8_t *packed, int k, int bits)
{
    if (bits == 1) /* one-bit deltas start at the lowest bit, wider ones at the highest */
        return packed[k / 8] >> k % 8 & 1;
    const int in_byte = 8 / bits;
    return (uint8_t)(packed[k / in_byte] >> (in_byte - 1 - k % in_byte) * bits & ((1 << bits) - 1));
}

static bool take_group(stream *s, int bits, uint8_t *deltas)
{
    const size_t size = (size_t)(GROUP * bits / 8);
    if (left(s) < size)
        return false;
    const uint8_t *const packed = s->at;
    s->at += size;
    if (bits == 0 || bits == 8) {
        if (bits)
            memcpy(deltas, packed, GROUP);
        else
            memset(deltas, 0, GROUP);
        return true;
    }
    const uint8_t sentinel = (uint8_t)((1 << bits) - 1);
    for (int k = 0; k < GROUP; k++) {
        deltas[k] = packed_delta(packed, k, bits);
        if (deltas[k] != sentinel)
            continue;
        if (left(s) == 0)
            return false;
        deltas[k] = *s->at++;
    }
    return true;
}

/* Reads the deltas of one byte of `count` elements; `deltas` has room for whole groups. */
static bool take_deltas(stream *s, int control, size_t count, uint8_t *deltas)
{
    if (s->version == 1 && control == CONTROL_ZERO) {
        memset(deltas, 0, count);
        return true;
    }
    if (s->version == 1 && control == CONTROL_BYTES) {
        if (left(s) < count)
            return false;
        memcpy(deltas, s->at, count);
        s->at += count;
        return true;
    }
    const uint8_t *const widths = bits_of[s->version == 0 ? 0 : control + 1];
    const size_t groups = (count + GROUP - 1) / GROUP, header_size = (groups + 3) / 4;
    if (left(s) < header_size)
        return false;
    const uint8_t *const header = s->at;
    s->at += header_size;
    for (size_t g = 0; g < groups; g++)
        if (!take_group(s, widths[header[g / 4] >> g % 4 * 2 & 3], deltas + g * GROUP))
            return false;
    return true;
}

static inline uint32_t unzigzag(uint32_t v) { return (v & 1) ? ~(v >> 1) : v >> 1; }

/* Adds up the deltas of four bytes of the elements. */
static void add_channel(stream *s, size_t first, uint8_t deltas[CHANNEL][MAX_BLOCK], size_t count, uint8_t *to)
{
    const uint8_t mode = s->version == 0 ? 0 : s->modes[first / CHANNEL];
    const uint32_t turn = 32u - (mode >> 4);
    uint8_t *const last = s->last + first;
    for (size_t i = 0; i < count; i++) {
        if ((mode & 15) == BYTE_DELTAS) {
            for (int k = 0; k < CHANNEL; k++)
                last[k] = (uint8_t)(last[k] + unzigzag(deltas[k][i]));
        } else if ((mode & 15) == WORD_DELTAS) {
            for (int k = 0; k < CHANNEL; k += 2) {
                const uint32_t delta = deltas[k][i] | (uint32_t)deltas[k + 1][i] << 8;
                const uint32_t value = (last[k] | (uint32_t)last[k + 1] << 8) + unzigzag(delta);
                last[k] = (uint8_t)value;
                last[k + 1] = (uint8_t)(value >> 8);
            }
        } else {
            uint32_t delta = 0;
            for (int k = 0; k < CHANNEL; k++)
                delta |= (uint32_t)deltas[k][i] << 8 * k;
            delta = delta << (turn & 31) | delta >> (32 - turn);
            for (int k = 0; k < CHANNEL; k++)
                last[k] ^= (uint8_t)(delta >> 8 * k);
        }
        memcpy(to + i * s->stride + first, last, CHANNEL);
    }
}

static bool take_block(stream *s, size_t count, uint8_t *to)
{
    uint8_t deltas[CHANNEL][MAX_BLOCK];
    const size_t channels = s->stride / CHANNEL;
    const uint8_t *const controls = s->at;
    if (s->version == 1) {
        if (left(s) < channels)
            return false;
        s->at += channels;
    }
    for (size_t c = 0; c < channels; c++) {
        for (int k = 0; k < CHANNEL; k++)
            if (!take_deltas(s, s->version == 1 ? controls[c] >> 2 * k & 3 : 0, count, deltas[k]))
                return false;
        add_channel(s, c * CHANNEL, deltas, count, to);
    }
    return true;
}

/* Finds the tail; false if there is none, or if it has unknown modes. */
static bool begin(stream *s, const uint8_t *bytes, size_t size)
{
    if (size == 0 || (bytes[0] != 0xA0 && bytes[0] != 0xA1))
        return false;
    s->version = bytes[0] & 1;
    const size_t modes = s->version ? s->stride / CHANNEL : 0, least = s->version ? TAIL_OF_1 : TAIL_OF_0;
    const size_t tail = s->stride + modes > least ? s->stride + modes : least;
    if (size - 1 < tail)
        return false;
    s->at = bytes + 1;
    s->end = bytes + size - tail;
    s->modes = bytes + size - modes;
    memcpy(s->last, s->modes - s->stride, s->stride);
    for (size_t c = 0; c < modes; c++)
        if ((s->modes[c] & 15) > XOR_DELTAS || (s->modes[c] >> 4 && (s->modes[c] & 15) != XOR_DELTAS))
            return false;
    return true;
}

bool e3d_meshopt_attributes(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride)
{
    stream s = {.stride = stride};
    if (!begin(&s, bytes, size))
        return false;
    const size_t fitting = BLOCK_BYTES / stride & ~(size_t)(GROUP - 1);
    const size_t most = fitting < MAX_BLOCK ? fitting : MAX_BLOCK;
    for (size_t done = 0; done < count;) {
        const size_t block = count - done < most ? count - done : most;
        if (!take_block(&s, block, to + done * stride))
            return false;
        done += block;
    }
    return s.at == s.end;
}
