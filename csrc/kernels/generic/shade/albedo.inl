/* albedo: looks up in a table the share of light that rough surfaces reflect if it is 1 all around (R64). */
#pragma once

#include "base/always_inline.h"
#include "e3d.h"

/* The place of a roughness and a cosine between normal and viewer in tables of one size. */
typedef struct albedo_place {
    int32_t first[V_LANES];
    vf32 by_roughness, by_cosine;
} albedo_place;

static inline vf32 albedo_clamp(vf32 v) { return v_min(v_max(v, v_setf(0.0f)), v_setf(1.0f)); }

static inline vi32 albedo_node(vf32 at, int size) { return v_mini(v_trunc(at), v_seti(size - 2)); }

static ALWAYS_INLINE albedo_place albedo_find(vf32 roughness, vf32 cosine, int size)
{
    vf32 last = v_setf((float)(size - 1));
    vf32 x = v_mul(albedo_clamp(roughness), last), y = v_mul(v_sqrt(albedo_clamp(cosine)), last);
    vi32 i = albedo_node(x, size), j = albedo_node(y, size);
    albedo_place at = {.by_roughness = v_sub(x, v_float(i)), .by_cosine = v_sub(y, v_float(j))};
    v_storei(at.first, v_addi(v_muli(i, v_seti(size)), j));
    return at;
}

static ALWAYS_INLINE vf32 albedo_row(const float *nodes, const albedo_place *at)
{
    vf32 a, b;
    v_load_pairs(nodes, at->first, &a, &b);
    return v_add(a, v_mul(v_sub(b, a), at->by_cosine));
}

static ALWAYS_INLINE vf32 albedo_of(e3d_dfg kind, const albedo_place *at)
{
    vf32 upper = albedo_row(E3D_DFG_TABLE[kind], at), lower = albedo_row(E3D_DFG_TABLE[kind] + E3D_DFG_SIZE, at);
    return v_add(upper, v_mul(v_sub(lower, upper), at->by_roughness));
}

static void kernel_albedo(e3d_dfg kind, const float *roughness, const float *cosine, int count, float *out)
{
    for (int i = 0; i < count; i += V_LANES) {
        albedo_place at = albedo_find(v_loadf(roughness + i), v_loadf(cosine + i), E3D_DFG_SIZE);
        v_storef(out + i, albedo_of(kind, &at));
    }
}
