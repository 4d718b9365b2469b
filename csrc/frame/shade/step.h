/* A step that the batches of a bucket take, and all of them. */
#pragma once

#include "frame/pass/prepared.h"
#include "frame/shade/job.h"

enum { E3D_MOST_STEPS = 16 };

/* The steps that shade a bucket; each batch takes all of them in order. */
typedef struct e3d_steps {
    const e3d_shade_in *in;
    const e3d_prepared *pass;
    const e3d_bucket *bucket;
    const e3d_shade_out *out;
    int wanted; /* what they need of its surfaces: E3D_WANT_... */
    int count;
    void (*step[E3D_MOST_STEPS])(const struct e3d_steps *s);
} e3d_steps;

typedef void (*e3d_shade_step)(const e3d_steps *s);
