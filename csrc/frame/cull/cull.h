/* The groups of clusters that may show. */
#ifndef E3D_CULL_H
#define E3D_CULL_H

#include <stdint.h>

#include "base/grow.h"
#include "base/limits.h"
#include "frame/pass/boxes.h"
#include "frame/pass/prepared.h"

/* What becomes of a cluster: it is transformed and drawn, or left out. */
typedef enum e3d_cull_result {
    E3D_RESULT_DRAWN = 0,
    E3D_RESULT_OUTSIDE,
    E3D_RESULT_BACKFACING,
    E3D_RESULT_OCCLUDED,
    E3D_CULL_RESULTS
} e3d_cull_result;

/* Clusters, and their triangles, by what became of the cluster. */
typedef struct e3d_cull_counters {
    int64_t clusters[E3D_CULL_RESULTS], triangles[E3D_CULL_RESULTS];
} e3d_cull_counters;

/* A group of clusters of one instance, in view. */
typedef struct e3d_candidate {
    uint32_t instance, group;
    int32_t draw, number; /* whose instance it is; its number in the frame: there are fewer than triangles */
    e3d_box_view view;
} e3d_candidate;

/* A thread's memory, and that of all. */
typedef struct e3d_cull_state {
    e3d_array candidates; /* e3d_candidate, as the groups come */
    e3d_cull_counters counters;
    int64_t blocks; /* that the boxes of the candidates may touch */
    int failed;     /* out of memory */
} e3d_cull_state;
typedef struct e3d_cull_memory {
    e3d_cull_state *of[E3D_MAX_THREADS];
    e3d_array tasks;
    e3d_array candidates; /* e3d_candidate, near ones first */
} e3d_cull_memory;

void e3d_cull_free(e3d_cull_memory *memory);
/* Lists the pass's candidates; 0 when memory is out. */
int e3d_find_candidates(const e3d_prepared *pass, e3d_cull_memory *out);

#endif
