/* Cubes: directions of their texels, and borders. */
#include <math.h>
#include <string.h>

#include "light/cube.h"

/* The axes along which the columns and rows of each face go: +X -X +Y -Y +Z -Z, in OpenGL's layout. */
static const struct {
    double middle[3], across[3], down[3];
} FACES[E3D_FACES] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

void e3d_cube_direction(int face, double p, double q, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (FACES[face].middle[k] + p * FACES[face].across[k]) + q * FACES[face].down[k];
}

void e3d_cube_unit(int face, double p, double q, float out[3])
{
    double d[3], length = sqrt((1.0 + p * p) + q * q);
    e3d_cube_direction(face, p, q, d);
    for (int k = 0; k < 3; k++)
        out[k] = (float)(d[k] / length);
}

double e3d_cube_weight(double p, double q)
{
    double length2 = (1.0 + p * p) + q * q;
    return 1.0 / (length2 * sqrt(length2));
}

/* ---- places ---- */

typedef struct place {
    int face;
    float p, q;
} place;

static place place_of(float x, float y, float z)
{
    float a = fabsf(x), b = fabsf(y), c = fabsf(z);
    if (a >= b && a >= c)
        return (place){x < 0.0f, (x < 0.0f ? z : -z) / a, -y / a};
    if (b >= c)
        return (place){2 + (y < 0.0f), x / b, (y < 0.0f ? -z : z) / b};
    return (place){4 + (z < 0.0f), (z < 0.0f ? -x : x) / c, -y / c};
}

/* ---- borders ---- */

/* The texel of another face that touches the edge beside a texel of the border. */
static const float *beyond(const e3d_cube *cube, int face, int32_t column, int32_t row)
{
    double ends[2] = {e3d_cube_middle(cube->size, column), e3d_cube_middle(cube->size, row)}, d[3];
    for (int k = 0; k < 2; k++) /* only just beyond the edge: farther out, the texels of a row would drift apart */
        ends[k] = fabs(ends[k]) > 1.0 ? ends[k] / fabs(ends[k]) * (1.0 + 0x1p-20) : ends[k];
    e3d_cube_direction(face, ends[0], ends[1], d);
    place at = place_of((float)d[0], (float)d[1], (float)d[2]);
    int32_t there[2];
    for (int k = 0; k < 2; k++) {
        there[k] = (int32_t)(((k ? at.q : at.p) + 1.0f) * 0.5f * (float)cube->size);
        there[k] = there[k] < cube->size ? there[k] : cube->size - 1;
    }
    return e3d_cube_texel(cube, at.face, there[0], there[1]);
}

static void fill_corner(const e3d_cube *cube, int face, int32_t column, int32_t row)
{
    int32_t inner[2] = {column < 0 ? 0 : column - 1, row < 0 ? 0 : row - 1};
    const float *a = e3d_cube_texel(cube, face, inner[0], inner[1]), *b = e3d_cube_texel(cube, face, column, inner[1]),
                *c = e3d_cube_texel(cube, face, inner[0], row);
    float *out = e3d_cube_texel(cube, face, column, row);
    for (int k = 0; k < E3D_TEXEL; k++) /* equal texels keep their value, which three thirds would not */
        out[k] = a[k] + ((b[k] - a[k]) + (c[k] - a[k])) / 3.0f;
}

void e3d_cube_fill_border(const e3d_cube *cube)
{
    const size_t bytes = E3D_TEXEL * sizeof(float);
    const int32_t ends[2] = {-1, cube->size};
    for (int face = 0; face < E3D_FACES; face++) {
        for (int end = 0; end < 2; end++)
            for (int32_t i = 0; i < cube->size; i++) {
                memcpy(e3d_cube_texel(cube, face, ends[end], i), beyond(cube, face, ends[end], i), bytes);
                memcpy(e3d_cube_texel(cube, face, i, ends[end]), beyond(cube, face, i, ends[end]), bytes);
            }
        for (int corner = 0; corner < 4; corner++)
            fill_corner(cube, face, ends[corner & 1], ends[corner >> 1]);
    }
}
