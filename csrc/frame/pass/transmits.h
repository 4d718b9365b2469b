/* Which materials light passes through (R133), and which of these bend or blur it (R160). */
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

/* Whether the faces of a material that transmits shift or blur what is behind them, in a frame that bends. */
static inline int e3d_bends(const e3d_material *material)
{
    const e3d_physical *p = &material->physical;
    return p->ior != 1.0f && (p->thickness != 0.0f || p->roughness != 0.0f);
}
