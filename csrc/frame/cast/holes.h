/* Holes of casters. */
#pragma once

#include <stdint.h>

#include "kernels/types/casters.h"

/* Whether light passes through a caster's material where the ray hits it; `weights` are those of its corners (R101). */
int e3d_caster_is_open(const e3d_caster_index *index, uint32_t caster, const float weight[3]);
