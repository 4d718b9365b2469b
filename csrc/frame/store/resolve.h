/* Resolves the samples of a tile to the caller's picture. */
#pragma once

#include <stdint.h>

#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "kernels/types/visible.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/store/store.h"

/* Prepares the store for a pass: its outputs, its background, and its encoded line colour. */
void e3d_resolve_prepare(const e3d_prepared *pass, e3d_store *out);
void e3d_resolve_begin(const e3d_store *store, e3d_store_memory *memory);
/* Reads back a drawn tile, some samples of which are to be shaded again. */
void e3d_resolve_again(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory);
/* Writes the colours of a batch, batch->color, to its samples. */
void e3d_resolve_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* Makes the batch's samples show the background again, since forward shading may have drawn there before. */
void e3d_resolve_hidden(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* Writes the colours of counts: how many faces, or edges, there are at each sample. */
void e3d_resolve_overdraw(const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory);
void e3d_resolve_wire(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory);
/* The same over the colours of one plane's samples. */
void e3d_resolve_wire_samples(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_samples *samples);
/* Writes the tile's pixels, and the depths in `visible`, to the targets. */
void e3d_resolve(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory);
