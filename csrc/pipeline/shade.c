/* shade, second half: visible samples, group by group and batch by batch, to colours and outputs (R20-R32). */
#include <string.h>

#include "pipeline/frame.h"

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

static void show_numbers(const e3d_frame *frame, e3d_batch *batch, const e3d_surface *surfaces)
{
    for (int i = 0; i < batch->count; i++) {
        const e3d_surface *s = &surfaces[batch->surface[i]];
        if (frame->mode == E3D_MODE_RANDOM)
            set_bytes(batch, i, random_bytes((uint32_t)s->local));
        else
            set_bytes(batch, i, number_bytes(frame->mode == E3D_MODE_OBJECT_ID ? s->node : s->local));
    }
}

static void show_depth(const e3d_context *context, e3d_batch *batch)
{
    const float *v = context->view + 8;
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
    const float *v = context->view;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++) {
            float n = (v[4 * k] * batch->normal[0][i] + v[4 * k + 1] * batch->normal[1][i]) +
                      v[4 * k + 2] * batch->normal[2][i];
            batch->color[k][i] = n * 0.5f + 0.5f;
        }
}

/* ---- lit and unlit ---- */

static void find_albedo(const e3d_context *context, const e3d_group *group, e3d_batch *batch,
                        const e3d_surface *surfaces)
{
    const e3d_kernels *kernels = context->kernels;
    const float *base = group->material->color;
    for (int k = 0; k < 3 && !group->textured; k++)
        for (int i = 0; i < batch->count; i++)
            batch->color[k][i] = base[k];
    if (group->textured) {
        const e3d_texture_view *texture = e3d_texture_get_view(group->material->texture);
        if (texture->filter == E3D_TRILINEAR)
            kernels->select_level(batch, surfaces, texture);
        kernels->texture(batch, texture, base);
    }
    if (group->by_vertex || group->by_instance)
        kernels->tint(batch, surfaces, group->by_vertex, group->by_instance);
}

static void light(const e3d_context *context, const e3d_group *group, e3d_batch *batch)
{
    const e3d_material *m = group->material;
    int shiny = e3d_is_shiny(m);
    context->kernels->light(batch, &context->lighting, shiny ? m->shininess : 0.0f);
    context->kernels->combine(batch, shiny ? m->specular : NULL, m->emissive);
}

static void clamp_colors(e3d_batch *batch)
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++) {
            float v = batch->color[k][i];
            v = v > 0.0f ? v : 0.0f;
            batch->color[k][i] = v < 1.0f ? v : 1.0f;
        }
}

static void find_colors(const e3d_context *context, const e3d_group *group, e3d_batch *batch,
                        const e3d_surface *surfaces)
{
    switch (context->frame->mode) {
    case E3D_MODE_LIT:
        if (group->face)
            light(context, group, batch);
        break;
    case E3D_MODE_DEPTH: show_depth(context, batch); break;
    case E3D_MODE_NORMAL: show_normal(context, batch); break;
    case E3D_MODE_RANDOM:
    case E3D_MODE_TRIANGLE_ID:
    case E3D_MODE_OBJECT_ID: show_numbers(context->frame, batch, surfaces); break;
    case E3D_MODE_UNLIT:
    case E3D_MODE_OVERDRAW: break;
    }
    clamp_colors(batch);
}

/* ---- batches ---- */

static int wanted_of(const e3d_context *context, const e3d_group *group)
{
    int wanted = context->wants & (E3D_WANT_POSITION | E3D_WANT_NORMAL | E3D_WANT_UV);
    if (group->textured && (context->wants & E3D_NEED_ALBEDO))
        wanted |= E3D_WANT_UV;
    return group->flat ? wanted | E3D_WANT_FLAT : wanted;
}

static void shade_batch(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile,
                        const e3d_group *group)
{
    e3d_batch *batch = &worker->tile->batch;
    const e3d_surface *surfaces = worker->surfaces.data;
    for (int i = batch->count; i < batch->count + E3D_PAD; i++) { /* whole vectors read these */
        batch->sample[i] = batch->sample[batch->count - 1];
        batch->surface[i] = batch->surface[batch->count - 1];
    }
    worker->counters.shaded += batch->count;
    context->kernels->interpolate(batch, surfaces, wanted_of(context, group));
    if (context->wants & E3D_NEED_ALBEDO)
        find_albedo(context, group, batch, surfaces);
    if (context->wants & E3D_NEED_OUTPUTS)
        e3d_outputs_batch(context, worker, tile);
    int hidden = group->face && context->frame->wireframe == E3D_WIRE_ONLY;
    if (!(context->wants & E3D_NEED_COLOR))
        return;
    if (hidden) {
        e3d_resolve_hidden(context, worker);
        return;
    }
    find_colors(context, group, batch, surfaces);
    e3d_resolve_batch(context, worker);
}

/* Writes whole fours, past the run's end: the next run, or padding, is written there afterwards. */
static void append_run(e3d_batch *batch, const e3d_run *run)
{
    int32_t *sample = batch->sample + batch->count, *surface = batch->surface + batch->count;
    for (int i = 0; i < run->length; i += 4)
        for (int k = 0; k < 4; k++) {
            sample[i + k] = run->sample + i + k;
            surface[i + k] = run->owner;
        }
    batch->count += run->length;
}

/* `count` sorted runs from `first` on, which are of one group. */
static void shade_group(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile,
                        const e3d_group *group, int32_t first, int32_t count)
{
    e3d_tile_memory *memory = worker->tile;
    e3d_batch *batch = &memory->batch;
    const e3d_run *run = memory->sorted + first, *end = run + count;
    while (run < end) {
        memory->batch_runs = run;
        for (batch->count = 0; run < end && batch->count + run->length <= E3D_BATCH; run++)
            append_run(batch, run);
        memory->batch_run_count = (int32_t)(run - memory->batch_runs);
        shade_batch(context, worker, tile, group);
    }
}

/* Runs are owned by their surfaces from here on. */
static int find_surfaces(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile,
                         int32_t count)
{
    e3d_run *runs = worker->tile->runs;
    for (int32_t i = 0; i < count; i++) {
        runs[i].owner = e3d_surface_of(context, worker, tile, runs[i].owner);
        if (runs[i].owner < 0)
            return 0;
    }
    return 1;
}

/* Counting sort by group, then surface, stable: what is shaded alike stands together. */
static void sort_runs(e3d_worker *worker, int32_t count)
{
    e3d_tile_memory *memory = worker->tile;
    e3d_surface *surfaces = worker->surfaces.data;
    e3d_group *groups = worker->groups.data;
    int32_t start = 0;
    for (size_t s = 0; s < worker->surfaces.count; s++)
        surfaces[s].runs = 0;
    for (size_t g = 0; g < worker->groups.count; g++)
        groups[g].count = 0;
    for (int32_t i = 0; i < count; i++)
        surfaces[memory->runs[i].owner].runs++;
    for (size_t s = 0; s < worker->surfaces.count; s++)
        groups[surfaces[s].group].count += surfaces[s].runs;
    for (size_t g = 0; g < worker->groups.count; g++) {
        groups[g].start = groups[g].next = start;
        start += groups[g].count;
    }
    for (size_t s = 0; s < worker->surfaces.count; s++) {
        e3d_group *group = &groups[surfaces[s].group];
        surfaces[s].next = group->next;
        group->next += surfaces[s].runs;
    }
    for (int32_t i = 0; i < count; i++)
        memory->sorted[surfaces[memory->runs[i].owner].next++] = memory->runs[i];
}

int e3d_shade_runs(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile, int32_t count)
{
    if (!find_surfaces(context, worker, tile, count))
        return 0;
    const e3d_group *groups = worker->groups.data;
    sort_runs(worker, count);
    for (size_t g = 0; g < worker->groups.count; g++)
        shade_group(context, worker, tile, &groups[g], groups[g].start, groups[g].count);
    return 1;
}
