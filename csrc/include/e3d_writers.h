/* Writes model files as text: arrays in, bytes out. No files, no Python, no locale.
 * The caller gives the room: E3D_FLOAT_LETTERS or E3D_INTEGER_LETTERS bytes for each number, and the length of the text between
 * them. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define E3D_FLOAT_LETTERS 16 /* room for "-0.000123456789" and "-1.23456789e-38", and one byte more */
#define E3D_INTEGER_LETTERS 11

/* Writes the shortest digits that read back as the same float; of several, the nearest: "1", "0.1", "1.5e-05", "1e+06", "-0",
 * "nan", "inf". Returns how many bytes it wrote; it adds no final zero. */
size_t e3d_write_float(float number, uint8_t *text);

/* Writes rows of `width` floats. between[k], of lengths[k] bytes, comes before number k, and between[width] ends the row.
 * Returns how many bytes it wrote. */
size_t e3d_write_float_rows(const float *numbers, size_t rows, size_t width,
                            const uint8_t *const *between, const size_t *lengths, uint8_t *text);

/* The numbers at a corner of a face of an OBJ file: v, v/vt, v//vn or v/vt/vn. */
typedef enum e3d_corner_form {
    E3D_CORNER_V,
    E3D_CORNER_V_VT,
    E3D_CORNER_V_VN,
    E3D_CORNER_V_VT_VN,
} e3d_corner_form;

/* Writes lines "f corner ... corner". Line k has sizes[k] corners; the numbers of all corners follow each other, for v, vt and
 * vn alike. ends[k] becomes the end of line k. A corner takes at most 3 * (E3D_INTEGER_LETTERS + 1) bytes, a line two more.
 * Returns how many bytes it wrote. */
size_t e3d_write_faces(const int32_t *sizes, size_t faces, const int32_t *positions,
                       const int32_t *others, e3d_corner_form form, uint8_t *text, int64_t *ends);
