/* Draws a tile's records one by one, each in a slot of its own. */
#pragma once

#include "kernels/types/shown.h"
#include "frame/tile/job.h"
#include "frame/tile/memory.h"

void e3d_marks_init(e3d_marks_memory *marks);
void e3d_slots_free(e3d_slots_state *slots);

/* Draws the scene's records, and shades them at once or later; 0 when memory is out. */
int e3d_slots_draw(const e3d_tile_job *job);
/* Replaces slots as owners of runs by their records' IDs. */
void e3d_slots_to_ids(const e3d_slots_state *slots, e3d_run *runs, int32_t count);
/* Draws what isn't the visible surface: overdraw counts, or the edges of a wireframe; 0 when memory is out. */
int e3d_slots_mark(const e3d_tile_job *job);
/* Draws the edges of a wireframe over the colours of samples, plane by plane; 0 when memory is out. */
int e3d_slots_mark_planes(const e3d_tile_job *job);
