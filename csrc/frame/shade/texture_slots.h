/* Materials with more textures than a base colour: which of them count, and their values for a batch. */
#pragma once

#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/texture_slots.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* R193: whether lobes of a bucket are as wide as the curvature of its mesh asks for. */
int e3d_wants_curvature(const e3d_prepared *pass, const e3d_bucket *bucket);
/* R168: whether a bucket's surfaces are translucent, and bound bodies that have a thickness. */
int e3d_is_translucent_body(const e3d_bucket *bucket);
/* Whether a material's faces are shaded with e3d_read_textures, and not just with a base colour. */
int e3d_needs_textures(const e3d_prepared *pass, const e3d_material *material);
/* Whether a texture counts on the faces of a bucket (R45). */
int e3d_texture_counts(const e3d_bucket *bucket, const e3d_texture_use *use);
/* Finds the textures to be read; all of them with E3D_WANT_TEXTURES in `wanted`. */
void e3d_find_textures(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_read_textures *out);
/* Adds the attributes of a primitive that textures need, as surface n. */
void e3d_add_texture_surface(const e3d_prepared *pass, const e3d_visible_primitive *primitive, const e3d_read_textures *textures,
                             e3d_texture_surfaces *out,
                             int32_t n);
/* Finds the texels of an interpolated batch; with E3D_WANT_TEXTURES also tangents, mapped normals, the base colour, and the
 * values that outputs ask for. */
void e3d_find_texture_batch(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, e3d_shade_memory *memory);
/* One channel of a slot's texture times a factor; or the factor alone. */
e3d_varying e3d_varying_of(const e3d_texture_memory *memory, e3d_texture_slot slot, int channel, float factor);
/* The alpha of a batch whose texels are found, without the vertices' and the instance's factors. */
e3d_varying e3d_mapped_alpha(const e3d_bucket *bucket, const e3d_texture_memory *textures);
/* R169: finds the depths of bodies. */
void e3d_find_bodies(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory);
/* Finds how much a physically based material reflects of what mirrors show; color is its base colour. */
void e3d_share_mirrors(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory);
/* Finds the colours of a physically based material. */
void e3d_light_physical(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_shade_memory *memory);
