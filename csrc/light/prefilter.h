/* What rough mirrors show of an environment, level by level. */
#pragma once

#include "light/cube.h"
#include "light/light_tree.h"

/* Fills a level, borders included, with the light that a mirror of that roughness, above 0, shows. */
void e3d_prefilter(const e3d_light_tree *tree, double roughness, int threads, const e3d_cube *out);
