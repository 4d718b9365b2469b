/* The scalar reference of ambient occlusion: e3d_find_occlusion without its checks. */
#ifndef E3D_REFERENCE_AMBIENT_OCCLUSION_H
#define E3D_REFERENCE_AMBIENT_OCCLUSION_H

#include "e3d_occlusion.h"

void e3d_reference_occlusion(const e3d_depth_picture *picture, float radius, float *scratch, float *visibility);

#endif
