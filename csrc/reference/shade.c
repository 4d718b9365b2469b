/* Shade: the colour of a surface in the frame's mode, not yet encoded.
 * In: a surface, the frame's mode. Out: three floats.
 * Overdraw is not about surfaces: resolve.c.
 * Rules: R31 through light.c, R49 ... R57, R211 through physical.c, R32, R44, R212; R117, R121 through tone.c. */
#include "reference/surface.h"

/* R32 */
static void color_from_bytes(uint32_t r, uint32_t g, uint32_t b, float out[3])
{
    out[0] = (float)(int32_t)r * E3D_UNORM8;
    out[1] = (float)(int32_t)g * E3D_UNORM8;
    out[2] = (float)(int32_t)b * E3D_UNORM8;
}

/* Source of the mixer: Chris Wellons, "Prospecting for hash functions", 2018 (lowbias32). */
static void random_color(uint32_t number, float out[3])
{
    uint32_t h = number;
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    color_from_bytes(64 + (h & 255) * 3 / 4, 64 + ((h >> 8) & 255) * 3 / 4, 64 + ((h >> 16) & 255) * 3 / 4,
                     out);
}

/* A bijection of 24 bits, so that different numbers below 2^24 have different colours. */
static void id_color(uint32_t id, float out[3])
{
    uint32_t h = (id + 1u) * 0x9E3779B1u & 0xFFFFFFu;
    color_from_bytes(h & 255, (h >> 8) & 255, (h >> 16) & 255, out);
}

/* R32 */
static void depth_color(const e3d_frame *frame, float metric_depth, float out[3])
{
    float scale = 1.0f / (frame->depth_far - frame->depth_near);
    float grey = 1.0f - ref_clamp((metric_depth - frame->depth_near) * scale, 0.0f, 1.0f);
    out[0] = out[1] = out[2] = grey;
}

/* R32 */
static int is_lit(const e3d_frame *frame, const ref_surface *surface)
{
    const ref_primitive *primitive = &surface->piece->primitive;
    return frame->mode == E3D_MODE_LIT && primitive->kind == REF_FACE && !primitive->material->is_unlit;
}

/* R31, R32, R57 */
static void find_color(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    const ref_primitive *primitive = &surface->piece->primitive;
    switch (frame->mode) {
    case E3D_MODE_RANDOM:
        random_color(primitive->local, out);
        return;
    case E3D_MODE_FACE_ID:
        id_color(primitive->local, out);
        return;
    case E3D_MODE_OBJECT_ID:
        id_color((uint32_t)surface->instance->object_id, out);
        return;
    case E3D_MODE_DEPTH:
        depth_color(frame, surface->metric_depth, out);
        return;
    case E3D_MODE_NORMAL:
        for (int c = 0; c < 3; c++)
            out[c] = surface->view_normal[c] * 0.5f + 0.5f;
        return;
    default:
        break;
    }
    if (is_lit(frame, surface)) {
        if (primitive->material->is_physical)
            ref_light_physical(frame, surface, out);
        else
            ref_light(frame, surface, out);
        return;
    }
    for (int c = 0; c < 3; c++)
        out[c] = surface->albedo[c];
}

/* What fog makes of black (R121). */
static void find_haze(const e3d_frame *frame, const ref_surface *surface, float haze[3])
{
    haze[0] = haze[1] = haze[2] = 0.0f;
    if (frame->fog.kind != E3D_FOG_NONE)
        ref_add_fog(&frame->fog, surface->metric_depth, 1, haze);
}

/* R121, of what transmits: light that passes brings the fog of its whole way. */
static void clear_haze(const e3d_frame *frame, const ref_surface *surface, const float haze[3], float color[3])
{
    float transmittance[3];
    if (frame->fog.kind == E3D_FOG_NONE || !ref_transmits(frame, surface->piece))
        return;
    ref_transmittance(frame, surface, transmittance);
    for (int c = 0; c < 3; c++)
        color[c] = ref_max(color[c] - transmittance[c] * haze[c], 0.0f);
}

/* R212 */
static void add_mirror(const e3d_frame *frame, const ref_surface *surface, float color[3])
{
    float share[3], haze[3];
    if (!(surface->mirror > 0.0f))
        return;
    if (!surface->piece->primitive.material->is_physical) {
        for (int c = 0; c < 3; c++)
            color[c] = color[c] + (surface->mirrored_light[c] - color[c]) * surface->mirror;
        return;
    }
    find_haze(frame, surface, haze);
    ref_mirror_share(frame, surface, share);
    for (int c = 0; c < 3; c++)
        color[c] = color[c] + share[c] * (surface->mirrored_light[c] - haze[c]);
}

/* The colour of a surface before R117, with all the fog between it and the eye. */
static void shade(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    int is_fogged = frame->mode == E3D_MODE_LIT || frame->mode == E3D_MODE_UNLIT;
    find_color(frame, surface, out);
    if (is_fogged && frame->fog.kind != E3D_FOG_NONE)
        ref_add_fog(&frame->fog, surface->metric_depth, is_lit(frame, surface), out);
    add_mirror(frame, surface, out);
}

void ref_shade(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    float haze[3];
    shade(frame, surface, out);
    find_haze(frame, surface, haze);
    clear_haze(frame, surface, haze, out);
}

void ref_show(const e3d_frame *frame, const ref_surface *surface, float out[3])
{
    float haze[3];
    shade(frame, surface, out);
    find_haze(frame, surface, haze);
    if (is_lit(frame, surface)) {
        ref_map_tone(frame->tone_mapping, out);
        ref_map_tone(frame->tone_mapping, haze);
    }
    for (int c = 0; c < 3; c++) {
        out[c] = ref_clamp(out[c], 0.0f, 1.0f);
        haze[c] = ref_clamp(haze[c], 0.0f, 1.0f);
    }
    clear_haze(frame, surface, haze, out);
}
