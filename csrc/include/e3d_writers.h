/* Writing model files as text: arrays in, bytes out. No files, no Python, no locale.
 *
 * The caller brings the room: for each number E3D_FLOAT_LETTERS or E3D_INTEGER_LETTERS bytes, and what is
 * written between them.
 */
#ifndef E3D_WRITERS_H
#define E3D_WRITERS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define E3D_FLOAT_LETTERS 16 /* "-0.000123456789", "-1.23456789e-38", and one to spare */
#define E3D_INTEGER_LETTERS 11

/* Writes the fewest digits that are read back as the same float, the nearest of those that are as few:
 * "1", "0.1", "1.5e-05", "1e+06", "-0", "nan", "inf". Returns how many bytes; no zero ends them. */
size_t e3d_write_float(float number, uint8_t *text);

/* Writes rows of `width` floats; `between[k]`, of `lengths[k]` bytes, before number k, and the last one,
 * `between[width]`, behind the row. Returns how many bytes. */
size_t e3d_write_float_rows(const float *numbers, size_t rows, size_t width,
                            const uint8_t *const *between, const size_t *lengths, uint8_t *text);

/* What a corner of a face of an OBJ file names: v, v/vt, v//vn or v/vt/vn. */
typedef enum e3d_corner_form {
    E3D_CORNER_V,
    E3D_CORNER_V_VT,
    E3D_CORNER_V_VN,
    E3D_CORNER_V_VT_VN,
} e3d_corner_form;

/* Writes lines "f corner ... corner": of sizes[k] corners each, whose numbers stand one after another, for
 * v and for the others. ends[k] becomes the end of line k. A corner takes at most
 * 3 * (E3D_INTEGER_LETTERS + 1) bytes, a line two more. Returns how many bytes. */
size_t e3d_write_faces(const int32_t *sizes, size_t faces, const int32_t *positions,
                       const int32_t *others, e3d_corner_form form, uint8_t *text, int64_t *ends);

#endif
