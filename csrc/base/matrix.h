/* Products and cofactors of matrices, row after row, in f64. Their operations and the order of these are the same everywhere. */
#pragma once

#include <string.h>

#include "base/always_inline.h"

/* Two columns of a row. */
typedef double e3d_double2 __attribute__((vector_size(16)));

/* b: rows in registers, since a load of two would wait for two stores of one. */
static ALWAYS_INLINE void e3d_multiply_rows(const double a[16], const e3d_double2 b[4][2], double out[16])
{
    for (int r = 0; r < 4; r++)
        for (int h = 0; h < 2; h++) {
            const double *m = a + 4 * r;
            e3d_double2 sum = ((m[0] * b[0][h] + m[1] * b[1][h]) + m[2] * b[2][h]) + m[3] * b[3][h];
            memcpy(out + 4 * r + 2 * h, &sum, sizeof sum);
        }
}

static inline void e3d_multiply(const double a[16], const double b[16], double out[16])
{
    e3d_double2 rows[4][2];
    memcpy(rows, b, sizeof rows);
    e3d_multiply_rows(a, rows, out);
}

/* The cofactors of the upper left 3x3, and its determinant. */
static inline double e3d_find_cofactors(const double m[16], double cofactor[9])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[3 * r + c] = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
        }
    return (m[0] * cofactor[0] + m[1] * cofactor[1]) + m[2] * cofactor[2];
}
