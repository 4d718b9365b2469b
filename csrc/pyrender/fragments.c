/* Fragments: gathered until they are lit together, then written to the samples that they cover.
 *
 * In: fragments in the order in which they are drawn. Out: codes of 8 bits. Always: depths were tested before.
 */
#include <math.h>

#include "pyrender/picture.h"
#include "pyrender/transfer_tables.h"

void pyr_add_fragment(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_weights *weights,
                      const pyr_plane *plane, int32_t x, int32_t y, uint32_t mask)
{
    pyr_batch *batch = &band->batch;
    if (batch->count == PYR_BATCH || (batch->count && batch->draw != draw))
        pyr_flush(band);
    batch->draw = draw;
    batch->x[batch->count] = x;
    batch->y[batch->count] = y;
    batch->mask[batch->count] = (uint8_t)mask;
    pyr_find_surface(band, vertices, weights, plane);
    batch->count++;
}

/* The code of light to the power of 1/2.2. */
static uint8_t power_code(const pyr_picture *picture, float light)
{
    if (!(light > 0))
        return 0;
    if (light >= 1)
        return 255;
    int code = picture->code_start[(int)(sqrtf(light) * PYR_CODE_STARTS)];
    while (code < 255 && light >= E3D_PYR_POWER_THRESHOLDS[code])
        code++;
    return (uint8_t)code;
}

static void find_codes(const pyr_picture *picture, const pyr_batch *batch, int i, uint8_t out[4])
{
    const e3d_pyr_frame *frame = picture->frame;
    if (frame->shading == E3D_PYR_PLAIN) {
        for (int c = 0; c < 4; c++)
            out[c] = pyr_code(batch->draw->color[c]);
        return;
    }
    for (int c = 0; c < 3; c++)
        out[c] = frame->shading == E3D_PYR_LIT ? power_code(picture, batch->color[c][i])
                                               : pyr_code(batch->base[c][i] * batch->vertex_color[c][i]);
    out[3] = pyr_code(batch->base[3][i] * batch->vertex_color[3][i]);
}

/* Source over what is there, in codes; alpha likewise. */
static void blend(uint8_t *to, const uint8_t code[4])
{
    int share = code[3];
    for (int c = 0; c < 4; c++)
        to[c] = (uint8_t)((code[c] * share + to[c] * (255 - share) + 127) / 255);
}

static void write_samples(const pyr_band *band, int i, const uint8_t code[4])
{
    const pyr_batch *batch = &band->batch;
    uint8_t *to = pyr_codes_at(band, batch->x[i], batch->y[i]);
    for (int s = 0; s < band->picture->frame->samples; s++, to += 4) {
        if (!(batch->mask[i] >> s & 1))
            continue;
        if (batch->draw->blends && code[3] != 255)
            blend(to, code);
        else
            memcpy(to, code, 4);
    }
}

/* A pixel of which no sample is kept: its colour, or what the fragment adds to it. */
static void write_pixel(const pyr_band *band, int i, const uint8_t code[4])
{
    const pyr_batch *batch = &band->batch;
    const e3d_pyr_frame *frame = band->picture->frame;
    uint32_t all = (1u << frame->samples) - 1;
    if (batch->mask[i] == all) {
        uint8_t *to = pyr_color_at(frame, batch->x[i], batch->y[i]);
        for (int c = 0; c < frame->channels; c++)
            to[c] = code[c];
        return;
    }
    uint16_t *sum = pyr_sums_at(band, batch->x[i], batch->y[i]);
    for (uint32_t left = batch->mask[i]; left; left &= left - 1)
        for (int c = 0; c < 4; c++)
            sum[c] = (uint16_t)(sum[c] + code[c]);
}

void pyr_flush(pyr_band *band)
{
    pyr_batch *batch = &band->batch;
    uint8_t code[4];
    if (batch->count && band->picture->frame->shading == E3D_PYR_LIT)
        pyr_light(band->picture->frame, batch);
    for (int i = 0; i < batch->count; i++) {
        find_codes(band->picture, batch, i, code);
        if (band->picture->keeps_samples)
            write_samples(band, i, code);
        else
            write_pixel(band, i, code);
    }
    batch->count = 0;
}
