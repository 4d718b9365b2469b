/* What geometry prefetches of the candidates that come next. */
#ifndef E3D_GEOMETRY_FETCH_H
#define E3D_GEOMETRY_FETCH_H

#include "data/mesh/mesh.h"
#include "e3d.h"
#include "frame/cull/cull.h"
#include "frame/geometry/round.h"

/* Clusters of the next candidate, and those of them that are to be fetched yet: a bit each. */
typedef struct e3d_next_clusters {
    const e3d_cluster *clusters;
    unsigned left;
} e3d_next_clusters;

/* What a candidate will read of its instance; few of those that did not show last time read it. */
void e3d_fetch_instance(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* What e3d_fetch_instance reads. */
void e3d_fetch_seen(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* The first two clusters of the next candidate that may be drawn, as far as one can tell yet. What tells of all of them is fetched. */
e3d_next_clusters e3d_find_next(const e3d_geometry_in *in, const e3d_geometry_out *out, const e3d_candidate *candidate);
/* The next cluster of those that are left of a group, or behind its last ones those of the next candidate: all at once would wait for
 * each other. */
void e3d_fetch_next(const e3d_mesh *mesh, const e3d_cluster *clusters, unsigned left, e3d_next_clusters *next);

#endif
