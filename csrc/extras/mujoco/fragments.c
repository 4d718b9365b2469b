/* Fragments: each triangle that shows in a pixel, once, with its colours (R264).
 * In: what shows at the samples. Out: fragments, row after row. */
#include "extras/mujoco/passes.h"

#define LEAST_ALPHA 0.99f /* less doesn't receive the light of lights with shadows */

/* Whether a triangle is of the side that reflects: of a plane, or the upper one of a box. */
static int reflects(const muj_draw *draw, int32_t triangle)
{
    return draw->is_reflective && (draw->kind == MUJ_GRID || draw->shape->normals[9 * (size_t)triangle + 2] > 0.5f);
}

typedef uint8_t codes[4][4];

/* The codes of a colour of four pixels. */
static void find_codes(const float4 rgb[3], codes out)
{
    for (int c = 0; c < 3; c++) {
        float4 v = less_of(more_of(rgb[c], splat(0)), splat(1)) * splat(255) + splat(0.5f);
        for (int l = 0; l < 4; l++)
            out[l][c] = (uint8_t)v[l];
    }
}

/* Adds a fragment for each of some pixels of a row, all of one record. */
static muj_fragment *add_fragments(const muj_picture *picture, muj_shader *shader, const muj_record *record, int32_t x, int32_t y,
                                   uint32_t lanes, uint32_t mask, muj_fragment *out)
{
    const muj_draw *draw = muj_draw_of(picture, record->draw);
    int count = picture->shadow_count < E3D_MUJ_LIGHTS ? picture->shadow_count : E3D_MUJ_LIGHTS;
    size_t size = muj_fragment_size(picture);
    muj_colors colors;
    codes code[MUJ_PASSES];
    uint8_t adds = (uint8_t)reflects(draw, record->triangle);
    muj_shade(shader, record, x, y, lanes, &colors);
    for (int p = 0; p <= count; p++)
        find_codes(colors.rgb[p], code[p]);
    for (int l = 0; l < 4; l++) {
        if (!(lanes >> l & 1))
            continue;
        out->pixel = y * picture->frame->width + x + l;
        out->mask = (uint8_t)mask;
        out->adds = adds;
        out->shadowed = draw->geom && colors.alpha[l] >= LEAST_ALPHA ? 0 : 0xFF;
        memcpy(out->code, code[0][l], 3);
        for (int k = 0; k < count; k++) {
            memcpy(out->extra[k], code[1 + k][l], 3);
            if (!(out->extra[k][0] | out->extra[k][1] | out->extra[k][2]))
                out->shadowed |= (uint8_t)(1 << k);
        }
        for (int c = 0; c < 3 && count; c++)
            out->place[c] = colors.place[c][l];
        out = (muj_fragment *)((uint8_t *)out + size);
    }
    return out;
}

/* The lanes, or samples, that show the same as number `l`. */
static uint32_t like(const int32_t shown[4], int l)
{
    uint32_t mask = 0;
    for (int k = 0; k < 4; k++)
        mask |= (uint32_t)(shown[k] == shown[l]) << k;
    return mask;
}

/* Adds the fragments of a pixel's samples. */
static muj_fragment *add_pixel(const muj_picture *picture, const muj_layer *layer, muj_shader *shader, const int32_t shown[4], int32_t x,
                               int32_t y, muj_fragment *out)
{
    uint32_t done = 0;
    for (int s = 0; s < 4; s++) {
        if (shown[s] < 0 || done >> s & 1)
            continue;
        uint32_t mask = like(shown, s);
        done |= mask;
        out = add_fragments(picture, shader, muj_record_of(layer, shown[s]), x & ~3, y, 1u << (x & 3), mask, out);
    }
    return out;
}

/* What all samples of a pixel show, or MUJ_NONE if they differ. */
static int32_t shown_by_all(const int32_t shown[4])
{
    int32_t differs = (shown[0] ^ shown[1]) | (shown[0] ^ shown[2]) | (shown[0] ^ shown[3]);
    return differs ? MUJ_NONE : shown[0];
}

/* Adds the fragments of four pixels: first those that show one thing, with those that show the same. */
static muj_fragment *add_four(const muj_picture *picture, const muj_layer *layer, muj_shader *shader, const int32_t *shown, int32_t x,
                              int32_t y, muj_fragment *out)
{
    int32_t count = picture->frame->width - x < 4 ? picture->frame->width - x : 4, whole[4] = {MUJ_NONE, MUJ_NONE, MUJ_NONE, MUJ_NONE};
    uint32_t samples = (1u << picture->samples) - 1, done = 0;
    for (int32_t l = 0; l < count; l++)
        whole[l] = picture->samples == 1 ? shown[l] : shown_by_all(shown + 4 * l);
    for (int32_t l = 0; l < count; l++) {
        if (whole[l] < 0) {
            if (picture->samples > 1)
                out = add_pixel(picture, layer, shader, shown + 4 * l, x + l, y, out);
        } else if (!(done >> l & 1)) {
            uint32_t lanes = like(whole, l);
            done |= lanes;
            out = add_fragments(picture, shader, muj_record_of(layer, whole[l]), x, y, lanes, samples, out);
        }
    }
    return out;
}

int muj_gather(const muj_target *target, const muj_layer *layer, muj_shader *shader, e3d_array *fragments)
{
    const muj_picture *picture = target->picture;
    size_t most = (size_t)picture->groups * 4 * muj_fragment_size(picture); /* of a row */
    fragments->count = 0;
    for (int32_t y = target->top; y < target->end; y++) {
        if (!e3d_array_reserve(fragments, fragments->count + most, 1))
            return 0;
        muj_fragment *out = (muj_fragment *)((uint8_t *)fragments->data + fragments->count);
        const int32_t *shown = target->shown + (size_t)(y - target->top) * (size_t)picture->groups * 4;
        for (int32_t x = 0; x < picture->frame->width; x += 4, shown += 4 * (size_t)picture->samples)
            out = add_four(picture, layer, shader, shown, x, y, out);
        fragments->count = (size_t)((uint8_t *)out - (uint8_t *)fragments->data);
    }
    return 1;
}
