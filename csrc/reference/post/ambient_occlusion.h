/* The scalar reference of ambient occlusion: e3d_find_occlusion without its checks. */
#pragma once

#include "e3d_occlusion.h"

e3d_status e3d_reference_occlusion(const e3d_depth_picture *picture, float radius, float *visibility);
