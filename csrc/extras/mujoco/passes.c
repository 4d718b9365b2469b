/* The passes that write codes, in MuJoCo's order: what is mirrored, fragments, what is blended (R262, R264, R267).
 * In: fragments, layers. Out: the codes of a band's samples.
 * Always: each pass is rounded to 8 bits, and ends at 255. */
#include "extras/mujoco/passes.h"

static uint8_t sum_of(int a, int b) { return (uint8_t)(a + b < 255 ? a + b : 255); }

/* a * b / 255, rounded */
static int product(int a, int b)
{
    int t = a * b + 128;
    return (t + (t >> 8)) >> 8;
}

/* ---- fragments ---- */

/* The code of a fragment above one that is there. */
static int code_of(const muj_picture *picture, const muj_fragment *f, int before, int c)
{
    int code = sum_of(before, f->code[c]);
    for (int k = 0; k < picture->shadow_count; k++)
        if (!(f->shadowed >> k & 1))
            code = sum_of(code, f->extra[k][c]);
    return code;
}

/* Writes a fragment that is alike at all its samples. */
static void write_alike(const muj_picture *picture, const muj_fragment *f, uint8_t *to)
{
    uint8_t code[16] = {0};
    for (int c = 0; c < 3; c++)
        code[c] = (uint8_t)code_of(picture, f, 0, c);
    if (f->mask == 15) {
        for (int s = 1; s < 4; s++)
            memcpy(code + 4 * s, code, 4);
        memcpy(to, code, sizeof code);
        return;
    }
    for (int s = 0; s < picture->samples; s++)
        if (f->mask >> s & 1)
            memcpy(to + 4 * s, code, 4);
}

void muj_write_fragments(const muj_target *target, const e3d_array *fragments, const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    const uint8_t *all = fragments->data;
    size_t size = muj_fragment_size(picture);
    int32_t first = target->top * picture->frame->width;
    for (size_t i = 0; i < fragments->count; i += size) {
        const muj_fragment *f = (const muj_fragment *)(all + i);
        uint8_t *to = codes->of + (size_t)(f->pixel - first) * (size_t)picture->samples * 4;
        if (!f->adds) {
            write_alike(picture, f, to);
            continue;
        }
        for (int s = 0; s < picture->samples; s++)
            for (int c = 0; c < 3 && f->mask >> s & 1; c++)
                to[4 * s + c] = (uint8_t)code_of(picture, f, to[4 * s + c], c);
    }
}

/* ---- blending ---- */

static void blend_sample(const uint8_t code[3], int alpha, int is_additive, uint8_t *to)
{
    for (int c = 0; c < 3; c++)
        to[c] = sum_of(product(code[c], alpha), is_additive ? to[c] : product(to[c], 255 - alpha));
}

static void blend_pixel(const muj_picture *picture, muj_shader *shader, const muj_record *record, int32_t x, int32_t y, uint32_t mask,
                        int is_additive, uint8_t *to)
{
    muj_colors colors;
    uint8_t code[3];
    int l = x & 3;
    muj_shade(shader, record, x & ~3, y, 1u << l, &colors);
    for (int c = 0; c < 3; c++)
        code[c] = muj_code(colors.rgb[0][c][l]);
    for (int s = 0; s < picture->samples; s++)
        if (mask >> s & 1)
            blend_sample(code, muj_code(colors.alpha[l]), is_additive, to + 4 * s);
}

static void blend_record(const muj_target *target, muj_shader *shader, const muj_record *record, const uint8_t *stencil, int is_additive,
                         const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    int32_t width = picture->frame->width, end = record->y1 < target->end ? record->y1 + 1 : target->end;
    for (int32_t y = record->y0 > target->top ? record->y0 : target->top; y < end; y++) {
        int count = muj_cover_row(target, record, y, codes->covers);
        for (int i = 0; i < count; i++)
            for (int l = 0; l < picture->group_pixels; l++) {
                int32_t x = codes->covers[i].x + l;
                uint32_t mask = picture->samples == 1 ? codes->covers[i].mask >> l & 1 : codes->covers[i].mask;
                size_t pixel = (size_t)(y - target->top) * (size_t)width + (size_t)x;
                if (x < width && stencil)
                    mask &= stencil[pixel];
                if (x < width && mask)
                    blend_pixel(picture, shader, record, x, y, mask, is_additive, codes->of + pixel * (size_t)picture->samples * 4);
            }
    }
}

static int32_t geom_of(const muj_picture *picture, const muj_layer *layer, int32_t item)
{
    return muj_draw_of(picture, muj_record_of(layer, item)->draw)->number;
}

void muj_blend_all(const muj_target *target, const muj_layer *layer, int32_t band, muj_shader *shader, const uint8_t *stencil,
                   const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    int is_additive = picture->frame->is_additive;
    int32_t count, first = 0;
    const int32_t *items = muj_band_items(layer, band, &count);
    for (int32_t i = 0; i < count; i++) {
        int is_haze = geom_of(picture, layer, items[i]) == MUJ_NONE;
        first += is_haze;
        blend_record(target, shader, muj_record_of(layer, items[i]), stencil, is_additive && !is_haze, codes);
    }
    for (int32_t end = count; end > first && !is_additive;) {
        int32_t start = end - 1;
        while (start > first && geom_of(picture, layer, items[start - 1]) == geom_of(picture, layer, items[end - 1]))
            start--;
        for (int32_t i = start; i < end; i++)
            blend_record(target, shader, muj_record_of(layer, items[i]), stencil, 0, codes);
        end = start;
    }
}

/* ---- mirrors ---- */

/* Writes the colours of what shows in the mirror, where the stencil is set. */
static void write_mirrored(const muj_target *target, const muj_layer *layer, muj_shader *shader, const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    int32_t width = picture->frame->width;
    for (int32_t y = target->top; y < target->end; y++)
        for (int32_t x = 0; x < width; x++) {
            size_t pixel = (size_t)(y - target->top) * (size_t)width + (size_t)x;
            const int32_t *shown = target->shown + (size_t)(y - target->top) * (size_t)picture->groups * 4 +
                                   (picture->samples == 1 ? (size_t)x : 4 * (size_t)x);
            int32_t last = MUJ_NONE;
            muj_colors colors;
            for (int s = 0; s < picture->samples; s++) {
                if (!(codes->stencil[pixel] >> s & 1) || shown[s] < 0)
                    continue;
                if (shown[s] != last)
                    muj_shade(shader, muj_record_of(layer, shown[s]), x & ~3, y, 1u << (x & 3), &colors);
                last = shown[s];
                for (int c = 0; c < 3; c++)
                    codes->of[(pixel * (size_t)picture->samples + (size_t)s) * 4 + (size_t)c] = muj_code(colors.rgb[0][c][x & 3]);
            }
        }
}

void muj_draw_mirrored(const muj_target *target, const muj_layer *opaque, const muj_layer *blended, int32_t band, muj_shader *shader,
                       const muj_codes *codes)
{
    int32_t count;
    const int32_t *items = muj_band_items(opaque, band, &count);
    muj_clear(target);
    for (int32_t i = 0; i < count; i++)
        muj_draw_record(target, muj_record_of(opaque, items[i]), items[i]);
    write_mirrored(target, opaque, shader, codes);
    muj_blend_all(target, blended, band, shader, codes->stencil, codes);
}
