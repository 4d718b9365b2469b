/* The light that falls on the other side of translucent surfaces. */
#pragma once

#include "frame/shade/job.h"

/* Finds it for a batch that isn't lit yet. */
void e3d_find_backlight(const e3d_steps *s);
