/* The display modes that show neither light nor the surfaces' own colours. */
#ifndef E3D_SHADE_MODES_H
#define E3D_SHADE_MODES_H

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Colours an interpolated batch as the frame's mode says. */
void e3d_show_mode(const e3d_prepared *pass, e3d_shade_memory *memory);

#endif
