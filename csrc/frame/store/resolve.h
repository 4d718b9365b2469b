/* The samples of a tile to the caller's picture. */
#ifndef E3D_RESOLVE_H
#define E3D_RESOLVE_H

#include <stdint.h>

#include "kernels/types/samples.h"
#include "kernels/types/shading.h"
#include "kernels/types/visible.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/store/store.h"

/* Finds what the store needs of a pass: its outputs, its background and its lines, encoded. */
void e3d_resolve_prepare(const e3d_prepared *pass, e3d_store *out);
void e3d_resolve_begin(const e3d_store *store, e3d_store_memory *memory);
/* Reads back a tile that is drawn already, of which some samples are to be shaded anew. */
void e3d_resolve_again(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory);
/* batch->color is that of its samples. */
void e3d_resolve_batch(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* The batch's samples show the background again: forward shading may have drawn there before. */
void e3d_resolve_hidden(const e3d_store *store, const e3d_batch *batch, e3d_store_memory *memory);
/* `counts`: of faces, or of edges, at each sample. */
void e3d_resolve_overdraw(const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory);
void e3d_resolve_wire(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_store_memory *memory);
/* The same over the colours of samples of one plane. */
void e3d_resolve_wire_samples(const e3d_store *store, const int32_t *counts, const e3d_tile *tile, e3d_samples *samples);
/* The tile's pixels, and what `visible` tells of depths, go to the targets. */
void e3d_resolve(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory);

#endif
