/* The samples of a tile to the caller's picture. */
#ifndef E3D_RESOLVE_H
#define E3D_RESOLVE_H

#include <stdint.h>

#include "core/limits.h"
#include "kernels/types/shading.h"

/* What is drawn in one colour: a sample of it and whether it counts (e3d_samples), and a pixel of nothing else. */
typedef struct e3d_ink {
    float sample[4];
    uint32_t rgba;
} e3d_ink;

typedef struct e3d_background {
    float color[3]; /* clamped */
    float sample[4];
    uint32_t rgba;
    uint32_t row[E3D_TILE]; /* of such pixels */
} e3d_background;

/* The colours of a tile. */
typedef struct e3d_pixels_memory {
    uint32_t rgba[E3D_TILE_SAMPLES + E3D_PAD]; /* of one sample a pixel */
    e3d_samples samples;                       /* of several */
} e3d_pixels_memory;

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

/* The frame's background and its lines, encoded. */
void e3d_resolve_prepare(e3d_context *context);
void e3d_resolve_begin(const e3d_context *context, e3d_worker *worker);
/* Reads back a tile that is drawn already, of which some samples are to be shaded anew. */
void e3d_resolve_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
/* batch->color is that of its samples. */
void e3d_resolve_batch(const e3d_context *context, e3d_worker *worker);
/* The batch's samples show the background again: forward shading may have drawn there before. */
void e3d_resolve_hidden(const e3d_context *context, e3d_worker *worker);
void e3d_resolve_overdraw(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_resolve_wire(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_resolve(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);

#endif
