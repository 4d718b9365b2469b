/* The outputs other than colour (the G-buffer). */
#pragma once

#include "base/limits.h"
#include "e3d_targets.h"
#include "kernels/types/visible.h"
#include "frame/pass/view.h"
#include "frame/store/store.h"

/* A tile's pixels have rows of E3D_TILE. The last place is for samples that stand for no pixel. */
enum { E3D_NO_PIXEL = E3D_TILE_SAMPLES };

int e3d_output_channels(e3d_output_kind kind);
/* Returns where a thread gathers an output, or NULL if nobody asked for it. */
void *e3d_outputs_gathered(const e3d_store *store, const e3d_store_memory *memory, e3d_output_kind kind);
/* Finds which outputs there are, and their places in a thread's memory. */
void e3d_outputs_prepare(const e3d_targets *targets, e3d_store *out);
void e3d_outputs_begin(const e3d_store *store, e3d_store_memory *memory);
void e3d_outputs_again(const e3d_store *store, const e3d_tile *tile, e3d_store_memory *memory);
void e3d_outputs_end(const e3d_store *store, const e3d_visible_tile *visible, const e3d_tile *tile, e3d_store_memory *memory);
/* Fills a whole tile with the background. */
void e3d_outputs_blank(const e3d_store *store, const e3d_tile *tile);
