/* Which records have alpha: those of materials that are masked or blended, or that light passes through. */
#pragma once

#include <stdint.h>

#include "e3d.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/pass/transmits.h"

/* The list for records of a material: masked, blended, E3D_ALPHA_NONE, or E3D_ALPHA_UNSEEN (R82, R133). */
static inline int e3d_alpha_kind(const e3d_prepared *pass, const e3d_material *material, int is_face)
{
    int transmits = is_face && e3d_transmits(pass->frame, material);
    if (material->alpha_mode == E3D_ALPHA_OPAQUE && !transmits)
        return E3D_ALPHA_NONE;
    if ((material->alpha_mode == E3D_ALPHA_MASK && !transmits) || e3d_plans(pass, E3D_PLAN_SOLID))
        return E3D_ALPHA_MASKED;
    return e3d_plans(pass, E3D_PLAN_BLENDS) ? E3D_ALPHA_BLENDED : E3D_ALPHA_UNSEEN;
}

/* The same for a primitive of a draw, by its number in its instance. */
static inline int e3d_alpha_kind_of(const e3d_prepared *pass, const e3d_draw_state *draw, int32_t primitive)
{
    const e3d_mesh_desc *mesh = &draw->mesh->desc;
    int is_face = primitive < mesh->faces_count;
    int32_t id = mesh->material_ids && is_face ? mesh->material_ids[primitive] : 0;
    return draw->any_alpha ? e3d_alpha_kind(pass, &pass->frame->materials[draw->draw->material_base + id], is_face) : E3D_ALPHA_NONE;
}
