/* Resolve: from the samples of a band to the caller's arrays.
 *
 * In:  what raster left at each sample.
 * Out: one row of pixels after another: colour averaged over a pixel's samples and encoded; every
 *      other output from the one sample of R35.
 * Rules: R32 (overdraw), R33 and R85 (average), R34 (encoding), R35 and R86 (outputs), R36 (what wireframe shows), R63 (an
 *      environment as the background); R84 through alpha.c.
 */
#include <math.h>

#include "reference/arithmetic.h"
#include "core/srgb_tables.h"
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

static uint8_t encode(const e3d_frame *frame, float v)
{
    if (frame->encode_srgb && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT))
        return encode_srgb(v);
    return (uint8_t)ref_rint(255.0f * v);
}

static void clamp_color(const float color[3], float out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = ref_clamp(color[c], 0.0f, 1.0f);
}

static void overdraw_color(uint8_t layers, float out[3])
{
    const uint8_t *color = E3D_OVERDRAW_RAMP[layers < 15 ? layers : 15];
    for (int c = 0; c < 3; c++)
        out[c] = (float)color[c] * E3D_UNORM8;
}

static int shows_backdrop(const e3d_frame *frame)
{
    return frame->backdrop.light.environment && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT);
}

/* R63: of the pixel that a sample belongs to. */
static void background_color(const e3d_frame *frame, int32_t x, int32_t y, float out[3])
{
    float color[3];
    if (shows_backdrop(frame))
        ref_backdrop(&frame->backdrop, x / frame->samples_axis, y / frame->samples_axis, color);
    clamp_color(shows_backdrop(frame) ? color : frame->background, out);
}

/* R129 */
static float find_visibility(const e3d_frame *frame, int32_t x, int32_t y)
{
    size_t pixel = (size_t)(y / frame->samples_axis) * (size_t)frame->width + (size_t)(x / frame->samples_axis);
    return frame->ambient_visibility ? frame->ambient_visibility[pixel] : 1.0f;
}

/* The colour of what is kept at a sample, clamped; returns 0, and the background's colour, where nothing shows. */
static int kept_color(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, float out[3])
{
    const e3d_frame *frame = scene->frame;
    size_t sample = (size_t)(y - band->first_row) * (size_t)band->width + (size_t)x;
    int64_t number = band->piece[sample];
    const ref_piece *piece = number < 0 ? NULL : &scene->pieces.items[number];
    int only_edges = frame->wireframe == E3D_WIRE_ONLY;
    int overdraw = frame->mode == E3D_MODE_OVERDRAW;
    if (band->edge[sample]) {
        clamp_color(frame->line_color, out);
        return 1;
    }
    if (overdraw && !only_edges && band->layers[sample] > 0) {
        overdraw_color(band->layers[sample], out);
        return 1;
    }
    if (overdraw || !piece || (only_edges && piece->primitive.kind == REF_FACE)) {
        background_color(frame, x, y, out);
        return 0;
    }
    ref_surface surface;
    float color[3];
    ref_surface_at(scene, piece, x, y, &surface);
    surface.visibility = find_visibility(frame, x, y);
    ref_shade(frame, &surface, color);
    clamp_color(color, out);
    scene->stats.pixels_shaded++;
    return 1;
}

/* The colour of a sample, multiplied by its alpha, which it returns. */
static float sample_color(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, float out[3])
{
    int has_background = shows_backdrop(scene->frame) || scene->frame->background[3] != 0.0f;
    float alpha = kept_color(scene, band, x, y, out) || has_background ? 1.0f : 0.0f;
    size_t sample = (size_t)(y - band->first_row) * (size_t)band->width + (size_t)x;
    for (int c = 0; c < 3 && alpha == 0.0f; c++)
        out[c] = 0.0f;
    if (!band->edge[sample])
        ref_blend_sample(scene, band, x, y, out, &alpha);
    return alpha;
}

/* R33, R85 and R34 of the pixel whose first sample is (x, y). */
static void resolve_color(ref_scene *scene, const ref_band *band, int32_t x, int32_t y, uint8_t out[4])
{
    const e3d_frame *frame = scene->frame;
    int32_t n = frame->samples_axis;
    float count = 0.0f; /* the sum of alphas */
    float sum[3] = {0.0f, 0.0f, 0.0f}, color[3];
    for (int32_t j = 0; j < n; j++)
        for (int32_t i = 0; i < n; i++) {
            count = count + sample_color(scene, band, x + i, y + j, color);
            for (int c = 0; c < 3; c++)
                sum[c] = sum[c] + color[c];
        }
    if (count == 0.0f)
        clamp_color(frame->background, sum);
    float scale = count == 0.0f ? 1.0f : 1.0f / count;
    for (int c = 0; c < 3; c++)
        out[c] = encode(frame, sum[c] * scale);
    out[3] = (uint8_t)ref_rint(255.0f * (count / (float)(n * n)));
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
    for (size_t c = 0; output != E3D_OUTPUT_COLOR && targets->name && c < channels; c++) \
        targets->name[channels * pixel + c] = background;
    E3D_EACH_OUTPUT(WRITE_BACKGROUND)
}

static void write_surface(const e3d_targets *targets, size_t pixel, const ref_surface *surface, float ndc_depth)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    write_id(targets->triangle_id, pixel, primitive->kind == REF_FACE ? primitive->index : -1);
    write_id(targets->object_id, pixel, surface->instance->object_id);
    write_id(targets->instance_id, pixel, surface->instance->instance_id);
    write_id(targets->material_id, pixel, primitive->material->id);
    write_floats(targets->ndc_depth, pixel, &ndc_depth, 1);
    write_floats(targets->depth, pixel, &surface->metric_depth, 1);
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
    size_t sample = (size_t)(y - band->first_row) * (size_t)band->width + (size_t)x;
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
    ref_surface_at(scene, &scene->pieces.items[number], x, y, &surface);
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
