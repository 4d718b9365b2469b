/* lobe: the light from all around that a rough mirror gathers (R68), for a block of texels at once. */
#pragma once

#include "base/always_inline.h"
#include "kernels/types/lobe.h"

/* With m = |n - l|^2: n.l = 1 - m/2 and 1 - (n.h)^2 = m/4, without loss of bits where l is near n. */
static ALWAYS_INLINE vf32 lobe_share(const vf32 n[3], const e3d_cell_group *group, int cell, vf32 square, vf32 rest)
{
    vf32 x = v_sub(n[0], v_setf(group->direction[0][cell])), y = v_sub(n[1], v_setf(group->direction[1][cell])),
         z = v_sub(n[2], v_setf(group->direction[2][cell]));
    vf32 m = v_add(v_add(v_mul(x, x), v_mul(y, y)), v_mul(z, z));
    vf32 t = v_add(square, v_mul(rest, v_mul(m, v_setf(0.25f)))), c = v_sub(v_setf(1.0f), v_mul(m, v_setf(0.5f)));
    return v_div(v_max(c, v_setf(0.0f)), v_mul(t, t));
}

static void kernel_lobe(const e3d_cell_group *group, e3d_lobe_block *block)
{
    vf32 square = v_setf(block->square), rest = v_setf(block->rest);
    for (int i = 0; i < E3D_LOBE_TEXELS; i += V_LANES) {
        const vf32 n[3] = {v_loadf(block->normal[0] + i), v_loadf(block->normal[1] + i), v_loadf(block->normal[2] + i)};
        vf32 sums[E3D_LOBE_SUMS];
        for (int k = 0; k < E3D_LOBE_SUMS; k++)
            sums[k] = v_loadf(block->sums[k] + i);
        for (int cell = 0; cell < E3D_CELLS; cell++) {
            vf32 share = lobe_share(n, group, cell, square, rest);
            for (int k = 0; k < 3; k++)
                sums[k] = v_add(sums[k], v_mul(share, v_setf(group->light[k][cell])));
            sums[3] = v_add(sums[3], v_mul(share, v_setf(group->weight[cell])));
        }
        for (int k = 0; k < E3D_LOBE_SUMS; k++)
            v_storef(block->sums[k] + i, sums[k]);
    }
}
