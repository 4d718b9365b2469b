/* Small triangles, which become fragments. */
#ifndef E3D_FRAGMENTS_H
#define E3D_FRAGMENTS_H

#include <stdint.h>

#include "kernels/types/visible.h"
#include "frame/geometry/records.h"
#include "frame/pass/prepared.h"

/* Whether a cluster more can have IDs. */
int e3d_fragments_fit(const e3d_geometry_memory *state);
/* Another cluster that has fragments, to be filled in; NULL when memory is out. */
e3d_drawn_cluster *e3d_fragments_cluster(e3d_fragment_set *set);
/* Takes small triangles of that cluster, a bit each, whose vertices the thread has: they become fragments now or later. */
void e3d_fragments_add(const e3d_prepared *pass, e3d_geometry_memory *state, const uint8_t *indices, uint64_t triangles);
/* All that were taken become fragments. */
void e3d_fragments_flush(const e3d_prepared *pass, e3d_geometry_memory *state);

#endif
