/* Surfaces on which exact shadows fall. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Whether exact shadows may fall on a bucket's samples. */
int e3d_receives_exact_shadows(const e3d_prepared *pass, const e3d_bucket *bucket);
/* Whether a bucket's normals are those of its vertices (R22). */
int e3d_has_smooth_normals(const e3d_bucket *bucket);
/* Finds the planes of the surfaces of such a bucket (R100, R194). */
void e3d_find_receivers(const e3d_steps *s, e3d_shade_memory *memory);
/* A step: finds the lights that are hidden from a batch's samples, and what of soft ones is. */
void e3d_hide_lights(const e3d_steps *s);
