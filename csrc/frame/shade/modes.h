/* The display modes that show neither light nor the surfaces' own colours. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Colours an interpolated batch as the frame's mode says. */
void e3d_show_mode(const e3d_prepared *pass, e3d_shade_memory *memory);
