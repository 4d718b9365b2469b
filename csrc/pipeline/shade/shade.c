/* shade, second half: visible samples, bucket by bucket and batch by batch, to colours and outputs (R20-R32). */
#include <string.h>

#include "core/limits.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/plan.h"
#include "pipeline/shade/runs.h"
#include "pipeline/shade/shade.h"
#include "pipeline/shade/surface.h"
#include "pipeline/shade/values.h"
#include "pipeline/state/context.h"
#include "pipeline/state/tile_memory.h"
#include "pipeline/state/worker.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/outputs.h"
#include "pipeline/store/resolve.h"

/* ---- display modes (R32) ---- */

static void set_bytes(e3d_batch *batch, int i, uint32_t bytes)
{
    for (int k = 0; k < 3; k++)
        batch->color[k][i] = (float)(bytes >> (8 * k) & 255u) * E3D_UNORM8;
}

static uint32_t random_bytes(uint32_t h)
{
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    uint32_t bytes = 0;
    for (int k = 0; k < 3; k++)
        bytes |= (64 + (h >> (8 * k) & 255u) * 3 / 4) << (8 * k);
    return bytes;
}

static uint32_t number_bytes(int32_t id) { return ((uint32_t)id + 1) * 0x9E3779B1u & 0xFFFFFFu; }

static void show_numbers(const e3d_frame *frame, const e3d_worker *worker, e3d_batch *batch)
{
    const e3d_visible_primitive *pieces = worker->surface.pieces.data;
    for (int i = 0; i < batch->count; i++) {
        const e3d_visible_primitive *piece = &pieces[worker->tile->surfaces.piece[batch->surface[i]]];
        if (frame->mode == E3D_MODE_RANDOM)
            set_bytes(batch, i, random_bytes((uint32_t)piece->local));
        else
            set_bytes(batch, i,
                      number_bytes(frame->mode == E3D_MODE_OBJECT_ID ? e3d_object_id(piece->draw->draw, piece->instance) : piece->local));
    }
}

static void show_depth(const e3d_context *context, e3d_batch *batch)
{
    const float *v = context->view->rows + 8;
    float near = context->frame->depth_near;
    float scale = 1.0f / (context->frame->depth_far - near);
    for (int i = 0; i < batch->count; i++) {
        float z = ((v[0] * batch->position[0][i] + v[1] * batch->position[1][i]) +
                   v[2] * batch->position[2][i]) + v[3];
        float t = ((0.0f - z) - near) * scale;
        t = t > 0.0f ? t : 0.0f;
        t = t < 1.0f ? t : 1.0f;
        for (int k = 0; k < 3; k++)
            batch->color[k][i] = 1.0f - t;
    }
}

static void show_normal(const e3d_context *context, e3d_batch *batch)
{
    const float *v = context->view->rows;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++) {
            float n = (v[4 * k] * batch->normal[0][i] + v[4 * k + 1] * batch->normal[1][i]) +
                      v[4 * k + 2] * batch->normal[2][i];
            batch->color[k][i] = n * 0.5f + 0.5f;
        }
}

/* ---- lit and unlit ---- */

static void find_albedo(const e3d_context *context, const e3d_bucket *bucket, e3d_batch *batch,
                        const e3d_surfaces *surfaces)
{
    const e3d_kernels *kernels = context->kernels;
    const float *base = bucket->material->color;
    for (int k = 0; k < 3 && !bucket->textured; k++)
        for (int i = 0; i < batch->count; i++)
            batch->color[k][i] = base[k];
    if (bucket->textured) {
        kernels->texture(batch, e3d_texture_get_view(bucket->material->texture), base);
    }
    if (bucket->by_vertex || bucket->by_instance)
        kernels->tint(batch, surfaces, bucket->by_vertex, bucket->by_instance);
}

static void light(const e3d_context *context, const e3d_bucket *bucket, e3d_batch *batch)
{
    const e3d_material *m = bucket->material;
    int shiny = e3d_adds(m->specular);
    context->kernels->light(batch, &context->view->lighting, shiny ? m->shininess : 0.0f);
    context->kernels->combine(batch, shiny ? m->specular : NULL, m->emissive);
}

static void find_colors(const e3d_context *context, const e3d_worker *worker, const e3d_bucket *bucket,
                        e3d_batch *batch)
{
    switch (context->frame->mode) {
    case E3D_MODE_LIT:
        if (bucket->face)
            light(context, bucket, batch);
        break;
    case E3D_MODE_DEPTH: show_depth(context, batch); break;
    case E3D_MODE_NORMAL: show_normal(context, batch); break;
    case E3D_MODE_RANDOM:
    case E3D_MODE_TRIANGLE_ID:
    case E3D_MODE_OBJECT_ID: show_numbers(context->frame, worker, batch); break;
    case E3D_MODE_UNLIT:
    case E3D_MODE_OVERDRAW: break;
    }
}

/* ---- batches ---- */

/* What the batches of a bucket need of their surfaces: identities need nothing. */
static int wanted_of(const e3d_context *context, const e3d_bucket *bucket)
{
    int wanted = e3d_plan_inputs(context->plan), colored = e3d_plans(context, E3D_PLAN_BASE_COLOR);
    if (bucket->textured && colored) {
        wanted |= E3D_WANT_UV;
        if (e3d_texture_get_view(bucket->material->texture)->filter == E3D_TRILINEAR)
            wanted |= E3D_WANT_LEVEL;
    }
    if (context->targets->barycentric || (colored && bucket->by_vertex))
        wanted |= E3D_WANT_WEIGHTS;
    if (wanted || (colored && bucket->by_instance))
        wanted |= E3D_WANT_SURFACE;
    return bucket->flat ? wanted | E3D_WANT_FLAT : wanted;
}

/* Whether samples go straight to where colours are kept. */
static int is_painted(const e3d_context *context, const e3d_bucket *bucket)
{
    return e3d_plans(context, E3D_PLAN_PAINTS) && !(bucket->face && context->frame->wireframe == E3D_WIRE_ONLY);
}

static void paint_batch(const e3d_context *context, e3d_worker *worker, const e3d_bucket *bucket, int wanted)
{
    const e3d_material *m = bucket->material;
    int lit = context->frame->mode == E3D_MODE_LIT && bucket->face, shiny = e3d_adds(m->specular);
    const e3d_paint paint = {
        .wanted = wanted,
        .texture = bucket->textured ? e3d_texture_get_view(m->texture) : NULL,
        .base = m->color,
        .by_vertex = bucket->by_vertex,
        .by_instance = bucket->by_instance,
        .lighting = lit ? &context->view->lighting : NULL,
        .shininess = shiny ? m->shininess : 0.0f,
        .specular = shiny ? m->specular : NULL,
        .emissive = e3d_adds(m->emissive) ? m->emissive : NULL,
        .srgb = e3d_plans(context, E3D_PLAN_ENCODES_SRGB),
        .samples = context->frame->samples_axis > 1 ? &worker->tile->pixels.samples : NULL,
    };
    context->kernels->paint(&worker->tile->batch, &worker->tile->surfaces, &paint, worker->tile->pixels.rgba);
}

static void shade_batch(const e3d_context *context, e3d_worker *worker, const e3d_bucket *bucket, int wanted)
{
    e3d_batch *batch = &worker->tile->batch;
    const e3d_surfaces *surfaces = &worker->tile->surfaces;
    worker->counters.shaded += batch->count;
    e3d_blank_some(context, worker);
    if (is_painted(context, bucket)) {
        paint_batch(context, worker, bucket, wanted);
        return;
    }
    if (wanted & E3D_WANT_SURFACE)
        context->kernels->interpolate(batch, surfaces, wanted);
    if (e3d_plans(context, E3D_PLAN_BASE_COLOR))
        find_albedo(context, bucket, batch, surfaces);
    if (e3d_plans(context, E3D_PLAN_OUTPUTS))
        e3d_outputs_batch(context, worker);
    int hidden = bucket->face && context->frame->wireframe == E3D_WIRE_ONLY;
    if (!e3d_plans(context, E3D_PLAN_COLORS))
        return;
    if (hidden) {
        e3d_resolve_hidden(context, worker);
        return;
    }
    find_colors(context, worker, bucket, batch);
    e3d_resolve_batch(context, worker);
}

/* Pieces of a chain that stand side by side, and so do their samples or runs, as in a tile of one material all do. */
typedef struct stretch {
    int32_t first, end; /* pieces */
    int32_t at, behind;
} stretch;

/* The one that begins with piece `first`; the piece behind it in the chain. A single bucket has all pieces of the tile. */
static int32_t find_stretch(const e3d_worker *worker, int32_t first, int32_t end, stretch *out)
{
    const e3d_visible_primitive *pieces = worker->surface.pieces.data;
    int32_t p = first;
    if (worker->surface.buckets.count == 1) {
        int32_t behind = end < 0 ? (int32_t)worker->surface.pieces.count : end;
        *out = (stretch){first, behind, pieces[first].first, pieces[behind - 1].end};
        return end;
    }
    *out = (stretch){first, first, pieces[first].first, pieces[first].first};
    for (; p != end && p == out->end; p = pieces[p].next) {
        out->behind = pieces[p].end;
        out->end++;
    }
    return p;
}

/* Adds as much of a stretch as the batch has room for. */
static void take(const e3d_context *context, e3d_worker *worker, int32_t piece, stretch *s)
{
    const e3d_shown *shown = &worker->tile->shown;
    e3d_batch *batch = &worker->tile->batch;
    const e3d_kernels *kernels = context->kernels;
    s->at += (shown->runs ? kernels->take_runs : kernels->take_shown)(shown, s->at, s->behind - s->at, piece, batch);
}

/* The samples of pieces whose surfaces, 0 and so on, are known. */
static void shade_pieces(const e3d_context *context, e3d_worker *worker, const e3d_bucket *bucket, int32_t first, int32_t end, int wanted)
{
    e3d_batch *batch = &worker->tile->batch;
    int32_t surface = 0;
    batch->count = 0;
    for (int32_t p = first; p != end;) {
        stretch s;
        p = find_stretch(worker, p, end, &s);
        for (;;) {
            take(context, worker, s.first - surface, &s);
            if (s.at == s.behind)
                break;
            shade_batch(context, worker, bucket, wanted);
            batch->count = 0;
        }
        surface += s.end - s.first;
    }
    shade_batch(context, worker, bucket, wanted);
}

static void shade_bucket(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile,
                        const e3d_bucket *bucket)
{
    int wanted = wanted_of(context, bucket);
    for (int32_t first = bucket->first, end; first >= 0; first = end) {
        end = e3d_add_surfaces(context, worker, bucket, first, wanted);
        if (wanted & E3D_WANT_SURFACE)
            e3d_find_surfaces(context, worker, tile, wanted);
        shade_pieces(context, worker, bucket, first, end, wanted);
    }
}

int e3d_shade_shown(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile)
{
    if (!e3d_find_pieces(context, worker))
        return 0;
    const e3d_bucket *buckets = worker->surface.buckets.data;
    for (size_t g = 0; g < worker->surface.buckets.count; g++)
        shade_bucket(context, worker, tile, &buckets[g]);
    return 1;
}

int e3d_shade_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t count)
{
    e3d_runs_memory *runs = &worker->tile->runs;
    e3d_show_runs(e3d_sort_runs(runs->rows, runs->spare, count), count, &worker->tile->shown);
    return e3d_shade_shown(context, worker, tile);
}
