/* The A-buffer of a tile (Carpenter 1984): fragments of blended records, which are sorted and laid over what the samples show. */
#ifndef E3D_TILE_A_BUFFER_H
#define E3D_TILE_A_BUFFER_H

#include <stdint.h>

#include "core/grow.h"
#include "core/limits.h"

typedef struct e3d_tile_job e3d_tile_job;

/* Fragments in front of what is kept, one after the other. With multisampling, one is of all samples that its record covers in a pixel. */
typedef struct e3d_a_buffer {
    e3d_array z;       /* float; with multisampling, in the plane that is blended */
    e3d_array cover;   /* with multisampling: uint32_t, a bit for each sample of the pixel */
    e3d_array sample;  /* int32_t: of the tile, or the pixel */
    e3d_array of;      /* int32_t: the number of its ID, of which there are fewer */
    e3d_array ids;     /* int32_t */
    e3d_array color;   /* float[4]: clamped, with alpha (e3d_shaded_list.color) */
    e3d_array through; /* float[4], where light passes through some material */
    e3d_array light;   /* float[4], where radiance is asked for */
    e3d_array depth, which;               /* sorted by sample: int32_t, greater is farther; uint32_t, the number of the fragment */
    uint32_t first[E3D_TILE_SAMPLES + 1]; /* in these, of each sample */
    uint16_t left[E3D_TILE_SAMPLES];      /* samples that are not sorted yet */
    float front_z[E3D_TILE_SAMPLES];      /* of the nearest fragment, */
    int32_t front_id[E3D_TILE_SAMPLES];   /* or E3D_NO_SLOT */
} e3d_a_buffer;

void e3d_a_buffer_free(e3d_a_buffer *buffer);
void e3d_a_buffer_clear(e3d_a_buffer *buffer);
/* Where the radiance of the tile's pixels is gathered, over which that of fragments is laid; NULL where it isn't asked for. */
void *e3d_radiance_of(const e3d_tile_job *job);
/* Shades what is listed, and keeps it as fragments; 0 when memory is out. */
int e3d_a_buffer_keep(const e3d_tile_job *job);
/* Sorts the fragments, and lays them over the tile's samples; 0 when memory is out. */
int e3d_a_buffer_blend(const e3d_tile_job *job);
/* With multisampling, of fragments of which no two are in one sample: lays them over the samples. */
void e3d_a_buffer_lay(const e3d_tile_job *job);

#endif
