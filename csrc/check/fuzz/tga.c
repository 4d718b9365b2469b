/* Fuzzes the unpacking of TGA files: the pixels, and how many, that an obvious loop gives.
 *
 * In:  a byte: the bytes a pixel; two: how many pixels are wanted; then the packets.
 */
#include "e3d_images.h"
#include "check/fuzz/input.h"

/* One pixel after the other. */
static size_t unpack(input in, size_t pixel_bytes, uint8_t *pixels, size_t count)
{
    size_t done = 0, left = 0;
    const uint8_t *pixel = NULL;
    int repeats = 0;
    for (; done < count; done++, left--) {
        if (left == 0) {
            if (in.left == 0)
                break;
            const uint32_t head = take_byte(&in);
            repeats = head > 127;
            left = (head & 127) + 1;
            pixel = NULL;
        }
        if (!repeats || !pixel) {
            if (in.left < pixel_bytes)
                break;
            pixel = in.at;
            in.at += pixel_bytes;
            in.left -= pixel_bytes;
        }
        memcpy(pixels + done * pixel_bytes, pixel, pixel_bytes);
    }
    return done;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    input in = {bytes, size};
    const size_t pixel_bytes = 1 + (size_t)take_below(&in, 4), count = take_word(&in) % 8192;
    uint8_t *pixels = room_for(count, pixel_bytes), *expected = room_for(count, pixel_bytes);
    const size_t done = e3d_tga_unpack(in.at, in.left, (int32_t)pixel_bytes, pixels, count);
    CLAIM(done == unpack(in, pixel_bytes, expected, count));
    CLAIM(memcmp(pixels, expected, done * pixel_bytes) == 0);
    free(pixels);
    free(expected);
    return 0;
}
