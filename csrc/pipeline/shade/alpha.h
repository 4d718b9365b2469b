/* The alphas of a list's samples, and what is done with them. */
#ifndef E3D_SHADE_ALPHA_H
#define E3D_SHADE_ALPHA_H

#include "e3d.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/job.h"

/* What finding the alphas of a bucket needs of its surfaces: E3D_WANT_... */
int e3d_alpha_wanted(const e3d_bucket *bucket);
/* Finds the alphas of the batch, and puts them, with the colours that it has, where they are wanted. */
void e3d_alpha_batch(const e3d_prepared *pass, const e3d_bucket *bucket, const e3d_shade_out *out);
/* The least alpha with which a material shows (R81). */
float e3d_alpha_cutoff(const e3d_material *material);

#endif
