/* A thread's memory for one tile: the parts that the stages keep, and all of it. */
#pragma once

#include <stdint.h>

#include "base/clock.h"
#include "base/grow.h"
#include "base/limits.h"
#include "kernels/types/alpha.h"
#include "kernels/types/bending.h"
#include "kernels/types/msaa_mixed.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/shade/job.h"
#include "frame/store/blank.h"
#include "frame/store/store.h"

/* The record in each slot: its ID and its order (uint32_t). */
typedef struct e3d_slots_state {
    e3d_array ids, orders;
} e3d_slots_state;

/* Counts and limits of samples besides the visible surface. */
typedef struct e3d_marks_memory {
    float bound[E3D_TILE_SAMPLES + E3D_PAD];      /* E3D_BEYOND_FAR everywhere */
    float edge_limit[E3D_TILE_SAMPLES + E3D_PAD]; /* an edge shows if its depth is less */
    int32_t count[E3D_TILE_SAMPLES + E3D_PAD];    /* how many faces there are, or edges */
} e3d_marks_memory;

enum { E3D_ALPHA_SLICES = 512 };

/* Layers in front of the visible surface, in any order. With multisampling, one layer stands for all samples that its record
 * covers in a pixel. */
typedef struct e3d_a_buffer {
    e3d_array z;       /* float; with multisampling, the depth in the plane that is blended */
    e3d_array cover;   /* with multisampling: uint32_t, a bit for each sample of the pixel */
    e3d_array sample;  /* int32_t: the sample of the tile, or the pixel */
    e3d_array of;      /* int32_t: the number of its ID; many layers share one */
    e3d_array ids;     /* int32_t */
    e3d_array color;   /* float[4]: clamped, with alpha (e3d_shaded_list.color) */
    e3d_array through; /* float[4], if light passes through some material */
    e3d_array light;   /* float[4], if radiance is asked for */
    e3d_array bend;    /* e3d_bend, if glass bends */
    e3d_array depth, which;               /* sorted by sample: int32_t, greater is farther; uint32_t, the number of the layer */
    uint32_t first[E3D_TILE_SAMPLES + 1]; /* where each sample's layers begin in these */
    uint16_t left[E3D_TILE_SAMPLES];      /* samples that are not blended yet */
    float front_z[E3D_TILE_SAMPLES];      /* of the nearest layer */
    int32_t front_id[E3D_TILE_SAMPLES];   /* or E3D_NO_SLOT */
} e3d_a_buffer;

/* The memory for records with alpha. */
typedef struct e3d_alpha_memory {
    float z[E3D_SHOWN_ROOM + 2 * E3D_PAD]; /* for each entry of the list (e3d_shade_memory.shown) */
    float alpha[E3D_SHOWN_ROOM];
    e3d_alpha_list list;
    /* e3d_piece, the blended records: as they are listed; by overlap, the farthest first */
    e3d_array pieces, sorted;
    e3d_array ranges, overlaps;            /* for each piece its depths (float[2]), and the number of its overlap (int32_t) */
    e3d_a_buffer a_buffer;
    _Alignas(64) e3d_behind_batch behind;
    e3d_array begun; /* with multisampling, if glass bends: e3d_begun, for each pixel */
} e3d_alpha_memory;

/* The entries of a list of pixels whose alphas cover a part of them (R190): their covers, or 0; and in the list that is left of
 * them the levels of their textures, and the alphas to the right, below, and by level 0. */
typedef struct e3d_edges_memory {
    int32_t cover[E3D_SHOWN_ROOM], lod[E3D_SHOWN_ROOM];
    float right[E3D_SHOWN_ROOM], below[E3D_SHOWN_ROOM], finest[E3D_SHOWN_ROOM];
} e3d_edges_memory;

/* Pixels that are averaged, and where they go. */
typedef struct e3d_average {
    int32_t count;
    uint16_t pixel[E3D_TILE_SAMPLES];
    uint8_t alpha[E3D_TILE_SAMPLES];
    float color[3][E3D_TILE_SAMPLES + E3D_PAD];
    uint32_t rgba[E3D_TILE_SAMPLES + E3D_PAD];
} e3d_average;

/* The memory for multisampling. A pixel has as many planes, and colours of samples, as it has samples. */
typedef struct e3d_multisample_memory {
    int32_t samples_room;
    e3d_visible_tile *planes;
    e3d_samples *samples; /* the colours of samples, if something is blended or drawn over them */
    uint64_t mixed[E3D_TILE];
    e3d_mixed_list list;
    e3d_average average;
    e3d_msaa_list alpha; /* the list of records with alpha */
    e3d_array covers;      /* int32_t: its covers */
    e3d_edges_memory edges;
} e3d_multisample_memory;

/* The memory of spans, and whether they paid lately. */
typedef struct e3d_spans_memory {
    _Alignas(64) e3d_cover cover;
    _Alignas(64) e3d_layers layers;
    int32_t without, left; /* how many tiles go without spans after they did not pay, and how many of these are left */
} e3d_spans_memory;

/* The sum. */
typedef struct e3d_tile_memory {
    e3d_visible_tile visible; /* used if tiles aren't kept over several rounds */
    e3d_marks_memory marks;
    e3d_store_memory pixels;
    e3d_shade_memory shade;
    e3d_spans_memory spans;
    e3d_slots_state slots;
    e3d_alpha_memory alpha;
    e3d_multisample_memory *multisample; /* NULL until it is asked for */
    e3d_blank_state blank;
    int64_t ns_raster, ns_shade, ns_resolve; /* of all tiles */
    int64_t lap;                             /* when the tile's last stage ended (e3d_lap) */
} e3d_tile_memory;

/* Adds to a stage's time what has passed since the thread's last lap. */
static inline void e3d_lap(e3d_tile_memory *memory, int64_t *stage_ns)
{
    int64_t now = e3d_now_ns();
    *stage_ns += now - memory->lap;
    memory->lap = now;
}
