/* What shows in a tile, primitive by primitive, and what each brings to its samples. */
#ifndef E3D_SURFACE_H
#define E3D_SURFACE_H

#include "e3d.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/job.h"

/* What interpolation must fill for a texture of a base colour or an alpha (E3D_WANT_*). */
int e3d_texture_wanted(const e3d_texture_view *view);
/* The primitives of what shows, chained by bucket; 0 when memory is out. */
int e3d_find_visible(const e3d_shade_in *in, e3d_shade_memory *memory);
/* The surfaces of primitives of a bucket from `first` on, without what e3d_find_surfaces adds; the first primitive that is left, or -1. */
int32_t e3d_add_surfaces(const e3d_shade_in *in, const e3d_bucket *bucket, int32_t first, int wanted, e3d_shade_memory *memory);
void e3d_find_surfaces(const e3d_prepared *pass, const e3d_tile *tile, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory);

#endif
