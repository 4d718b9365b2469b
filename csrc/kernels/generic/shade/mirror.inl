/* mirror: how much materials reflect of what mirrors show, and their colours with it (R211, R212). */
#pragma once

#include "base/always_inline.h"
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "kernels/generic/shade/texture_slots.inl"
#include "kernels/generic/shade/brdf.inl"
#include "kernels/generic/shade/brdf_lights.inl"
#include "kernels/generic/shade/physical.inl"

static ALWAYS_INLINE void mirror_shares(const e3d_batch *batch, const e3d_texture_batch *m, const e3d_brdf *brdf,
                                        const e3d_lighting *lighting, int has_coat, e3d_mirror_batch *out)
{
    vf32 one = v_setf(1.0f);
    for (int i = 0; i < batch->count; i += V_LANES) {
        brdf_lanes at;
        brdf_begin(batch, m, brdf, lighting, has_coat, 0, i, &at);
        vf32 share = v_loadf(out->share + i), w5 = fifth_power(v_sub(one, v_min(at.base.nv, one)));
        for (int k = 0; k < 3; k++) {
            vf32 reflected = v_mul(share, v_add(at.f0[k], v_mul(at.f_rise[k], w5)));
            if (has_coat)
                reflected = v_mul(reflected, v_sub(one, brdf_coat_share(brdf, &at, i)));
            v_storef(out->reflected[k] + i, reflected);
        }
    }
}

static void kernel_mirror_shares(const e3d_batch *batch, const e3d_texture_batch *textures, const e3d_brdf *brdf,
                                 const e3d_lighting *lighting, e3d_mirror_batch *out)
{
    if (brdf->has_coat)
        mirror_shares(batch, textures, brdf, lighting, 1, out);
    else
        mirror_shares(batch, textures, brdf, lighting, 0, out);
}

static void kernel_mirror_light(e3d_batch *batch, int is_physical, const e3d_mirror_batch *mirrors)
{
    for (int i = 0; i < batch->count; i += V_LANES) {
        vf32 share = v_loadf(mirrors->share + i);
        vmask shows = v_gt(share, v_setf(0.0f));
        for (int k = 0; k < 3; k++) {
            vf32 color = v_loadf(batch->color[k] + i), light = v_loadf(mirrors->light[k] + i), added;
            if (is_physical)
                added = v_mul(v_loadf(mirrors->reflected[k] + i), v_sub(light, v_loadf(mirrors->haze[k] + i)));
            else
                added = v_mul(v_sub(light, color), share);
            v_storef(batch->color[k] + i, v_self(shows, v_add(color, added), color));
        }
    }
}
