/* From colours to codes: fragments, shadows, and MuJoCo's passes. */
#pragma once

#include "extras/mujoco/shading.h"

/* What a triangle shows in a pixel, as the passes before the transparent geoms draw it. */
typedef struct muj_fragment {
    int32_t pixel;
    uint8_t mask, adds, shadowed;   /* its samples; whether it is added to the reflection; a bit for each shadow light */
    uint8_t code[3];
    float place[3];
    uint8_t extra[E3D_MUJ_LIGHTS][3]; /* what each shadow light adds */
} muj_fragment;

/* Fragments lie close together: each has room for as many lights with shadows as the picture has. */
static inline size_t muj_fragment_size(const muj_picture *picture)
{
    return (offsetof(muj_fragment, extra) + 3 * (size_t)picture->shadow_count + 3) / 4 * 4;
}

/* ---- shadow.c ---- */

typedef struct muj_shadow_memory {
    e3d_array *lists;               /* the lookups of each band */
    int32_t list_count, worker_count;
    muj_worker *workers;
    e3d_array planes, sorted, starts;
} muj_shadow_memory;

/* Marks the fragments that shadow light number `k` doesn't reach; 0 when memory is out. `fragments`: those of each band. */
int muj_cast(const muj_picture *picture, int32_t k, const e3d_array *fragments, int32_t bands, int32_t threads, muj_shadow_memory *memory);
void muj_free_shadow_memory(muj_shadow_memory *memory);

/* ---- fragments.c ---- */

/* Lists the fragments that a target shows, `count` counting bytes; 0 when memory is out. */
int muj_gather(const muj_target *target, const muj_layer *layer, muj_shader *shader, e3d_array *fragments);

/* ---- passes.c ---- */

/* The codes of a band's samples, four bytes each, and what else its last passes need. */
typedef struct muj_codes {
    uint8_t *of;                    /* (rows, width, samples, 4) */
    uint8_t *stencil;               /* (rows, width): the samples where the reflecting geom shows */
    muj_cover *covers;              /* room for a row */
} muj_codes;

/* Draws what is mirrored, where the stencil is set. `target` is drawn into. */
void muj_draw_mirrored(const muj_target *target, const muj_layer *opaque, const muj_layer *blended, int32_t band, muj_shader *shader,
                       const muj_codes *codes);
/* Writes fragments, with the light of all shadow lights that reach them. */
void muj_write_fragments(const muj_target *target, const e3d_array *fragments, const muj_codes *codes);
/* Blends the haze, then the transparent draws: from front to back, then from back to front. */
void muj_blend_all(const muj_target *target, const muj_layer *layer, int32_t band, muj_shader *shader, const uint8_t *stencil,
                   const muj_codes *codes);
