/* Ambient visibility of samples. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Finds the visibility of a batch (R129), if the frame has it: that of its pixels; 1 for blended samples. */
void e3d_find_visibility(const e3d_prepared *pass, const e3d_shade_out *out);
