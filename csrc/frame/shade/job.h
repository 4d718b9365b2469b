/* What shading reads and writes: the constants of a pass, a thread's memory, what shows in a tile. */
#ifndef E3D_SHADE_JOB_H
#define E3D_SHADE_JOB_H

#include <stdint.h>

#include "base/grow.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/records.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/shade/runs.h"
#include "frame/store/blank.h"
#include "frame/store/store.h"

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
typedef struct e3d_texture_memory {
    e3d_read_textures read; /* of the bucket */
    _Alignas(64) e3d_texture_surfaces surfaces;
    _Alignas(64) e3d_texture_batch batch;
} e3d_texture_memory;

/* A thread's memory, of one tile. */
typedef struct e3d_shade_memory {
    e3d_runs_memory runs;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    e3d_lane_array light[3]; /* its radiance, where blended samples are kept with theirs */
    _Alignas(64) e3d_surfaces surfaces; /* of the batch and its neighbours */
    e3d_texture_memory textures;
    e3d_array primitives;                   /* e3d_visible_primitive */
    e3d_array buckets;                  /* e3d_bucket */
    _Alignas(64) e3d_receivers receivers; /* the planes of the surfaces, where lights have exact shadows */
    int64_t shaded;                     /* samples, of all tiles */
} e3d_shade_memory;

/* Where samples go. Those of a list, in which a sample may be several times, do not simply show. */
typedef enum e3d_sink {
    E3D_SINK_PIXELS = 0, /* what shows: colours go to pixels or to the samples that become pixels, and outputs are stored */
    E3D_SINK_OUTPUTS,    /* all but colours and radiance is stored */
    E3D_SINK_ALPHA_TEST, /* a list: alphas are found */
    E3D_SINK_A_BUFFER,   /* a list: alphas and colours are found */
    E3D_SINK_SOLID,      /* a list: colours are found, and alphas are 1 */
    E3D_SINK_SAMPLES     /* a list that has each sample once: they are laid over the tile's samples */
} e3d_sink;

/* What is found of a list, by the places in it. */
typedef struct e3d_shaded_list {
    float *alpha;        /* E3D_SINK_ALPHA_TEST */
    float (*color)[4];   /* E3D_SINK_A_BUFFER: clamped colours, with alpha; -alpha of a face that a wireframe doesn't show */
    float (*through)[4]; /* E3D_SINK_A_BUFFER: NULL, or the shares of light that pass (e3d_alpha_layers) */
    float (*light)[4];   /* E3D_SINK_A_BUFFER: NULL, or radiances, with alpha */
    int32_t primitive, at;   /* the primitive of the last sample, and the place behind it */
} e3d_shaded_list;

/* Its own memory, a tile's pixels, and the tiles that are cleared meanwhile. */
typedef struct e3d_shade_out {
    e3d_shade_memory *memory;
    e3d_store_memory *pixels;
    e3d_blank_state *blank;
    e3d_sink sink;
    e3d_shaded_list *list; /* of those sinks that are lists */
} e3d_shade_out;

/* Samples that are shaded by the same steps: all before `first` tells which. */
typedef struct e3d_bucket {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance, unshadowed;
    int8_t mapped;                          /* by more than a texture of the base colour at the mesh's own coordinates: texture_slots.h */
    int8_t has_uvs, has_uvs1, has_tangents; /* of mapped ones */
    int8_t transmits;                       /* R133 */
    int8_t lit, hidden;                     /* light falls on it; faces that a wireframe leaves out */
    int32_t first, last; /* of its visible primitives */
} e3d_bucket;

/* A primitive that shows in a tile, and its samples, or its runs (e3d_shown). */
typedef struct e3d_visible_primitive {
    const e3d_record *record;       /* or NULL: */
    const e3d_drawn_cluster *drawn; /* the primitive is of fragments */
    const float *corners;           /* c[k][j] of a cut record, or NULL */
    const e3d_draw_state *draw;
    int32_t instance, local; /* in its draw, in its instance */
    int32_t vertex[3];       /* of the mesh; as many as there are */
    int32_t bucket, next;     /* the next of the same bucket, or -1 */
    int32_t first, end;
} e3d_visible_primitive;

#endif
