/* The data that the stages of a picture in pyrender's manner share: vertices, bands of rows, fragments. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "e3d_pyrender.h"

enum { PYR_BATCH = 64,        /* fragments that are lit side by side */
       PYR_BAND = 16,         /* a thread takes so many rows at a time */
       PYR_CODE_STARTS = 4096 /* steps of pyr_picture.code_start */ };

/* A vertex after its transformation. Clip space is f64: near planes of millimetres leave f32 few digits of depth. */
typedef struct pyr_vertex {
    double clip[4];
    float world[4], normal[4]; /* the fourth is 0 */
} pyr_vertex;

_Static_assert(sizeof(pyr_vertex) == 64, "a vertex is a cache line: triangles take vertices from anywhere");

/* The change of the perspective-correct weights of a triangle's corners over the picture: at (x, y) in pixels, y down, weight
 * k is row[k][0]*x + row[k][1]*y + row[k][2], divided by the sum of the three. */
typedef struct pyr_plane {
    double row[3][3];
    int32_t corner[3];
    const pyr_vertex *vertex[3];
} pyr_plane;

/* The weights of a fragment: up to three vertices, and the share of each. */
typedef struct pyr_weights {
    int32_t corner[3];
    float weight[3];
} pyr_weights;

/* Fragments of one draw, as structure of arrays. Values that are not known have neutral defaults. */
typedef struct pyr_batch {
    int32_t count;
    uint32_t number;                            /* counts the batches before it */
    const e3d_pyr_draw *draw;
    const pyr_vertex *vertices;
    const e3d_pyr_draw *filled;                 /* the draw whose constants all fragments have, but for textures */
    int32_t x[PYR_BATCH], y[PYR_BATCH];
    uint8_t mask[PYR_BATCH];                    /* the places that are covered and show */
    const pyr_plane *plane[PYR_BATCH];          /* the plane of a triangle whose surface is found there later, or NULL */
    _Alignas(16) float world[3][PYR_BATCH];
    _Alignas(16) float normal[3][PYR_BATCH];
    _Alignas(16) float base[4][PYR_BATCH];
    _Alignas(16) float vertex_color[4][PYR_BATCH];
    _Alignas(16) float metallic[PYR_BATCH], roughness[PYR_BATCH], occlusion[PYR_BATCH];
    _Alignas(16) float emissive[3][PYR_BATCH];
    _Alignas(16) float unshadowed[PYR_BATCH];
    _Alignas(16) float color[3][PYR_BATCH];
} pyr_batch;

/* The data that all threads read. */
typedef struct pyr_picture {
    const e3d_pyr_frame *frame;
    pyr_vertex **vertices;                      /* for each draw; NULL: it shows nowhere */
    int32_t places;                             /* 1, or the samples and the centre */
    int32_t depth_place;                        /* the place that the picture's depths are from */
    /* Codes and depths of all places are kept, since a later step may be hidden by an earlier one, or blended over it */
    int32_t keeps_samples;
    uint8_t code_start[PYR_CODE_STARTS + 1];    /* by steps of the square root of light: the code at which the search begins */
    uint8_t background[4];
    /* The offset of each place from the centre, in 1/256 pixel, y down */
    int32_t sample_x[E3D_PYR_PLACES], sample_y[E3D_PYR_PLACES];
} pyr_picture;

/* The rows of the picture that a thread is drawing. */
typedef struct pyr_band {
    const pyr_picture *picture;
    int32_t top, end;
    uint8_t *codes;                             /* if samples are kept: (rows, width, samples, 4) */
    double *depth;                              /* if samples are kept: (rows, width, places) z_ndc, infinity where nothing is */
    /* Else, for pixels that show several things: (rows, width, 4), codes times samples */
    uint16_t *sums;
    int32_t *differs;                           /* (width): whether the places of a pixel show different things */
    pyr_batch batch;
} pyr_band;

static inline uint8_t *pyr_codes_at(const pyr_band *band, int32_t x, int32_t y)
{
    const e3d_pyr_frame *frame = band->picture->frame;
    return band->codes + ((size_t)(y - band->top) * (size_t)frame->width + (size_t)x) * (size_t)frame->samples * 4;
}

static inline double *pyr_depths_at(const pyr_band *band, int32_t x, int32_t y)
{
    size_t pixel = (size_t)(y - band->top) * (size_t)band->picture->frame->width + (size_t)x;
    return band->depth + pixel * (size_t)band->picture->places;
}

/* The code of 0 .. 1, rounded as Mesa does: the product to f32, and a half to even. */
static inline uint8_t pyr_code(float v)
{
    float product = (v > 0 ? v < 1 ? v : 1 : 0) * (255.0f / 256.0f);
    float sum = product + 32768.0f;
    uint32_t bits;
    memcpy(&bits, &sum, sizeof bits);
    return (uint8_t)bits;
}

static inline uint16_t *pyr_sums_at(const pyr_band *band, int32_t x, int32_t y)
{
    return band->sums + ((size_t)(y - band->top) * (size_t)band->picture->frame->width + (size_t)x) * 4;
}

static inline uint8_t *pyr_color_at(const e3d_pyr_frame *frame, int32_t x, int32_t y)
{
    return frame->color + ((size_t)y * (size_t)frame->width + (size_t)x) * (size_t)frame->channels;
}

/* ---- vertices.c ---- */

/* Transforms vertices first to end - 1 of a draw. */
void pyr_transform(const e3d_pyr_frame *frame, const e3d_pyr_draw *draw, int32_t first, int32_t end, pyr_vertex *out);

/* ---- plane.c ---- */

/* Finds the corners of primitive number `number`: three, two or one. */
void pyr_corners(const e3d_pyr_draw *draw, int32_t number, int32_t out[3]);
void pyr_set_plane(const e3d_pyr_frame *frame, const e3d_pyr_draw *draw, const pyr_vertex *vertices, int32_t triangle,
                   pyr_plane *out);
/* Finds the weights at a point; returns z_ndc there. */
double pyr_weigh(const pyr_plane *plane, double x, double y, pyr_weights *out);
double pyr_depth_at(const pyr_plane *plane, double x, double y);
double pyr_depth_at_place(const pyr_picture *picture, const pyr_plane *plane, int place, int32_t x, int32_t y);
/* Whether a triangle shows its back. For one that is partly behind the viewer, the homogeneous area decides. */
int pyr_shows_back(const pyr_vertex *vertices, const int32_t corner[3]);
/* Whether a primitive surely shows nothing in a band, nor one pixel above or below it. */
int pyr_misses_band(const pyr_band *band, const pyr_vertex *vertices, const int32_t *corner, int count);

/* ---- fragments.c ---- */

/* The distance of z_ndc; 0 behind the far plane. */
float pyr_metric_depth(const e3d_pyr_frame *frame, double z);
/* Keeps the places in `mask` at which z is nearer than what is there, and stores z there; returns the samples among them. */
uint32_t pyr_test_depths(const pyr_band *band, int32_t x, int32_t y, uint32_t mask, const double z[E3D_PYR_PLACES]);
/* Adds a fragment. With `plane` it is a triangle's, and the plane gives the detail at which textures are read. */
void pyr_add_fragment(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_weights *weights,
                      const pyr_plane *plane, int32_t x, int32_t y, uint32_t mask);
/* If samples are kept: adds what a triangle shows at those places of a pixel where nothing is nearer. */
void pyr_add_nearer(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_plane *plane, int32_t x, int32_t y,
                    uint32_t mask);
/* If no samples are kept: adds what a triangle shows at the centre of a pixel. Its surface, and its depth if `mask` has the
 * place of depths, are found when the batch is lit: one fragment after the other, which a processor overlaps. Until then the
 * plane must stay. */
void pyr_add_shown(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_plane *plane, int32_t x, int32_t y,
                   uint32_t mask);
/* Lights and writes the fragments that were added. */
void pyr_flush(pyr_band *band);

/* ---- surface.c ---- */

/* Begins a batch: gives all its fragments the constants of the draw, without textures. */
void pyr_begin_surfaces(const e3d_pyr_frame *frame, pyr_batch *batch);
/* Finds the surface of fragment `i` of the batch. */
void pyr_find_surface(pyr_band *band, int i, const pyr_weights *weights, const pyr_plane *plane);

/* ---- texels.c ---- */

/* The colour of a texture at (u, v), in 0 .. 1; missing channels are 1. `detail`: texels a pixel, at most. */
void pyr_sample(const e3d_pyr_texture *texture, float u, float v, float detail, float out[4]);

/* ---- light.c ---- */

void pyr_light(const e3d_pyr_frame *frame, pyr_batch *batch);

/* ---- shadow.c ---- */

/* Finds the share of a light that reaches each fragment. */
void pyr_find_unshadowed(const e3d_pyr_light *light, pyr_batch *batch);

/* ---- visible.c, triangles.c, lines.c ---- */

void pyr_draw_visible(pyr_band *band, const e3d_pyr_step *step);
void pyr_draw_triangles(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices);
void pyr_draw_lines(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices);
void pyr_draw_edges(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices);
void pyr_draw_points(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices);
