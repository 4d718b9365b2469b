/* Records in blocks of 64 x 64 pixels, in which edges that cross it fit 32 bits, as R20 has it (R258). */
#pragma once

#include "extras/mujoco/kernels/kernels.h"

enum { MUJ_BLOCK = 64 };

/* A record in a block: edges and depths at the samples of its first group of four. */
typedef struct muj_block {
    int32_t edge[3][4];             /* floors of 1/256 */
    int32_t across[3], down[3];     /* for a group, for a row */
    int32_t is_inside;              /* all of the block is */
    float z[4], z_across, z_down;
} muj_block;

/* 0 if the record covers nothing of the block. x0: the first pixel of a group. */
static inline int muj_begin_block(const muj_raster *raster, const muj_record *record, int32_t x0, int32_t y0, int32_t x1, int32_t y1, muj_block *out)
{
    int64_t dx = x0 - record->x0, dy = y0 - record->y0, wide = x1 - x0 + 1, high = y1 - y0 + 1;
    out->is_inside = 1;
    for (int k = 0; k < 3; k++) {
        int64_t a = record->a[k], b = record->b[k], e = record->e[k] + MUJ_SUB * (a * dx + b * dy);
        int64_t least = e + MUJ_SUB * ((a < 0 ? a * wide : 0) + (b < 0 ? b * high : 0));
        int64_t most = e + MUJ_SUB * ((a > 0 ? a * wide : 0) + (b > 0 ? b * high : 0));
        if (most < 0)
            return 0;
        if (least >= 0)
            a = b = e = 0; /* inside for the whole block */
        else
            out->is_inside = 0;
        for (int l = 0; l < 4; l++)
            out->edge[k][l] = (int32_t)((e + a * raster->lane_x[l] + b * raster->lane_y[l]) >> 8);
        out->across[k] = (int32_t)a * raster->group_pixels;
        out->down[k] = (int32_t)b;
    }
    double z = record->z + (record->zx * (double)dx + record->zy * (double)dy);
    for (int l = 0; l < 4; l++)
        out->z[l] = (float)(z + (record->zx * (raster->lane_x[l] * (1.0 / MUJ_SUB)) + record->zy * (raster->lane_y[l] * (1.0 / MUJ_SUB))));
    out->z_across = (float)(record->zx * raster->group_pixels);
    out->z_down = (float)record->zy;
    return 1;
}

/* Whether a record is so small that its edges fit 32 bits without blocks: triangles that are cut off reach farther than pixels. */
static inline int muj_is_narrow(const muj_record *record)
{
    for (int k = 0; k < 3; k++)
        if (record->e[k] > 1 << 28 || record->e[k] < -(1 << 28) || record->a[k] > 1 << 13 || record->a[k] < -(1 << 13) ||
            record->b[k] > 1 << 13 || record->b[k] < -(1 << 13))
            return 0;
    return 1;
}
