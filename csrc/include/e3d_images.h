/* Image files: the loops over bytes that Python is too slow for.
 *
 * In:  pixels, or the bytes of a file.
 * Out: the bytes of a file, or pixels.
 * Always: integers only, so the same pixels give the same file on every machine; nothing is read or
 *      written outside the arrays given, whatever the bytes.
 */
#ifndef E3D_IMAGES_H
#define E3D_IMAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Encodes pixels, top row first, as a PNG file.
 *
 * In:  width and height from 1 to 16384; the rows lie `stride` bytes apart. 1 to 4 channels: grey, grey with
 *      alpha, RGB, RGBA; 8 bits each, or 16 with the higher byte first.
 * Out: *file is to be freed with free(); false, and nothing to free, if memory runs out. */
bool e3d_png_encode(const uint8_t *pixels, int32_t width, int32_t height, ptrdiff_t stride,
                    int32_t channels, int32_t bits, uint8_t **file, size_t *size);

/* Unpacks the run-length packets of a TGA file until `count` pixels of `pixel_bytes` (1 to 4) are
 * there, into pixels[count * pixel_bytes]. Returns how many pixels the data held, at most `count`:
 * fewer if it ends early. */
size_t e3d_tga_unpack(const uint8_t *data, size_t length, int32_t pixel_bytes, uint8_t *pixels,
                      size_t count);

/* What ends the scan lines of a Radiance picture before all are there. */
typedef enum e3d_rgbe_fault {
    E3D_RGBE_WHOLE = 0, /* nothing does */
    E3D_RGBE_CUT_SHORT,
    E3D_RGBE_RUN_TOO_LONG,      /* or of no length: it doesn't fit its line */
    E3D_RGBE_NOTHING_TO_REPEAT, /* a line begins with a repetition */
    E3D_RGBE_OTHER_WIDTH        /* a line says that it has another width */
} e3d_rgbe_fault;

/* Unpacks lines of a Radiance picture into pixels[lines * width * 4]. Returns how many are whole; *used is
 * where in the data the next one begins, or the fault is. */
size_t e3d_rgbe_unpack(const uint8_t *data, size_t length, int32_t width, size_t lines,
                       uint8_t *pixels, size_t *used, e3d_rgbe_fault *fault);

#endif
