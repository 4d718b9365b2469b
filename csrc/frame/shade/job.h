/* The inputs and outputs of shading: a pass's constants, a thread's memory, what shows in a tile, and the steps that shade it. */
#pragma once

#include <stdint.h>

#include "base/grow.h"
#include "e3d.h"
#include "kernels/types/bending.h"
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
    const float *const *corners;   /* c[k][j] of the clipped records of each thread */
    const e3d_store *store;
    const e3d_bins *bins; /* tiles without any entry are cleared between batches */
    float unorm8[256];    /* the values of 8-bit vertex and instance colours (R23) */
} e3d_shade_in;

/* The memory for materials with more textures than a base colour. */
typedef struct e3d_texture_memory {
    e3d_read_textures read; /* of the bucket */
    _Alignas(64) e3d_texture_surfaces surfaces;
    _Alignas(64) e3d_texture_batch batch;
} e3d_texture_memory;

/* A thread's memory for shading one tile. */
typedef struct e3d_shade_memory {
    e3d_runs_memory runs;
    _Alignas(64) e3d_shown shown;
    _Alignas(64) e3d_batch batch;
    e3d_lane_array light[3]; /* the batch's radiance, if blended samples keep theirs */
    e3d_bend_batch bends;    /* the batch's bends, if its surfaces bend */
    _Alignas(64) e3d_surfaces surfaces; /* the surfaces of the batch and of their neighbours */
    e3d_texture_memory textures;
    _Alignas(64) e3d_mirror_batch mirrors; /* the batch in mirrors */
    e3d_array primitives;                   /* e3d_visible_primitive */
    e3d_array buckets;                  /* e3d_bucket */
    _Alignas(64) e3d_receivers receivers; /* the surfaces' planes, if lights have exact shadows */
    int64_t shaded;                     /* how many samples were shaded, in all tiles */
} e3d_shade_memory;

/* The sink of a batch: where its samples go. With a list the samples do not simply show, and one sample may stand in it several
 * times. */
typedef enum e3d_sink {
    E3D_SINK_PIXELS = 0, /* samples that show: colours go to pixels, or to the samples that become pixels; outputs are stored */
    E3D_SINK_OUTPUTS,    /* samples that show: everything but colours and radiance is stored */
    E3D_SINK_ALPHA_TEST, /* a list: alphas are found */
    E3D_SINK_A_BUFFER,   /* a list: alphas and colours are found */
    E3D_SINK_SOLID,      /* a list: colours are found, and alphas are 1 */
    E3D_SINK_SAMPLES     /* a list that has each sample once: it is blended over the tile's samples */
} e3d_sink;

/* The results of shading a list, in its order. */
typedef struct e3d_shaded_list {
    float *alpha;        /* E3D_SINK_ALPHA_TEST */
    int32_t *lod;        /* E3D_SINK_ALPHA_TEST: NULL, or the level at which the alpha's texture is read (R190) */
    float (*color)[4];   /* E3D_SINK_A_BUFFER: clamped colours, with alpha; -alpha for a face that a wireframe doesn't show */
    float (*through)[4]; /* E3D_SINK_A_BUFFER: NULL, or the shares of light that pass (e3d_alpha_layers) */
    float (*light)[4];   /* E3D_SINK_A_BUFFER: NULL, or radiances, with alpha */
    e3d_bend *bend;      /* E3D_SINK_A_BUFFER: NULL, or what layers bend */
    int32_t primitive, at;   /* the primitive of the last sample, and the place behind that */
} e3d_shaded_list;

/* The outputs of shading: the thread's memory, a tile's pixels, and the tiles that it clears meanwhile. */
typedef struct e3d_shade_out {
    e3d_shade_memory *memory;
    e3d_store_memory *pixels;
    e3d_blank_state *blank;
    e3d_sink sink;
    e3d_shaded_list *list; /* for sinks that are lists */
} e3d_shade_out;

/* A bucket: samples that are shaded by the same steps. Everything before `first` decides which steps. */
typedef struct e3d_bucket {
    const e3d_material *material;
    int8_t face, flat, textured, by_vertex, by_instance, unshadowed;
    /* Not 0: it reads more than a texture of the base colour at the mesh's own coordinates (texture_slots.h) */
    int8_t mapped;
    int8_t has_uvs, has_uvs1, has_tangents; /* of mapped ones */
    int8_t transmits, bends;                /* R133, R160 */
    int8_t translucent;                     /* R168 */
    int8_t mirrors;                         /* not 0: its faces may show mirrors (R210) */
    int8_t lit, hidden;                     /* not 0: light falls on it; its faces are left out by a wireframe */
    int32_t first, last; /* the chain of its visible primitives */
} e3d_bucket;

/* A visible primitive of a tile, and its samples or runs (e3d_shown). */
typedef struct e3d_visible_primitive {
    const e3d_record *record;       /* or NULL: */
    const e3d_drawn_cluster *drawn; /* the cluster, if the primitive has fragments */
    const float *corners;           /* c[k][j] of a clipped record, or NULL */
    const e3d_draw_state *draw;
    int32_t instance, local; /* in its draw; in its instance */
    int32_t vertex[3];       /* numbers in the mesh, as many as the primitive has */
    int32_t bucket, next;     /* the next primitive of the same bucket, or -1 */
    int32_t first, end;
} e3d_visible_primitive;

enum { E3D_MOST_STEPS = 32 }; /* more than steps.c names in all */

/* The steps that shade a bucket; each batch takes all of them in order. */
typedef struct e3d_steps {
    const e3d_shade_in *in;
    const e3d_prepared *pass;
    const e3d_bucket *bucket;
    const e3d_shade_out *out;
    int wanted; /* what they need of its surfaces: E3D_WANT_... */
    int count;
    void (*step[E3D_MOST_STEPS])(const struct e3d_steps *s);
} e3d_steps;

typedef void (*e3d_shade_step)(const e3d_steps *s);
