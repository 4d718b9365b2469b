/* Equirectangular pictures to the faces of a cube (R65, R66).
 *
 * Each texel is the mean of many places on it, between whose texels the picture is interpolated: a sun of one pixel keeps its light
 * to about a hundredth. Near the poles, where pixels are narrower than places lie apart, rows are averaged to pixels as wide as they
 * are high first. The azimuth of a place on one of the four upright faces depends on its column alone, and its height above
 * the horizon is the same on all four.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/pool.h"
#include "light/arc_tangent.h"
#include "light/picture.h"

#define E3D_MAX_RADIANCE 0x1p40f
#define HALF_PI 0x1.921fb54442d18p+0

enum { PLACES = 3 }; /* places along a texel, for each pixel of the picture that falls on it */

/* A copy of the picture with its numbers limited, and a register for each pixel. Rows and columns continue beyond the ends,
 * around the sphere. */
typedef struct picture {
    float *texels; /* (height + 2, width + 2, 4) */
    int32_t width, height;
} picture;

static float *picture_texel(const picture *p, int32_t column, int32_t row)
{
    return p->texels + E3D_TEXEL * ((size_t)(row + 1) * ((size_t)p->width + 2) + (size_t)(column + 1));
}

static float limited(float v)
{
    v = v > 0.0f ? v : 0.0f;
    return v < E3D_MAX_RADIANCE ? v : E3D_MAX_RADIANCE;
}

typedef struct copy_job {
    const float *pixels;
    const picture *to;
} copy_job;

/* How many pixels to either side, near a pole, are together about as wide as a pixel is high. */
static int32_t spread_of(const picture *p, int32_t row)
{
    int32_t from_pole = row < p->height - 1 - row ? row : p->height - 1 - row;
    double angle = 2.0 * HALF_PI * (from_pole + 0.5) / p->height, square = angle * angle;
    double sine = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0)); /* accurate to a thousandth where it matters */
    double spread = (1.0 / sine - 0.5) * ((double)p->width / (2.0 * p->height)), most = (p->width - 1) / 2;
    return angle > 1.0 ? 0 : (int32_t)(spread < most ? spread : most);
}

/* A column at most one width away from the picture. */
static int32_t around(int32_t column, int32_t width)
{
    if (column < 0)
        return column + width;
    return column < width ? column : column - width;
}

static void copy_pixel(const copy_job *job, const float *row, int32_t x, int32_t spread, float *out)
{
    int32_t width = job->to->width;
    double sum[3] = {0};
    for (int32_t i = x - spread; i <= x + spread; i++) {
        const float *from = row + 3 * (size_t)around(i, width);
        for (int k = 0; k < 3; k++)
            sum[k] += (double)(isfinite(from[k]) ? limited(from[k]) : 0.0f);
    }
    for (int k = 0; k < 3; k++)
        out[k] = (float)(sum[k] / (2 * spread + 1));
    out[3] = 0.0f;
}

static void copy_row(void *argument, int row)
{
    const copy_job *job = argument;
    const picture *to = job->to;
    const size_t bytes = E3D_TEXEL * sizeof(float);
    const float *from = job->pixels + 3 * (size_t)row * (size_t)to->width;
    int32_t spread = spread_of(to, row);
    for (int32_t x = 0; x < to->width; x++)
        copy_pixel(job, from, x, spread, picture_texel(to, x, row));
    memcpy(picture_texel(to, -1, row), picture_texel(to, to->width - 1, row), bytes);
    memcpy(picture_texel(to, to->width, row), picture_texel(to, 0, row), bytes);
}

/* Beyond a pole the picture continues half a turn around. */
static void copy_poles(const picture *to)
{
    const int32_t rows[2][2] = {{-1, 0}, {to->height, to->height - 1}};
    for (int pole = 0; pole < 2; pole++)
        for (int32_t x = -1; x <= to->width; x++) {
            int32_t across = (x + to->width / 2 + to->width) % to->width;
            memcpy(picture_texel(to, x, rows[pole][0]), picture_texel(to, across, rows[pole][1]), E3D_TEXEL * sizeof(float));
        }
}

static int copy_picture(const float *pixels, int threads, picture *to)
{
    to->texels = malloc(((size_t)to->width + 2) * ((size_t)to->height + 2) * E3D_TEXEL * sizeof(float));
    if (!to->texels)
        return 0;
    copy_job job = {pixels, to};
    e3d_pool_share(threads, to->height, copy_row, &job);
    copy_poles(to);
    return 1;
}

/* Adds the picture's radiance at (u, v); these wrap around, and lie in [0, 1]. */
static void add_sample(const picture *p, double u, double v, float sum[E3D_TEXEL])
{
    float x = (float)(u * p->width + 0.5), y = (float)(v * p->height + 0.5);
    int32_t column = (int32_t)x, row = (int32_t)y;
    column = column < p->width ? column : p->width;
    row = row < p->height ? row : p->height;
    float f = x - (float)column, g = y - (float)row;
    const float *upper = picture_texel(p, column - 1, row - 1), *lower = upper + E3D_TEXEL * ((size_t)p->width + 2);
    for (int k = 0; k < E3D_TEXEL; k++) {
        float t = upper[k] + (upper[E3D_TEXEL + k] - upper[k]) * f;
        float b = lower[k] + (lower[E3D_TEXEL + k] - lower[k]) * f;
        sum[k] += t + (b - t) * g;
    }
}

/* ---- places of the sphere ---- */

/* A vector's angle to the x axis, as a share of the whole turn: in (-1/2, 1/2]. */
static double turn_of(double y, double x)
{
    double rise = fabs(y), run = fabs(x), longer = rise > run ? rise : run, shorter = rise > run ? run : rise;
    double angle = e3d_arc_tangent(longer > 0.0 ? shorter / longer : 0.0);
    angle = rise > run ? HALF_PI - angle : angle;
    angle = x < 0.0 ? 2.0 * HALF_PI - angle : angle;
    return (y < 0.0 ? -angle : angle) / (4.0 * HALF_PI);
}

static double wrapped(double u)
{
    if (u < 0.0)
        return u + 1.0;
    return u >= 1.0 ? u - 1.0 : u;
}

/* ---- the faces ---- */

typedef struct faces_job {
    const picture *from;
    const e3d_cube *to;
    int places;          /* along a texel */
    const double *turns; /* for each place along a row its azimuth on an upright face */
} faces_job;

static double place_at(const faces_job *job, int32_t number) { return e3d_cube_middle(job->to->size * job->places, number); }

/* A row of the four upright faces. */
static void fill_upright(void *argument, int row)
{
    static const double BASE[4] = {0.5, 0.0, 0.75, 0.25}; /* the azimuths of the middles: +X -X +Z -Z */
    static const int FACE[4] = {0, 1, 4, 5};
    const faces_job *job = argument;
    int n = job->places;
    for (int32_t column = 0; column < job->to->size; column++) {
        float sums[4][E3D_TEXEL] = {{0}};
        for (int k = 0; k < n * n; k++) {
            int32_t x = column * n + k % n, y = row * n + k / n;
            double p = place_at(job, x), q = place_at(job, y), v = 0.5 + 2.0 * turn_of(q, sqrt(1.0 + p * p));
            for (int face = 0; face < 4; face++)
                add_sample(job->from, wrapped(BASE[face] - job->turns[x]), v, sums[face]);
        }
        for (int face = 0; face < 4; face++)
            for (int k = 0; k < E3D_TEXEL; k++)
                e3d_cube_texel(job->to, FACE[face], column, row)[k] = sums[face][k] / (float)(n * n);
    }
}

/* A row of the upper and the lower face. */
static void fill_level(void *argument, int row)
{
    const faces_job *job = argument;
    int n = job->places;
    for (int32_t column = 0; column < job->to->size; column++) {
        float sums[2][E3D_TEXEL] = {{0}};
        for (int k = 0; k < n * n; k++) {
            double p = place_at(job, column * n + k % n), q = place_at(job, row * n + k / n);
            double azimuth = turn_of(q, p), v = 2.0 * turn_of(sqrt(p * p + q * q), 1.0);
            add_sample(job->from, wrapped(0.5 + azimuth), v, sums[0]);
            add_sample(job->from, wrapped(0.5 - azimuth), 1.0 - v, sums[1]);
        }
        for (int face = 0; face < 2; face++)
            for (int k = 0; k < E3D_TEXEL; k++)
                e3d_cube_texel(job->to, 2 + face, column, row)[k] = sums[face][k] / (float)(n * n);
    }
}

static int fill_faces(const picture *from, int threads, const e3d_cube *cube)
{
    int around = from->width > 2 * from->height ? from->width : 2 * from->height; /* pixels */
    int finest = 4 * cube->size;                                                  /* the level where one pixel falls on a texel */
    faces_job job = {from, cube, PLACES * ((around + finest - 1) / finest), NULL};
    int32_t count = job.places * cube->size;
    double *turns = malloc((size_t)count * sizeof *turns);
    if (!turns)
        return 0;
    for (int32_t x = 0; x < count; x++)
        turns[x] = turn_of(place_at(&job, x), 1.0);
    job.turns = turns;
    e3d_pool_share(threads, cube->size, fill_upright, &job);
    e3d_pool_share(threads, cube->size, fill_level, &job);
    free(turns);
    e3d_cube_fill_border(cube);
    return 1;
}

int e3d_cube_from_picture(const float *pixels, int32_t width, int32_t height, int threads, const e3d_cube *cube)
{
    picture from = {NULL, width, height};
    int filled = copy_picture(pixels, threads, &from) && fill_faces(&from, threads, cube);
    free(from.texels);
    return filled;
}
