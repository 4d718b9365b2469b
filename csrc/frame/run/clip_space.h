/* Draws one mesh in clip space, without a camera: what the low-level doors share. */
#pragma once

#include "e3d.h"

/* Fills what of a frame is the same for all such pictures (its places are those of clip space), and draws it. */
e3d_status e3d_draw_in_clip_space(const e3d_mesh_desc *desc, const e3d_material *materials, int32_t material_count, e3d_frame *frame,
                                  const e3d_targets *targets, e3d_backend backend, int32_t threads);
