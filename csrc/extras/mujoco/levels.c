/* Levels of textures: half as many texels along each side, of those before (R263).
 * In: texels, and what their codes mean. Out: texels. */
#include <math.h>

#include "extras/mujoco/picture.h"

/* The texels of a level that a smaller one lies between, and the share of the second. */
typedef struct between {
    int32_t low, high;
    double share;
} between;

static between find_between(int32_t i, int32_t size, int32_t half)
{
    if (size == 1)
        return (between){0, 0, 0};
    double at = (i + 0.5) * ((double)size / half) - 0.5, low = floor(at);
    int32_t first = (int32_t)low;
    return (between){first, first + 1 < size ? first + 1 : size - 1, at - low};
}

static double mean_of(double a, double b, double share) { return share > 0 ? a * (1 - share) + b * share : a; }

/* How many limits a value reaches. */
static uint8_t code_of(const double limits[255], double v)
{
    int low = 0, high = 255;
    while (low < high) {
        int middle = (low + high) / 2;
        if (limits[middle] <= v)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}

static void halve_texel(const uint8_t *const corner[4], const between *x, const between *y, const double meaning[256], const double limits[255],
                        uint8_t *to)
{
    for (int c = 0; c < 4; c++) {
        double v[4];
        for (int k = 0; k < 4; k++)
            v[k] = c < 3 ? meaning[corner[k][c]] : corner[k][c] / 255.0;
        double mean = mean_of(mean_of(v[0], v[2], y->share), mean_of(v[1], v[3], y->share), x->share);
        to[c] = c < 3 ? code_of(limits, mean) : (uint8_t)floor(mean * 255 + 0.5);
    }
}

void e3d_muj_halve(const uint8_t *texels, int32_t faces, int32_t height, int32_t width, const double meaning[256], const double limits[255],
                   uint8_t *to)
{
    int32_t rows = height > 1 ? height / 2 : 1, columns = width > 1 ? width / 2 : 1;
    for (int32_t j = 0; j < faces * rows; j++) {
        between y = find_between(j % rows, height, rows);
        const uint8_t *face = texels + (size_t)(j / rows) * (size_t)height * (size_t)width * 4;
        const uint8_t *upper = face + (size_t)y.low * (size_t)width * 4, *lower = face + (size_t)y.high * (size_t)width * 4;
        for (int32_t i = 0; i < columns; i++, to += 4) {
            between x = find_between(i, width, columns);
            size_t left = 4 * (size_t)x.low, right = 4 * (size_t)x.high;
            halve_texel((const uint8_t *const[4]){upper + left, upper + right, lower + left, lower + right}, &x, &y, meaning, limits, to);
        }
    }
}
