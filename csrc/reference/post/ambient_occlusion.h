/* The scalar reference of ambient occlusion: e3d_find_occlusion without its checks. */
#pragma once

#include "e3d_occlusion.h"

void e3d_reference_occlusion(const e3d_depth_picture *picture, float radius, float *scratch, float *visibility);
