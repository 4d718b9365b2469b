/* Run-length packets of TGA files.
 *
 * In:  packets: a head byte, then one pixel to repeat (head > 127) or 1 to 128 pixels as they are.
 * Out: pixels. The last packet may hold more pixels than are wanted.
 * Source: Truevision TGA File Format Specification 2.0.
 */
#include <string.h>

#include "e3d_images.h"

static void repeat(uint8_t *to, const uint8_t *pixel, size_t pixel_bytes, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        for (size_t byte = 0; byte < pixel_bytes; byte++) {
            to[k * pixel_bytes + byte] = pixel[byte];
        }
    }
}

size_t e3d_tga_unpack(const uint8_t *data, size_t length, int32_t pixel_bytes, uint8_t *pixels,
                      size_t count)
{
    const size_t size = (size_t)pixel_bytes;
    size_t position = 0;
    size_t done = 0;
    while (done < count && position < length) {
        const uint8_t head = data[position++];
        const size_t available = (length - position) / size;
        size_t wanted = (head & 127u) + 1u;
        if (wanted > count - done) {
            wanted = count - done;
        }
        if (head > 127) {
            if (available == 0) {
                break;
            }
            repeat(pixels + done * size, data + position, size, wanted);
            position += size;
        } else {
            if (wanted > available) {
                wanted = available;
                length = 0; /* ends the loop, since the data is cut short */
            }
            memcpy(pixels + done * size, data + position, wanted * size);
            position += wanted * size;
        }
        done += wanted;
    }
    return done;
}
