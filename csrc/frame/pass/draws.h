/* The draws of a frame, their instances and their places in the order. */
#pragma once

#include "base/grow.h"
#include "data/mesh/mesh.h"
#include "e3d.h"

/* An instance, without what depends on the eye (e3d_view_instance). */
typedef struct e3d_instance {
    int32_t draw;
    uint32_t order; /* the order of its first primitive */
    float world[12], normal[9]; /* valid once e3d_view_instance.ready is set */
} e3d_instance;

enum { E3D_LINES_A_UNIT = 256 }; /* so many lines, points or edges are one unit of work */

/* A draw in the frame: where its instances and units of work start. */
typedef struct e3d_draw_state {
    const e3d_draw *draw;
    const e3d_mesh *mesh;
    int64_t instance_base, unit_base, group_base;
    int32_t primitives;  /* an instance */
    int32_t placed;      /* how many instances have their place in the order */
    uint32_t order;      /* the order of the first primitive; with E3D_POSE_NODES each instance has its own */
    int32_t line_units, point_units, edge_units; /* an instance */
    int32_t units;       /* their sum */
    /* Traits of its materials; two-sidedness is found only if faces are culled */
    int32_t any_two_sided, all_two_sided, any_alpha;
} e3d_draw_state;

/* A place in the order of drawing: all instances of a draw, or one node of E3D_POSE_NODES. */
typedef struct e3d_order_entry {
    uint32_t order; /* the order of its first primitive */
    int32_t draw, instance;
} e3d_order_entry;

/* All draws of a frame. Later frames use the memory again. */
typedef struct e3d_draws {
    e3d_draw_state *states;
    e3d_instance *instances;
    e3d_order_entry *order;
    int32_t count, instance_count, order_count;
    int64_t units, groups;
    int any_transmits; /* light passes through some of their materials */
    e3d_array state_memory, instance_memory, order_memory;
} e3d_draws;

/* Prepares the draws of a frame. `edges`: the edges of wireframes are drawn, too. `alpha`: some materials are masked or blended. */
e3d_status e3d_draws_prepare(e3d_draws *draws, const e3d_frame *frame, int edges, int alpha);
void e3d_draws_free(e3d_draws *draws);

/* These return the draw of an instance, a unit of work or a group of clusters, by its number in the frame, which must exist. */
const e3d_draw_state *e3d_draw_of_instance(const e3d_draws *draws, int64_t instance);
const e3d_draw_state *e3d_draw_of_unit(const e3d_draws *draws, int64_t unit);
const e3d_draw_state *e3d_draw_of_group(const e3d_draws *draws, int64_t group);
/* The last entry that starts at or before a place in the order. */
const e3d_order_entry *e3d_find_order_entry(const e3d_draws *draws, uint32_t order);

/* The numbers that object_id and instance_id output. */
static inline int32_t e3d_object_id(const e3d_draw *draw, int32_t instance)
{
    return draw->pose_kind == E3D_POSE_NODES ? draw->node_ids[instance] : draw->node_id;
}
static inline int32_t e3d_instance_id(const e3d_draw *draw, int32_t instance)
{
    if (draw->instance_ids)
        return draw->instance_ids[instance];
    return draw->pose_kind == E3D_POSE_NODES ? 0 : draw->first_instance + instance;
}
