/* Records with alpha in a tile: which of their samples show, and what is laid over those behind. */
#ifndef E3D_TILE_ALPHA_H
#define E3D_TILE_ALPHA_H

#include <stdint.h>

#include "core/grow.h"
#include "core/limits.h"
#include "kernels/types/alpha.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/shade/shade.h"

typedef struct e3d_tile_job e3d_tile_job;

enum { E3D_ALPHA_SLICES = 512 };

/* Samples of blended records in front of what is kept, one after the other. */
typedef struct e3d_alpha_fragments {
    e3d_array z;      /* float */
    e3d_array sample; /* int32_t */
    e3d_array of;     /* int32_t: the number of its ID, of which there are fewer */
    e3d_array ids;    /* int32_t */
    e3d_array color;  /* float[4]: clamped, with alpha (e3d_shaded_list.color) */
    e3d_array through; /* float[4], where light passes through some material */
    e3d_array light;   /* float[4], where radiance is asked for */
    e3d_array depth, which;               /* sorted by sample: int32_t, greater is farther; uint32_t, the number of the fragment */
    uint32_t first[E3D_TILE_SAMPLES + 1]; /* in these, of each sample */
} e3d_alpha_fragments;

/* A thread's memory, of one tile. */
typedef struct e3d_alpha_memory {
    float z[E3D_SHOWN_ROOM + 2 * E3D_PAD]; /* of each entry of the list (e3d_shade_memory.shown) */
    float alpha[E3D_SHOWN_ROOM];
    e3d_alpha_list list;
    e3d_array pieces, sorted;              /* e3d_piece of the blended records: as they are listed; by group, the farthest first */
    e3d_array ranges, groups;              /* of each piece its depths (float[2]), and its group (int32_t) */
    e3d_alpha_fragments fragments;
    uint16_t left[E3D_TILE_SAMPLES];       /* samples that are not sorted yet */
    float front_z[E3D_TILE_SAMPLES];       /* of the nearest fragment */
    int32_t front_id[E3D_TILE_SAMPLES];    /* or E3D_NO_SLOT */
} e3d_alpha_memory;

void e3d_alpha_free(e3d_alpha_memory *memory);

/* These return 0 when memory is out. */

/* Adds what masked records show to the visible surface, whose samples are written. */
int e3d_alpha_cut(const e3d_tile_job *job);
/* Adds the samples that faces with alpha show, hidden or not, to the overdraw counts. */
int e3d_alpha_count(const e3d_tile_job *job);
/* Lays blended records over the tile's samples, which are shaded. */
int e3d_alpha_blend(const e3d_tile_job *job);
/* The depths of the nearest fragments become those of the visible surface. */
void e3d_alpha_front(const e3d_tile_job *job);

/* Room for so many fragments of so many IDs, some of which light may pass through; 0 when memory is out. */
int e3d_alpha_reserve_fragments(e3d_alpha_fragments *f, size_t count, size_t ids, int transmits);
void e3d_alpha_clear_fragments(e3d_alpha_fragments *f);
/* Sorts the fragments of the memory, and lays them over samples; 0 when memory is out. */
int e3d_alpha_blend_fragments(const e3d_tile_job *job, e3d_samples *samples);

/* What is done with a list when it is full, or done. */
typedef int (*e3d_alpha_action)(const e3d_tile_job *job);

/* Lists the samples of a record's rows y0 .. y1; whenever the list is full, it is acted on, and begun again. */
int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action);
/* Begins a list of what is in front of the visible surface; `all`: of everything that is no farther than the far plane. */
void e3d_alpha_begin(const e3d_tile_job *job, int all);
/* Shades the list; `to`: where what is kept of each entry goes, but for alphas that are tested. */
int e3d_alpha_shade(const e3d_tile_job *job, e3d_sink sink, e3d_shaded_list to);

#endif
