/* How a mesh becomes clusters. */
#ifndef E3D_CLUSTERS_H
#define E3D_CLUSTERS_H

#include "core/mesh.h"

/* Fills the mesh's clusters, groups, positions, indices and faces; 0 when memory is out (what is there is the mesh's to
 * free). lo and hi bound the vertices that are finite. */
int e3d_clusters_build(e3d_mesh *mesh, const float lo[3], const float hi[3]);

/* Makes a box hold a point, unless that isn't finite. */
void e3d_grow_bounds(const float *p, float lo[3], float hi[3], int32_t *any);

#endif
