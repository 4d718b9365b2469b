/* The steps of a bucket's batches, from interpolation to their sink. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

/* Chooses the steps of a bucket, and finds the inputs that they need of its surfaces. */
e3d_steps e3d_choose_steps(const e3d_shade_in *in, const e3d_bucket *bucket, const e3d_shade_out *out);
