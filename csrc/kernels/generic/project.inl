/* project: finds the corners on the screen of visible primitives that have no record (R3, R8, R9), a vector of them at a time. */
#pragma once

#include "kernels/types/shading.h"
#include "kernels/types/vertices.h"
#include "kernels/generic/transform.inl"
#include "kernels/generic/setup.inl"
#include "kernels/generic/surface.inl"

static inline vf32 project_row(const vf32 m[4], const vf32 v[3])
{
    return v_add(dot_three(m, v), m[3]);
}

static inline void project_keep(vmask chosen, int32_t *words, vi32 v)
{
    v_storei(words, v_seli(chosen, v, v_loadi(words)));
}

static void kernel_project(e3d_surfaces *s, const e3d_viewport *viewport)
{
    vf32 scale_x = v_setf(viewport->scale_x), scale_y = v_setf(viewport->scale_y);
    for (int n = 0; n < s->count; n += V_LANES) {
        element_lanes lanes = elements_of(s->matrix + n);
        const e3d_surfaces *matrices = surfaces_from(s, &lanes);
        vi32 x[3], y[3], kind = v_loadi(s->project + n), zero = v_seti(0), one = v_seti(1);
        vf32 iw[3], m[3][4];
        vmask chosen = v_mnot(v_eqi(kind, zero));
        for (int row = 0; row < 3; row++)
            for (int c = 0; c < 4; c++)
                m[row][c] = take(matrices->clip[4 * (row < 2 ? row : 3) + c], &lanes, lanes.same);
        for (int k = 0; k < 3; k++) {
            const vf32 v[3] = {v_loadf(s->position[0][k] + n), v_loadf(s->position[1][k] + n),
                               v_loadf(s->position[2][k] + n)};
            iw[k] = v_div(v_setf(1.0f), project_row(m[2], v));
            x[k] = transform_snap(v_add(v_mul(v_mul(project_row(m[0], v), iw[k]), scale_x), scale_x));
            y[k] = transform_snap(v_sub(scale_y, v_mul(v_mul(project_row(m[1], v), iw[k]), scale_y)));
        }
        vmask swapped = v_negi(setup_area(x, y));
        for (int k = 0; k < 3; k++) {
            int other = k ? 3 - k : 0;
            project_keep(chosen, s->x[k] + n, v_seli(swapped, x[other], x[k]));
            project_keep(chosen, s->y[k] + n, v_seli(swapped, y[other], y[k]));
            v_storef(s->iw[k] + n, v_self(chosen, v_self(swapped, iw[other], iw[k]), v_loadf(s->iw[k] + n)));
        }
        vi32 exchanged = v_seli(swapped, one, zero), mirrored = v_shr(kind, 1);
        project_keep(chosen, s->swapped + n, exchanged);
        project_keep(chosen, s->back + n, v_seli(v_eqi(exchanged, mirrored), one, zero));
    }
}
