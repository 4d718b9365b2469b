/* Small triangles, which become fragments. */
#pragma once

#include <stdint.h>

#include "kernels/types/visible.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"

/* Whether there are IDs for one more cluster. */
int e3d_fragments_fit(const e3d_geometry_memory *state);
/* Adds a cluster that has fragments, for the caller to fill in; NULL when memory is out. */
e3d_drawn_cluster *e3d_fragments_cluster(e3d_fragment_set *set);
/* Takes small triangles, as bits, of the cluster in the thread's vertices. They become fragments now or later. */
void e3d_fragments_add(const e3d_prepared *pass, e3d_geometry_memory *state, const uint8_t *indices, uint64_t triangles);
/* Turns all triangles that were taken into fragments. */
void e3d_fragments_flush(const e3d_prepared *pass, e3d_geometry_memory *state);
