/* The visible primitives of a tile, and the attributes of their surfaces. */
#pragma once

#include "e3d.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/job.h"

/* The inputs that a texture of a base colour or an alpha needs (E3D_WANT_*). */
int e3d_texture_wanted(const e3d_texture_view *view);
/* Finds the visible primitives, chained by bucket; 0 when memory is out. */
int e3d_find_visible(const e3d_shade_in *in, e3d_shade_memory *memory);
/* Adds the surfaces of a bucket's primitives from `first` on, without what e3d_find_surfaces adds. Returns the first primitive
 * that is left, or -1. */
int32_t e3d_add_surfaces(const e3d_shade_in *in, const e3d_bucket *bucket, int32_t first, int wanted, e3d_shade_memory *memory);
void e3d_find_surfaces(const e3d_prepared *pass, const e3d_tile *tile, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory);
