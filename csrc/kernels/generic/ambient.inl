/* ambient: light from all around, which may differ by direction (R130) and from pixel to pixel (R129). */
#ifndef E3D_KERNELS_AMBIENT_INL
#define E3D_KERNELS_AMBIENT_INL

#include "core/always_inline.h"
#include "e3d.h"
#include "kernels/types/shading.h"

/* Whether it does. */
static inline int ambient_varies(const e3d_lighting *lighting) { return lighting->ambient_terms != NULL || lighting->has_visibility; }

/* R130: what white surfaces of these normals show of it. */
static ALWAYS_INLINE void ambient_light(const e3d_lighting *lighting, const vf32 n[3], vf32 out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = v_setf(lighting->ambient[k]);
    if (!lighting->ambient_terms)
        return;
    vf32 square = v_mul(n[2], n[2]);
    const vf32 factors[E3D_AMBIENT_TERMS - 1] = {n[0], n[1], n[2], v_sub(v_mul(n[0], n[0]), square), v_sub(v_mul(n[1], n[1]), square),
                                                 v_mul(n[0], n[1]), v_mul(n[1], n[2]), v_mul(n[2], n[0])};
    for (int k = 0; k < 3; k++) {
        vf32 sum = v_add(out[k], v_setf(lighting->ambient_terms[0][k]));
        for (int t = 1; t < E3D_AMBIENT_TERMS; t++)
            sum = v_add(sum, v_mul(v_setf(lighting->ambient_terms[t][k]), factors[t - 1]));
        out[k] = v_max(sum, v_setf(0.0f));
    }
}

#endif
