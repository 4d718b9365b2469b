/* Alpha: the alpha test, and blending over what is behind.
 * In: pieces whose materials are masked or blended, and the samples that they cover.
 * Out: whether masked ones show there; the fragments of blended ones, sorted by sample, and samples with their colours
 * blended over them.
 * Rules: R81 (coverage), R82 (visibility), R83 (order), R84 (composition), R123 (of radiance), R105, R108 and R190 (multisampling).
 * The alpha of a surface is R80, in surface.c; R166, what blending begins with behind glass, in refraction.c. */
#include <math.h>
#include <stdlib.h>

#include "reference/arithmetic.h"
#include "reference/surface.h"

static e3d_alpha_mode alpha_mode_of(const ref_piece *piece)
{
    const e3d_material *material = piece->primitive.material;
    return material ? material->alpha_mode : E3D_ALPHA_OPAQUE; /* a wireframe's edge has no material */
}

static int32_t first_of(uint32_t samples)
{
    int32_t n = 0;
    while (!(samples >> n & 1))
        n++;
    return n;
}

/* R190: an alpha, so that 1/2 is the cutoff. */
static float centred(float alpha, float cutoff)
{
    if (alpha < cutoff)
        return (0.5f * alpha) / cutoff;
    return cutoff < 1.0f ? 0.5f + (0.5f * (alpha - cutoff)) / (1.0f - cutoff) : 1.0f;
}

/* R190: the share of a pixel that a surface covers. */
static float share_of(const ref_scene *scene, const ref_piece *piece, const ref_place *at, const ref_surface *surface)
{
    static const ref_other_way RIGHT = {{1.0f, 0.0f}, 0}, BELOW = {{0.0f, 1.0f}, 0}, FINEST = {{0.0f, 0.0f}, 1};
    float cutoff = piece->primitive.material->alpha_cutoff, h = centred(surface->alpha, cutoff);
    ref_surface right, below, finest;
    if (!(h > 0.0f && h < 1.0f))
        return surface->alpha >= cutoff ? 1.0f : 0.0f;
    ref_surface_other(scene, piece, at, &RIGHT, &right);
    ref_surface_other(scene, piece, at, &BELOW, &below);
    ref_surface_other(scene, piece, at, &FINEST, &finest);
    float x = centred(right.alpha, cutoff) - h, y = centred(below.alpha, cutoff) - h;
    float lost = ref_min(fabsf(centred(finest.alpha, cutoff) - h) * 8.0f, 1.0f);
    float least = ((float)(surface->alpha_lod < 1024 ? surface->alpha_lod : 1024) * 0x1p-10f) * lost;
    float slope = ref_clamp(sqrtf(x * x + y * y), least, 1.0f);
    if (slope > 0.0f)
        return (h - 0.5f) / slope + 0.5f;
    return h >= 0.5f ? 1.0f : 0.0f;
}

/* R108: the samples that a share of a pixel covers. */
static uint32_t coverage_of(const ref_scene *scene, float share)
{
    uint32_t covered = 0;
    for (int32_t n = 0; n < scene->pixel_samples; n++)
        if (share * (float)scene->pixel_samples >= (float)n + 0.5f)
            covered |= (uint32_t)1 << n;
    return covered;
}

/* R81 and R108 */
uint32_t ref_alpha_covers(const ref_scene *scene, const ref_piece *piece, int32_t x, int32_t y, uint32_t covered)
{
    e3d_alpha_mode mode = alpha_mode_of(piece);
    if (mode == E3D_ALPHA_OPAQUE || (scene->pattern && ref_is_blended(scene->frame, piece)))
        return covered;
    const ref_place at = {x, y, first_of(covered), 0};
    ref_surface surface;
    ref_surface_at(scene, piece, &at, &surface);
    float alpha = surface.alpha; /* R80 */
    if (ref_transmits(scene->frame, piece))
        return ref_transmitting_alpha(piece->primitive.material, alpha) >= E3D_LEAST_ALPHA ? covered : 0;
    float cutoff = mode == E3D_ALPHA_MASK ? piece->primitive.material->alpha_cutoff : E3D_LEAST_ALPHA;
    if (scene->pattern && scene->frame->alpha_to_coverage && mode == E3D_ALPHA_MASK)
        return covered & coverage_of(scene, share_of(scene, piece, &at, &surface));
    return alpha >= cutoff ? covered : 0;
}

/* R82 */
int ref_is_blended(const e3d_frame *frame, const ref_piece *piece)
{
    if (ref_transmits(frame, piece))
        return 1;
    return alpha_mode_of(piece) == E3D_ALPHA_BLEND && (frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT);
}

e3d_status ref_add_fragment(ref_band *band, size_t sample, float depth, int64_t piece)
{
    if (band->fragment_count == band->fragment_capacity) {
        int64_t capacity = band->fragment_capacity ? 2 * band->fragment_capacity : 1024;
        ref_fragment *fragments = realloc(band->fragments, (size_t)capacity * sizeof *fragments);
        if (!fragments)
            return E3D_OUT_OF_MEMORY;
        band->fragments = fragments;
        band->fragment_capacity = capacity;
    }
    band->fragments[band->fragment_count++] = (ref_fragment){sample, depth, piece};
    return E3D_OK;
}

/* Pieces are numbered in order; if the last one shows, in the order of drawing. */
static int is_in_front(const ref_scene *scene, const ref_band *band, const ref_fragment *fragment)
{
    int64_t kept = band->piece[fragment->sample];
    float depth = band->depth[fragment->sample];
    if (kept < 0)
        return 1;
    if (scene->frame->hidden != E3D_HIDDEN_ZBUFFER)
        return fragment->piece > kept;
    return fragment->depth < depth || (fragment->depth == depth && fragment->piece < kept);
}

/* For qsort: of one sample's fragments, the later piece comes first. */
static int later_first(const void *left, const void *right)
{
    const ref_fragment *a = left, *b = right;
    if (a->sample != b->sample)
        return a->sample < b->sample ? -1 : 1;
    return a->piece > b->piece ? -1 : 1;
}

static int earlier_first(const void *left, const void *right)
{
    const ref_fragment *a = left, *b = right;
    if (a->sample != b->sample)
        return a->sample < b->sample ? -1 : 1;
    return a->piece < b->piece ? -1 : 1;
}

static int farther_first(const void *left, const void *right)
{
    const ref_fragment *a = left, *b = right;
    if (a->sample == b->sample && a->depth != b->depth)
        return a->depth > b->depth ? -1 : 1;
    return later_first(left, right);
}

/* Finds where the fragments of each sample begin. */
static void index_fragments(ref_band *band)
{
    size_t samples = (size_t)band->rows * (size_t)band->width * (size_t)band->pixel_samples;
    int64_t at = 0;
    for (size_t sample = 0; sample <= samples; sample++) {
        while (at < band->fragment_count && band->fragments[at].sample < sample)
            at++;
        band->first_fragment[sample] = at;
    }
}

/* R83 */
void ref_sort_fragments(const ref_scene *scene, ref_band *band)
{
    int64_t left = 0;
    for (int64_t i = 0; i < band->fragment_count; i++)
        if (is_in_front(scene, band, &band->fragments[i]))
            band->fragments[left++] = band->fragments[i];
    band->fragment_count = left;
    if (left > 1)
        qsort(band->fragments, (size_t)left, sizeof *band->fragments,
              scene->frame->hidden == E3D_HIDDEN_ZBUFFER ? farther_first : earlier_first);
    index_fragments(band);
}

/* R105: the first sample of the pixel in which the piece has a fragment; R195: this one alone. */
static ref_place first_with(const ref_scene *scene, const ref_band *band, const ref_place *at, int64_t piece)
{
    ref_place first = {at->x, at->y, 0, 0};
    if (scene->frame->sample_shading)
        return (ref_place){at->x, at->y, at->number, 1};
    for (; first.number < at->number; first.number++) {
        size_t sample = ref_sample_at(band, &first);
        for (int64_t i = band->first_fragment[sample]; i < band->first_fragment[sample + 1]; i++)
            if (band->fragments[i].piece == piece)
                return first;
    }
    return first;
}

/* A fragment's layer over a sample: a surface with its alpha, and for one that transmits (R133) the shares of light that pass. */
typedef struct layer {
    ref_surface surface;
    int transmits;
    float transmittance[3];
} layer;

/* Returns 0 if the fragment's alpha is too small to blend. */
static int find_layer(const ref_scene *scene, const ref_piece *piece, const ref_place *at, layer *out)
{
    ref_surface_at(scene, piece, at, &out->surface);
    out->transmits = ref_transmits(scene->frame, piece);
    if (out->transmits)
        out->surface.alpha = ref_transmitting_alpha(piece->primitive.material, out->surface.alpha);
    if (out->surface.alpha < E3D_LEAST_ALPHA)
        return 0;
    if (out->transmits)
        ref_transmittance(scene->frame, &out->surface, out->transmittance);
    return 1;
}

/* R166 */
static void add_bends(const ref_scene *scene, const ref_band *band, const ref_place *at, ref_bend *sum)
{
    size_t sample = ref_sample_at(band, at);
    ref_no_bend(sum);
    for (int64_t i = band->first_fragment[sample]; i < band->first_fragment[sample + 1] && ref_frame_bends(scene->frame); i++) {
        const ref_place first = first_with(scene, band, at, band->fragments[i].piece);
        layer layer;
        if (find_layer(scene, &scene->pieces.items[band->fragments[i].piece], &first, &layer))
            ref_add_bend(scene->frame, &layer.surface, &first, sum);
    }
}

/* R84 */
void ref_blend_sample(ref_scene *scene, const ref_band *band, const ref_place *at, float color[3], float *alpha)
{
    size_t sample = ref_sample_at(band, at);
    ref_bend sum;
    add_bends(scene, band, at, &sum);
    ref_begin_behind(scene->frame, &sum, at, color, alpha);
    for (int64_t i = band->first_fragment[sample]; i < band->first_fragment[sample + 1]; i++) {
        const ref_piece *piece = &scene->pieces.items[band->fragments[i].piece];
        const ref_place first = first_with(scene, band, at, band->fragments[i].piece);
        layer layer;
        float shaded[3];
        if (scene->frame->wireframe == E3D_WIRE_ONLY && piece->primitive.kind == REF_FACE)
            continue;
        scene->stats.pixels_shaded += first.number == at->number;
        if (!find_layer(scene, piece, &first, &layer))
            continue;
        ref_show(scene->frame, &layer.surface, shaded);
        if (layer.transmits) {
            ref_lay_transmitting(shaded, layer.surface.alpha, layer.transmittance, color, alpha);
            continue;
        }
        for (int c = 0; c < 3; c++)
            color[c] = shaded[c] * layer.surface.alpha + color[c] * (1.0f - layer.surface.alpha);
        *alpha = layer.surface.alpha + *alpha * (1.0f - layer.surface.alpha);
    }
}

/* R123 */
void ref_blend_radiance(const ref_scene *scene, const ref_band *band, const ref_place *at, float radiance[3])
{
    size_t sample = ref_sample_at(band, at);
    ref_bend sum;
    add_bends(scene, band, at, &sum);
    ref_begin_radiance(scene->frame, &sum, at, radiance);
    for (int64_t i = band->first_fragment[sample]; i < band->first_fragment[sample + 1]; i++) {
        layer layer;
        float light[3];
        if (!find_layer(scene, &scene->pieces.items[band->fragments[i].piece], at, &layer))
            continue;
        ref_shade(scene->frame, &layer.surface, light);
        for (int c = 0; c < 3; c++) {
            float alpha = layer.surface.alpha, rest = 1.0f - alpha;
            if (layer.transmits)
                rest = rest + alpha * layer.transmittance[c];
            radiance[c] = (isfinite(light[c]) ? light[c] : 0.0f) * alpha + radiance[c] * rest;
        }
    }
}
