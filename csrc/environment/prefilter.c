/* What rough mirrors show of an environment (R67, R68): light l counts D(h)(n.l), GGX's D of the half vector h of n and l, as the
 * split sum takes it (Karis, Real Shading in Unreal Engine 4, 2013: the mirror is seen along its normal).
 *
 * Narrow lobes are sampled: directions of equal shares of D (n.h) on a spiral of the golden angle, each in the cube whose texels are
 * about as large as its share (Krivanek and Colbert, Real-time Shading with Filtered Importance Sampling, 2008). Wide lobes are sums
 * over all texels of a small cube.
 */
#include <math.h>
#include <string.h>

#include "core/pool.h"
#include "environment/cube.h"
#include "environment/prefilter.h"

#define PI 0x1.921fb54442d18p+1

enum {
    SAMPLES = 96,
    SUM_SIZE = 32, /* texels along a face of the cube that is summed */
    LANES = 4      /* partial sums side by side */
};
#define WIDE 0.45 /* roughness above which texels are summed */
#define TEXELS_A_SHARE 2.0

/* ---- narrow lobes ---- */

typedef struct lobe_sample {
    float x, y, z, weight; /* z is along the normal */
    const e3d_cube *cube;
} lobe_sample;

typedef struct lobe {
    lobe_sample samples[SAMPLES];
    int count;
    const e3d_cube *out;
} lobe;

/* GGX's D times pi. */
static double distribution(double square, double h2)
{
    double t = h2 * (square - 1.0) + 1.0;
    return square / (t * t);
}

/* The cube of which so many texels take a sample's solid angle. */
static const e3d_cube *cube_of(const e3d_halves *halves, double solid_angle)
{
    double size = halves->of[0].size, texel = TEXELS_A_SHARE * 4.0 * PI / (E3D_FACES * size * size);
    int n = 0;
    for (; n < halves->count - 1 && texel * 2.0 < solid_angle; n++)
        texel *= 4.0;
    return &halves->of[n];
}

static void find_samples(const e3d_halves *halves, double roughness, lobe *out)
{
    const double COSINE = -0x1.798869e0de833p-1, SINE = 0x1.59d9dd253cc13p-1; /* of the golden angle */
    double square = roughness * roughness * roughness * roughness, c = 1.0, s = 0.0, total = 0.0;
    out->count = 0;
    for (int i = 0; i < SAMPLES; i++) {
        double share = (i + 0.5) / SAMPLES, h2 = (1.0 - share) / (1.0 + (square - 1.0) * share);
        double z = 2.0 * h2 - 1.0, radius = sqrt(1.0 - z * z), turned = c * COSINE - s * SINE;
        s = s * COSINE + c * SINE;
        c = turned;
        if (z <= 0.0)
            continue;
        const e3d_cube *cube = cube_of(halves, 4.0 * PI / (SAMPLES * distribution(square, h2)));
        out->samples[out->count++] = (lobe_sample){(float)(radius * c), (float)(radius * s), (float)z, (float)z, cube};
        total += (float)z;
    }
    for (int i = 0; i < out->count; i++)
        out->samples[i].weight = (float)(out->samples[i].weight / total);
}

/* The unit vectors of a texel: along the face, down it, and outwards. */
static void find_frame(const e3d_cube *cube, int face, int32_t column, int32_t row, float frame[3][3])
{
    double p = e3d_cube_middle(cube->size, column), q = e3d_cube_middle(cube->size, row), n[3], t[3], b[3], middle[3];
    e3d_cube_direction(face, p, q, n);
    e3d_cube_direction(face, 0.0, 0.0, middle);
    e3d_cube_direction(face, 1.0, 0.0, t);
    double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        n[k] /= length;
        t[k] -= middle[k];
    }
    double along = (n[0] * t[0] + n[1] * t[1]) + n[2] * t[2], rest = sqrt(1.0 - along * along);
    for (int k = 0; k < 3; k++)
        t[k] = (t[k] - along * n[k]) / rest;
    for (int k = 0; k < 3; k++)
        b[k] = n[(k + 1) % 3] * t[(k + 2) % 3] - n[(k + 2) % 3] * t[(k + 1) % 3];
    for (int k = 0; k < 3; k++) {
        frame[0][k] = (float)t[k];
        frame[1][k] = (float)b[k];
        frame[2][k] = (float)n[k];
    }
}

static void sample_texel(const lobe *lobe, int face, int32_t column, int32_t row)
{
    float frame[3][3], *out = e3d_cube_texel(lobe->out, face, column, row);
    double sum[3] = {0};
    find_frame(lobe->out, face, column, row, frame);
    for (int i = 0; i < lobe->count; i++) {
        const lobe_sample *s = &lobe->samples[i];
        float d[3], light[3];
        for (int k = 0; k < 3; k++)
            d[k] = (s->x * frame[0][k] + s->y * frame[1][k]) + s->z * frame[2][k];
        e3d_cube_sample(s->cube, d, light);
        for (int k = 0; k < 3; k++)
            sum[k] += (double)(s->weight * light[k]);
    }
    for (int k = 0; k < 3; k++)
        out[k] = (float)sum[k];
    out[3] = 0.0f;
}

static void sample_row(void *argument, int number)
{
    const lobe *lobe = argument;
    int32_t size = lobe->out->size;
    for (int32_t column = 0; column < size; column++)
        sample_texel(lobe, number / size, column, number % size);
}

/* ---- wide lobes ---- */

/* The texels of a cube as arrays: directions, solid angles and light. */
typedef struct texel_rows {
    float direction[3][E3D_FACES * SUM_SIZE * SUM_SIZE], weight[E3D_FACES * SUM_SIZE * SUM_SIZE];
    float light[3][E3D_FACES * SUM_SIZE * SUM_SIZE];
    int count, row; /* texels of a row of a face */
    float square;
    const e3d_cube *out;
} texel_rows;

static void find_texels(const e3d_cube *cube, texel_rows *out)
{
    int n = 0;
    for (int face = 0; face < E3D_FACES; face++)
        for (int32_t row = 0; row < cube->size; row++)
            for (int32_t column = 0; column < cube->size; column++, n++) {
                double p = e3d_cube_middle(cube->size, column), q = e3d_cube_middle(cube->size, row), d[3];
                e3d_cube_direction(face, p, q, d);
                double length = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
                const float *texel = e3d_cube_texel(cube, face, column, row);
                for (int k = 0; k < 3; k++) {
                    out->direction[k][n] = (float)(d[k] / length);
                    out->light[k][n] = texel[k];
                }
                out->weight[n] = (float)e3d_cube_weight(p, q);
            }
    out->count = n;
    out->row = cube->size;
}

/* What a row of texels adds: red, green, blue, and what light of 1 would. */
static void add_row(const texel_rows *t, int first, const float n[3], double sums[4])
{
    float partial[4][LANES] = {{0}};
    for (int i = first; i < first + t->row; i += LANES)
        for (int k = 0; k < LANES; k++) {
            float c = (n[0] * t->direction[0][i + k] + n[1] * t->direction[1][i + k]) + n[2] * t->direction[2][i + k];
            float h2 = (1.0f + c) * 0.5f, d = h2 * (t->square - 1.0f) + 1.0f;
            c = c > 0.0f ? c : 0.0f;
            float weight = (c * t->weight[i + k]) / (d * d);
            for (int channel = 0; channel < 3; channel++)
                partial[channel][k] += weight * t->light[channel][i + k];
            partial[3][k] += weight;
        }
    for (int channel = 0; channel < 4; channel++)
        for (int k = 0; k < LANES; k++)
            sums[channel] += (double)partial[channel][k];
}

static void sum_row(void *argument, int number)
{
    const texel_rows *t = argument;
    int32_t size = t->out->size, row = number % size;
    for (int32_t column = 0; column < size; column++) {
        double n[3], sums[4] = {0};
        float *out = e3d_cube_texel(t->out, number / size, column, row);
        e3d_cube_direction(number / size, e3d_cube_middle(size, column), e3d_cube_middle(size, row), n);
        double length = sqrt((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
        const float unit[3] = {(float)(n[0] / length), (float)(n[1] / length), (float)(n[2] / length)};
        for (int first = 0; first < t->count; first += t->row)
            add_row(t, first, unit, sums);
        for (int k = 0; k < 3; k++)
            out[k] = (float)(sums[k] / sums[3]);
        out[3] = 0.0f;
    }
}

static const e3d_cube *cube_to_sum(const e3d_halves *halves)
{
    int n = 0;
    while (halves->of[n].size > SUM_SIZE)
        n++;
    return &halves->of[n];
}

void e3d_prefilter(const e3d_halves *halves, double roughness, int threads, const e3d_cube *out)
{
    int rows = E3D_FACES * out->size;
    if (roughness > WIDE) {
        texel_rows texels;
        find_texels(cube_to_sum(halves), &texels);
        texels.square = (float)(roughness * roughness * roughness * roughness);
        texels.out = out;
        e3d_pool_share(threads, rows, sum_row, &texels);
    } else {
        lobe samples = {.out = out};
        find_samples(halves, roughness, &samples);
        e3d_pool_share(threads, rows, sample_row, &samples);
    }
    e3d_cube_fill_border(out);
}
