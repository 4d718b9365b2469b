/* The steps of a bucket's batches, from interpolation to their sink. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Chooses the steps of a bucket, and finds the inputs that they need of its surfaces. */
e3d_steps e3d_choose_steps(const e3d_shade_in *in, const e3d_bucket *bucket, const e3d_shade_out *out);
/* Whether exact shadows may fall on a bucket's samples. */
int e3d_receives_exact_shadows(const e3d_prepared *pass, const e3d_bucket *bucket);
/* Whether a bucket's normals are those of its vertices (R22). */
int e3d_has_smooth_normals(const e3d_bucket *bucket);
