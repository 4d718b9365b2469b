/* From colours to codes: fragments, shadows, and MuJoCo's passes. */
#pragma once

#include "extras/mujoco/shading.h"

/* ---- shadow.c ---- */

typedef struct muj_shadow_memory {
    e3d_array *lists;               /* the lookups of each band */
    int32_t list_count, worker_count;
    muj_worker *workers;
    e3d_array planes, sorted, starts, marks;
} muj_shadow_memory;

/* Marks the fragments that shadow light number `k` doesn't reach; 0 when memory is out. `fragments`: those of each band. */
int muj_cast(const muj_picture *picture, int32_t k, const muj_fragments *fragments, int32_t bands, int32_t threads, muj_shadow_memory *memory);
void muj_free_shadow_memory(muj_shadow_memory *memory);

/* ---- fragments.c ---- */

/* Lists the fragments that a target shows, and shades them; 0 when memory is out. stencil: the samples that count, (rows, width),
 * or NULL for all. */
int muj_gather(const muj_target *target, const muj_layer *layer, muj_shader *shader, const uint8_t *stencil, muj_fragments *fragments);

/* ---- passes.c ---- */

/* The codes of a band's samples, and what else its last passes need. */
typedef struct muj_codes {
    uint32_t *of;                   /* (rows, width, samples) */
    uint8_t *stencil;               /* (rows, width): the samples where the reflecting geom shows */
    muj_cover *covers;              /* room for a row */
    muj_fragments *fragments;       /* of what is mirrored or blended */
    e3d_array *ranges;
} muj_codes;

/* Draws what is mirrored, where the stencil is set; 0 when memory is out. `target` is drawn into. */
int muj_draw_mirrored(const muj_target *target, const muj_layer *opaque, const muj_layer *blended, int32_t band, muj_shader *shader,
                      muj_shader *blend_shader, const muj_codes *codes);
/* Writes fragments to samples, with the light of all shadow lights that reach them. */
void muj_write_fragments(const muj_target *target, const muj_fragments *fragments, const muj_codes *codes);
/* Blends the haze, then the transparent draws: from front to back, then from back to front; 0 when memory is out. */
int muj_blend_all(const muj_target *target, const muj_layer *layer, int32_t band, muj_shader *shader, const uint8_t *stencil,
                  const muj_codes *codes);
/* Writes a band of the picture: the means of samples; or, of a band without blending, fragments above what is mirrored (NULL:
 * nothing is). */
void muj_resolve(const muj_target *target, const uint32_t *codes);
void muj_resolve_fragments(const muj_target *target, const muj_fragments *fragments, const muj_codes *mirrored);
