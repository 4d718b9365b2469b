/* Equirectangular pictures to the faces of a cube. */
#pragma once

#include <stdint.h>

#include "light/cube.h"

/* Fills the cube with the mean of the picture over each texel, borders included; 0 when memory is out. pixels: as for
 * e3d_environment_create. */
int e3d_cube_from_picture(const float *pixels, int32_t width, int32_t height, int threads, const e3d_cube *cube);
