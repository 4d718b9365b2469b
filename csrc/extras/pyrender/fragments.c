/* Fragments: tests their depths, gathers them, lights them together, and writes them to the samples that they cover.
 * In: fragments in the order of drawing. Out: codes of 8 bits; and depths if no samples are kept.
 * Always: if samples are kept, depths were tested before. */
#include <math.h>

#include "extras/pyrender/picture.h"
#include "extras/pyrender/transfer_tables.h"

float pyr_metric_depth(const e3d_pyr_frame *frame, double z)
{
    double near = frame->depth_near, far = frame->depth_far;
    if (!(z <= 1))
        return 0;
    if (frame->depth_is_straight)
        return (float)(near + (z + 1) * 0.5 * (far - near));
    if (isinf(far))
        return (float)(2 * near / (1 - z));
    return (float)(2 * near * far / (far + near - z * (far - near)));
}

uint32_t pyr_test_depths(const pyr_band *band, int32_t x, int32_t y, uint32_t mask, const double z[E3D_PYR_PLACES])
{
    const pyr_picture *picture = band->picture;
    double *depth = pyr_depths_at(band, x, y);
    uint32_t kept = 0;
    for (int p = 0; p < picture->places; p++)
        if (mask >> p & 1 && z[p] >= -1 && z[p] <= 1 && z[p] < depth[p]) {
            depth[p] = z[p];
            kept |= 1u << p;
        }
    return kept;
}

/* Adds a fragment; returns its number in the batch. */
static int add(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, int32_t x, int32_t y, uint32_t mask)
{
    pyr_batch *batch = &band->batch;
    if (batch->count == PYR_BATCH || (batch->count && batch->draw != draw))
        pyr_flush(band);
    if (!batch->count) {
        batch->draw = draw;
        batch->vertices = vertices;
        pyr_begin_surfaces(band->picture->frame, batch);
    }
    batch->x[batch->count] = x;
    batch->y[batch->count] = y;
    batch->mask[batch->count] = (uint8_t)mask;
    return batch->count++;
}

void pyr_add_fragment(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_weights *weights,
                      const pyr_plane *plane, int32_t x, int32_t y, uint32_t mask)
{
    int i = add(band, draw, vertices, x, y, mask);
    band->batch.plane[i] = NULL;
    pyr_find_surface(band, i, weights, plane);
}

void pyr_add_nearer(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_plane *plane, int32_t x, int32_t y,
                    uint32_t mask)
{
    const pyr_picture *picture = band->picture;
    double z[E3D_PYR_PLACES] = {0};
    for (int p = 0; p < picture->places; p++)
        if (mask >> p & 1)
            z[p] = pyr_depth_at_place(picture, plane, p, x, y);
    mask = pyr_test_depths(band, x, y, mask, z) & ((1u << picture->frame->samples) - 1);
    if (!mask || picture->frame->shading == E3D_PYR_DEPTH)
        return;
    pyr_weights weights;
    pyr_weigh(plane, x + 0.5, y + 0.5, &weights);
    pyr_add_fragment(band, draw, vertices, &weights, plane, x, y, mask);
}

void pyr_add_shown(pyr_band *band, const e3d_pyr_draw *draw, const pyr_vertex *vertices, const pyr_plane *plane, int32_t x, int32_t y,
                   uint32_t mask)
{
    int i = add(band, draw, vertices, x, y, mask);
    band->batch.plane[i] = plane;
}

/* Writes the depth of a pixel, if the fragment shows at the place of depths. `z`: the depth at its centre. */
static void write_depth(const pyr_band *band, int i, double z)
{
    const pyr_picture *picture = band->picture;
    const e3d_pyr_frame *frame = picture->frame;
    const pyr_batch *batch = &band->batch;
    if (!(batch->mask[i] >> picture->depth_place & 1))
        return;
    if (frame->depth_place != E3D_PYR_CENTRE)
        z = pyr_depth_at_place(picture, batch->plane[i], picture->depth_place, batch->x[i], batch->y[i]);
    frame->depth[(size_t)batch->y[i] * (size_t)frame->width + (size_t)batch->x[i]] = pyr_metric_depth(frame, z);
}

/* Finds the surfaces that pyr_add_shown left for later. */
static void find_surfaces(pyr_band *band)
{
    pyr_batch *batch = &band->batch;
    pyr_weights weights[PYR_BATCH];
    for (int i = 0; i < batch->count; i++) {
        const pyr_plane *plane = batch->plane[i];
        if (!plane)
            continue;
        write_depth(band, i, pyr_weigh(plane, batch->x[i] + 0.5, batch->y[i] + 0.5, &weights[i]));
    }
    for (int i = 0; i < batch->count && band->picture->frame->shading != E3D_PYR_DEPTH; i++)
        if (batch->plane[i])
            pyr_find_surface(band, i, &weights[i], batch->plane[i]);
}

/* The code of light raised to the power of 1/2.2. */
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

/* Blends a source over the codes that are there; alpha likewise. */
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

/* Writes a pixel without kept samples: its colour, or the fragment's part of it. */
static void write_pixel(const pyr_band *band, int i, const uint8_t code[4])
{
    const pyr_batch *batch = &band->batch;
    const e3d_pyr_frame *frame = band->picture->frame;
    uint32_t all = (1u << frame->samples) - 1, mask = batch->mask[i] & all;
    if (mask == all) {
        uint8_t *to = pyr_color_at(frame, batch->x[i], batch->y[i]);
        for (int c = 0; c < frame->channels; c++)
            to[c] = code[c];
        return;
    }
    uint16_t *sum = pyr_sums_at(band, batch->x[i], batch->y[i]);
    for (uint32_t left = mask; left; left &= left - 1)
        for (int c = 0; c < 4; c++)
            sum[c] = (uint16_t)(sum[c] + code[c]);
}

void pyr_flush(pyr_band *band)
{
    pyr_batch *batch = &band->batch;
    const e3d_pyr_frame *frame = band->picture->frame;
    uint8_t code[4];
    find_surfaces(band);
    if (batch->count && frame->shading == E3D_PYR_LIT)
        pyr_light(frame, batch);
    for (int i = 0; i < batch->count && frame->color; i++) {
        find_codes(band->picture, batch, i, code);
        if (band->picture->keeps_samples)
            write_samples(band, i, code);
        else
            write_pixel(band, i, code);
    }
    batch->count = 0;
    batch->number++;
}
