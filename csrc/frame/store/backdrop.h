/* An environment or a gradient as the background (R63, R122). */
#ifndef E3D_STORE_BACKDROP_H
#define E3D_STORE_BACKDROP_H

#include <stdint.h>

#include "base/limits.h"
#include "data/tone_tables.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/pass/view.h"
#include "frame/store/store.h"

/* Finds a frame's gradient: what repeats along each row of pixels. */
void e3d_backdrop_prepare(const e3d_frame *frame, uint32_t (*rows)[E3D_DITHER]);
/* Fills the memory of the tile that is drawn. */
void e3d_backdrop_fill(const e3d_store *store, e3d_store_memory *memory);
/* Its colour behind one pixel of the picture, clamped, and its alpha. */
void e3d_backdrop_pixel(const e3d_store *store, const e3d_tile *tile, int x, int y, float color[4]);
/* Puts it where the samples of a batch are. */
void e3d_backdrop_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* The pixels of a tile that nothing else shows in, E3D_TILE apart from row to row; E3D_PAD more are written. */
void e3d_backdrop_pixels(const e3d_store *store, const e3d_tile *tile, uint32_t *rgba);
/* The radiance of an environment there. */
void e3d_backdrop_radiance(const e3d_store *store, const e3d_tile *tile, float (*out)[3]);

#endif
