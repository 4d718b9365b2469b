/* The data that the stages of the store share: a pass's outputs and background, and a thread's pixels. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/grow.h"
#include "base/limits.h"
#include "data/tone_tables.h"
#include "e3d_targets.h"
#include "kernels/types/samples.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* Something drawn in one colour: its sample and whether that counts (e3d_samples), and the pixel of nothing else. */
typedef struct e3d_ink {
    float sample[4];
    uint32_t rgba;
} e3d_ink;

typedef struct e3d_background {
    float color[3]; /* clamped */
    float sample[4];
    uint32_t rgba;
    uint32_t row[E3D_TILE]; /* of such pixels */
} e3d_background;

typedef struct e3d_output {
    void *target; /* or NULL */
    size_t first; /* its first word in e3d_store_memory */
} e3d_output;

/* Constant for a pass. */
typedef struct e3d_store {
    const e3d_prepared *pass;
    e3d_output outputs[E3D_OUTPUTS]; /* by kind */
    size_t words;                    /* the words of all outputs in a thread's memory */
    e3d_background background;
    e3d_ink line;
    const uint32_t (*gradient)[E3D_DITHER]; /* the gradient's codes for each row of pixels; NULL: there is none */
} e3d_store;

/* A thread's memory: the pixels of one tile. */
typedef struct e3d_store_memory {
    e3d_tile tile;                             /* that is drawn */
    uint32_t rgba[E3D_TILE_SAMPLES + E3D_PAD]; /* the pixels, with one sample each */
    e3d_samples samples;                       /* the samples, if a pixel has several, or if something is blended over it */
    int sampled;                               /* whether the tile's colours go to `samples` */
    e3d_array words;                           /* int32_t or float: the outputs other than colour, one after the other */
} e3d_store_memory;

/* R33 for a pixel whose samples are alike. */
static inline float e3d_mean_of(float value, int samples)
{
    float sum = 0.0f;
    for (int i = 0; i < samples; i++)
        sum = sum + value;
    return sum * (1.0f / (float)samples);
}
