/* Projected pieces of primitives, which become records, and the lists that records of materials with alpha go to. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d.h"
#include "kernels/types/vertices.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/pass/transmits.h"

typedef struct e3d_corner {
    int32_t x, y;
    float zn, iw;
    float c[3];
} e3d_corner;
typedef struct e3d_primitive {
    uint32_t order;
    int set, face, cut;
    int alpha; /* the list that it goes to (e3d_alpha_kind) */
    e3d_cull cull;
    int mirrored;
} e3d_primitive;
int e3d_project(const float v[4], int clipped, const e3d_viewport *viewport, e3d_corner *out);
/* Makes a record of a piece that shows, and bins it, unless records are sorted first. */
void e3d_emit(const e3d_prepared *pass, e3d_geometry_memory *state, const e3d_corner corner[3], const e3d_primitive *primitive);
/* The chains of a set in which records of a kind of alpha are listed. */
e3d_chains *e3d_chains_of(e3d_record_set *set, int alpha);

/* Whether there are IDs and memory for `more` records. */
int e3d_records_fit(e3d_record_set *set, int id_bits, size_t more);

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
    if (!draw->any_alpha)
        return E3D_ALPHA_NONE;
    return e3d_alpha_kind(pass, e3d_material_at(pass->frame, draw, primitive), e3d_face_of(draw, primitive) >= 0);
}
