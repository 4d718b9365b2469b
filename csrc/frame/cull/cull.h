/* The groups of clusters that may show. */
#pragma once

#include <stdint.h>

#include "base/grow.h"
#include "base/limits.h"
#include "frame/pass/boxes.h"
#include "frame/pass/prepared.h"

/* The fate of a cluster: it is drawn, or left out for one of these reasons. */
typedef enum e3d_cull_result {
    E3D_RESULT_DRAWN = 0,
    E3D_RESULT_OUTSIDE,
    E3D_RESULT_BACKFACING,
    E3D_RESULT_OCCLUDED,
    E3D_CULL_RESULTS
} e3d_cull_result;

/* How many clusters, and triangles in them, had each fate. */
typedef struct e3d_cull_counters {
    int64_t clusters[E3D_CULL_RESULTS], triangles[E3D_CULL_RESULTS];
} e3d_cull_counters;

/* A group of clusters of one instance, in view. */
typedef struct e3d_candidate {
    uint32_t instance, group;
    /* The draw of the instance; the group's number in the frame, which fits since there are fewer groups than triangles */
    int32_t draw, number;
    e3d_box_view view;
} e3d_candidate;

/* A thread's memory, and the memory of all threads. */
typedef struct e3d_cull_state {
    e3d_array candidates; /* e3d_candidate, in the order of the groups */
    e3d_cull_counters counters;
    int64_t blocks; /* how many blocks of samples the candidates' boxes touch, at most */
    int failed;     /* out of memory */
} e3d_cull_state;
typedef struct e3d_cull_memory {
    e3d_cull_state *of[E3D_MAX_THREADS];
    e3d_array tasks;
    e3d_array candidates; /* e3d_candidate, near ones first */
} e3d_cull_memory;

void e3d_cull_free(e3d_cull_memory *memory);
/* Lists the candidates of a pass; 0 when memory is out. */
int e3d_find_candidates(const e3d_prepared *pass, e3d_cull_memory *out);
