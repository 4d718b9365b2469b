/* Which materials light passes through (R133). */
#pragma once

#include "e3d.h"

/* Whether the faces of a material are laid over what is behind them, since they let light pass. */
static inline int e3d_transmits(const e3d_frame *frame, const e3d_material *material)
{
    return material->is_physical && material->physical.transmission != 0.0f && frame->mode == E3D_MODE_LIT && !material->is_unlit;
}

/* Whether a material isn't simply opaque. */
static inline int e3d_is_seen_through(const e3d_frame *frame, const e3d_material *material)
{
    return material->alpha_mode != E3D_ALPHA_OPAQUE || e3d_transmits(frame, material);
}
