/* Tiles of several samples a pixel, of which each surface is shaded once (R103-R108). */
#ifndef E3D_MULTISAMPLE_H
#define E3D_MULTISAMPLE_H

#include <stdint.h>

#include "core/grow.h"
#include "core/limits.h"
#include "kernels/types/alpha.h"
#include "kernels/types/mixed.h"
#include "kernels/types/samples.h"
#include "kernels/types/visible.h"

typedef struct e3d_tile_job e3d_tile_job;

/* Pixels that are averaged, and where they go. */
typedef struct e3d_average {
    int32_t count;
    uint16_t pixel[E3D_TILE_SAMPLES];
    uint8_t alpha[E3D_TILE_SAMPLES];
    float color[3][E3D_TILE_SAMPLES + E3D_PAD];
    uint32_t rgba[E3D_TILE_SAMPLES + E3D_PAD];
} e3d_average;

/* A thread's memory, of one tile. Planes and colours of samples are as many as a pixel has samples. */
typedef struct e3d_multisample_memory {
    int32_t samples_room;
    e3d_visible_tile *planes;
    e3d_samples *samples; /* where more shows in samples than what they keep */
    uint64_t mixed[E3D_TILE];
    e3d_mixed_list list;
    e3d_average average;
    e3d_planes_list alpha; /* of records with alpha, */
    e3d_array covers;      /* and what it holds: int32_t */
} e3d_multisample_memory;

/* Makes room for so many samples a pixel; 0 when memory is out. */
int e3d_multisample_reserve(e3d_multisample_memory **memory, int32_t samples);
void e3d_multisample_free(e3d_multisample_memory *memory);

/* These return 0 when memory is out. */

/* Draws a tile to its pixels. */
int e3d_multisample_draw(const e3d_tile_job *job);
/* Shades pixels (a bit each, row by row), and averages them to pixels, or, if `layered`, leaves their colours in the samples. */
int e3d_mixed_shade(const e3d_tile_job *job, int layered);
/* Averages the colours of the samples of all pixels. */
void e3d_mixed_average_samples(const e3d_tile_job *job);

#endif
