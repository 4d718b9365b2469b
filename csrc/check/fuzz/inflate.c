/* DEFLATE read bit by bit: no tables but the codes' lengths, no speed. Source: RFC 1951. */
#include "check/fuzz/inflate.h"

#include <string.h>

enum { MAX_LENGTH = 15,
       LITERALS = 288,
       DISTANCES = 30,
       ALL = LITERALS + DISTANCES };

typedef struct stream {
    const uint8_t *bytes;
    size_t size, bit, done, count, window;
    uint8_t *to;
    int bad;
} stream;

/* Symbols by the length of their codes: those of one length stand in a row, and so do their codes. */
typedef struct code {
    uint16_t of_length[MAX_LENGTH + 1], symbol[LITERALS];
} code;

static uint32_t take_bits(stream *s, int count)
{
    uint32_t bits = 0;
    for (int k = 0; k < count; k++, s->bit++) {
        if (s->bit / 8 >= s->size) {
            s->bad = 1;
            return 0;
        }
        bits |= (uint32_t)(s->bytes[s->bit / 8] >> s->bit % 8 & 1) << k;
    }
    return bits;
}

/* Refuses lengths that promise more codes than there are. */
static void make_code(stream *s, code *c, const uint8_t *lengths, int count)
{
    uint16_t at[MAX_LENGTH + 2] = {0};
    int32_t left = 1;
    memset(c, 0, sizeof *c);
    for (int k = 0; k < count; k++)
        c->of_length[lengths[k]]++;
    c->of_length[0] = 0;
    for (int length = 1; length <= MAX_LENGTH; length++) {
        left = 2 * left - c->of_length[length];
        s->bad |= left < 0;
        at[length + 1] = (uint16_t)(at[length] + c->of_length[length]);
    }
    for (int k = 0; k < count; k++)
        if (lengths[k])
            c->symbol[at[lengths[k]]++] = (uint16_t)k;
}

static int take_symbol(stream *s, const code *c)
{
    int32_t bits = 0, first = 0, index = 0;
    for (int length = 1; length <= MAX_LENGTH && !s->bad; length++) {
        bits |= (int32_t)take_bits(s, 1);
        const int32_t count = c->of_length[length];
        if (bits - first < count)
            return c->symbol[index + bits - first];
        index += count;
        first = (first + count) << 1;
        bits <<= 1;
    }
    s->bad = 1;
    return 0;
}

static void put_byte(stream *s, uint8_t byte)
{
    s->bad |= s->done == s->count;
    if (!s->bad)
        s->to[s->done++] = byte;
}

static void copy_stored(stream *s)
{
    s->bit = (s->bit + 7) / 8 * 8;
    const uint32_t count = take_bits(s, 16), inverse = take_bits(s, 16);
    s->bad |= (count ^ inverse) != 0xFFFF;
    for (uint32_t k = 0; k < count && !s->bad; k++)
        put_byte(s, (uint8_t)take_bits(s, 8));
}

static void take_codes(stream *s, code *literals, code *distances)
{
    static const uint8_t order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint8_t lengths[ALL + 138] = {0}, meta[19] = {0};
    const int literal_count = (int)take_bits(s, 5) + 257, distance_count = (int)take_bits(s, 5) + 1;
    const int meta_count = (int)take_bits(s, 4) + 4;
    for (int k = 0; k < meta_count; k++)
        meta[order[k]] = (uint8_t)take_bits(s, 3);
    code items;
    make_code(s, &items, meta, 19);
    const int count = literal_count + distance_count;
    s->bad |= literal_count > 286 || distance_count > DISTANCES;
    for (int k = 0; k < count && !s->bad;) {
        const int item = take_symbol(s, &items);
        if (item < 16) {
            lengths[k++] = (uint8_t)item;
            continue;
        }
        s->bad |= item == 16 && k == 0;
        const uint8_t length = item == 16 && k > 0 ? lengths[k - 1] : 0;
        int run = item == 16 ? 3 + (int)take_bits(s, 2) : item == 17 ? 3 + (int)take_bits(s, 3)
                                                                     : 11 + (int)take_bits(s, 7);
        while (run-- > 0)
            lengths[k++] = length;
        s->bad |= k > count;
    }
    s->bad |= lengths[256] == 0;
    if (s->bad)
        return;
    make_code(s, literals, lengths, literal_count);
    make_code(s, distances, lengths + literal_count, distance_count);
}

static void copy_match(stream *s, int symbol, const code *distances)
{
    static const uint16_t base[30] = {1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129,
                                      193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    const int group = symbol - 257;
    s->bad |= group > 28;
    uint32_t length = 258;
    if (group < 8)
        length = 3 + (uint32_t)group;
    else if (group < 28)
        length = 3 + ((4 + ((uint32_t)group & 3)) << (group / 4 - 1)) + take_bits(s, group / 4 - 1);
    const int far = take_symbol(s, distances);
    s->bad |= far >= DISTANCES;
    if (s->bad)
        return;
    const size_t distance = base[far] + take_bits(s, far < 4 ? 0 : far / 2 - 1);
    s->bad |= distance > s->done || distance > s->window;
    for (uint32_t k = 0; k < length && !s->bad; k++)
        put_byte(s, s->to[s->done - distance]);
}

static void copy_coded(stream *s)
{
    code literals, distances;
    take_codes(s, &literals, &distances);
    while (!s->bad) {
        const int symbol = take_symbol(s, &literals);
        if (symbol == 256)
            return;
        if (symbol < 256)
            put_byte(s, (uint8_t)symbol);
        else
            copy_match(s, symbol, &distances);
    }
}

size_t inflate_stream(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t window)
{
    stream s = {.bytes = bytes, .size = size, .to = to, .count = count, .window = window};
    for (uint32_t last = 0; !last && !s.bad;) {
        last = take_bits(&s, 1);
        const uint32_t kind = take_bits(&s, 2);
        if (kind == 0)
            copy_stored(&s);
        else if (kind == 2)
            copy_coded(&s);
        else
            s.bad = 1; /* the writer has no blocks of fixed codes */
    }
    return s.bad || s.done != count ? SIZE_MAX : (s.bit + 7) / 8;
}
