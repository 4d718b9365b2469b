/* What a thread keeps of the geometry that it makes. */
#ifndef E3D_GEOMETRY_STATE_H
#define E3D_GEOMETRY_STATE_H

#include <stdint.h>

#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "pipeline/cull/cull.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/geometry/records.h"

typedef struct e3d_geometry_counters {
    e3d_cull_counters culled;
    int64_t triangles_rejected, triangles_drawn; /* of clusters that show */
    int64_t triangles_clipped, records, bin_entries;
} e3d_geometry_counters;

typedef struct e3d_geometry_state {
    e3d_record_set sets[E3D_SETS];
    e3d_fragment_set fragments;
    _Alignas(64) e3d_vertices vertices; /* of the cluster that is drawn */
    e3d_survivors survivors;
    uint32_t number; /* of the thread */
    int id_bits;     /* of an ID: they tell the thread */
    int failed;      /* out of memory */
    e3d_geometry_counters counters;
} e3d_geometry_state;

#endif
