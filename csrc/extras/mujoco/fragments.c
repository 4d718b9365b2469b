/* Fragments: each triangle that shows in a pixel, once (R264).
 * In: what shows at the samples. Out: fragments, row after row. */
#include "base/vectors.h"
#include "extras/mujoco/passes.h"

enum { MIXED = -2 }; /* the samples of a pixel differ */

/* The samples that show the same as number `s`. */
static uint32_t like(const int32_t shown[4], int s)
{
    uint32_t mask = 0;
    for (int k = 0; k < 4; k++)
        mask |= (uint32_t)(shown[k] == shown[s]) << k;
    return mask;
}

/* What all samples of a pixel show, or MIXED. */
static inline int32_t shown_by_all(const int32_t shown[4])
{
    int32_t differs = (shown[0] ^ shown[1]) | (shown[0] ^ shown[2]) | (shown[0] ^ shown[3]);
    return differs ? MIXED : shown[0];
}

static inline int4 like_at(const int32_t *shown, int4 what)
{
    int4 here;
    memcpy(&here, shown, sizeof here);
    return here == what;
}

/* Where the samples that show the same as number `from` end; there is room for three vectors more. */
static int32_t end_of_same(const int32_t *shown, int32_t from, int32_t end)
{
    int4 what = {shown[from], shown[from], shown[from], shown[from]};
    while (from + 4 <= end && lanes_of((like_at(shown + from, what) & like_at(shown + from + 4, what)) &
                                       (like_at(shown + from + 8, what) & like_at(shown + from + 12, what))) == 15)
        from += 16;
    while (from < end && shown[from] == what[0])
        from++;
    return from < end ? from : end;
}

/* Adds the fragments of a pixel, of those samples that count. */
static int add_mixed(muj_shader *shader, const muj_layer *layer, const int32_t shown[4], uint32_t samples, int32_t x, int32_t y, muj_fragments *out)
{
    for (int s = 0; s < 4; s++) {
        if (shown[s] < 0 || !(samples >> s & 1))
            continue;
        uint32_t mask = like(shown, s) & samples;
        samples &= ~mask;
        if (!muj_add_run(shader, muj_record_of(layer, shown[s]), x, x + 1, y, mask, out))
            return 0;
    }
    return 1;
}

/* Adds the fragments of a row: runs of pixels that show one thing, and pixels that show several. */
static int add_row(const muj_picture *picture, muj_shader *shader, const muj_layer *layer, const int32_t *shown, const uint8_t *stencil,
                   int32_t y, muj_fragments *out)
{
    int32_t width = picture->frame->width, samples = picture->samples, end;
    uint32_t all = (1u << samples) - 1;
    for (int32_t x = 0; x < width; x = end) {
        int32_t what = samples == 1 ? shown[x] : shown_by_all(shown + 4 * x);
        uint32_t counts = stencil ? stencil[x] : all;
        end = x + 1;
        if (what == MIXED || counts != all) {
            if (counts && !(samples == 1 ? 1 : add_mixed(shader, layer, shown + 4 * x, counts, x, y, out)))
                return 0;
            continue;
        }
        end = end_of_same(shown, x * samples, width * samples) / samples;
        for (int32_t k = x + 1; stencil && k < end; k++)
            end = stencil[k] == all ? end : k;
        if (what >= 0 && !muj_add_run(shader, muj_record_of(layer, what), x, end, y, all, out))
            return 0;
    }
    return 1;
}

int muj_gather(const muj_target *target, const muj_layer *layer, muj_shader *shader, const uint8_t *stencil, muj_fragments *fragments)
{
    const muj_picture *picture = target->picture;
    if (!muj_begin_band(shader, target->top, fragments))
        return 0;
    for (int32_t y = target->top; y < target->end; y++) {
        size_t row = (size_t)(y - target->top);
        if (!add_row(picture, shader, layer, target->shown + row * picture->stride,
                     stencil ? stencil + row * (size_t)picture->frame->width : NULL, y, fragments))
            return 0;
    }
    return muj_shade_all(shader, fragments);
}
