/* Image files: the loops over bytes that are too slow in Python.
 * In: pixels, or the bytes of a file. Out: the bytes of a file, or pixels.
 * Always: integers only, so the same pixels give the same file on every machine; nothing outside the arrays is read or written,
 * whatever the bytes are. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Encodes pixels, top row first, as a PNG file.
 * In: width and height from 1 to 16384; `stride` is the distance of rows in bytes. 1 to 4 channels: grey, grey with alpha, RGB,
 * RGBA; 8 bits each, or 16 with the higher byte first.
 * Out: *file, which the caller frees with free(). False, and nothing to free, if memory is out. */
bool e3d_png_encode(const uint8_t *pixels, int32_t width, int32_t height, ptrdiff_t stride,
                    int32_t channels, int32_t bits, uint8_t **file, size_t *size);

/* Unpacks the run-length packets of a TGA file into pixels[count * pixel_bytes]; pixel_bytes is 1 to 4. Returns how many pixels
 * the data held: `count`, or fewer if it ends early. */
size_t e3d_tga_unpack(const uint8_t *data, size_t length, int32_t pixel_bytes, uint8_t *pixels,
                      size_t count);

/* Why a Radiance picture ends before all its scan lines are there. */
typedef enum e3d_rgbe_fault {
    E3D_RGBE_WHOLE = 0, /* nothing does */
    E3D_RGBE_CUT_SHORT,
    E3D_RGBE_RUN_TOO_LONG,      /* a run that is longer than the rest of its line, or has no length */
    E3D_RGBE_NOTHING_TO_REPEAT, /* a line that begins with a repetition */
    E3D_RGBE_OTHER_WIDTH        /* a line whose header gives another width */
} e3d_rgbe_fault;

/* Unpacks lines of a Radiance picture into pixels[lines * width * 4]. Returns how many lines are whole; *used is the offset in
 * the data of the next line, or of the fault. */
size_t e3d_rgbe_unpack(const uint8_t *data, size_t length, int32_t width, size_t lines,
                       uint8_t *pixels, size_t *used, e3d_rgbe_fault *fault);
