/* Raster: which record shows at each sample (R258).
 * In: records in their order. Out: depths and numbers of records; or what a record covers.
 * Always: edges are whole numbers. In a block of 64 x 64 pixels those that cross it fit 32 bits, as R20 has it. */
#include "base/vectors.h"
#include "extras/mujoco/geometry.h"

enum { BLOCK = 64 };

void muj_clear(const muj_target *target)
{
    const muj_picture *picture = target->picture;
    size_t count = (size_t)(target->end - target->top) * (size_t)picture->groups * 4;
    memset(target->depth, 0, count * sizeof *target->depth);
    memset(target->shown, 0xFF, count * sizeof *target->shown);
}

/* A record in a block: edges and depths at the lanes of its first group. */
typedef struct block {
    int4 edge[3];                   /* floors of 1/256 */
    int32_t across[3], down[3];     /* for a group, for a row */
    float4 z;
    float z_across, z_down;
} block;

/* 0 if the record covers nothing of the block. x0: the first pixel of a group. */
static int begin_block(const muj_picture *picture, const muj_record *record, int32_t x0, int32_t y0, int32_t x1, int32_t y1, block *out)
{
    int64_t dx = x0 - record->x0, dy = y0 - record->y0, wide = x1 - x0 + 1, high = y1 - y0 + 1;
    for (int k = 0; k < 3; k++) {
        int64_t a = record->a[k], b = record->b[k], e = record->e[k] + MUJ_SUB * (a * dx + b * dy);
        int64_t least = e + MUJ_SUB * ((a < 0 ? a * wide : 0) + (b < 0 ? b * high : 0));
        int64_t most = e + MUJ_SUB * ((a > 0 ? a * wide : 0) + (b > 0 ? b * high : 0));
        if (most < 0)
            return 0;
        if (least >= 0)
            a = b = e = 0; /* inside for the whole block */
        for (int l = 0; l < 4; l++)
            out->edge[k][l] = (int32_t)((e + a * picture->lane_x[l] + b * picture->lane_y[l]) >> 8);
        out->across[k] = (int32_t)a * picture->group_pixels;
        out->down[k] = (int32_t)b;
    }
    double z = record->z + (record->zx * (double)dx + record->zy * (double)dy);
    for (int l = 0; l < 4; l++)
        out->z[l] = (float)(z + (record->zx * (picture->lane_x[l] * (1.0 / MUJ_SUB)) + record->zy * (picture->lane_y[l] * (1.0 / MUJ_SUB))));
    out->z_across = (float)(record->zx * picture->group_pixels);
    out->z_down = (float)record->zy;
    return 1;
}

static inline int4 splat_int(int32_t v) { return (int4){v, v, v, v}; }

/* Draws a row of groups of a block. */
static inline void draw_row(const block *in, int32_t row, int32_t count, int32_t number, float *depth, int32_t *shown)
{
    int4 edge[3];
    for (int k = 0; k < 3; k++)
        edge[k] = in->edge[k] + splat_int(in->down[k] * row);
    float4 z_row = in->z + splat(in->z_down * (float)row);
    for (int32_t i = 0; i < count; i++) {
        int4 outside = (edge[0] | edge[1]) | edge[2];
        for (int k = 0; k < 3; k++)
            edge[k] += splat_int(in->across[k]);
        if (lanes_of(outside) == 15)
            continue;
        float4 z = z_row + splat(in->z_across * (float)i), before = load4(depth + 4 * i);
        int4 seen = (outside >= 0) & (z >= before) & (z <= 1);
        if (!lanes_of(seen))
            continue;
        int4 last;
        memcpy(&last, shown + 4 * i, sizeof last);
        store4(depth + 4 * i, choose(seen, z, before));
        last = choose_bits(seen, splat_int(number), last);
        memcpy(shown + 4 * i, &last, sizeof last);
    }
}

void muj_draw_record(const muj_target *target, const muj_record *record, int32_t number)
{
    const muj_picture *picture = target->picture;
    int32_t pixels = picture->group_pixels, first = record->x0 / pixels * pixels;
    int32_t top = record->y0 > target->top ? record->y0 : target->top, bottom = record->y1 < target->end ? record->y1 : target->end - 1;
    block in;
    for (int32_t x = first; x <= record->x1 && top <= bottom; x += BLOCK) {
        int32_t last = x + BLOCK - 1 < record->x1 ? x + BLOCK - 1 : record->x1;
        last = last / pixels * pixels + pixels - 1; /* whole groups */
        if (!begin_block(picture, record, x, top, last, bottom, &in))
            continue;
        for (int32_t y = top; y <= bottom; y++) {
            size_t at = ((size_t)(y - target->top) * (size_t)picture->groups + (size_t)(x / pixels)) * 4;
            draw_row(&in, y - top, (last - x + 1) / pixels, number, target->depth + at, target->shown + at);
        }
    }
}

int muj_cover_row(const muj_target *target, const muj_record *record, int32_t y, muj_cover *out)
{
    const muj_picture *picture = target->picture;
    int32_t pixels = picture->group_pixels, first = record->x0 / pixels * pixels;
    int count = 0;
    block in;
    for (int32_t x = first; x <= record->x1; x += BLOCK) {
        int32_t last = x + BLOCK - 1 < record->x1 ? x + BLOCK - 1 : record->x1;
        last = last / pixels * pixels + pixels - 1;
        if (!begin_block(picture, record, x, y, last, y, &in))
            continue;
        const float *depth = target->depth + ((size_t)(y - target->top) * (size_t)picture->groups + (size_t)(x / pixels)) * 4;
        for (int32_t i = 0; i < (last - x + 1) / pixels; i++) {
            int4 outside = (in.edge[0] | in.edge[1]) | in.edge[2];
            float4 z = in.z + splat(in.z_across * (float)i);
            int mask = lanes_of((outside >= 0) & (z >= load4(depth + 4 * i)) & (z <= 1));
            for (int k = 0; k < 3; k++)
                in.edge[k] += splat_int(in.across[k]);
            if (mask)
                out[count++] = (muj_cover){x + i * pixels, y, (uint32_t)mask};
        }
    }
    return count;
}
