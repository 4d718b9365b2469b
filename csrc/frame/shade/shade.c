/* shade, second half: sends visible samples, bucket by bucket and batch by batch, to their sink (R20-R32). */
#include <string.h>

#include "base/grow.h"
#include "base/limits.h"
#include "data/srgb_tables.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/shading.h"
#include "kernels/types/shown.h"
#include "frame/pass/prepared.h"
#include "frame/shade/receivers.h"
#include "frame/shade/runs.h"
#include "frame/shade/shade.h"
#include "frame/shade/steps.h"
#include "frame/shade/surface.h"

void e3d_shade_prepare(e3d_shade_in *in)
{
    for (int c = 0; c < 256; c++)
        in->unorm8[c] = (float)(in->pass->frame->decode_srgb ? SRGB_TO_LINEAR16[c] : c * 257) * E3D_UNORM16;
}

void e3d_shade_free(e3d_shade_memory *memory)
{
    e3d_array_free(&memory->primitives);
    e3d_array_free(&memory->buckets);
}

/* Primitives of a chain that are neighbours, and so are their samples or runs. In a tile of one material all of them are. */
typedef struct stretch {
    int32_t first, end; /* primitives */
    int32_t at, behind;
} stretch;

/* Finds the stretch that begins with primitive `first`; returns the primitive behind it in the chain. If there is one bucket,
 * the stretch is the whole tile. */
static int32_t find_stretch(const e3d_shade_memory *memory, int32_t first, int32_t end, stretch *out)
{
    const e3d_visible_primitive *primitives = memory->primitives.data;
    int32_t p = first;
    if (memory->buckets.count == 1) {
        int32_t behind = end < 0 ? (int32_t)memory->primitives.count : end;
        *out = (stretch){first, behind, primitives[first].first, primitives[behind - 1].end};
        return end;
    }
    *out = (stretch){first, first, primitives[first].first, primitives[first].first};
    for (; p != end && p == out->end; p = primitives[p].next) {
        out->behind = primitives[p].end;
        out->end++;
    }
    return p;
}

/* Adds as much of a stretch as the batch has room for. */
static void take(const e3d_kernels *kernels, e3d_shade_memory *memory, int32_t primitive, stretch *s)
{
    const e3d_shown *shown = &memory->shown;
    s->at += (shown->runs      ? kernels->take_runs
              : shown->pattern ? kernels->take_placed
                               : kernels->take_shown)(shown, s->at, s->behind - s->at, primitive, &memory->batch);
}

static void shade_batch(const e3d_steps *s)
{
    for (int k = 0; k < s->count; k++)
        s->step[k](s);
}

/* Shades the samples of primitives whose surfaces are known; the first one is surface 0. */
static void shade_primitives(const e3d_steps *steps, int32_t first, int32_t end)
{
    e3d_shade_memory *memory = steps->out->memory;
    e3d_batch *batch = &memory->batch;
    int32_t surface = 0;
    batch->count = batch->facets = 0;
    batch->pattern = memory->shown.pattern;
    batch->at_samples = memory->shown.at_samples;
    batch->finest = memory->shown.finest;
    memcpy(batch->beside, memory->shown.beside, sizeof batch->beside);
    for (int32_t p = first; p != end;) {
        stretch s;
        p = find_stretch(memory, p, end, &s);
        for (;;) {
            take(steps->pass->kernels, memory, s.first - surface, &s);
            if (s.at == s.behind)
                break;
            shade_batch(steps);
            batch->count = 0;
        }
        surface += s.end - s.first;
    }
    shade_batch(steps);
}

static void shade_bucket(const e3d_shade_in *in, const e3d_tile *tile, const e3d_bucket *bucket, const e3d_shade_out *out)
{
    const e3d_steps s = e3d_choose_steps(in, bucket, out);
    e3d_shade_memory *memory = out->memory;
    memory->batch.unmapped_normal = bucket->mapped ? memory->textures.batch.shading_normal : NULL;
    for (int32_t first = bucket->first, end; first >= 0; first = end) {
        end = e3d_add_surfaces(in, bucket, first, s.wanted, memory);
        if (s.wanted & E3D_WANT_SURFACE)
            e3d_find_surfaces(in->pass, tile, bucket, s.wanted, memory);
        if (e3d_receives_exact_shadows(in->pass, bucket) && s.wanted & E3D_WANT_POSITION)
            e3d_find_receivers(&s, memory);
        shade_primitives(&s, first, end);
    }
}

int e3d_shade_shown(const e3d_shade_in *in, const e3d_tile *tile, const e3d_shade_out *out)
{
    if (!e3d_find_visible(in, out->memory))
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

int e3d_shade_plane(const e3d_shade_in *in, const e3d_tile *tile, int32_t count, int32_t number, const e3d_shade_out *out)
{
    e3d_shade_memory *memory = out->memory;
    e3d_show_runs(e3d_sort_runs(memory->runs.rows, memory->runs.spare, count), count, &memory->shown);
    memory->shown.pattern = in->pass->pattern;
    memory->shown.at_samples = 1;
    for (int i = 0; i < E3D_BATCH + E3D_PAD; i++)
        memory->batch.number[i] = number; /* take_runs leaves it */
    return e3d_shade_shown(in, tile, out);
}
