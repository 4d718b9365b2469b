/* Raster: which record shows at each sample (R258).
 * In: records in their order. Out: depths and numbers of records; or what a record covers.
 */
#include "base/vectors.h"
#include "extras/mujoco/kernels/block.h"
#include "extras/mujoco/geometry.h"

static muj_raster raster_of(const muj_target *target)
{
    const muj_picture *picture = target->picture;
    muj_raster out = {target->top, target->end, picture->group_pixels, {0}, {0}, picture->stride, target->depth, target->shown};
    memcpy(out.lane_x, picture->lane_x, sizeof out.lane_x);
    memcpy(out.lane_y, picture->lane_y, sizeof out.lane_y);
    return out;
}

void muj_draw_records(const muj_target *target, const muj_layer *layer, int32_t band)
{
    muj_raster raster = raster_of(target);
    size_t size = (size_t)(target->end - target->top) * raster.stride;
    int32_t count;
    const int32_t *items = muj_band_items(layer, band, &count);
    memset(target->depth, 0, size * sizeof *target->depth);
    memset(target->shown, 0xFF, size * sizeof *target->shown);
    target->picture->kernels->draw(&raster, layer->records.data, items, count);
}

static inline int4 splat_int(int32_t v) { return (int4){v, v, v, v}; }
static inline int4 load_int(const int32_t *p) { return (int4){p[0], p[1], p[2], p[3]}; }

int muj_cover_row(const muj_target *target, const muj_record *record, int32_t y, muj_cover *out)
{
    const muj_picture *picture = target->picture;
    int32_t pixels = picture->group_pixels, first = record->x0 / pixels * pixels;
    int count = 0;
    muj_raster raster = raster_of(target);
    muj_block in;
    for (int32_t x = first; x <= record->x1; x += MUJ_BLOCK) {
        int32_t last = x + MUJ_BLOCK - 1 < record->x1 ? x + MUJ_BLOCK - 1 : record->x1;
        last = last / pixels * pixels + pixels - 1;
        if (!muj_begin_block(&raster, record, x, y, last, y, &in))
            continue;
        const float *depth = target->depth + (size_t)(y - target->top) * picture->stride + (size_t)(x / pixels) * 4;
        int4 edge[3];
        for (int k = 0; k < 3; k++)
            edge[k] = load_int(in.edge[k]);
        for (int32_t i = 0; i < (last - x + 1) / pixels; i++) {
            int4 outside = (edge[0] | edge[1]) | edge[2];
            float4 z = load4(in.z) + splat(in.z_across * (float)i);
            int mask = lanes_of((outside >= 0) & (z >= load4(depth + 4 * i)) & (z <= 1));
            for (int k = 0; k < 3; k++)
                edge[k] += splat_int(in.across[k]);
            if (mask)
                out[count++] = (muj_cover){x + i * pixels, y, (uint32_t)mask};
        }
    }
    return count;
}
