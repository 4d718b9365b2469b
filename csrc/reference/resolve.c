/* Resolve: writes the samples of a band to the caller's arrays.
 * In: the samples that raster found. Out: one row of pixels after another: colour averaged over a pixel's samples and
 * encoded; every other output from the one sample of R35.
 * Rules: R32 (overdraw), R33 and R85 (average), R34 (encoding), R35 and R86 (outputs), R36 (wireframes), R63 (an environment
 * as the background), R123 (radiance); R84 and R123 through alpha.c, R117, R122 through tone.c. */
#include <math.h>

#include "reference/arithmetic.h"
#include "data/srgb_tables.h"
#include "reference/surface.h"

/* R34: the number of thresholds that are <= v; they ascend. */
static uint8_t encode_srgb(float v)
{
    int low = 0, high = 255;
    while (low < high) {
        int middle = (low + high) / 2;
        if (SRGB_THRESHOLDS[middle] <= v)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}

uint8_t ref_encode(float v, int is_srgb) { return is_srgb ? encode_srgb(v) : (uint8_t)ref_rint(255.0f * v); }

static uint8_t encode(const e3d_frame *frame, float v)
{
    return ref_encode(v, frame->encode_srgb && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT));
}

static void clamp_color(const float color[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = ref_clamp(color[c], 0.0f, 1.0f);
}

static void overdraw_color(uint8_t count, float out[3])
{
    const uint8_t *color = E3D_OVERDRAW_RAMP[count < 15 ? count : 15];
    for (int c = 0; c < 3; c++)
        out[c] = (float)color[c] * E3D_UNORM8;
}

static int shows_backdrop(const e3d_frame *frame)
{
    return frame->backdrop.light.environment && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT);
}

/* R63, R122: the background in the pixel of a sample. */
static void background_color(const e3d_frame *frame, const ref_place *at, float out[3])
{
    int32_t column = at->x / frame->samples_axis, row = at->y / frame->samples_axis;
    float color[3] = {frame->background[0], frame->background[1], frame->background[2]};
    if (shows_backdrop(frame)) {
        ref_backdrop(&frame->backdrop, column, row, color);
        if (frame->mode == E3D_MODE_LIT)
            ref_map_tone(frame->tone_mapping, color);
    } else if (frame->gradient.shows) {
        ref_gradient(frame, column, row, color);
    }
    clamp_color(color, out);
}

/* R105: the first sample of the pixel that shows the same piece as this one; R195: this one alone. */
static ref_place first_kept(const ref_scene *scene, const ref_band *band, const ref_place *at)
{
    int64_t number = band->piece[ref_sample_at(band, at)];
    ref_place first = {at->x, at->y, 0, 0};
    if (scene->frame->sample_shading)
        return (ref_place){at->x, at->y, at->number, 1};
    while (band->piece[ref_sample_at(band, &first)] != number)
        first.number++;
    return first;
}

/* Finds a surface, with the share of ambient light that reaches it (R129). */
static void find_surface(const ref_scene *scene, const ref_piece *piece, const ref_place *at, ref_surface *out)
{
    const e3d_frame *frame = scene->frame;
    ref_surface_at(scene, piece, at, out);
    if (frame->ambient_visibility && !ref_is_blended(frame, piece))
        out->visibility = frame->ambient_visibility[at->y / frame->samples_axis * frame->width + at->x / frame->samples_axis];
}

/* Finds the clamped colour of the visible piece at a sample. If there is none, returns 0, and finds the background's colour. */
static int kept_color(ref_scene *scene, const ref_band *band, const ref_place *at, float out[3])
{
    const e3d_frame *frame = scene->frame;
    size_t sample = ref_sample_at(band, at);
    int64_t number = band->piece[sample];
    const ref_piece *piece = number < 0 ? NULL : &scene->pieces.items[number];
    int only_edges = frame->wireframe == E3D_WIRE_ONLY;
    int overdraw = frame->mode == E3D_MODE_OVERDRAW;
    if (band->edge[sample]) {
        clamp_color(frame->line_color, out);
        return 1;
    }
    if (overdraw && !only_edges && band->overdraw[sample] > 0) {
        overdraw_color(band->overdraw[sample], out);
        return 1;
    }
    if (overdraw || !piece || (only_edges && piece->primitive.kind == REF_FACE)) {
        background_color(frame, at, out);
        return 0;
    }
    ref_surface surface;
    const ref_place first = first_kept(scene, band, at);
    find_surface(scene, piece, &first, &surface);
    ref_show(frame, &surface, out);
    scene->stats.pixels_shaded += first.number == at->number;
    return 1;
}

/* Finds the colour of a sample, multiplied by its alpha, and returns the alpha. */
static float sample_color(ref_scene *scene, const ref_band *band, const ref_place *at, float out[3])
{
    int has_background = shows_backdrop(scene->frame) || scene->frame->background[3] != 0.0f;
    float alpha = kept_color(scene, band, at, out) || has_background ? 1.0f : 0.0f;
    for (int c = 0; c < 3 && alpha == 0.0f; c++)
        out[c] = 0.0f;
    if (!band->edge[ref_sample_at(band, at)])
        ref_blend_sample(scene, band, at, out, &alpha);
    return alpha;
}

/* R33, R85 and R34 for sums over a pixel's samples: of colours, and of alphas. */
static void resolve_sums(const e3d_frame *frame, const float sum[4], int32_t samples, const float background[3], uint8_t out[4])
{
    float scale = sum[3] == 0.0f ? 1.0f : 1.0f / sum[3];
    for (int c = 0; c < 3; c++)
        out[c] = encode(frame, (sum[3] == 0.0f ? background[c] : sum[c]) * scale);
    out[3] = (uint8_t)ref_rint(255.0f * (sum[3] / (float)samples));
}

/* Sums up the samples of the pixel whose first sample is (x, y), row by row. */
static void sum_rows(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, float sum[4])
{
    int32_t n = scene->frame->samples_axis;
    float color[3];
    for (int c = 0; c < 4; c++)
        sum[c] = 0.0f;
    for (int32_t j = 0; j < n; j++)
        for (int32_t i = 0; i < n; i++) {
            const ref_place at = {x + i, y + j, 0, 0};
            sum[3] = sum[3] + sample_color(scene, band, &at, color);
            for (int c = 0; c < 3; c++)
                sum[c] = sum[c] + color[c];
        }
}

/* R106: adds samples in pairs, then these sums in pairs, until one is left. */
static void sum_pairs(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, float sum[4])
{
    float samples[E3D_MOST_MSAA_SAMPLES][4];
    int32_t count = scene->pixel_samples;
    for (int32_t n = 0; n < count; n++) {
        const ref_place at = {x, y, n, 0};
        samples[n][3] = sample_color(scene, band, &at, samples[n]);
    }
    for (; count > 1; count /= 2)
        for (int32_t n = 0; n < count / 2; n++)
            for (int c = 0; c < 4; c++)
                samples[n][c] = samples[2 * n][c] + samples[2 * n + 1][c];
    for (int c = 0; c < 4; c++)
        sum[c] = samples[0][c];
}

static void resolve_color(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, uint8_t out[4])
{
    const e3d_frame *frame = scene->frame;
    float sum[4], background[3];
    clamp_color(frame->background, background);
    if (scene->pattern)
        sum_pairs(scene, band, x, y, sum);
    else
        sum_rows(scene, band, x, y, sum);
    resolve_sums(frame, sum, frame->samples_axis * frame->samples_axis * scene->pixel_samples, background, out);
}

static void write_floats(float *target, size_t pixel, const float *values, int components)
{
    for (int c = 0; target && c < components; c++)
        target[pixel * (size_t)components + (size_t)c] = isfinite(values[c]) ? values[c] : 0.0f;
}

static void write_id(int32_t *target, size_t pixel, int32_t id)
{
    if (target)
        target[pixel] = id;
}

static void write_background(const e3d_targets *targets, size_t pixel)
{
#define WRITE_BACKGROUND(output, name, type, channels, background, ...) \
    for (size_t c = 0; output != E3D_OUTPUT_COLOR && output != E3D_OUTPUT_RADIANCE && targets->name && c < channels; c++) \
        targets->name[channels * pixel + c] = background;
    E3D_EACH_OUTPUT(WRITE_BACKGROUND)
}

/* R123: the radiance of the visible piece at a sample. If there is none, only an environment has any. */
static void kept_radiance(const ref_scene *scene, const ref_band *band, const ref_place *at, float out[3])
{
    const e3d_frame *frame = scene->frame;
    int64_t number = band->piece[ref_sample_at(band, at)];
    ref_surface surface;
    for (int c = 0; c < 3; c++)
        out[c] = 0.0f;
    if (frame->mode == E3D_MODE_OVERDRAW)
        return;
    if (number >= 0) {
        find_surface(scene, &scene->pieces.items[number], at, &surface);
        ref_shade(frame, &surface, out);
    } else if (shows_backdrop(frame)) {
        ref_backdrop(&frame->backdrop, at->x / frame->samples_axis, at->y / frame->samples_axis, out);
    }
}

/* R123 */
static void write_radiance(const ref_scene *scene, const ref_band *band, const ref_place *at, size_t pixel, float *target)
{
    float radiance[3];
    if (!target)
        return;
    kept_radiance(scene, band, at, radiance);
    for (int c = 0; c < 3; c++)
        radiance[c] = isfinite(radiance[c]) ? radiance[c] : 0.0f;
    ref_blend_radiance(scene, band, at, radiance);
    write_floats(target, pixel, radiance, 3);
}

static void write_surface(const e3d_targets *targets, size_t pixel, const ref_surface *surface, float ndc_depth)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    write_id(targets->face_id, pixel, primitive->kind == REF_FACE ? primitive->index : -1);
    write_id(targets->object_id, pixel, surface->instance->object_id);
    write_id(targets->instance_id, pixel, surface->instance->instance_id);
    write_id(targets->material_id, pixel, primitive->material->id);
    write_floats(targets->ndc_depth, pixel, &ndc_depth, 1);
    write_floats(targets->depth, pixel, &surface->metric_depth, 1);
    write_floats(targets->range, pixel, &surface->range, 1);
    write_floats(targets->albedo, pixel, surface->albedo, 3);
    write_floats(targets->normal, pixel, surface->view_normal, 3);
    write_floats(targets->position, pixel, surface->view_position, 3);
    write_floats(targets->world_normal, pixel, surface->world_normal, 3);
    write_floats(targets->world_position, pixel, surface->world_position, 3);
    write_floats(targets->uv, pixel, surface->uv, 2);
    write_floats(targets->barycentric, pixel, surface->barycentric, 3);
    int is_physical = primitive->kind == REF_FACE && primitive->material->is_physical;
    const float metallic_roughness[2] = {is_physical ? surface->physical.metallic : 0.0f,
                                         is_physical ? surface->physical.roughness : 1.0f};
    write_floats(targets->metallic_roughness, pixel, metallic_roughness, 2);
    write_floats(targets->emissive, pixel, surface->emissive, 3);
    write_floats(targets->tangent, pixel, surface->view_tangent, 4);
}

/* R35 */
static void resolve_outputs(const ref_scene *scene, const ref_band *band, int32_t x, int32_t y,
                            const e3d_targets *targets, size_t pixel)
{
    const ref_place at = {x, y, 0, 0};
    size_t sample = ref_sample_at(band, &at);
    write_radiance(scene, band, &at, pixel, targets->radiance);
    int64_t end = band->first_fragment[sample + 1], number = band->piece[sample];
    float depth = band->depth[sample];
    if (scene->frame->transparent_outputs && end > band->first_fragment[sample]) { /* R86 */
        number = band->fragments[end - 1].piece;
        depth = band->fragments[end - 1].depth;
    }
    if (number < 0) {
        write_background(targets, pixel);
        return;
    }
    ref_surface surface;
    find_surface(scene, &scene->pieces.items[number], &at, &surface);
    write_surface(targets, pixel, &surface, depth);
}

void ref_resolve_band(ref_scene *scene, const ref_band *band, const e3d_targets *targets)
{
    int32_t n = scene->frame->samples_axis, width = scene->frame->width;
    int has_data = 0;
    for (int k = E3D_OUTPUT_COLOR + 1; k < E3D_OUTPUTS; k++)
        has_data |= e3d_targets_get(targets, k) != NULL;
    for (int32_t y = band->first_row; y < band->first_row + band->rows; y += n)
        for (int32_t column = 0; column < width; column++) {
            size_t pixel = (size_t)(y / n) * (size_t)width + (size_t)column;
            if (targets->color)
                resolve_color(scene, band, column * n, y, targets->color + 4 * pixel);
            if (has_data)
                resolve_outputs(scene, band, column * n + n / 2, y + n / 2, targets, pixel);
        }
}
