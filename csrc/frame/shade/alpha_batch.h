/* The alphas of a batch, and the sinks of samples that are tested or blended. */
#pragma once

#include "e3d.h"
#include "frame/shade/job.h"

/* The inputs that the alphas of a bucket need: E3D_WANT_... */
int e3d_alpha_wanted(const e3d_bucket *bucket);
/* The least alpha with which a material shows (R81). */
float e3d_alpha_cutoff(const e3d_material *material);

/* Step: finds the alphas of a batch. */
void e3d_find_alphas(const e3d_steps *s);
/* Step: keeps the alphas at their places in the list. */
void e3d_keep_alphas(const e3d_steps *s);
/* Step: keeps clamped colours and alphas in the list, as layers. */
void e3d_keep_layers(const e3d_steps *s);
/* Step: keeps alphas of 1 in the list. */
void e3d_keep_solid(const e3d_steps *s);
/* Step: blends the batch over the tile's samples. */
void e3d_lay_batch(const e3d_steps *s);
