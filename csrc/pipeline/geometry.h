/* The items of a round, cluster by cluster, to records and fragments in bins. */
#ifndef E3D_GEOMETRY_H
#define E3D_GEOMETRY_H

typedef struct e3d_context e3d_context;

void e3d_geometry(e3d_context *context);

#endif
