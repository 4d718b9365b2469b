/* The candidates of a round, cluster by cluster, to records and fragments in bins. */
#ifndef E3D_GEOMETRY_H
#define E3D_GEOMETRY_H

#include "kernels/types/records.h"
#include "kernels/types/vertices.h"

typedef struct e3d_context e3d_context;

/* A thread's memory. */
typedef struct e3d_geometry_state {
    _Alignas(64) e3d_vertices vertices; /* of the cluster that is drawn */
    e3d_survivors survivors;
} e3d_geometry_state;

void e3d_geometry(e3d_context *context);

#endif
