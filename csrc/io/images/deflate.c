/* DEFLATE: repeats become matches, what is left gets prefix codes.
 *
 * In:  bytes, chunk by chunk; the last 32 KiB before a chunk are kept to match with.
 * Out: blocks with codes of their own, or stored as they are where that is shorter.
 * Always: integers, read byte by byte in one order, so the same bytes give the same stream on every
 *      machine. Memory is constant but for the output.
 * Method: a table by the hash of four bytes remembers the last place where they stood; a match is
 * taken at once, without looking for a longer one, there or at the next byte.
 * Source: RFC 1951.
 */
#include "deflate.h"

#include <stdlib.h>
#include <string.h>

#include "huffman.h"

#define MIN_MATCH 4
#define MAX_MATCH 258
#define LONG_MATCH 16    /* of longer matches only the ends are entered in the table */

#define LITERALS 256
#define END_OF_BLOCK 256
#define LENGTH_SYMBOLS 286
#define DISTANCE_SYMBOLS 30
#define CODE_LENGTH_SYMBOLS 19
#define CODE_LENGTH_LIMIT 7

struct deflater {
    bit_writer *out;
    size_t filled;  /* bytes in the buffer; those before `pending` are compressed */
    size_t pending; /* where the block that is being made begins */
    uint32_t base;  /* the stream position of buffer[0], plus a window, so that 0 is never a place in reach */
    uint32_t token_count;
    uint32_t tokens[DEFLATE_MAX_TOKENS]; /* a literal, or length << 16 | distance */
    uint32_t literal_frequency[LENGTH_SYMBOLS];
    uint32_t distance_frequency[DISTANCE_SYMBOLS];
    uint32_t places[1 << DEFLATE_HASH_BITS];
    uint8_t buffer[DEFLATE_ROOM];
};

/* A symbol, and the extra bits that distinguish the values sharing it. */
typedef struct symbol_bits {
    uint32_t symbol;
    uint32_t extra;
    uint32_t extra_count;
} symbol_bits;

static uint32_t highest_bit(uint32_t value)
{
    return 31u - (uint32_t)__builtin_clz(value);
}

static symbol_bits length_symbol(uint32_t length)
{
    const uint32_t value = length - 3;
    if (length == MAX_MATCH) {
        return (symbol_bits){LENGTH_SYMBOLS - 1, 0, 0};
    }
    if (value < 8) {
        return (symbol_bits){LITERALS + 1 + value, 0, 0};
    }
    const uint32_t extra_count = highest_bit(value) - 2;
    const uint32_t leading = value >> extra_count; /* 4 to 7 */
    const uint32_t symbol = LITERALS + 1 + 4 * extra_count + leading;
    return (symbol_bits){symbol, value & ((1u << extra_count) - 1u), extra_count};
}

static symbol_bits distance_symbol(uint32_t distance)
{
    const uint32_t value = distance - 1;
    if (value < 4) {
        return (symbol_bits){value, 0, 0};
    }
    const uint32_t extra_count = highest_bit(value) - 1;
    const uint32_t leading = value >> extra_count; /* 2 or 3 */
    const uint32_t symbol = 2 * extra_count + leading;
    return (symbol_bits){symbol, value & ((1u << extra_count) - 1u), extra_count};
}

/* Blocks */

/* The lengths of both codes as one list, in which the symbols 16 to 18 stand for repeats. */
typedef struct code_lengths {
    int32_t literal_count, distance_count, item_count;
    uint8_t item[LENGTH_SYMBOLS + DISTANCE_SYMBOLS];
    uint8_t extra[LENGTH_SYMBOLS + DISTANCE_SYMBOLS];
    huffman_code code;
    uint32_t frequency[CODE_LENGTH_SYMBOLS];
    int32_t written; /* lengths of `code` that are written, in ORDER */
} code_lengths;

static const uint8_t ORDER[CODE_LENGTH_SYMBOLS] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

static uint32_t repeat_bits(uint32_t item)
{
// clang-format off
    return item < 16 ? 0 : item == 16 ? 2 : item == 17 ? 3 : 7;
// clang-format on
}

static void add_item(code_lengths *lengths, uint32_t item, uint32_t extra)
{
    lengths->item[lengths->item_count] = (uint8_t)item;
    lengths->extra[lengths->item_count++] = (uint8_t)extra;
    lengths->frequency[item]++;
}

/* Adds a length that occurs `run` times in a row. */
static void add_run(code_lengths *lengths, uint32_t length, uint32_t run)
{
    if (length != 0) {
        add_item(lengths, length, 0);
        run--;
    }
    while (run >= 3) {
// clang-format off
        const uint32_t most = length != 0 ? 6 : run > 10 ? 138 : 10;
        const uint32_t step = run < most ? run : most;
        const uint32_t item = length != 0 ? 16 : most == 10 ? 17 : 18;
// clang-format on
        add_item(lengths, item, step - (item == 18 ? 11 : 3));
        run -= step;
    }
    while (run > 0) {
        add_item(lengths, length, 0);
        run--;
    }
}

static int32_t used_symbols(const huffman_code *code, int32_t count)
{
    while (code->length[count - 1] == 0) {
        count--;
    }
    return count;
}

static void describe_codes(code_lengths *lengths, const huffman_code *literals,
                           const huffman_code *distances)
{
    uint8_t all[LENGTH_SYMBOLS + DISTANCE_SYMBOLS];
    memset(lengths, 0, sizeof *lengths);
    lengths->literal_count = used_symbols(literals, LENGTH_SYMBOLS);
    lengths->distance_count = used_symbols(distances, DISTANCE_SYMBOLS);
    const int32_t count = lengths->literal_count + lengths->distance_count;
    memcpy(all, literals->length, (size_t)lengths->literal_count);
    memcpy(all + lengths->literal_count, distances->length, (size_t)lengths->distance_count);
    for (int32_t first = 0, next; first < count; first = next) {
        for (next = first + 1; next < count && all[next] == all[first]; next++) {
        }
        add_run(lengths, all[first], (uint32_t)(next - first));
    }
    huffman_make(&lengths->code, lengths->frequency, CODE_LENGTH_SYMBOLS, CODE_LENGTH_LIMIT);
    lengths->written = CODE_LENGTH_SYMBOLS;
    while (lengths->code.length[ORDER[lengths->written - 1]] == 0) {
        lengths->written--;
    }
}

/* How many bits a block with these codes takes. */
static uint64_t coded_bits(const deflater *d, const code_lengths *lengths,
                           const huffman_code *literals, const huffman_code *distances)
{
    uint64_t bits = 3 + 14 + 3 * (uint64_t)lengths->written;
    for (int32_t k = 0; k < lengths->item_count; k++) {
        bits += lengths->code.length[lengths->item[k]] + repeat_bits(lengths->item[k]);
    }
    for (uint32_t symbol = 0; symbol < LENGTH_SYMBOLS; symbol++) {
        const uint32_t number = symbol - LITERALS - 1; /* there are 28 groups, four to each number of extra bits */
        const uint32_t extra = symbol < LITERALS + 9 || number == 28 ? 0 : number / 4 - 1;
        bits += (uint64_t)d->literal_frequency[symbol] * (literals->length[symbol] + extra);
    }
    for (uint32_t symbol = 0; symbol < DISTANCE_SYMBOLS; symbol++) {
        const uint32_t extra = symbol < 4 ? 0 : symbol / 2 - 1;
        bits += (uint64_t)d->distance_frequency[symbol] * (distances->length[symbol] + extra);
    }
    return bits;
}

static void write_codes(bit_writer *out, const code_lengths *lengths)
{
    writer_bits(out, (uint64_t)lengths->literal_count - 257, 5);
    writer_bits(out, (uint64_t)lengths->distance_count - 1, 5);
    writer_bits(out, (uint64_t)lengths->written - 4, 4);
    for (int32_t k = 0; k < lengths->written; k++) {
        writer_bits(out, lengths->code.length[ORDER[k]], 3);
    }
    for (int32_t k = 0; k < lengths->item_count; k++) {
        const uint32_t item = lengths->item[k];
        writer_bits(out, lengths->code.bits[item], lengths->code.length[item]);
        writer_bits(out, lengths->extra[k], repeat_bits(item));
    }
}

static void write_symbol(bit_writer *out, const huffman_code *code, symbol_bits value)
{
    const uint32_t length = code->length[value.symbol];
    const uint64_t bits = (uint64_t)value.extra << length | code->bits[value.symbol];
    writer_bits(out, bits, length + value.extra_count);
}

static void write_tokens(const deflater *d, const huffman_code *literals,
                         const huffman_code *distances)
{
    bit_writer *out = d->out;
    for (uint32_t k = 0; k < d->token_count; k++) {
        const uint32_t token = d->tokens[k];
        if (token < LITERALS) {
            writer_bits(out, literals->bits[token], literals->length[token]);
        } else {
            write_symbol(out, literals, length_symbol(token >> 16));
            write_symbol(out, distances, distance_symbol(token & 0xFFFFu));
        }
    }
    writer_bits(out, literals->bits[END_OF_BLOCK], literals->length[END_OF_BLOCK]);
}

static void write_stored(bit_writer *out, const uint8_t *bytes, size_t count, bool is_last)
{
    do {
        const size_t part = count < DEFLATE_MAX_STORED ? count : DEFLATE_MAX_STORED;
        writer_bits(out, is_last && part == count, 1);
        writer_bits(out, 0, 2);
        writer_align(out);
        const uint8_t head[4] = {(uint8_t)part, (uint8_t)(part >> 8), (uint8_t)~part,
                                 (uint8_t)(~part >> 8)};
        writer_bytes(out, head, sizeof head);
        writer_bytes(out, bytes, part);
        bytes += part;
        count -= part;
    } while (count > 0);
}

/* Writes the tokens so far, for the bytes from `pending` to `end`. */
static void end_block(deflater *d, size_t end, bool is_last)
{
    huffman_code literals, distances;
    code_lengths lengths;
    d->literal_frequency[END_OF_BLOCK] = 1;
    huffman_make(&literals, d->literal_frequency, LENGTH_SYMBOLS, HUFFMAN_MAX_LENGTH);
    huffman_make(&distances, d->distance_frequency, DISTANCE_SYMBOLS, HUFFMAN_MAX_LENGTH);
    describe_codes(&lengths, &literals, &distances);
    const uint64_t stored_bits = 8 * (uint64_t)(end - d->pending + 5);
    if (coded_bits(d, &lengths, &literals, &distances) < stored_bits) {
        writer_bits(d->out, is_last, 1);
        writer_bits(d->out, 2, 2);
        write_codes(d->out, &lengths);
        write_tokens(d, &literals, &distances);
    } else {
        write_stored(d->out, d->buffer + d->pending, end - d->pending, is_last);
    }
    d->pending = end;
    d->token_count = 0;
    memset(d->literal_frequency, 0, sizeof d->literal_frequency);
    memset(d->distance_frequency, 0, sizeof d->distance_frequency);
}

/* Matches */

static uint32_t read_four(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static uint32_t hash(uint32_t four)
{
    return four * 2654435761u >> (32 - DEFLATE_HASH_BITS);
}

static uint32_t common_length(const uint8_t *a, const uint8_t *b, uint32_t limit)
{
    uint32_t length = MIN_MATCH;
    while (length + 8 <= limit && memcmp(a + length, b + length, 8) == 0) {
        length += 8;
    }
    while (length < limit && a[length] == b[length]) {
        length++;
    }
    return length;
}

static void enter(deflater *d, size_t at)
{
    d->places[hash(read_four(d->buffer + at))] = d->base + (uint32_t)at;
}

/* Enters the bytes at `at` in the table; returns the length of the match there, or 0. */
static uint32_t find_match(deflater *d, size_t at, uint32_t limit, uint32_t *distance)
{
    const uint8_t *here = d->buffer + at;
    const uint32_t four = read_four(here);
    uint32_t *place = &d->places[hash(four)];
    const uint32_t back = d->base + (uint32_t)at - *place;
    *place = d->base + (uint32_t)at;
    if (back > DEFLATE_WINDOW || read_four(here - back) != four) {
        return 0;
    }
    *distance = back;
    return common_length(here, here - back, limit);
}

/* Turns the buffer from `pending` to its end into blocks; for the last block it only makes the tokens. */
static void compress(deflater *d)
{
    const size_t end = d->filled;
    size_t at = d->pending;
    while (at < end) {
        const uint32_t limit = end - at < MAX_MATCH ? (uint32_t)(end - at) : MAX_MATCH;
        uint32_t distance = 0;
        const uint32_t length = limit < MIN_MATCH ? 0 : find_match(d, at, limit, &distance);
        if (d->token_count == DEFLATE_MAX_TOKENS) {
            end_block(d, at, false);
        }
        if (length == 0) {
            d->tokens[d->token_count++] = d->buffer[at];
            d->literal_frequency[d->buffer[at]]++;
            at++;
            continue;
        }
        d->tokens[d->token_count++] = length << 16 | distance;
        d->literal_frequency[length_symbol(length).symbol]++;
        d->distance_frequency[distance_symbol(distance).symbol]++;
        const size_t last = at + length;
        at = length > LONG_MATCH ? last - 4 : at + 1;
        for (; at < last && at + MIN_MATCH <= end; at++) {
            enter(d, at);
        }
        at = last;
    }
}

/* The stream */

deflater *deflate_begin(bit_writer *out)
{
    deflater *d = malloc(sizeof *d);
    if (d == NULL) {
        out->failed = true;
        return NULL;
    }
    memset(d, 0, offsetof(deflater, buffer));
    d->out = out;
    d->base = DEFLATE_WINDOW + 1;
    return d;
}

uint8_t *deflate_room(deflater *d, size_t count)
{
    if (count > DEFLATE_ROOM - d->filled) {
        compress(d);
        if (d->token_count > 0) {
            end_block(d, d->filled, false);
        }
        const size_t gone = d->filled - DEFLATE_WINDOW;
        memmove(d->buffer, d->buffer + gone, DEFLATE_WINDOW);
        d->base += (uint32_t)gone;
        d->filled = d->pending = DEFLATE_WINDOW;
    }
    uint8_t *room = d->buffer + d->filled;
    d->filled += count;
    return room;
}

void deflate_end(deflater *d)
{
    compress(d);
    end_block(d, d->filled, true);
    writer_align(d->out);
    free(d);
}
