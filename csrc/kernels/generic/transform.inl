/* transform: object space to clip space to the snapped screen (R3, R5, R8), a vector of vertices at a time. Coordinates that
 * only a clipped triangle would use may be far outside: they are clamped before the conversion to integers, which changes no
 * coordinate that is used. */
#pragma once

#include "base/limits.h"
#include "kernels/types/vertices.h"

static inline vi32 transform_flag(vmask m, int32_t bit)
{
    return v_seli(m, v_seti(bit), v_seti(0));
}

static inline vi32 transform_code(vf32 x, vf32 y, vf32 z, vf32 w, const e3d_viewport *viewport)
{
    vf32 zero = v_setf(0.0f), negative_w = v_sub(zero, w);
    vf32 gx = v_mul(v_setf(viewport->guard_x), w), gy = v_mul(v_setf(viewport->guard_y), w);
    vmask guard = v_mor(v_mor(v_gt(x, gx), v_lt(x, v_sub(zero, gx))),
                        v_mor(v_gt(y, gy), v_lt(y, v_sub(zero, gy))));
    /* v - v is 0 for finite v, and NaN for others. */
    vf32 none = v_add(v_add(v_sub(x, x), v_sub(y, y)), v_add(v_sub(z, z), v_sub(w, w)));
    vi32 code = transform_flag(v_lt(z, negative_w), E3D_NEAR);
    code = v_ori(code, transform_flag(v_gt(z, w), E3D_FAR));
    code = v_ori(code, transform_flag(v_lt(x, negative_w), E3D_LEFT));
    code = v_ori(code, transform_flag(v_gt(x, w), E3D_RIGHT));
    code = v_ori(code, transform_flag(v_lt(y, negative_w), E3D_BOTTOM));
    code = v_ori(code, transform_flag(v_gt(y, w), E3D_TOP));
    code = v_ori(code, transform_flag(v_lt(w, v_setf(E3D_W_MIN)), E3D_BEHIND));
    code = v_ori(code, transform_flag(guard, E3D_BEYOND_GUARD));
    return v_ori(code, transform_flag(v_mnot(v_eq(none, zero)), E3D_NONFINITE));
}

static inline vi32 transform_snap(vf32 v)
{
    const float most = 0x1p26f; /* beyond every snapped coordinate */
    vf32 low = v_max(v, v_setf(-most));
    return v_rint(v_min(low, v_setf(most)));
}

/* Finds screen coordinates and outcodes from the clip coordinates of one vector; returns the outcodes. */
static inline vi32 transform_finish(vf32 x, vf32 y, vf32 z, vf32 w, const e3d_viewport *viewport,
                                    e3d_vertices *out, int i)
{
    vf32 scale_x = v_setf(viewport->scale_x), scale_y = v_setf(viewport->scale_y);
    vf32 iw = v_div(v_setf(1.0f), w), zn = v_mul(z, iw);
    vi32 code = transform_code(x, y, z, w, viewport);
    vmask finite = v_eq(v_sub(zn, zn), v_setf(0.0f));
    v_storef(out->x + i, x);
    v_storef(out->y + i, y);
    v_storef(out->z + i, z);
    v_storef(out->w + i, w);
    v_storef(out->iw + i, iw);
    v_storef(out->zn + i, zn);
    v_storei(out->sx + i, transform_snap(v_add(v_mul(v_mul(x, iw), scale_x), scale_x)));
    v_storei(out->sy + i, transform_snap(v_sub(scale_y, v_mul(v_mul(y, iw), scale_y))));
    code = v_ori(code, transform_flag(v_mnot(finite), E3D_BAD_SCREEN));
    v_storei(out->code + i, code);
    return code;
}

static inline vf32 transform_row(const float *m, vf32 x, vf32 y, vf32 z)
{
    vf32 sum = v_add(v_mul(v_setf(m[0]), x), v_mul(v_setf(m[1]), y));
    return v_add(v_add(sum, v_mul(v_setf(m[2]), z)), v_setf(m[3]));
}

/* Pads with a copy of a vertex, so that the padding adds no outcode bits. */
static inline void transform_end(vi32 codes, int count, e3d_vertices *out)
{
    out->count = count;
    out->special = v_any(v_mnot(v_eqi(codes, v_seti(0))));
}

/* Transforms vertices in the frustum, which need neither outcodes nor coordinates for clipping. Returns 0 if one isn't
 * finite, or is too near. */
static inline int transform_inside(const float *positions, int stride, int count, const float matrix[16],
                                   const e3d_viewport *viewport, e3d_vertices *restrict out)
{
    vf32 scale_x = v_setf(viewport->scale_x), scale_y = v_setf(viewport->scale_y), none = v_setf(0.0f);
    vmask good = v_eq(none, none);
    for (int i = 0; i < count; i += V_LANES) {
        vf32 x = v_loadf(positions + i), y = v_loadf(positions + stride + i),
             z = v_loadf(positions + 2 * stride + i);
        vf32 w = transform_row(matrix + 12, x, y, z), iw = v_div(v_setf(1.0f), w);
        vf32 zn = v_mul(transform_row(matrix + 8, x, y, z), iw);
        vf32 xn = v_mul(transform_row(matrix, x, y, z), iw), yn = v_mul(transform_row(matrix + 4, x, y, z), iw);
        v_storef(out->iw + i, iw);
        v_storef(out->zn + i, zn);
        v_storei(out->sx + i, v_rint(v_add(v_mul(xn, scale_x), scale_x)));
        v_storei(out->sy + i, v_rint(v_sub(scale_y, v_mul(yn, scale_y))));
        good = v_mand(good, v_mand(v_eq(v_sub(zn, zn), none), v_ge(w, v_setf(E3D_W_MIN))));
    }
    return !v_any(v_mnot(good));
}

static void kernel_transform(const float *positions, int stride, int count, const float matrix[16],
                             const e3d_viewport *viewport, int inside, e3d_vertices *out)
{
    vi32 codes = v_seti(0);
    inside = inside && transform_inside(positions, stride, count, matrix, viewport, out);
    for (int i = 0; i < count && !inside; i += V_LANES) {
        vf32 x = v_loadf(positions + i), y = v_loadf(positions + stride + i),
             z = v_loadf(positions + 2 * stride + i);
        vi32 code = transform_finish(transform_row(matrix, x, y, z), transform_row(matrix + 4, x, y, z),
                                     transform_row(matrix + 8, x, y, z), transform_row(matrix + 12, x, y, z),
                                     viewport, out, i);
        codes = v_ori(codes, code);
    }
    transform_end(codes, count, out);
}

static void kernel_take_clip(const float *positions, int stride, int count,
                             const e3d_viewport *viewport, e3d_vertices *out)
{
    vi32 codes = v_seti(0);
    for (int i = 0; i < count; i += V_LANES)
        codes = v_ori(codes, transform_finish(v_loadf(positions + i), v_loadf(positions + stride + i),
                                              v_loadf(positions + 2 * stride + i),
                                              v_loadf(positions + 3 * stride + i), viewport, out, i));
    transform_end(codes, count, out);
}
