/* The loops over vertices, triangles, samples, corners and fragments of pictures in MuJoCo's manner, once for each backend.
 * In: arrays. Out: arrays. Always: every backend gives the same bytes; `scalar` is written plainly, without vectors. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_backends.h"
#include "e3d_mujoco.h"

enum { MUJ_SUB = 256,                   /* steps of a pixel */
       MUJ_PASSES = 1 + E3D_MUJ_LIGHTS, /* the first pass, and one for each light with shadows */
       MUJ_COLUMN = 64,                 /* pixels of a row to which a face's weights belong */
       MUJ_CORNERS = 96,                /* corners that are lit at once; whole triangles, whole vectors */
       MUJ_BATCH = 256,                 /* fragments that are shaded at once */
       MUJ_OUTSIDE = INT32_MIN };

/* ---- vertices and triangles ---- */

typedef struct muj_projection {
    float column[4][4];             /* of (x, y, z, 1): X and Y in 1/256 pixel, Z, W */
    float most;                     /* vertices that lie farther to a side than this are outside */
    int32_t has_clip;
    float clip[4];                  /* with has_clip, what has a negative distance from this plane is outside */
} muj_projection;

/* Vertices in 1/256 pixel, as they are and snapped, side by side; the first of both is MUJ_OUTSIDE of those that need clipping.
 * Each array has room for a vector more. */
typedef struct muj_vertices {
    float *x, *y, *z;
    int32_t (*snapped)[2];
} muj_vertices;

typedef struct muj_choice {
    int32_t facing;                 /* 1: fronts show, -1: backs, 0: both */
    int32_t samples, at[2][4];      /* of a pixel; where they are, in 1/256 pixel */
    int32_t low[2], high[2];        /* the pixels that count, the last ones included */
} muj_choice;

/* ---- samples ---- */

/* A triangle in pixels; edges are a*x + b*y + e in steps of 1/256 pixel, counted from the corner of pixel (x0, y0). */
typedef struct muj_record {
    int32_t x0, y0, x1, y1;         /* the pixels that it may cover, the last ones included */
    int32_t a[3], b[3];
    int64_t e[3];
    double z, zx, zy;               /* the depth at the corner of pixel (x0, y0), and its change for each pixel */
    int32_t draw, triangle;
} muj_record;

/* Rows of samples that are drawn to. Samples lie in groups of four: the samples of a pixel, or four pixels of a row. */
typedef struct muj_raster {
    int32_t top, end;               /* rows of the picture */
    int32_t group_pixels;           /* pixels of a group */
    int32_t lane_x[4], lane_y[4];   /* the samples' places in a group, in 1/256 pixel */
    size_t stride;                  /* samples of a row, and room for a vector more */
    float *depth;                   /* from row `top` on */
    int32_t *shown;                 /* numbers of records, or -1 */
} muj_raster;

/* ---- shadows ---- */

/* The texels of maps that are read, and the depths there, in steps. A vector more may be read. */
typedef struct muj_lookups {
    int32_t *x, *y, *step;
} muj_lookups;

/* A record that may hide light: edges at its first texel are floors of 1/256. No depth of it exceeds `bound`. */
typedef struct muj_shadow_test {
    int32_t low[2], high[2], edge[3], across[3], down[3], bound;
} muj_shadow_test;

/* ---- corners ---- */

/* A light as corners see it. */
typedef struct muj_lamp {
    int32_t is_directional, pass;
    float pos[3], dir[3];           /* dir: unit */
    float attenuation[3], ambient[3], diffuse[3], specular[3], exponent, cutoff_cosine;
} muj_lamp;

typedef struct muj_lamps {
    int32_t count, passes;
    muj_lamp lamp[E3D_MUJ_LIGHTS];
    float eye[3], ambient;
} muj_lamps;

typedef struct muj_corners {
    int32_t count;
    float place[3][MUJ_CORNERS], normal[3][MUJ_CORNERS]; /* normals of any length */
    float rgb[3][MUJ_CORNERS], emission[MUJ_CORNERS], specular[MUJ_CORNERS], shininess[MUJ_CORNERS];
    float color[MUJ_PASSES][3][MUJ_CORNERS];             /* what is found: 0 .. 1 */
} muj_corners;

/* ---- fragments ---- */

/* A triangle's corners, as numbers one after the other: at (x, y), in pixels from the first one of a column and a band, corner
 * k weighs (base[k] + x*across[k]) + y*down[k], over the three's sum. What most fragments need comes first, since it is read in
 * blocks of eight numbers. */
typedef struct muj_face {
    float base[3], across[3], down[3];
    float color[3][3], coordinates[3][3], alpha[3], ahead[3], place[3][3]; /* channel, corner; the first pass's colour */
    float shadow_color[MUJ_PASSES - 1][3][3];                              /* of as many passes as there are */
} muj_face;

/* Where the colour of a pass begins in a face. */
static inline int muj_color_at(int pass)
{
    size_t at = pass ? offsetof(muj_face, shadow_color) + (size_t)(pass - 1) * 9 * sizeof(float) : offsetof(muj_face, color);
    return (int)(at / sizeof(float));
}

typedef struct muj_fog {
    float end, range, color[3];
} muj_fog;

/* Fragments that one texture covers, or none. */
typedef struct muj_batch {
    const float *faces;             /* eight numbers more may be read */
    const e3d_muj_texture *texture; /* NULL: none */
    const muj_fog *fog;             /* NULL: none */
    int32_t bottom;                 /* the picture's last row, from the band's first one */
    int32_t passes, needs_place, needs_alpha, count;
    int32_t face[MUJ_BATCH], x[MUJ_BATCH], y[MUJ_BATCH]; /* where a face begins in `faces`; pixels in its column and band */
    uint32_t code[MUJ_PASSES][MUJ_BATCH];                /* what is found: red, green, blue, 0 */
    float place[3][MUJ_BATCH], alpha[MUJ_BATCH];         /* if they are needed */
} muj_batch;

/* ---- the table ---- */

typedef struct muj_kernels {
    /* Transforms vertices, (count, 3) (R257). */
    void (*transform)(const muj_projection *projection, const float *positions, int32_t count, const muj_vertices *out);
    /* Lists the triangles first .. end - 1 that may show, or need clipping; returns how many. `out` has room for all, and a
     * vector more. */
    int32_t (*choose)(const muj_choice *choice, const muj_vertices *vertices, const int32_t *corners, int32_t first, int32_t end, int32_t *out);
    /* Draws records, by their numbers: where one is not farther than what is there, it shows (R258). */
    void (*draw)(const muj_raster *raster, muj_record *const *records, const int32_t *numbers, int32_t count);
    /* Lists the lookups first .. end - 1 that a record covers and that are not surely nearer; returns how many (R265). */
    int32_t (*cover)(const muj_shadow_test *test, const muj_lookups *lookups, int32_t first, int32_t end, int32_t *out);
    /* Lights corners (R261). */
    void (*light)(const muj_lamps *lamps, muj_corners *corners);
    /* Shades fragments (R259, R263, R264, R267). Arrays are filled up to whole vectors. */
    void (*shade)(muj_batch *batch);
} muj_kernels;

/* The kernels of a backend that this machine can run. */
const muj_kernels *muj_kernels_for(e3d_backend backend);
