/* The alphas of a batch, and the sinks of samples that do not simply show. */
#ifndef E3D_ALPHA_BATCH_H
#define E3D_ALPHA_BATCH_H

#include "e3d.h"
#include "frame/shade/job.h"
#include "frame/shade/step.h"

/* What finding the alphas of a bucket needs of its surfaces: E3D_WANT_... */
int e3d_alpha_wanted(const e3d_bucket *bucket);
/* The least alpha with which a material shows (R81). */
float e3d_alpha_cutoff(const e3d_material *material);

/* Steps: the alphas of a batch are found; */
void e3d_find_alphas(const e3d_steps *s);
/* they go to their places in the list, */
void e3d_keep_alphas(const e3d_steps *s);
/* or with the colours, which are clamped, */
void e3d_keep_layers(const e3d_steps *s);
/* or alphas of 1 do; */
void e3d_keep_solid(const e3d_steps *s);
/* or the batch is laid over the tile's samples. */
void e3d_lay_batch(const e3d_steps *s);

#endif
