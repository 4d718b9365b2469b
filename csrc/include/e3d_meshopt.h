/* Unpacks buffer views of glTF files: EXT_meshopt_compression and KHR_meshopt_compression.
 * Source: the specification of KHR_meshopt_compression, appendices A (bitstream) and B (filters).
 * Always: nothing outside the bytes given is read or written, whatever they hold. Each function returns false if the stream is
 * damaged; the bytes in `to` then mean nothing. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define E3D_MESHOPT_MAX_STRIDE 256

/* Mode 0: `count` elements of `stride` bytes, a multiple of 4 from 4 to E3D_MESHOPT_MAX_STRIDE. */
bool e3d_meshopt_attributes(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride);

/* Modes 1 and 2: `count` indices (of triangles: a multiple of 3), little-endian, of `stride` bytes: 2 or 4. */
bool e3d_meshopt_triangles(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride);
bool e3d_meshopt_indices(const uint8_t *bytes, size_t size, uint8_t *to, size_t count, size_t stride);

typedef enum e3d_meshopt_filter {
    E3D_MESHOPT_OCTAHEDRAL, /* stride 4 or 8 */
    E3D_MESHOPT_QUATERNION, /* stride 8 */
    E3D_MESHOPT_EXPONENTIAL, /* any multiple of 4 */
    E3D_MESHOPT_COLOR /* stride 4 or 8 */
} e3d_meshopt_filter;

/* Undoes a filter: decodes the elements of attributes in place. */
void e3d_meshopt_undo_filter(uint8_t *elements, size_t count, size_t stride, e3d_meshopt_filter filter);
