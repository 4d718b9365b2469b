/* The faces of a cube, as in e3d_environment_level, and places on it (R60). */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_environment.h"

enum { E3D_FACES = 6,
       E3D_TEXEL = 4 }; /* floats of a texel */

typedef struct e3d_cube {
    float *texels;
    int32_t size;
} e3d_cube;

static inline size_t e3d_cube_texels(int32_t size) { return E3D_FACES * ((size_t)size + 2) * ((size_t)size + 2); }

/* A texel of a face; its border has the numbers -1 and size. */
static inline float *e3d_cube_texel(const e3d_cube *cube, int face, int32_t column, int32_t row)
{
    size_t pitch = (size_t)cube->size + 2;
    return cube->texels + E3D_TEXEL * (((size_t)face * pitch + (size_t)(row + 1)) * pitch + (size_t)(column + 1));
}

/* The coordinate of a texel's middle on its face, in (-1, 1). */
static inline double e3d_cube_middle(int32_t size, int32_t number) { return (2.0 * number + 1.0) / size - 1.0; }

/* The direction of a place on a face; not of unit length. */
void e3d_cube_direction(int face, double p, double q, double out[3]);
/* The same of unit length. */
void e3d_cube_unit(int face, double p, double q, float out[3]);
/* The solid angle of a texel, without a factor that all texels of a cube share. */
double e3d_cube_weight(double p, double q);
/* Fills the borders with the neighbouring faces' texels; where three faces meet, with their mean. */
void e3d_cube_fill_border(const e3d_cube *cube);
