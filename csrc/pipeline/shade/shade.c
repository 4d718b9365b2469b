/* shade, second half: visible samples, bucket by bucket and batch by batch, to colours and outputs (R20-R32). */
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "core/srgb_tables.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/fog.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"
#include "pipeline/shade/alpha.h"
#include "pipeline/shade/ambient.h"
#include "pipeline/shade/job.h"
#include "pipeline/shade/maps.h"
#include "pipeline/shade/runs.h"
#include "pipeline/shade/shade.h"
#include "pipeline/shade/surface.h"
#include "pipeline/shade/values.h"
#include "pipeline/store/blank.h"
#include "pipeline/store/resolve.h"

void e3d_shade_prepare(e3d_shade_in *in)
{
    for (int c = 0; c < 256; c++)
        in->unorm8[c] = (float)(in->pass->frame->decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257) * E3D_UNORM16;
}

void e3d_shade_free(e3d_shade_memory *memory)
{
    e3d_array_free(&memory->pieces);
    e3d_array_free(&memory->buckets);
}

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

static void show_numbers(e3d_mode mode, e3d_shade_memory *memory)
{
    const e3d_visible_primitive *pieces = memory->pieces.data;
    e3d_batch *batch = &memory->batch;
    for (int i = 0; i < batch->count; i++) {
        const e3d_visible_primitive *piece = &pieces[memory->surfaces.piece[batch->surface[i]]];
        if (mode == E3D_MODE_RANDOM)
            set_bytes(batch, i, random_bytes((uint32_t)piece->local));
        else
            set_bytes(batch, i,
                      number_bytes(mode == E3D_MODE_OBJECT_ID ? e3d_object_id(piece->draw->draw, piece->instance) : piece->local));
    }
}

static void show_depth(const e3d_prepared *pass, e3d_batch *batch)
{
    const float *v = pass->view->rows + 8;
    float near = pass->frame->depth_near;
    float scale = 1.0f / (pass->frame->depth_far - near);
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

static void show_normal(const e3d_prepared *pass, e3d_batch *batch)
{
    const float *v = pass->view->rows;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++) {
            float n = (v[4 * k] * batch->normal[0][i] + v[4 * k + 1] * batch->normal[1][i]) +
                      v[4 * k + 2] * batch->normal[2][i];
            batch->color[k][i] = n * 0.5f + 0.5f;
        }
}

/* ---- lit and unlit ---- */

static void find_albedo(const e3d_kernels *kernels, const e3d_bucket *bucket, e3d_shade_memory *memory)
{
    e3d_batch *batch = &memory->batch;
    const float *base = bucket->material->color;
    for (int k = 0; k < 3 && !bucket->textured; k++)
        for (int i = 0; i < batch->count; i++)
            batch->color[k][i] = base[k];
    if (bucket->textured)
        kernels->texture(batch, &memory->surfaces, e3d_texture_get_view(bucket->material->texture.texture), base);
    if (bucket->by_vertex || bucket->by_instance)
        kernels->tint(batch, &memory->surfaces, bucket->by_vertex, bucket->by_instance);
}

/* Whether exact shadows may fall on a bucket's samples. */
static int hides_lights(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return e3d_plans(pass, E3D_PLAN_HIDES) && bucket->face && !bucket->material->is_unlit && !bucket->unshadowed;
}

static void light(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_batch *batch)
{
    const e3d_material *m = bucket->material;
    int shiny = e3d_adds(m->specular);
    pass->kernels->light(batch, e3d_lighting_of(pass->view, bucket->unshadowed), shiny ? m->shininess : 0.0f);
    pass->kernels->combine(batch, shiny ? m->specular : NULL, m->emissive, pass->view->lighting.exposure);
}

static void find_colors(const e3d_prepared *pass, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    e3d_shade_memory *memory = out->memory;
    switch (pass->frame->mode) {
    case E3D_MODE_LIT:
        e3d_find_visibility(pass, out);
        if (hides_lights(pass, bucket))
            pass->kernels->hide(&memory->batch, &pass->view->lighting, pass->casters, &memory->receivers);
        if (bucket->face && bucket->material->is_physical && !bucket->material->is_unlit)
            e3d_light_physical(pass, bucket, memory);
        else if (bucket->face && !bucket->material->is_unlit)
            light(pass, bucket, &memory->batch);
        break;
    case E3D_MODE_DEPTH: show_depth(pass, &memory->batch); break;
    case E3D_MODE_NORMAL: show_normal(pass, &memory->batch); break;
    case E3D_MODE_RANDOM:
    case E3D_MODE_TRIANGLE_ID:
    case E3D_MODE_OBJECT_ID: show_numbers(pass->frame->mode, memory); break;
    case E3D_MODE_UNLIT:
    case E3D_MODE_OVERDRAW: break;
    }
}

/* ---- fog and tone (R117, R121) ---- */

static int is_lit(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return pass->frame->mode == E3D_MODE_LIT && bucket->face && !bucket->material->is_unlit;
}

static const e3d_fog_view *fog_of(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return e3d_plans(pass, E3D_PLAN_ADDS_FOG) ? &pass->view->fog[is_lit(pass, bucket)] : NULL;
}

static e3d_tone_mapping tone_of(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return is_lit(pass, bucket) ? pass->frame->tone_mapping : E3D_TONE_NONE;
}

/* The radiance of a batch. */
static void find_radiance(const e3d_prepared *pass, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    const e3d_fog_view *fog = fog_of(pass, bucket);
    e3d_batch *batch = &out->memory->batch;
    float *const color[3] = {batch->color[0], batch->color[1], batch->color[2]};
    const e3d_lane_array *places = e3d_batch_places(batch);
    const float *const position[3] = {places[0], places[1], places[2]};
    find_colors(pass, bucket, out);
    if (fog)
        pass->kernels->fog(fog, position, batch->count, color);
}

static void map_tone(const e3d_prepared *pass, const e3d_bucket *bucket, e3d_batch *batch)
{
    float *const color[3] = {batch->color[0], batch->color[1], batch->color[2]};
    e3d_tone_mapping tone = tone_of(pass, bucket);
    if (tone != E3D_TONE_NONE)
        pass->kernels->tone(tone, color, batch->count);
}

/* ---- batches ---- */

/* What the batches of a bucket need of their surfaces: identities need nothing. */
static int wanted_to_show(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    int wanted = e3d_plan_inputs(pass->plan), colored = e3d_plans(pass, E3D_PLAN_BASE_COLOR);
    if (bucket->mapped)
        wanted |= E3D_WANT_WEIGHTS | E3D_WANT_MAPS;
    else if (bucket->textured && colored) {
        wanted |= e3d_texture_wanted(e3d_texture_get_view(bucket->material->texture.texture));
    }
    if (pass->targets->barycentric || (colored && bucket->by_vertex))
        wanted |= E3D_WANT_WEIGHTS;
    if (wanted || (colored && bucket->by_instance))
        wanted |= E3D_WANT_SURFACE;
    if (pass->frame->normals == E3D_NORMALS_FACET && is_lit(pass, bucket) && wanted & E3D_WANT_POSITION)
        wanted |= E3D_WANT_FACET;
    return bucket->flat ? wanted | E3D_WANT_FLAT : wanted;
}

static int wanted_of(const e3d_prepared *pass, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    if (!out->alpha || out->alpha->use == E3D_ALPHA_OUTPUTS || out->alpha->use == E3D_SOLID_KEEP)
        return wanted_to_show(pass, bucket);
    return e3d_alpha_wanted(bucket) | (out->alpha->use == E3D_ALPHA_TEST ? 0 : wanted_to_show(pass, bucket));
}

/* Whether samples go straight to where colours are kept. */
static int is_painted(const e3d_prepared *pass, const e3d_bucket *bucket)
{
    return e3d_plans(pass, E3D_PLAN_PAINTS) && !bucket->mapped && !(bucket->face && pass->frame->wireframe == E3D_WIRE_ONLY);
}

/* To pixels, or, of a list, to colours that stay in the batch. */
static void paint_batch(const e3d_prepared *pass, const e3d_bucket *bucket, int wanted, const e3d_shade_out *out)
{
    const e3d_material *m = bucket->material;
    int lit = is_lit(pass, bucket), shiny = e3d_adds(m->specular);
    const e3d_paint paint = {
        .wanted = wanted,
        .texture = bucket->textured ? e3d_texture_get_view(m->texture.texture) : NULL,
        .base = m->color,
        .by_vertex = bucket->by_vertex,
        .by_instance = bucket->by_instance,
        .lighting = lit ? e3d_lighting_of(pass->view, bucket->unshadowed) : NULL,
        .shininess = shiny ? m->shininess : 0.0f,
        .specular = shiny ? m->specular : NULL,
        .emissive = e3d_adds(m->emissive) ? m->emissive : NULL,
        .srgb = e3d_plans(pass, E3D_PLAN_ENCODES_SRGB),
        .samples = out->pixels->sampled && !out->alpha ? &out->pixels->samples : NULL,
        .fog = fog_of(pass, bucket),
        .tone = tone_of(pass, bucket),
    };
    if (lit)
        e3d_find_visibility(pass, out);
    pass->kernels->paint(&out->memory->batch, &out->memory->surfaces, &paint, out->alpha ? NULL : out->pixels->rgba);
}

/* The outputs beside colour. Afterwards the batch has its radiance, if that is one of them. */
static void put_outputs(const e3d_shade_in *in, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    e3d_outputs_batch(in->store, bucket, out->memory, out->pixels);
    if (e3d_plans(in->pass, E3D_PLAN_KEEPS_RADIANCE)) {
        find_radiance(in->pass, bucket, out);
        e3d_outputs_radiance(in->store, &out->memory->batch, out->pixels);
    }
}

/* A batch whose samples do not simply show. */
static void shade_alpha(const e3d_shade_in *in, const e3d_bucket *bucket, int wanted, const e3d_shade_out *out)
{
    const e3d_prepared *pass = in->pass;
    e3d_shade_memory *memory = out->memory;
    e3d_alpha_use use = out->alpha->use;
    if (use == E3D_SOLID_KEEP && is_painted(pass, bucket)) {
        memory->shaded += memory->batch.count;
        paint_batch(pass, bucket, wanted, out);
        e3d_alpha_batch(pass, bucket, out);
        return;
    }
    if (wanted & E3D_WANT_SURFACE)
        pass->kernels->interpolate(&memory->batch, &memory->surfaces, wanted);
    if (bucket->mapped)
        e3d_find_map_batch(pass, bucket, wanted, memory);
    else if (use != E3D_ALPHA_TEST && e3d_plans(pass, E3D_PLAN_BASE_COLOR))
        find_albedo(pass->kernels, bucket, memory);
    if (use == E3D_ALPHA_OUTPUTS) {
        e3d_outputs_batch(in->store, bucket, memory, out->pixels);
        return;
    }
    if (use != E3D_ALPHA_TEST) {
        memory->shaded += memory->batch.count;
        find_radiance(pass, bucket, out);
        if (out->alpha->light)
            memcpy(memory->light, memory->batch.color, sizeof memory->light);
        map_tone(pass, bucket, &memory->batch);
    }
    e3d_alpha_batch(pass, bucket, out);
}

static void shade_batch(const e3d_shade_in *in, const e3d_bucket *bucket, int wanted, const e3d_shade_out *out)
{
    if (out->alpha) {
        shade_alpha(in, bucket, wanted, out);
        return;
    }
    const e3d_prepared *pass = in->pass;
    e3d_batch *batch = &out->memory->batch;
    out->memory->shaded += batch->count;
    e3d_blank_some(in->store, in->bins, out->blank);
    if (is_painted(pass, bucket)) {
        paint_batch(pass, bucket, wanted, out);
        return;
    }
    if (wanted & E3D_WANT_SURFACE)
        pass->kernels->interpolate(batch, &out->memory->surfaces, wanted);
    if (bucket->mapped)
        e3d_find_map_batch(pass, bucket, wanted, out->memory);
    else if (e3d_plans(pass, E3D_PLAN_BASE_COLOR))
        find_albedo(pass->kernels, bucket, out->memory);
    if (e3d_plans(pass, E3D_PLAN_OUTPUTS))
        put_outputs(in, bucket, out);
    int hidden = bucket->face && pass->frame->wireframe == E3D_WIRE_ONLY;
    if (!e3d_plans(pass, E3D_PLAN_COLORS))
        return;
    if (hidden) {
        e3d_resolve_hidden(in->store, batch, out->pixels);
        return;
    }
    if (!e3d_plans(pass, E3D_PLAN_KEEPS_RADIANCE))
        find_radiance(pass, bucket, out);
    map_tone(pass, bucket, batch);
    e3d_resolve_batch(in->store, batch, out->pixels);
}

/* Pieces of a chain that stand side by side, and so do their samples or runs, as in a tile of one material all do. */
typedef struct stretch {
    int32_t first, end; /* pieces */
    int32_t at, behind;
} stretch;

/* The one that begins with piece `first`; the piece behind it in the chain. A single bucket has all pieces of the tile. */
static int32_t find_stretch(const e3d_shade_memory *memory, int32_t first, int32_t end, stretch *out)
{
    const e3d_visible_primitive *pieces = memory->pieces.data;
    int32_t p = first;
    if (memory->buckets.count == 1) {
        int32_t behind = end < 0 ? (int32_t)memory->pieces.count : end;
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
static void take(const e3d_kernels *kernels, e3d_shade_memory *memory, int32_t piece, stretch *s)
{
    const e3d_shown *shown = &memory->shown;
    s->at += (shown->runs      ? kernels->take_runs
              : shown->pattern ? kernels->take_placed
                               : kernels->take_shown)(shown, s->at, s->behind - s->at, piece, &memory->batch);
}

/* The samples of pieces whose surfaces, 0 and so on, are known. */
static void shade_pieces(const e3d_shade_in *in, const e3d_bucket *bucket, int32_t first, int32_t end, int wanted, const e3d_shade_out *out)
{
    e3d_batch *batch = &out->memory->batch;
    int32_t surface = 0;
    batch->count = batch->facets = 0;
    batch->pattern = out->memory->shown.pattern;
    for (int32_t p = first; p != end;) {
        stretch s;
        p = find_stretch(out->memory, p, end, &s);
        for (;;) {
            take(in->pass->kernels, out->memory, s.first - surface, &s);
            if (s.at == s.behind)
                break;
            shade_batch(in, bucket, wanted, out);
            batch->count = 0;
        }
        surface += s.end - s.first;
    }
    shade_batch(in, bucket, wanted, out);
}

static void shade_bucket(const e3d_shade_in *in, const e3d_tile *tile, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    int wanted = wanted_of(in->pass, bucket, out);
    out->memory->batch.unmapped_normal = bucket->mapped ? out->memory->maps.batch.shading_normal : NULL;
    for (int32_t first = bucket->first, end; first >= 0; first = end) {
        end = e3d_add_surfaces(in, bucket, first, wanted, out->memory);
        if (wanted & E3D_WANT_SURFACE)
            e3d_find_surfaces(in->pass, tile, bucket, wanted, out->memory);
        if (hides_lights(in->pass, bucket) && wanted & E3D_WANT_POSITION)
            in->pass->kernels->receivers(&out->memory->surfaces, &out->memory->receivers);
        shade_pieces(in, bucket, first, end, wanted, out);
    }
}

int e3d_shade_shown(const e3d_shade_in *in, const e3d_tile *tile, const e3d_shade_out *out)
{
    if (!e3d_find_pieces(in, out->memory))
        return 0;
    const e3d_bucket *buckets = out->memory->buckets.data;
    for (size_t g = 0; g < out->memory->buckets.count; g++)
        shade_bucket(in, tile, &buckets[g], out);
    return 1;
}

int e3d_shade_runs(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, const e3d_shade_out *out)
{
    e3d_runs_memory *runs = &out->memory->runs;
    e3d_show_runs(e3d_sort_runs(runs->rows, runs->spare, count), count, &out->memory->shown);
    return e3d_shade_shown(in, tile, out);
}
