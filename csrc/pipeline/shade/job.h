/* What shading reads and writes: the constants of a pass, a thread's memory, what shows in a tile. */
#ifndef E3D_SHADE_JOB_H
#define E3D_SHADE_JOB_H

#include <stdint.h>

#include "core/grow.h"
#include "e3d.h"
#include "kernels/types/maps.h"
#include "kernels/types/records.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/runs.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/store.h"

typedef struct e3d_bins e3d_bins;

typedef struct e3d_shade_in {
    const e3d_prepared *pass;
    const e3d_record_table *table; /* of what shows */
    const float *const *corners;   /* c[k][j] of the cut records of each thread */
    const e3d_store *store;
    const e3d_bins *bins; /* tiles without any are cleared between batches */
    float unorm8[256];    /* values of 8-bit vertex and instance colours (R23) */
} e3d_shade_in;

/* Of materials of more than a base colour. */
typedef struct e3d_map_memory {
    e3d_maps maps; /* of the bucket */
    _Alignas(64) e3d_map_surfaces surfaces;
    _Alignas(64) e3d_map_batch batch;
} e3d_map_memory;

/* A thread's memory, of one tile. */
typedef struct e3d_shade_memory {
    e3d_runs_memory runs;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    e3d_lane_array light[3]; /* its radiance, where blended samples are kept with theirs */
    _Alignas(64) e3d_surfaces surfaces; /* of the batch and its neighbours */
    e3d_map_memory maps;
    e3d_array pieces;                   /* e3d_visible_primitive */
    e3d_array buckets;                  /* e3d_bucket */
    _Alignas(64) e3d_receivers receivers; /* the planes of the surfaces, where lights have exact shadows */
    int64_t shaded;                     /* samples, of all tiles */
} e3d_shade_memory;

/* What is done with the samples of a list that are not to be stored as they are: a sample may be in it several times. */
typedef enum e3d_alpha_use {
    E3D_ALPHA_TEST = 0, /* their alphas are found */
    E3D_ALPHA_KEEP,     /* their alphas and colours are found */
    E3D_ALPHA_LAY,      /* they are laid over the tile's samples: each is in the list once */
    E3D_ALPHA_OUTPUTS,  /* all but their colours and their radiance is stored */
    E3D_SOLID_KEEP      /* their colours are found, whose alphas are 1 */
} e3d_alpha_use;

/* How, and where to: by the places of the list. */
typedef struct e3d_alpha_shading {
    e3d_alpha_use use;
    float *alpha;       /* E3D_ALPHA_TEST */
    float (*color)[4];  /* E3D_ALPHA_KEEP: clamped colours, with alpha; -alpha of a face that a wireframe doesn't show */
    float (*through)[4]; /* E3D_ALPHA_KEEP: NULL, or the shares of light that pass (e3d_alpha_layers) */
    float (*light)[4];   /* E3D_ALPHA_KEEP: NULL, or radiances, with alpha */
    int32_t piece, at;  /* the piece of the last sample, and the place behind it */
} e3d_alpha_shading;

/* Its own memory, a tile's pixels, and the tiles that are cleared meanwhile. */
typedef struct e3d_shade_out {
    e3d_shade_memory *memory;
    e3d_store_memory *pixels;
    e3d_blank_state *blank;
    e3d_alpha_shading *alpha; /* or NULL: what is shaded shows */
} e3d_shade_out;

/* Samples that are shaded by the same steps. */
typedef struct e3d_bucket {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance, unshadowed;
    int8_t mapped;                          /* by more than a texture of the base colour at the mesh's own coordinates: maps.h */
    int8_t has_uvs, has_uvs1, has_tangents; /* of mapped ones */
    int8_t transmits;                       /* R133 */
    int32_t first, last; /* of its visible pieces */
} e3d_bucket;

/* A piece that shows in a tile, and its samples, or its runs (e3d_shown). */
typedef struct e3d_visible_primitive {
    const e3d_record *record;       /* or NULL: */
    const e3d_drawn_cluster *drawn; /* the piece is of fragments */
    const float *corners;           /* c[k][j] of a cut record, or NULL */
    const e3d_draw_state *draw;
    int32_t instance, local; /* in its draw, in its instance */
    int32_t vertex[3];       /* of the mesh; as many as there are */
    int32_t bucket, next;     /* the next of the same bucket, or -1 */
    int32_t first, end;
} e3d_visible_primitive;

#endif
