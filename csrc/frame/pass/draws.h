/* The draws of a frame, their instances and their places in the order; the primitive and the instance that an ID stands for. */
#pragma once

#include <stdint.h>

#include "base/always_inline.h"
#include "base/grow.h"
#include "data/mesh/mesh.h"
#include "e3d.h"
#include "kernels/types/visible.h"

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

/* The instance that was found last, and the order of its first primitive. Mostly the next primitive belongs to it, too. */
typedef struct e3d_instance_finder {
    const e3d_draw_state *draw; /* NULL: none was found yet */
    uint32_t first;
    int32_t instance; /* in its draw */
} e3d_instance_finder;

/* Finds the instance that a place in the order belongs to. */
void e3d_find_instance(const e3d_draws *draws, uint32_t order, e3d_instance_finder *finder);

/* Finds the instance of a fragment's triangle; returns the number of its face. */
static ALWAYS_INLINE int32_t e3d_find_face(const e3d_draws *draws, const e3d_drawn_cluster *drawn, int32_t triangle, e3d_instance_finder *finder)
{
    finder->draw = &draws->states[drawn->draw];
    finder->first = drawn->order;
    finder->instance = drawn->instance - (int32_t)finder->draw->instance_base;
    return drawn->faces[triangle];
}

/* Finds the instance of a record. Returns the primitive's number in the mesh: faces come before lines, and lines before points. */
static ALWAYS_INLINE int32_t e3d_find_primitive(const e3d_draws *draws, uint32_t order, e3d_instance_finder *finder)
{
    if (!finder->draw || order - finder->first >= (uint32_t)finder->draw->primitives)
        e3d_find_instance(draws, order, finder);
    return (int32_t)(order - finder->first);
}

/* The number of a primitive's face, or -1. */
static ALWAYS_INLINE int32_t e3d_face_of(const e3d_draw_state *draw, int32_t primitive)
{
    return primitive < draw->mesh->desc.faces_count ? primitive : -1;
}

/* The number of a face's material in its draw. */
static ALWAYS_INLINE int32_t e3d_material_of(const e3d_draw_state *draw, int32_t face)
{
    return draw->mesh->material_most ? draw->mesh->desc.material_ids[face] : 0;
}

/* The material of a primitive, by its number in the mesh; lines and points have the first one of their draw. */
static ALWAYS_INLINE const e3d_material *e3d_material_at(const e3d_frame *frame, const e3d_draw_state *draw, int32_t primitive)
{
    int32_t face = e3d_face_of(draw, primitive);
    return &frame->materials[draw->draw->material_base + (face < 0 ? 0 : e3d_material_of(draw, face))];
}
