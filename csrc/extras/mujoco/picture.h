/* The data that all stages of a picture in MuJoCo's manner share: draws, views, the picture. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/grow.h"
#include "base/vectors.h"
#include "e3d_mujoco.h"
#include "extras/mujoco/kernels/kernels.h"

enum { MUJ_BAND = 16,                   /* a thread takes so many rows at a time */
       MUJ_GUARD = 4096,
       MUJ_MOST = 16000, /* pixels of a side, texels of a map: 256 times as many fit 22 bits */
       MUJ_NONE = -1 };

typedef enum muj_kind { MUJ_TRIANGLES = 0,
                        MUJ_GRID, /* a plane: two triangles that are drawn, cells that are lit */
                        MUJ_LINES } muj_kind;

typedef enum muj_mapping { MUJ_UNTEXTURED = 0,
                           MUJ_BY_UVS,
                           MUJ_BY_POSITION,
                           MUJ_BY_DIRECTION } muj_mapping;

/* A part of a geom: a shape at a place. */
typedef struct muj_draw {
    muj_kind kind;
    const e3d_muj_shape *shape, *plain; /* plain: the same without inner lines */
    const e3d_muj_plane *plane;
    const e3d_muj_geom *geom;       /* NULL: the sky, the haze */
    int32_t number;                 /* of the geom */
    int32_t facing;                 /* 1: fronts show, -1: backs, 0: both */
    int32_t is_lit, is_reflective, is_haze, casts;
    muj_mapping mapping;
    const e3d_muj_texture *texture;
    float scale[3], offset[2];      /* of the texture's coordinates */
    float rgba[4];
    double world[3][4];
    float normal[3][3];             /* turns normals; their length is not kept */
    int32_t lines;
    float line_ends[12][2][3], width;
} muj_draw;

/* How the scene is looked at. */
typedef struct muj_view {
    double rows[4][4];              /* X, Y, Z, W from the world: X/W and Y/W are pixels, Z/W the depth */
    double ahead[4];                /* the distance ahead of the eye */
    double eye[3];
    int32_t is_mirrored, has_clip;
    double clip[4];                 /* with has_clip, points with a negative distance from this plane don't show */
    float tint;                     /* of colours, before light */
    int32_t low[2], high[2];        /* the pixels that count, the last ones included */
    int32_t samples;                /* of a pixel */
    int32_t first_sample;           /* they lie between this and 256 less this, in 1/256 pixel */
    double guard;                   /* pixels to each side; triangles that reach farther are clipped */
} muj_view;

typedef struct muj_picture {
    const e3d_muj_frame *frame;
    const muj_kernels *kernels;
    e3d_array draws, blended;       /* opaque draws in order; the haze, then transparent draws, those of near geoms first */
    muj_view view, mirror;
    int32_t has_mirror, has_haze;
    int32_t shadow_lights[E3D_MUJ_LIGHTS], shadow_count;
    int32_t samples, group_pixels, groups; /* pixels of a group; groups of a row */
    size_t stride;                  /* samples of a row, and room for a vector more */
    int32_t lane_x[4], lane_y[4];   /* the lanes' places in a group, in 1/256 pixel */
} muj_picture;

static inline int muj_is_behind(const double eye[3], const e3d_muj_geom *geom)
{
    float d = 0;
    for (int r = 0; r < 3; r++)
        d += ((float)eye[r] - geom->pos[r]) * geom->mat[3 * r + 2];
    return d < 0;
}

/* Where a pixel's samples are, in 1/256 pixel, Y down: Mesa's four, or the middle. */
static inline int32_t muj_sample_at(int32_t samples, int axis, int s)
{
    static const uint8_t AT[2][4] = {{96, 224, 32, 160}, {224, 160, 96, 32}};
    return samples == 1 ? MUJ_SUB / 2 : AT[axis][s];
}

/* The code of a number, rounded half up. */
static inline uint8_t muj_code(float v)
{
    return (uint8_t)((v > 0 ? v < 1 ? v : 1 : 0) * 255.0f + 0.5f);
}

/* ---- expand.c ---- */

/* Finds the draws of all geoms; 0 when memory is out. */
int muj_expand(muj_picture *picture);
const muj_draw *muj_draw_of(const muj_picture *picture, int32_t number);

/* ---- views.c ---- */

void muj_set_view(const e3d_muj_frame *frame, muj_view *out);
/* The scene as it is mirrored at a geom's plane, or at the upper side of a box; 0 if the eye is behind it. */
int muj_set_mirror(const muj_view *view, const e3d_muj_geom *geom, muj_view *out);
/* How a light looks at its map: X and Y in texels. */
void muj_set_light_view(const e3d_muj_frame *frame, const e3d_muj_light *light, muj_view *out);
/* rows * world, for a draw */
void muj_compose(const double rows[4], const double world[3][4], double out[4]);
