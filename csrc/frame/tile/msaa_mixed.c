/* shade with multisampling, mixed pixels: shades each surface that shows in a pixel once (R105), and averages the colours of the
 * samples (R106).
 * In: the planes of a tile, and which of its pixels to shade.
 * Out: pixels, or the colours of samples if something is drawn over them.
 * Always: a list has at most as many colours as a tile has samples; the pixels of a full list are done before the next begins. */
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "data/sample_patterns.h"
#include "base/vectors.h"
#include "kernels/kernels.h"
#include "kernels/types/msaa_mixed.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/geometry/records.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"
#include "frame/shade/runs.h"
#include "frame/store/backdrop.h"
#include "frame/store/store.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/memory.h"
#include "frame/tile/msaa_mixed.h"

/* ---- what is listed ---- */

/* The ID that a sample shows: if a wireframe leaves out faces, these show the background. */
static int32_t shown_id(const e3d_tile_job *job, int32_t id, int only_edges)
{
    if (!only_edges || id < 0)
        return id;
    return e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], (uint32_t)id)->meta & E3D_RECORD_FACE ? E3D_NO_SLOT : id;
}

/* The number of the background's colour behind a pixel. */
static int32_t background_of(const e3d_tile_job *job, int32_t pixel, e3d_mixed_list *list)
{
    if (!e3d_plans(job->in->pass, E3D_PLAN_BACKDROP))
        return E3D_MIXED_BACKGROUND;
    int32_t number = list->colors++, place = E3D_MIXED_BACKDROP + number;
    e3d_backdrop_pixel(job->in->shade->store, &job->tile, pixel % E3D_TILE, pixel / E3D_TILE, list->color[place]);
    list->place[number] = (uint16_t)place;
    return number;
}

/* Lists a pixel: one colour for each primitive that shows in it, found at the first sample that shows it. */
static int32_t list_pixel(const e3d_tile_job *job, int32_t at, int only_edges, e3d_run *runs, int32_t count, e3d_mixed_list *list)
{
    const e3d_visible_tile *planes = job->visible;
    int32_t samples = job->in->pass->pattern->count, pixel = list->pixel[at], ids[E3D_MOST_MSAA_SAMPLES];
    for (int32_t s = 0; s < samples; s++) {
        int32_t t = 0, id = shown_id(job, planes[s].id[pixel], only_edges);
        ids[s] = id;
        while (t < s && ids[t] != id)
            t++;
        if (t < s) {
            list->of[s][at] = list->of[t][at];
        } else if (id < 0) {
            list->of[s][at] = (uint16_t)background_of(job, pixel, list);
        } else {
            list->of[s][at] = (uint16_t)list->colors++;
            runs[count++] = (e3d_run){id, (uint16_t)(pixel | s << E3D_SHOWN_NUMBER), list->of[s][at]};
        }
    }
    return count;
}

/* Lists pixels from `first` on while there is room; returns the next pixel. */
static int32_t list_pixels(const e3d_tile_job *job, int32_t first, e3d_run *runs, int32_t *count, e3d_mixed_list *list)
{
    const e3d_prepared *pass = job->in->pass;
    int32_t samples = pass->pattern->count;
    int only_edges = e3d_plans(pass, E3D_PLAN_EDGES_ALONE);
    *count = list->colors = 0;
    if (!only_edges && !e3d_plans(pass, E3D_PLAN_BACKDROP)) {
        first = pass->kernels->list_mixed(job->visible, samples, first, runs, list);
        *count = list->colors;
        return first;
    }
    for (; first < list->pixels && list->colors + samples <= E3D_TILE_SAMPLES; first++)
        *count = list_pixel(job, first, only_edges, runs, *count, list);
    return first;
}

/* Sorts the listed colours by the primitives that they are shaded from; here a run's `length` is the number of its colour. */
static void show(const e3d_tile_job *job, int32_t count, e3d_mixed_list *list)
{
    e3d_runs_memory *memory = &job->memory->shade.runs;
    e3d_shown *shown = &job->memory->shade.shown;
    const e3d_run *runs = e3d_sort_runs(memory->rows, memory->spare, count);
    e3d_show_runs(runs, count, shown);
    shown->runs = 0;
    shown->pattern = job->in->pass->pattern;
    for (int32_t i = 0; i < count; i++) {
        shown->sample[i] = runs[i].sample;
        list->place[runs[i].length] = (uint16_t)i;
    }
}

/* ---- what becomes of it ---- */

/* R106: adds colours in pairs, then these sums in pairs, until one is left. */
static inline float4 sum_of(float4 color[E3D_MOST_MSAA_SAMPLES], int32_t samples)
{
    for (; samples > 1; samples /= 2)
        for (int32_t s = 0; s < samples / 2; s++)
            color[s] = color[2 * s] + color[2 * s + 1];
    return color[0];
}

/* R33, R85: adds a pixel to be encoded, by the sum of its colours. If all samples are opaque, as mostly, 1 over the sum of their
 * alphas is `share`. */
static inline void add_average(const e3d_store *store, int32_t pixel, float4 sum, float share, e3d_average *out)
{
    int32_t n = out->count++;
    float alpha = sum[3] * share, scale = alpha == 1.0f ? share : 1.0f / (sum[3] > 0.0f ? sum[3] : 1.0f);
    float4 mean = sum * splat(scale);
    for (int k = 0; k < 3; k++)
        out->color[k][n] = sum[3] > 0.0f ? mean[k] : store->background.color[k];
    out->alpha[n] = (uint8_t)lrintf(255.0f * alpha);
    out->pixel[n] = (uint16_t)pixel;
}

static void encode_averages(const e3d_tile_job *job)
{
    const e3d_prepared *pass = job->in->pass;
    e3d_average *a = &job->memory->multisample->average;
    uint32_t *rgba = job->memory->pixels.rgba;
    pass->kernels->encode(a->color[0], a->color[1], a->color[2], a->count, e3d_plans(pass, E3D_PLAN_ENCODES_SRGB), a->rgba);
    for (int32_t n = 0; n < a->count; n++)
        rgba[a->pixel[n]] = (a->rgba[n] & 0xFFFFFFu) | (uint32_t)a->alpha[n] << 24;
    a->count = 0;
}

static void average_list(const e3d_tile_job *job, int32_t first, int32_t end)
{
    const e3d_mixed_list *list = &job->memory->multisample->list;
    int32_t samples = job->in->pass->pattern->count;
    float share = 1.0f / (float)samples;
    for (int32_t p = first; p < end; p++) {
        float4 color[E3D_MOST_MSAA_SAMPLES];
        for (int32_t s = 0; s < samples; s++)
            color[s] = load4(list->color[list->place[list->of[s][p]]]);
        add_average(job->in->shade->store, list->pixel[p], sum_of(color, samples), share, &job->memory->multisample->average);
    }
    encode_averages(job);
}

/* Keeps the colours in the samples. */
static void keep_list(const e3d_tile_job *job, int32_t first, int32_t end)
{
    const e3d_mixed_list *list = &job->memory->multisample->list;
    e3d_samples *out = job->memory->multisample->samples;
    int32_t samples = job->in->pass->pattern->count;
    for (int32_t p = first; p < end; p++)
        for (int32_t s = 0; s < samples; s++) {
            const float *color = list->color[list->place[list->of[s][p]]];
            for (int k = 0; k < 3; k++)
                out[s].color[k][list->pixel[p]] = color[k];
            out[s].counts[list->pixel[p]] = color[3];
        }
}

/* Lists and shades the pixels whose bits are set, row by row. */
static void take_pixels(const e3d_tile_job *job, e3d_mixed_list *list)
{
    list->pixels = 0;
    for (int32_t y = 0; y < job->tile.height; y++)
        for (uint64_t left = job->memory->multisample->mixed[y]; left; left &= left - 1)
            list->pixel[list->pixels++] = y * E3D_TILE + __builtin_ctzll(left);
    memset(list->pixel + list->pixels, 0, E3D_PAD * sizeof *list->pixel);
}

int e3d_mixed_shade(const e3d_tile_job *job, int layered)
{
    e3d_mixed_list *list = &job->memory->multisample->list;
    job->memory->multisample->average.count = 0;
    list->place[E3D_MIXED_BACKGROUND] = E3D_MIXED_BACKGROUND;
    store4(list->color[E3D_MIXED_BACKGROUND], load4(job->in->shade->store->background.sample));
    take_pixels(job, list);
    for (int32_t first = 0, next, count; first < list->pixels; first = next) {
        next = list_pixels(job, first, job->memory->shade.runs.rows, &count, list);
        show(job, count, list);
        if (count && !e3d_alpha_shade(job, E3D_SINK_SOLID, (e3d_shaded_list){.color = list->color}))
            return 0;
        if (layered)
            keep_list(job, first, next);
        else
            average_list(job, first, next);
    }
    return 1;
}

void e3d_mixed_average_samples(const e3d_tile_job *job)
{
    e3d_multisample_memory *memory = job->memory->multisample;
    int32_t samples = job->in->pass->pattern->count;
    float share = 1.0f / (float)samples;
    memory->average.count = 0;
    for (int32_t y = 0; y < job->tile.height; y++)
        for (int32_t x = 0; x < job->tile.width; x++) {
            float4 color[E3D_MOST_MSAA_SAMPLES];
            int32_t at = y * E3D_TILE + x;
            for (int32_t s = 0; s < samples; s++) {
                const e3d_samples *from = &memory->samples[s];
                color[s] = (float4){from->color[0][at], from->color[1][at], from->color[2][at], from->counts[at]};
            }
            add_average(job->in->shade->store, at, sum_of(color, samples), share, &memory->average);
        }
    encode_averages(job);
}
