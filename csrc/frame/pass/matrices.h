/* The matrices of an instance, in float64 and a fixed order of operations (R1, R2). */
#pragma once

#include <stdint.h>

#include "e3d.h"

/* World from object space, of one instance of a draw. */
void e3d_world_matrix(const e3d_draw *draw, int32_t instance, double out[16]);
void e3d_clip_matrix(const double clip_from_world[16], const double world[16], float out[16]);
/* Finds the matrix of normals, scaled; zero if it isn't finite. Returns whether the world matrix mirrors. */
int e3d_normal_matrix(const double world[16], float out[9]);
/* Whether the upper left 3x3 part mirrors. */
int e3d_mirrors(const double m[16]);
