/* The groups of clusters that may show. */
#ifndef E3D_CULL_H
#define E3D_CULL_H

#include <stdint.h>

#include "core/grow.h"
#include "pipeline/pass/boxes.h"

typedef struct e3d_context e3d_context;

/* A group of clusters of one instance, in view. */
typedef struct e3d_candidate {
    uint32_t instance, group;
    int32_t draw, number; /* whose instance it is; its number in the frame: there are fewer than triangles */
    e3d_box_view view;
} e3d_candidate;

/* A thread's memory, and that of all. */
typedef struct e3d_cull_state {
    e3d_array candidates; /* e3d_candidate, as the groups come */
} e3d_cull_state;
typedef struct e3d_cull_memory {
    e3d_array tasks;
    e3d_array candidates; /* e3d_candidate, near ones first */
} e3d_cull_memory;

void e3d_cull_free(e3d_cull_memory *memory);
/* Lists the frame's candidates; 0 when memory is out. */
int e3d_find_candidates(e3d_context *context);

#endif
