/* A tile's records one by one, each in a slot. */
#ifndef E3D_SLOTS_H
#define E3D_SLOTS_H

#include "kernels/types/shown.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

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
