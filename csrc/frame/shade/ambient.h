/* Ambient visibility of samples. */
#ifndef E3D_SHADE_AMBIENT_H
#define E3D_SHADE_AMBIENT_H

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Finds that of the batch (R129), where the frame has it: of its pixels, or 1 of what is blended. */
void e3d_find_visibility(const e3d_prepared *pass, const e3d_shade_out *out);

#endif
