/* An environment or a gradient as the background (R63, R122). */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "data/tone_tables.h"
#include "e3d.h"
#include "kernels/types/shading.h"
#include "frame/pass/view.h"
#include "frame/store/store.h"

/* Prepares a frame's gradient: the codes that repeat along each row of pixels. */
void e3d_backdrop_prepare(const e3d_frame *frame, uint32_t (*rows)[E3D_DITHER]);
/* Fills the samples of the tile that is drawn. */
void e3d_backdrop_fill(const e3d_store *store, e3d_store_memory *memory);
/* Finds its colour behind one pixel of the picture, clamped, and its alpha. */
void e3d_backdrop_pixel(const e3d_store *store, const e3d_tile *tile, int x, int y, float color[4]);
/* Writes it to the samples of a batch. */
void e3d_backdrop_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* Finds the pixels of a tile that shows nothing else. Rows are E3D_TILE pixels apart; E3D_PAD more are written. */
void e3d_backdrop_pixels(const e3d_store *store, const e3d_tile *tile, uint32_t *rgba);
/* Finds an environment's radiance there. */
void e3d_backdrop_radiance(const e3d_store *store, const e3d_tile *tile, float (*out)[3]);
