/* The list of samples that records with alpha cover in a tile, before their alphas are known. */
#pragma once

#include <stdint.h>

#include "base/limits.h"
#include "base/vectors.h"
#include "data/sample_patterns.h"
#include "kernels/types/shown.h"

/* A list of samples, with their depths. A sample may be in it several times. */
typedef struct e3d_alpha_list {
    const float *limit;  /* for each sample of the tile: listed samples are nearer, */
    const int32_t *kept; /* or as near, and come before the record of this ID (R16) */
    e3d_shown *shown;
    float *z; /* of each entry; E3D_PAD more are written */
    uint64_t once[E3D_TILE]; /* for each row a bit a sample: it is in the list */
    uint64_t met;            /* not 0: a sample was listed again */
} e3d_alpha_list;

/* The same with multisampling: an entry is a pixel (e3d_shown.pattern), and its covered samples: a bit each. */
typedef struct e3d_msaa_list {
    const e3d_sample_pattern *pattern;
    const float *limit[E3D_MOST_MSAA_SAMPLES]; /* as above, for each plane */
    const int32_t *kept[E3D_MOST_MSAA_SAMPLES];
    e3d_shown *shown;
    int32_t *cover; /* of each entry; E3D_PAD more are written */
    int alone;      /* not 0: each covered sample is an entry of its own (R195) */
} e3d_msaa_list;

/* The layers that blended records add to a tile, sample after sample: sample s has those from first[s] to first[s + 1] - 1. */
typedef struct e3d_alpha_layers {
    const uint32_t *first;
    const int32_t *depth;  /* greater is farther; E3D_PAD more are read */
    const uint32_t *which; /* the number of each layer's colour */
    const float (*color)[4]; /* clamped, and alpha */
    /* NULL, or for each colour the shares of light that pass, and 1; the 1 is 0 if it only has alpha */
    const float (*through)[4];
    const float (*light)[4];   /* NULL, or for each colour its radiance, finite, and alpha */
    float (*lit)[3];           /* the radiance of the tile's pixels, E3D_TILE to a row, over which that is blended, */
    int axis;                  /* for the one sample that stands for a pixel of axis x axis samples */
} e3d_alpha_layers;

/* R84: blends a clamped colour, followed by its alpha, over a sample; over[3] is the sum of alphas. */
static inline void e3d_lay_layer(const float color[4], float over[4])
{
    float4 own = load4(color), a = LANES(own, own, 3, 3, 3, 3), one = splat(1.0f);
    a = (float4)((int4)(a >= splat(E3D_LEAST_ALPHA)) & (int4)a);
    store4(over, LANES(own, one, 0, 1, 2, 4) * a + load4(over) * (one - a));
}

/* R135: the same for a colour through which shares of light pass. */
static inline void e3d_lay_transmitting(const float color[4], const float through[3], float over[4])
{
    float a = color[3] >= E3D_LEAST_ALPHA ? color[3] : 0.0f, rest[3];
    for (int k = 0; k < 3; k++) {
        rest[k] = (1.0f - a) + a * through[k];
        float sum = color[k] * a + over[k] * rest[k];
        over[k] = sum < 1.0f ? sum : 1.0f;
    }
    float mean = ((rest[0] + rest[1]) + rest[2]) * E3D_THIRD, most = over[0] > over[1] ? over[0] : over[1];
    most = most > over[2] ? most : over[2];
    over[3] = (1.0f - mean) + over[3] * mean;
    if (most >= E3D_LEAST_ALPHA)
        over[3] = over[3] > most ? over[3] : most;
}

/* One or the other. */
static inline void e3d_lay_any(const float color[4], const float through[4], float over[4])
{
    if (through && through[3] != 0.0f)
        e3d_lay_transmitting(color, through, over);
    else
        e3d_lay_layer(color, over);
}

/* R123: blends the radiance of a sample's layers over that of its pixel, if the sample stands for the pixel. */
static inline void e3d_lay_light(const e3d_alpha_layers *layers, const uint32_t *order, int count, int sample)
{
    int x = sample % E3D_TILE, y = sample / E3D_TILE, axis = layers->axis;
    if (x % axis != axis / 2 || y % axis != axis / 2)
        return;
    float *over = layers->lit[y / axis * E3D_TILE + x / axis];
    for (int i = 0; i < count; i++) {
        const float *light = layers->light[order[i]], *through = layers->through ? layers->through[order[i]] : NULL;
        float a = light[3], rest = 1.0f - a;
        if (!(a >= E3D_LEAST_ALPHA)) /* it isn't laid at all: 0 times it would make +0 of -0 */
            continue;
        for (int k = 0; k < 3; k++)
            over[k] = light[k] * a + over[k] * (through && through[3] != 0.0f ? rest + a * through[k] : rest);
    }
}
