/* The passes that write codes, in MuJoCo's order: what is mirrored, fragments, what is blended (R262, R264, R267).
 * In: fragments, layers. Out: the codes of a band's samples.
 * Always: each pass is rounded to 8 bits, and ends at 255. */
#include "extras/mujoco/passes.h"

/* Sums of two colours' channels, each at most 255. */
static inline uint32_t sum_of(uint32_t a, uint32_t b)
{
    uint32_t even = (a & 0x00FF00FF) + (b & 0x00FF00FF), odd = (a >> 8 & 0x00FF00FF) + (b >> 8 & 0x00FF00FF);
    uint32_t even_over = even >> 8 & 0x00010001, odd_over = odd >> 8 & 0x00010001;
    even |= (even_over << 8) - even_over, odd |= (odd_over << 8) - odd_over;
    return (even & 0x00FF00FF) | (odd & 0x00FF00FF) << 8;
}

/* a * b / 255, rounded */
static uint32_t product(uint32_t a, uint32_t b)
{
    uint32_t t = a * b + 128;
    return (t + (t >> 8)) >> 8;
}

/* ---- fragments ---- */

/* The code of fragment number i above one that is there. */
static inline uint32_t code_above(const muj_fragments *fragments, size_t i, uint32_t before)
{
    uint32_t code = muj_codes_of(fragments, 0)[i];
    code = before ? sum_of(before, code) : code;
    for (int p = 1; p < fragments->passes; p++)
        if (!(((const uint8_t *)fragments->shadowed.data)[i] >> (p - 1) & 1))
            code = sum_of(code, muj_codes_of(fragments, p)[i]);
    return code;
}

/* Writes a code to some samples of a pixel. */
static inline void put(const muj_picture *picture, uint32_t mask, uint32_t code, uint32_t *to)
{
    if (mask == 15) {
        to[0] = to[1] = to[2] = to[3] = code;
        return;
    }
    for (int s = 0; s < picture->samples; s++)
        if (mask >> s & 1)
            to[s] = code;
}

static void write_run(const muj_picture *picture, const muj_fragments *fragments, const muj_run *run, uint32_t *to)
{
    for (int32_t i = 0; i < run->count; i++, to += picture->samples) {
        size_t number = (size_t)(run->first + i);
        if (!run->adds) {
            put(picture, run->mask, code_above(fragments, number, 0), to);
            continue;
        }
        for (int s = 0; s < picture->samples; s++)
            if (run->mask >> s & 1)
                to[s] = code_above(fragments, number, to[s]);
    }
}

/* Where the samples of a run's first pixel are. */
static uint32_t *samples_of(const muj_target *target, const muj_codes *codes, const muj_run *run)
{
    int32_t first = target->top * target->picture->frame->width;
    return codes->of + (size_t)(run->pixel - first) * (size_t)target->picture->samples;
}

void muj_write_fragments(const muj_target *target, const muj_fragments *fragments, const muj_codes *codes)
{
    const muj_run *runs = fragments->runs.data;
    for (size_t i = 0; i < fragments->runs.count; i++)
        write_run(target->picture, fragments, &runs[i], samples_of(target, codes, &runs[i]));
}

/* ---- the picture ---- */

/* The sums of colours' channels: red and blue, green. */
typedef struct sums {
    uint32_t even, odd;
} sums;

static inline void add_to(sums *out, uint32_t code, uint32_t times)
{
    out->even += (code & 0x00FF00FF) * times;
    out->odd += (code >> 8 & 0xFF) * times;
}

static inline uint32_t mean_of_four(const sums *in)
{
    return ((in->even + 0x00020002) >> 2 & 0x00FF00FF) | (in->odd + 2) >> 2 << 8;
}

static void write_pixel(const muj_picture *picture, size_t pixel, uint32_t code)
{
    memcpy(picture->frame->color + 3 * pixel, &code, 3);
}

void muj_resolve(const muj_target *target, const uint32_t *codes)
{
    const muj_picture *picture = target->picture;
    size_t width = (size_t)picture->frame->width, first = (size_t)target->top * width, count = (size_t)(target->end - target->top) * width;
    for (size_t i = 0; i < count; i++) {
        sums sum = {0};
        if (picture->samples == 1) {
            write_pixel(picture, first + i, codes[i]);
            continue;
        }
        for (int s = 0; s < 4; s++)
            add_to(&sum, codes[4 * i + (size_t)s], 1);
        write_pixel(picture, first + i, mean_of_four(&sum));
    }
}

/* Adds what a fragment gives a pixel: of each of its samples, above what is mirrored there, or alike. */
static inline void add_fragment(const muj_fragments *fragments, size_t number, uint32_t mask, const uint32_t *mirrored, sums *out)
{
    static const uint8_t COUNT[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    if (!mirrored || !(mirrored[0] | mirrored[1] | mirrored[2] | mirrored[3])) {
        add_to(out, code_above(fragments, number, 0), COUNT[mask]);
        return;
    }
    for (int s = 0; s < 4; s++)
        if (mask >> s & 1)
            add_to(out, code_above(fragments, number, mirrored[s]), 1);
}

/* Writes pixels that follow each other, four at once: their colours are 12 bytes. */
static void write_pixels(const muj_picture *picture, size_t pixel, const uint32_t *codes, int32_t count)
{
    int32_t k = 0;
    for (; k + 4 <= count; k += 4) {
        const uint32_t *c = codes + k;
        uint32_t bytes[3] = {c[0] | c[1] << 24, c[1] >> 8 | c[2] << 16, c[2] >> 16 | c[3] << 8};
        memcpy(picture->frame->color + 3 * (pixel + (size_t)k), bytes, sizeof bytes);
    }
    for (; k < count; k++)
        write_pixel(picture, pixel + (size_t)k, codes[k]);
}

/* Writes a run of which all samples are alike. */
static void resolve_alike(const muj_picture *picture, const muj_fragments *fragments, const muj_run *run)
{
    uint32_t codes[MUJ_COLUMN];
    const uint32_t *first = muj_codes_of(fragments, 0) + run->first;
    if (fragments->passes == 1) {
        write_pixels(picture, (size_t)run->pixel, first, run->count);
        return;
    }
    memcpy(codes, first, (size_t)run->count * sizeof *codes);
    for (int p = 1; p < fragments->passes; p++) {
        const uint32_t *more = muj_codes_of(fragments, p) + run->first;
        const uint8_t *shadowed = (const uint8_t *)fragments->shadowed.data + run->first;
        for (int32_t k = 0; k < run->count; k++)
            codes[k] = sum_of(codes[k], more[k] & ((uint32_t)(shadowed[k] >> (p - 1) & 1) - 1));
    }
    write_pixels(picture, (size_t)run->pixel, codes, run->count);
}

static int is_black(const uint32_t *codes, int32_t count)
{
    uint32_t any = 0;
    for (int32_t i = 0; i < count; i++)
        any |= codes[i];
    return !any;
}

static void resolve_run(const muj_picture *picture, const muj_fragments *fragments, const muj_run *run, const uint32_t *mirrored)
{
    if (!mirrored || is_black(mirrored, run->count * picture->samples)) {
        resolve_alike(picture, fragments, run);
        return;
    }
    for (int32_t k = 0; k < run->count; k++) {
        size_t number = (size_t)(run->first + k), pixel = (size_t)(run->pixel + k);
        if (picture->samples == 1) {
            write_pixel(picture, pixel, code_above(fragments, number, mirrored[k]));
            continue;
        }
        sums sum = {0};
        add_fragment(fragments, number, 15, mirrored + 4 * k, &sum);
        write_pixel(picture, pixel, mean_of_four(&sum));
    }
}

static void clear_pixels(const muj_picture *picture, int32_t first, int32_t end)
{
    memset(picture->frame->color + 3 * (size_t)first, 0, 3 * (size_t)(end - first));
}

/* The fragments of a pixel follow each other. Samples without one are black. */
void muj_resolve_fragments(const muj_target *target, const muj_fragments *fragments, const muj_codes *mirrored)
{
    const muj_picture *picture = target->picture;
    const muj_run *runs = fragments->runs.data;
    size_t i = 0;
    int32_t width = picture->frame->width, next = target->top * width;
    uint32_t all = (1u << picture->samples) - 1;
    while (i < fragments->runs.count) {
        int32_t pixel = runs[i].pixel;
        sums sum = {0};
        clear_pixels(picture, next, pixel);
        next = pixel + runs[i].count;
        if (runs[i].mask == all) {
            resolve_run(picture, fragments, &runs[i], mirrored && runs[i].adds ? samples_of(target, mirrored, &runs[i]) : NULL);
            i++;
            continue;
        }
        for (; i < fragments->runs.count && runs[i].pixel == pixel; i++)
            add_fragment(fragments, (size_t)runs[i].first, runs[i].mask,
                         mirrored && runs[i].adds ? samples_of(target, mirrored, &runs[i]) : NULL, &sum);
        write_pixel(picture, (size_t)pixel, mean_of_four(&sum));
    }
    clear_pixels(picture, next, target->end * width);
}

/* ---- blending ---- */

static uint32_t blended(uint32_t code, uint32_t before, int is_additive)
{
    uint32_t alpha = code >> 24, out = 0;
    for (int c = 0; c < 3; c++) {
        uint32_t there = before >> 8 * c & 255;
        uint32_t v = product(code >> 8 * c & 255, alpha) + (is_additive ? there : product(there, 255 - alpha));
        out |= (v < 255 ? v : 255) << 8 * c;
    }
    return out;
}

static int32_t geom_of(const muj_picture *picture, const muj_layer *layer, int32_t item)
{
    return muj_draw_of(picture, muj_record_of(layer, item)->draw)->number;
}

/* Adds the fragments of a record that nothing hides. */
static int add_record(const muj_target *target, muj_shader *shader, const muj_record *record, const uint8_t *stencil, const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    int32_t width = picture->frame->width, end = record->y1 < target->end ? record->y1 + 1 : target->end;
    for (int32_t y = record->y0 > target->top ? record->y0 : target->top; y < end; y++) {
        int count = muj_cover_row(target, record, y, codes->covers);
        size_t row = (size_t)(y - target->top) * (size_t)width;
        for (int i = 0; i < count; i++)
            for (int l = 0; l < picture->group_pixels; l++) {
                int32_t x = codes->covers[i].x + l;
                uint32_t mask = picture->samples == 1 ? codes->covers[i].mask >> l & 1 : codes->covers[i].mask;
                if (x < width && stencil)
                    mask &= stencil[row + (size_t)x];
                if (x < width && mask && !muj_add_run(shader, record, x, x + 1, y, mask, codes->fragments))
                    return 0;
            }
    }
    return 1;
}

/* Blends runs over the samples, from number `from` to `end`. */
static void blend_some(const muj_target *target, const muj_codes *codes, size_t from, size_t end, int is_additive)
{
    const muj_run *runs = codes->fragments->runs.data;
    const uint32_t *code = muj_codes_of(codes->fragments, 0);
    for (; from < end; from++) {
        uint32_t *to = samples_of(target, codes, &runs[from]);
        for (int s = 0; s < target->picture->samples; s++)
            if (runs[from].mask >> s & 1)
                to[s] = blended(code[runs[from].first], to[s], is_additive);
    }
}

int muj_blend_all(const muj_target *target, const muj_layer *layer, int32_t band, muj_shader *shader, const uint8_t *stencil,
                  const muj_codes *codes)
{
    const muj_picture *picture = target->picture;
    int is_additive = picture->frame->is_additive;
    int32_t count, first = 0;
    const int32_t *items = muj_band_items(layer, band, &count);
    if (!count)
        return 1;
    if (!muj_begin_band(shader, target->top, codes->fragments) || !e3d_array_reserve(codes->ranges, (size_t)count + 1, sizeof(size_t)))
        return 0;
    size_t *ranges = codes->ranges->data;
    for (int32_t i = 0; i < count; i++) {
        ranges[i] = codes->fragments->runs.count;
        if (!add_record(target, shader, muj_record_of(layer, items[i]), stencil, codes))
            return 0;
        first += geom_of(picture, layer, items[i]) == MUJ_NONE;
    }
    ranges[count] = codes->fragments->runs.count;
    if (!muj_shade_all(shader, codes->fragments))
        return 0;
    blend_some(target, codes, 0, ranges[first], 0); /* the haze */
    blend_some(target, codes, ranges[first], ranges[count], is_additive);
    for (int32_t end = count; end > first && !is_additive;) {
        int32_t start = end - 1;
        while (start > first && geom_of(picture, layer, items[start - 1]) == geom_of(picture, layer, items[end - 1]))
            start--;
        blend_some(target, codes, ranges[start], ranges[end], 0);
        end = start;
    }
    return 1;
}

/* ---- mirrors ---- */

int muj_draw_mirrored(const muj_target *target, const muj_layer *opaque, const muj_layer *blended, int32_t band, muj_shader *shader,
                      muj_shader *blend_shader, const muj_codes *codes)
{
    int32_t count;
    muj_band_items(opaque, band, &count);
    muj_draw_records(target, opaque, band);
    if (count) {
        if (!muj_gather(target, opaque, shader, codes->stencil, codes->fragments))
            return 0;
        muj_write_fragments(target, codes->fragments, codes);
    }
    return muj_blend_all(target, blended, band, blend_shader, codes->stencil, codes);
}
