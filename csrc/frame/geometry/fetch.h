/* Prefetches for the candidates that come next. */
#pragma once

#include "data/mesh/mesh.h"
#include "e3d.h"
#include "frame/cull/cull.h"
#include "frame/geometry/round.h"

/* Clusters of the next candidate, and which of them are still to be prefetched: a bit each. */
typedef struct e3d_next_clusters {
    const e3d_cluster *clusters;
    unsigned left;
} e3d_next_clusters;

/* Prefetches what a candidate will read of its instance. Candidates that did not show last time seldom read it. */
void e3d_fetch_instance(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* Prefetches what e3d_fetch_instance reads. */
void e3d_fetch_seen(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* Finds the first two clusters of the next candidate that will probably be drawn, and prefetches the boxes and cones of all its
 * clusters. */
e3d_next_clusters e3d_find_next(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* Prefetches the next of the clusters that are left of a group; behind the last one, one of the next candidate. All at once
 * would wait for each other. */
void e3d_fetch_next(const e3d_mesh *mesh, const e3d_cluster *clusters, unsigned left, e3d_next_clusters *next);
