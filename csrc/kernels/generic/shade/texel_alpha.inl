/* texture: reads the fourth channel of texels, which only alphas and some slots need (R30). */
#pragma once

#include "base/always_inline.h"
#include "e3d.h"
#include "kernels/generic/shade/texture.inl"

/* The alpha of one vector of texels of 16 bits. */
static ALWAYS_INLINE vi32 alpha_of_16(const void *texels, vi32 at) { return v_shr(v_gatheri(texels, v_addi(v_addi(at, at), v_seti(1))), 16); }

/* The alpha of one vector of texels of 8 bits, which are stored signed. */
static ALWAYS_INLINE vi32 alpha_of_8(const void *texels, vi32 at) { return v_xori(v_shr(v_gatheri(texels, at), 24), v_seti(128)); }

/* R30 with 15 bits: columns are blended first. */
static ALWAYS_INLINE vi32 alpha_between(vi32 upper, vi32 lower, vi32 down)
{
    return v_addi(upper, v_sra(v_addi(v_muli(v_subi(lower, upper), down), v_seti(128)), 8));
}

static ALWAYS_INLINE vf32 alpha_mix(const texture_plan *plan, int bits, const texture_places *places, int i)
{
    const void *texels = plan->view->levels[0].texels;
    vi32 one = v_seti(1), all = v_seti(255), top = v_loadi(places->top + i), across = v_loadi(places->across + i), down = v_loadi(places->down + i);
    if (bits == 8) {
        vi32 bottom = v_addi(top, v_seti(plan->levels.stride[0])), left = v_subi(all, across);
        vi32 upper = v_addi(v_muli(alpha_of_8(texels, top), left), v_muli(alpha_of_8(texels, v_addi(top, one)), across));
        vi32 lower = v_addi(v_muli(alpha_of_8(texels, bottom), left), v_muli(alpha_of_8(texels, v_addi(bottom, one)), across));
        return v_float(v_addi(v_muli(upper, v_subi(all, down)), v_muli(lower, down)));
    }
    vi32 bottom = v_loadi(places->bottom + i);
    vi32 left = alpha_between(alpha_of_16(texels, top), alpha_of_16(texels, bottom), down);
    vi32 right = alpha_between(alpha_of_16(texels, v_addi(top, one)), alpha_of_16(texels, v_addi(bottom, one)), down);
    return v_float(v_addi(v_muli(left, v_subi(v_seti(256), across)), v_muli(right, across)));
}

static ALWAYS_INLINE vf32 alpha_read(const texture_plan *plan, int filter, int bits, int i)
{
    const void *texels = plan->view->levels[0].texels;
    if (filter == E3D_NEAREST)
        return v_float(bits == 8 ? alpha_of_8(texels, v_loadi(plan->near.top + i)) : alpha_of_16(texels, v_loadi(plan->near.top + i)));
    vf32 a = alpha_mix(plan, bits, &plan->near, i);
    if (filter == E3D_BILINEAR)
        return a;
    vi32 between = v_andi(v_loadi(plan->lod + i), v_seti(255));
    if (!v_any(v_gti(between, v_seti(0))))
        return a;
    vf32 b = alpha_mix(plan, bits, &plan->far, i);
    return v_add(a, v_mul(v_sub(b, a), v_mul(v_float(between), v_setf(0x1p-8f))));
}
