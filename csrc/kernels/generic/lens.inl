/* lens: filters the light of a pinhole picture for pixels of a lens (R204). A lane is a pixel for what lies along an axis; then
 * each pixel's taps are added for itself, its four channels at a time. */
#pragma once

#include <stdint.h>
#include <string.h>

#include "e3d_lens.h"
#include "base/always_inline.h"
#include "data/lens_filter.h"
#include "kernels/types/lens.h"

/* Four channels, in the compiler's own vectors. */
typedef float lens_color __attribute__((vector_size(16)));
typedef int32_t lens_numbers __attribute__((vector_size(16)));
typedef uint16_t lens_light __attribute__((vector_size(16)));
typedef uint64_t lens_pair __attribute__((vector_size(16)));

/* The taps along an axis. Beyond those of its own, a lane has others that weigh nothing. */
typedef struct lens_taps {
    vi32 first;    /* at least 0 */
    int count;     /* of the lane that has the most */
    int is_inside; /* all lanes' pictures have so many from the first one on */
    vf32 sum;
    float weight[E3D_LENS_TAPS][V_LANES];
} lens_taps;

static ALWAYS_INLINE int32_t lens_most(vi32 numbers)
{
    int32_t lane[V_LANES], most = 1;
    v_storei(lane, numbers);
    for (int l = 0; l < V_LANES; l++)
        most = lane[l] > most ? lane[l] : most;
    return most;
}

static ALWAYS_INLINE void lens_find_taps(lens_taps *t, vi32 at, vi32 half, int32_t side)
{
    vi32 zero = v_seti(0), sum = zero, one = v_seti(1), last = v_seti(side - 1);
    vi32 from_centre = v_subi(at, v_seti(E3D_LENS_ONE / 2)); /* the centre of pixel i is at 256 i + 128 */
    t->first = v_maxi(v_addi(v_sra(v_subi(from_centre, half), 8), one), zero);
    vi32 end = v_mini(v_sra(v_subi(v_addi(from_centre, half), one), 8), last);
    t->count = lens_most(v_addi(v_subi(end, t->first), one));
    t->is_inside = !v_any(v_gti(v_addi(t->first, v_seti(t->count)), v_seti(side)));
    vi32 away = v_subi(v_shl(t->first, 8), from_centre);
    for (int i = 0; i < t->count; i++) {
        vi32 weight = v_subi(half, v_maxi(away, v_subi(zero, away)));
        vmask beyond = v_gti(v_addi(t->first, v_seti(i)), last);
        weight = v_seli(beyond, zero, v_maxi(weight, zero));
        sum = v_addi(sum, weight);
        v_storef(t->weight[i], v_float(weight));
        away = v_addi(away, v_seti(E3D_LENS_ONE));
    }
    t->sum = v_float(sum);
}

static ALWAYS_INLINE lens_color lens_load(const uint16_t *light)
{
    uint64_t four;
    memcpy(&four, light, sizeof four);
    lens_light pixel = (lens_light)(lens_pair){four, 0}, zero = {0};
#if defined(__clang__)
    lens_light wide = __builtin_shufflevector(pixel, zero, 0, 8, 1, 9, 2, 10, 3, 11);
#else
    lens_light wide = __builtin_shuffle(pixel, zero, (lens_light){0, 8, 1, 9, 2, 10, 3, 11});
#endif
    return __builtin_convertvector((lens_numbers)wide, lens_color); /* a plain one of 16 bits has four instructions more */
}

/* Adds taps of a pixel, whose weights along both axes are V_LANES apart. */
static ALWAYS_INLINE lens_color lens_add(const uint16_t *light, intptr_t pitch, const float *across, int columns, const float *down,
                                         int rows)
{
    lens_color sum = {0.0f, 0.0f, 0.0f, 0.0f};
    for (int j = 0; j < rows; j++, light += pitch) {
        lens_color row = lens_load(light) * across[0];
        for (int k = 1; k < columns; k++)
            row = row + lens_load(light + 4 * k) * across[k * V_LANES];
        sum = sum + row * down[j * V_LANES];
    }
    return sum;
}

/* What the pixels of a vector add. */
typedef struct lens_group {
    const uint16_t *light; /* of their picture */
    int32_t width, height;
    int count;
    lens_taps x, y;
    int32_t left[V_LANES], top[V_LANES];
    float share[V_LANES]; /* 1 over the sum of the weights */
} lens_group;

/* Adds the taps of all pixels, so many columns each. */
static ALWAYS_INLINE void lens_add_all(const lens_group *g, int columns, float *mean)
{
    intptr_t pitch = 4 * (intptr_t)g->width;
    for (int l = 0; l < g->count; l++) {
        const uint16_t *first = g->light + g->top[l] * pitch + 4 * (intptr_t)g->left[l];
        lens_color color = lens_add(first, pitch, &g->x.weight[0][l], columns, &g->y.weight[0][l], g->y.count) * g->share[l];
        memcpy(mean + 4 * l, &color, sizeof color);
    }
}

/* The same where some pictures end before. */
static ALWAYS_INLINE void lens_add_cut(const lens_group *g, float *mean)
{
    intptr_t pitch = 4 * (intptr_t)g->width;
    for (int l = 0; l < g->count; l++) {
        int32_t columns = g->width - g->left[l], rows = g->height - g->top[l];
        lens_color color = {0.0f, 0.0f, 0.0f, 0.0f};
        if (columns > 0 && rows > 0)
            color = lens_add(g->light + g->top[l] * pitch + 4 * (intptr_t)g->left[l], pitch, &g->x.weight[0][l],
                             columns < g->x.count ? columns : g->x.count, &g->y.weight[0][l],
                             rows < g->y.count ? rows : g->y.count);
        color = color * g->share[l];
        memcpy(mean + 4 * l, &color, sizeof color);
    }
}

static ALWAYS_INLINE void lens_mean(lens_group *g, const e3d_lens_pixel *pixels, float *mean)
{
    vi32 at = v_shl(v_mini(v_iota(), v_seti(g->count - 1)), 2), halves = v_gatheri(&pixels->across, at);
    lens_find_taps(&g->x, v_gatheri(&pixels->x, at), v_andi(halves, v_seti(E3D_LENS_FULL)), g->width);
    lens_find_taps(&g->y, v_gatheri(&pixels->y, at), v_shr(halves, 16), g->height);
    vf32 whole = v_mul(g->x.sum, g->y.sum), nothing = v_setf(0.0f);
    v_storef(g->share, v_self(v_gt(whole, nothing), v_div(v_setf(1.0f), whole), nothing));
    v_storei(g->left, g->x.first);
    v_storei(g->top, g->y.first);
    switch (g->x.is_inside && g->y.is_inside ? g->x.count : 0) { /* the compiler knows the most usual numbers */
    case 0: lens_add_cut(g, mean); break;
    case 2: lens_add_all(g, 2, mean); break;
    case 3: lens_add_all(g, 3, mean); break;
    case 4: lens_add_all(g, 4, mean); break;
    default: lens_add_all(g, g->x.count, mean);
    }
}

static void kernel_lens(const uint16_t *light, const e3d_lens_face *face, const e3d_lens_pixel *pixels, int count, float *mean)
{
    lens_group g;
    g.light = light + 4 * face->start, g.width = face->width, g.height = face->height;
    for (int i = 0; i < count; i += V_LANES) {
        g.count = count - i < V_LANES ? count - i : V_LANES;
        lens_mean(&g, pixels + i, mean + 4 * (size_t)i);
    }
}
