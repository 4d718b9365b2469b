/* Materials of more than a base colour: which of their textures count, and what these say of a batch. */
#ifndef E3D_SHADE_TEXTURE_SLOTS_H
#define E3D_SHADE_TEXTURE_SLOTS_H

#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/texture_slots.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Whether such a material's faces are shaded with e3d_read_textures, beyond the base colour. */
int e3d_needs_textures(const e3d_material *material, const e3d_targets *targets);
/* Whether a texture counts on faces of a bucket (R45). */
int e3d_texture_counts(const e3d_bucket *bucket, const e3d_texture_use *use);
/* Finds the textures that are read for what is wanted: E3D_WANT_TEXTURES. */
void e3d_find_textures(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_read_textures *out);
/* What a primitive brings, as surface n. */
void e3d_add_texture_surface(const e3d_prepared *pass, const e3d_visible_primitive *primitive, const e3d_read_textures *textures,
                             e3d_texture_surfaces *out,
                             int32_t n);
/* Of a batch that is interpolated: texels, and with E3D_WANT_TEXTURES tangents, mapped normals, the base colour, and what outputs ask for. */
void e3d_find_texture_batch(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory);
/* The alpha of a batch of which texels are found, but for the vertices' and the instance's. */
e3d_varying e3d_mapped_alpha(const e3d_bucket *bucket, const e3d_texture_memory *textures);
/* The colours of a physically based material. */
void e3d_light_physical(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory);

#endif
