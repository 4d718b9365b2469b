/* The backface test of an instance's clusters. */
#pragma once

#include "kernels/types/vertices.h"

void e3d_facing_prepare(const e3d_viewport *viewport, const float clip[16], e3d_facing *out);
