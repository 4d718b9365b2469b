/* A tile's records one by one, each in a slot. */
#ifndef E3D_SLOTS_H
#define E3D_SLOTS_H

#include "core/grow.h"
#include "core/limits.h"
#include "kernels/types/shown.h"

typedef struct e3d_tile_job e3d_tile_job;

/* A thread's memory: of each slot of a tile the record's ID and order (uint32_t). */
typedef struct e3d_slots_state {
    e3d_array ids, orders;
} e3d_slots_state;

/* What is counted or marked beside the visible surface, sample by sample. */
typedef struct e3d_marks_memory {
    float bound[E3D_TILE_SAMPLES + E3D_PAD];      /* E3D_BEYOND_FAR everywhere */
    float edge_limit[E3D_TILE_SAMPLES + E3D_PAD]; /* what an edge's depth must be less than */
    int32_t count[E3D_TILE_SAMPLES + E3D_PAD];    /* overdraw, then edges */
} e3d_marks_memory;

void e3d_marks_init(e3d_marks_memory *marks);
void e3d_slots_free(e3d_slots_state *slots);

/* Draws the records of the scene, and shades them at once or leaves that for later; 0 when memory is out. */
int e3d_slots_draw(const e3d_tile_job *job);
/* Runs that slots own are owned by their records' IDs. */
void e3d_slots_to_ids(const e3d_slots_state *slots, e3d_run *runs, int32_t count);
/* Draws what there is beside the visible surfaces: overdraw counts, or the edges of a wireframe; 0 when memory is out. */
int e3d_slots_mark(const e3d_tile_job *job);
/* Draws the edges of a wireframe over the colours of samples, plane by plane; 0 when memory is out. */
int e3d_slots_mark_planes(const e3d_tile_job *job);

#endif
