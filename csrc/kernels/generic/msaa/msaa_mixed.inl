/* raster with multisampling: finds the surfaces in mixed pixels, whose samples don't all show the same (R105), a vector of
 * pixels at a time. */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/types/msaa_mixed.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "kernels/generic/setup.inl"

/* Adds a colour to shade for each lane whose bit is set: it is found for this ID, at this sample. `number` is the colour's,
 * which is kept as the run's length. */
static ALWAYS_INLINE int mixed_add(vi32 id, vi32 sample, vi32 number, uint32_t bits, e3d_run *out)
{
    int32_t owner[V_LANES], rest[V_LANES];
    int count = v_pack(owner, id, bits);
    v_pack(rest, v_ori(sample, v_shl(number, 16)), bits);
    v_store_pairs(out, v_loadi(owner), v_loadi(rest)); /* a run's sample and length share a word */
    return count;
}

/* Lists a vector of pixels: a colour for each ID that shows in a pixel, at the first sample that shows it. Which samples show
 * the same is unpredictable, so there is no branch on it. */
static ALWAYS_INLINE int mixed_vector(const e3d_visible_tile *planes, int samples, int first, e3d_run *runs, int count, e3d_mixed_list *list)
{
    vi32 pixel = v_loadi(list->pixel + first), id[E3D_MOST_MSAA_SAMPLES], number[E3D_MOST_MSAA_SAMPLES];
    uint32_t tail = setup_tail(list->pixels - first);
    for (int s = 0; s < samples; s++) {
        id[s] = v_gatheri(planes[s].id, pixel);
        number[s] = v_seti(E3D_MIXED_BACKGROUND);
        vmask seen = v_negi(id[s]);
        for (int t = 0; t < s; t++) {
            vmask same = v_eqi(id[s], id[t]);
            number[s] = v_seli(same, number[t], number[s]);
            seen = v_mor(seen, same);
        }
        uint32_t fresh = v_bits(v_mnot(seen)) & tail;
        vi32 behind = v_sums(v_seli(seen, v_seti(0), v_seti(1)));
        number[s] = v_seli(seen, number[s], v_addi(v_seti(count - 1), behind));
        v_pack16(list->of[s] + first, number[s], setup_tail(V_LANES));
        count += mixed_add(id[s], v_ori(pixel, v_seti(s << E3D_SHOWN_NUMBER)), number[s], fresh, runs + count);
    }
    return count;
}

static int kernel_list_mixed(const e3d_visible_tile *planes, int samples, int first, e3d_run *runs, e3d_mixed_list *list)
{
    int count = 0;
    for (; first < list->pixels && count + V_LANES * samples <= E3D_TILE_SAMPLES; first += V_LANES)
        count = samples == 4 ? mixed_vector(planes, 4, first, runs, count, list) : mixed_vector(planes, samples, first, runs, count, list);
    list->colors = count;
    return first < list->pixels ? first : list->pixels;
}
