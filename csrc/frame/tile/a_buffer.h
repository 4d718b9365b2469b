/* The A-buffer of a tile (Carpenter 1984): layers of blended records, which are sorted and laid over what the samples show. */
#pragma once

#include "frame/tile/job.h"
#include "frame/tile/memory.h"

void e3d_a_buffer_free(e3d_a_buffer *buffer);
void e3d_a_buffer_clear(e3d_a_buffer *buffer);
/* Where the radiance of the tile's pixels is gathered; NULL if it isn't asked for. The layers' radiance is blended over it. */
void *e3d_radiance_of(const e3d_tile_job *job);
/* Shades the listed samples, and keeps them as layers; 0 when memory is out. */
int e3d_a_buffer_keep(const e3d_tile_job *job);
/* Sorts the layers, and blends them over the tile's samples; 0 when memory is out. */
int e3d_a_buffer_blend(const e3d_tile_job *job);
/* With multisampling: blends layers of which no two share a sample, without sorting. */
void e3d_a_buffer_lay(const e3d_tile_job *job);
