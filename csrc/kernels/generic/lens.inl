/* lens: filters the light of pinhole pictures for pixels of a lens (R204). A lane is a pixel; taps that one lane has more than
 * another weigh nothing there. */
#pragma once

#include "base/always_inline.h"
#include "data/lens_filter.h"
#include "kernels/types/lens.h"

/* The taps along an axis. */
typedef struct lens_taps {
    vi32 first, last;     /* the former at least 0; the latter of the face's row or column */
    int count;            /* of the lane that has the most */
    vf32 sum;
    float weight[E3D_LENS_TAPS][V_LANES];
} lens_taps;

static ALWAYS_INLINE int lens_most(vi32 counts)
{
    int32_t lane[V_LANES], most = 1;
    v_storei(lane, counts);
    for (int l = 0; l < V_LANES; l++)
        most = lane[l] > most ? lane[l] : most;
    return most;
}

static ALWAYS_INLINE void lens_find_taps(lens_taps *t, vi32 at, vi32 half, vi32 side)
{
    vi32 zero = v_seti(0), sum = zero, one = v_seti(1);
    vi32 from_centre = v_subi(at, v_seti(E3D_LENS_ONE / 2)); /* the centre of pixel i is at 256 i + 128 */
    t->first = v_maxi(v_addi(v_sra(v_subi(from_centre, half), 8), one), zero);
    t->last = v_subi(side, one);
    vi32 end = v_mini(v_sra(v_subi(v_addi(from_centre, half), one), 8), t->last);
    t->count = lens_most(v_addi(v_subi(end, t->first), one));
    vi32 away = v_subi(v_shl(t->first, 8), from_centre);
    for (int i = 0; i < t->count; i++) {
        vi32 weight = v_subi(half, v_maxi(away, v_subi(zero, away)));
        vmask beyond = v_gti(v_addi(t->first, v_seti(i)), t->last);
        weight = v_seli(beyond, zero, v_maxi(weight, zero));
        sum = v_addi(sum, weight);
        v_storef(t->weight[i], v_float(weight));
        away = v_addi(away, v_seti(E3D_LENS_ONE));
    }
    t->sum = v_float(sum);
}

static ALWAYS_INLINE void lens_add(vf32 part[4], const uint16_t *light, vi32 pixel, vf32 weight)
{
    vi32 low = v_seti(E3D_LENS_FULL), at = v_shl(pixel, 1);
    vi32 red_green = v_gatheri(light, at), blue_alpha = v_gatheri(light + 2, at);
    part[0] = v_add(part[0], v_mul(v_float(v_andi(red_green, low)), weight));
    part[1] = v_add(part[1], v_mul(v_float(v_shr(red_green, 16)), weight));
    part[2] = v_add(part[2], v_mul(v_float(v_andi(blue_alpha, low)), weight));
    part[3] = v_add(part[3], v_mul(v_float(v_shr(blue_alpha, 16)), weight));
}

static ALWAYS_INLINE void lens_mean(const uint16_t *light, e3d_lens_batch *batch, int i)
{
    vf32 nothing = v_setf(0.0f), sum[4] = {nothing, nothing, nothing, nothing};
    vi32 width = v_loadi(batch->width + i), start = v_loadi(batch->start + i);
    lens_taps x, y;
    lens_find_taps(&x, v_loadi(batch->x + i), v_loadi(batch->across + i), width);
    lens_find_taps(&y, v_loadi(batch->y + i), v_loadi(batch->down + i), v_loadi(batch->height + i));
    for (int j = 0; j < y.count; j++) {
        vf32 part[4] = {nothing, nothing, nothing, nothing}, weight = v_loadf(y.weight[j]);
        vi32 row = v_addi(start, v_muli(v_mini(v_addi(y.first, v_seti(j)), y.last), width));
        for (int k = 0; k < x.count; k++)
            lens_add(part, light, v_addi(row, v_mini(v_addi(x.first, v_seti(k)), x.last)), v_loadf(x.weight[k]));
        for (int c = 0; c < 4; c++)
            sum[c] = v_add(sum[c], v_mul(part[c], weight));
    }
    vf32 whole = v_mul(x.sum, y.sum);
    vf32 share = v_self(v_gt(whole, nothing), v_div(v_setf(1.0f), whole), nothing);
    for (int c = 0; c < 4; c++)
        v_storef(batch->light[c] + i, v_mul(sum[c], share));
}

static void kernel_lens(const uint16_t *light, e3d_lens_batch *batch)
{
    for (int i = 0; i < batch->count; i += V_LANES)
        lens_mean(light, batch, i);
}
