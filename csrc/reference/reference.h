/* The scalar reference: the whole renderer again, one sample at a time, from docs/exactness alone.
 *
 * It is the oracle that every kernel is compared with, byte for byte, and the page to read first:
 * start at reference.c, which reads as the way of a frame. It shares no code with the kernels.
 */
#pragma once

#include "e3d.h"
#include "e3d_behind.h"
#include "e3d_bloom.h"
#include "e3d_lens.h"

/* Draws a frame into the targets. `stats` may be NULL. Nothing is written unless E3D_OK is returned.
 * `frame->shading` is ignored: deferred and forward give the same bytes. */
e3d_status e3d_reference_render(const e3d_frame *frame, const e3d_targets *targets, e3d_stats *stats);
/* Adds the glow of a picture to it. */
e3d_status e3d_reference_bloom(const e3d_bloom *bloom);
/* Finds the levels of the picture behind glass. */
void e3d_reference_behind(const e3d_behind *picture, float *levels);
/* Draws the colours of a picture through a lens. */
void e3d_reference_lens(const e3d_lens_colors *colors);
