/* raster, alpha to coverage: which samples of a pixel the alpha of a masked record leaves (R108, R190).
 * In: the list of pixels that masked records cover. Out: the covers of its entries.
 * An edge is as wide as a pixel, whatever the slope of its alpha, which is the difference to the alphas one pixel to the right and
 * below. Where levels lost details, that says less than the alpha itself.
 * Most pixels need no slope, since they are covered wholly or not at all; so the others are listed again. */
#include <math.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/types/shown.h"
#include "frame/pass/prepared.h"
#include "frame/shade/alpha_batch.h"
#include "frame/shade/job.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/coverage.h"
#include "frame/tile/memory.h"

enum { MOST_LOD = 1024 }; /* four levels */

/* R190: an alpha, so that 1/2 is the cutoff. */
static float centred(float alpha, float cutoff)
{
    if (alpha < cutoff)
        return (0.5f * alpha) / cutoff;
    return cutoff < 1.0f ? 0.5f + (0.5f * (alpha - cutoff)) / (1.0f - cutoff) : 1.0f;
}

static const e3d_material *material_of(const e3d_shade_memory *shade, const e3d_visible_primitive *primitive)
{
    return ((const e3d_bucket *)shade->buckets.data)[primitive->bucket].material;
}

/* ---- pixels that are covered wholly or not at all ---- */

/* Leaves all samples of a pixel or none, and returns 1 if it lies on an edge. Slopes are at most 1, so that h of 0 or 1 decides. */
static int cover_pixel(const e3d_material *material, int sharpens, float alpha, int32_t *cover, int32_t *edge)
{
    float cutoff = e3d_alpha_cutoff(material), h = centred(alpha, cutoff);
    int is_edge = sharpens && material->alpha_mode == E3D_ALPHA_MASK && h > 0.0f && h < 1.0f;
    *edge = is_edge ? *cover : 0;
    if (is_edge || !(alpha >= cutoff))
        *cover = 0;
    return is_edge;
}

int e3d_cover_pixels(const e3d_tile_job *job, int32_t *edges)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    e3d_multisample_memory *memory = job->memory->multisample;
    int sharpens = job->in->pass->frame->alpha_to_coverage;
    *edges = 0;
    if (!e3d_alpha_shade(job, E3D_SINK_ALPHA_TEST, (e3d_shaded_list){.lod = sharpens ? memory->edges.lod : NULL}))
        return 0;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    for (int32_t p = 0; p < shade->shown.primitives; p++)
        for (int32_t n = primitives[p].first; n < primitives[p].end; n++)
            *edges += cover_pixel(material_of(shade, &primitives[p]), sharpens, job->memory->alpha.alpha[n], &memory->alpha.cover[n],
                                  &memory->edges.cover[n]);
    return 1;
}

/* ---- edges ---- */

/* Moves entry `from` of the list to place `to`, before it. */
static void move_entry(const e3d_tile_job *job, int32_t from, int32_t to)
{
    e3d_shown *shown = &job->memory->shade.shown;
    e3d_multisample_memory *memory = job->memory->multisample;
    shown->sample[to] = shown->sample[from];
    shown->of[to] = shown->primitives;
    memory->alpha.cover[to] = memory->edges.cover[from];
    memory->edges.lod[to] = memory->edges.lod[from];
    job->memory->alpha.alpha[to] = job->memory->alpha.alpha[from];
}

/* Leaves in the list the pixels on edges. */
static void list_edges(const e3d_tile_job *job)
{
    e3d_shade_memory *shade = &job->memory->shade;
    e3d_shown *shown = &shade->shown;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    int32_t all = shown->primitives;
    shown->count = shown->primitives = 0;
    for (int32_t p = 0; p < all; p++) {
        const e3d_shown_primitive primitive = {shown->primitive[p].id, shown->count};
        for (int32_t n = primitives[p].first; n < primitives[p].end; n++)
            if (job->memory->multisample->edges.cover[n])
                move_entry(job, n, shown->count++);
        shown->primitive[shown->primitives] = primitive;
        shown->primitives += shown->count > primitive.first;
    }
}

/* Finds the alphas of the list so many pixels to the right and below. */
static int find_beside(const e3d_tile_job *job, float right, float below, float *alpha)
{
    e3d_shown *shown = &job->memory->shade.shown;
    shown->beside[0] = right;
    shown->beside[1] = below;
    int found = e3d_alpha_shade(job, E3D_SINK_ALPHA_TEST, (e3d_shaded_list){.alpha = alpha});
    shown->beside[0] = shown->beside[1] = 0.0f;
    return found;
}

/* Finds the alphas of the list by level 0 of their textures. */
static int find_finest(const e3d_tile_job *job, float *alpha)
{
    e3d_shown *shown = &job->memory->shade.shown;
    shown->finest = 1;
    int found = e3d_alpha_shade(job, E3D_SINK_ALPHA_TEST, (e3d_shaded_list){.alpha = alpha});
    shown->finest = 0;
    return found;
}

/* R190: the share of a pixel that is covered. */
static float share_of(const e3d_tile_job *job, int32_t n, float cutoff)
{
    const e3d_edges_memory *edges = &job->memory->multisample->edges;
    float h = centred(job->memory->alpha.alpha[n], cutoff);
    float x = centred(edges->right[n], cutoff) - h, y = centred(edges->below[n], cutoff) - h;
    float lost = fabsf(centred(edges->finest[n], cutoff) - h) * 8.0f;
    float least = ((float)(edges->lod[n] < MOST_LOD ? edges->lod[n] : MOST_LOD) * (1.0f / MOST_LOD)) * (lost < 1.0f ? lost : 1.0f);
    float slope = sqrtf(x * x + y * y);
    slope = slope > least ? slope : least;
    slope = slope < 1.0f ? slope : 1.0f;
    if (slope > 0.0f)
        return (h - 0.5f) / slope + 0.5f;
    return h >= 0.5f ? 1.0f : 0.0f;
}

/* R108: the samples that a share covers, a bit each. */
static uint32_t coverage_of(float share, int32_t samples)
{
    uint32_t covered = 0;
    for (int32_t n = 0; n < samples; n++)
        if (share * (float)samples >= (float)n + 0.5f)
            covered |= (uint32_t)1 << n;
    return covered;
}

int e3d_cover_edges(const e3d_tile_job *job)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    e3d_multisample_memory *memory = job->memory->multisample;
    list_edges(job);
    if (!find_beside(job, 1.0f, 0.0f, memory->edges.right) || !find_beside(job, 0.0f, 1.0f, memory->edges.below) ||
        !find_finest(job, memory->edges.finest))
        return 0;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    for (int32_t p = 0; p < shade->shown.primitives; p++)
        for (int32_t n = primitives[p].first; n < primitives[p].end; n++) {
            float share = share_of(job, n, e3d_alpha_cutoff(material_of(shade, &primitives[p])));
            memory->alpha.cover[n] &= (int32_t)coverage_of(share, job->in->pass->pattern->count);
        }
    return 1;
}
