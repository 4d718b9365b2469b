/* What rough mirrors show of an environment, level by level. */
#ifndef E3D_PREFILTER_H
#define E3D_PREFILTER_H

#include <stdint.h>

#include "environment/cube.h"

enum { E3D_MAX_HALVES = 12 };

/* A cube and its halves, each half the size of the one before. */
typedef struct e3d_halves {
    e3d_cube of[E3D_MAX_HALVES];
    int count;
} e3d_halves;

/* Fills a level, borders too, with what a mirror of that roughness, above 0, shows of the finest cube. */
void e3d_prefilter(const e3d_halves *halves, double roughness, int threads, const e3d_cube *out);

#endif
