/* Fuzzes the scan lines of Radiance pictures: what is unpacked, packed again byte by byte, unpacks to the same pixels.
 *
 * In:  a word: the width; a byte: the lines; then their bytes.
 */
#include "e3d_images.h"
#include "check/fuzz/input.h"

/* Lines of the new kind in stretches of one byte; room for 4 + 8 * width each. */
static size_t pack(const uint8_t *pixels, size_t width, size_t lines, uint8_t *out)
{
    uint8_t *to = out;
    for (size_t line = 0; line < lines; line++, pixels += 4 * width) {
        const uint8_t head[4] = {2, 2, (uint8_t)(width >> 8), (uint8_t)width};
        memcpy(to, head, sizeof head);
        to += sizeof head;
        for (size_t channel = 0; channel < 4; channel++)
            for (size_t x = 0; x < width; x++) {
                *to++ = 1;
                *to++ = pixels[4 * x + channel];
            }
    }
    return (size_t)(to - out);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const size_t width = 1 + take_word(&in) % 2048, lines = 1 + (size_t)take_below(&in, 16);
    uint8_t *pixels = room_for(4 * width, lines), *again = room_for(4 * width, lines);
    size_t used, used_again;
    e3d_rgbe_fault fault;
    uint8_t *file = room_for(in.left, 1);
    memcpy(file, in.at, in.left);
    const size_t done = e3d_rgbe_unpack(file, in.left, (int32_t)width, lines, pixels, &used, &fault);
    CLAIM(done <= lines && used <= in.left);
    CLAIM((done == lines) == (fault == E3D_RGBE_WHOLE));
    if (width >= 8 && done) {
        uint8_t *packed = room_for(done, 4 + 8 * width);
        const size_t length = pack(pixels, width, done, packed);
        CLAIM(e3d_rgbe_unpack(packed, length, (int32_t)width, done, again, &used_again, &fault) == done);
        CLAIM(used_again == length && memcmp(pixels, again, 4 * width * done) == 0);
        free(packed);
    }
    free(file);
    free(pixels);
    free(again);
    return 0;
}
