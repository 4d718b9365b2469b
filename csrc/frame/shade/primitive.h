/* The primitive and the instance that an ID stands for. */
#pragma once

#include <stdint.h>

#include "base/always_inline.h"
#include "data/mesh/mesh.h"
#include "kernels/types/visible.h"
#include "frame/pass/draws.h"

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
