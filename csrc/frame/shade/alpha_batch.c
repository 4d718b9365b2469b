/* shade, the last steps of samples with alpha (R80). Their alphas are kept for the alpha test, or their alphas and colours for
 * the A-buffer, or they are blended over the tile at once (R84). */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "base/vectors.h"
#include "kernels/kernels.h"
#include "kernels/types/bending.h"
#include "kernels/types/texture_slots.h"
#include "kernels/types/shading.h"
#include "frame/shade/alpha_batch.h"
#include "frame/shade/texture_slots.h"
#include "frame/shade/surface.h"

float e3d_alpha_cutoff(const e3d_material *material)
{
    return material->alpha_mode == E3D_ALPHA_MASK ? material->alpha_cutoff : E3D_LEAST_ALPHA;
}

int e3d_alpha_wanted(const e3d_bucket *bucket)
{
    int wanted = bucket->by_vertex || bucket->by_instance ? E3D_WANT_ALPHA | E3D_WANT_SURFACE : 0;
    if (bucket->by_vertex)
        wanted |= E3D_WANT_WEIGHTS;
    if (bucket->mapped)
        return wanted | E3D_WANT_WEIGHTS | E3D_WANT_SURFACE;
    if (bucket->textured && !e3d_texture_get_view(bucket->material->texture.texture)->is_opaque) {
        wanted |= E3D_WANT_SURFACE | e3d_texture_wanted(e3d_texture_get_view(bucket->material->texture.texture));
    }
    return wanted;
}

/* The place in the list of the batch's next sample, which is of that primitive. A primitive's samples follow each other. */
static int32_t next_place(const e3d_visible_primitive *primitives, int32_t primitive, e3d_shaded_list *list)
{
    if (primitive != list->primitive) {
        list->primitive = primitive;
        list->at = primitives[primitive].first;
    }
    return list->at++;
}

/* R190: lod of each sample of a batch, or NULL where the alpha's texture has none. */
static const int32_t *lods_of(const e3d_bucket *bucket, const e3d_shade_memory *memory)
{
    const e3d_read_textures *read = &memory->textures.read;
    int32_t texture = bucket->mapped ? read->of_slot[E3D_SLOT_TEXTURE] : -1;
    if (bucket->mapped ? texture < 0 : !bucket->textured)
        return NULL;
    const e3d_texture_view *view = e3d_texture_get_view(bucket->material->texture.texture);
    if (view->filter != E3D_TRILINEAR || view->is_opaque)
        return NULL;
    return bucket->mapped ? memory->textures.batch.lod[read->read[texture].place] : memory->batch.lod;
}

void e3d_keep_alphas(const e3d_steps *s)
{
    const e3d_shade_memory *memory = s->out->memory;
    const e3d_batch *batch = &memory->batch;
    e3d_shaded_list *list = s->out->list;
    const int32_t *lods = list->lod ? lods_of(s->bucket, memory) : NULL;
    for (int i = 0; i < batch->count; i++) {
        int32_t place = next_place(memory->primitives.data, memory->surfaces.primitive[batch->surface[i]], list);
        list->alpha[place] = batch->alpha[i];
        if (list->lod)
            list->lod[place] = lods ? lods[i] : 0;
    }
}

/* Transposes the clamped colours of four samples from channels to rows. */
static inline void keep_four(const e3d_batch *batch, int i, float sign, float (*color)[4])
{
    float4 channel[4], zero = splat(0.0f), one = splat(1.0f);
    for (int k = 0; k < 3; k++)
        channel[k] = less_of(more_of(load4(batch->color[k] + i), zero), one);
    channel[3] = splat(sign) * load4(batch->alpha + i);
    float4 low = LANES(channel[0], channel[1], 0, 4, 1, 5), low2 = LANES(channel[2], channel[3], 0, 4, 1, 5);
    float4 high = LANES(channel[0], channel[1], 2, 6, 3, 7), high2 = LANES(channel[2], channel[3], 2, 6, 3, 7);
    store4(color[0], LANES(low, low2, 0, 1, 4, 5));
    store4(color[1], LANES(low, low2, 2, 3, 6, 7));
    store4(color[2], LANES(high, high2, 0, 1, 4, 5));
    store4(color[3], LANES(high, high2, 2, 3, 6, 7));
}

/* Keeps samples first to end - 1 of the batch, which are neighbours in the list. */
static void keep_run(const e3d_batch *batch, int first, int end, float sign, float (*color)[4])
{
    float rest[4][4];
    int i = first;
    for (; i + 4 <= end; i += 4)
        keep_four(batch, i, sign, color + (i - first));
    if (i < end) { /* lanes beyond the batch's end land in padding */
        keep_four(batch, i, sign, rest);
        memcpy(color + (i - first), rest, (size_t)(end - i) * sizeof *rest);
    }
}

/* Keeps the light that passes through them. */
static void keep_through(const e3d_texture_batch *textures, int first, int end, float (*through)[4])
{
    for (int i = first; i < end; i++, through++) {
        for (int k = 0; k < 3; k++)
            (*through)[k] = textures ? textures->through[k][i] : 0.0f;
        (*through)[3] = textures ? 1.0f : 0.0f;
    }
}

/* Keeps their radiance, with alpha. */
static void keep_light(const e3d_lane_array *radiance, const float *alpha, int first, int end, float (*light)[4])
{
    for (int i = first; i < end; i++, light++) {
        for (int k = 0; k < 3; k++)
            (*light)[k] = fabsf(radiance[k][i]) <= FLT_MAX ? radiance[k][i] : 0.0f;
        (*light)[3] = alpha[i];
    }
}

/* Keeps what they bend. */
static void keep_bends(const e3d_bend_batch *bends, int first, int end, e3d_bend *out)
{
    static const e3d_bend NOTHING;
    for (int i = first; i < end; i++, out++) {
        *out = NOTHING;
        if (!bends)
            continue;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 2; k++)
                out->shift[c][k] = bends->shift[c][k][i];
        out->blur = bends->blur[i];
        out->depth = bends->depth[i];
    }
}

/* Whether the batch's samples from i on, the first of them at that place in the list, are neighbours in the list, too. Places grow
 * from sample to sample, so it is enough that the last primitive begins as much later in the list as in the batch. */
static int is_run(const e3d_shade_memory *memory, int i, int32_t place)
{
    const e3d_batch *batch = &memory->batch;
    const e3d_visible_primitive *primitives = memory->primitives.data;
    int32_t last = batch->surface[batch->count - 1];
    int64_t begin = (int64_t)primitives[memory->surfaces.primitive[last]].first - place + i;
    if (batch->surface[i] == last)
        return 1;
    return begin > i && begin < batch->count && batch->surface[begin] == last && batch->surface[begin - 1] != last;
}

/* Where the samples end that are neighbours both in the batch and in the list, from sample i and that place on. Mostly that is
 * the whole batch: the samples of one primitive, or of several that follow each other in the list. */
static int end_of_run(const e3d_shade_memory *memory, int i, int32_t place, e3d_shaded_list *list)
{
    const e3d_batch *batch = &memory->batch;
    const e3d_visible_primitive *primitives = memory->primitives.data;
    int end = i + 1;
    if (is_run(memory, i, place)) {
        list->primitive = memory->surfaces.primitive[batch->surface[batch->count - 1]];
        return batch->count;
    }
    for (; end < batch->count; end++) {
        int32_t primitive = memory->surfaces.primitive[batch->surface[end]];
        if (primitive != list->primitive && primitives[primitive].first != place + (end - i))
            break;
        list->primitive = primitive;
    }
    return end;
}

/* bucket: of samples that are blended; else NULL. */
static void keep(e3d_shade_memory *memory, const e3d_bucket *bucket, float sign, e3d_shaded_list *list)
{
    const e3d_batch *batch = &memory->batch;
    for (int i = 0, end; i < batch->count; i = end) {
        int32_t place = next_place(memory->primitives.data, memory->surfaces.primitive[batch->surface[i]], list);
        end = end_of_run(memory, i, place, list);
        keep_run(batch, i, end, sign, list->color + place);
        if (list->through)
            keep_through(bucket && bucket->transmits ? &memory->textures.batch : NULL, i, end, list->through + place);
        if (list->light)
            keep_light(memory->light, batch->alpha, i, end, list->light + place);
        if (list->bend)
            keep_bends(bucket && bucket->bends ? &memory->bends : NULL, i, end, list->bend + place);
        list->at = place + (end - i);
    }
}

/* R133: where materials aren't blended, one that transmits light is opaque or absent. */
static void round_alphas(const e3d_material *m, e3d_batch *batch)
{
    for (int i = 0; i < batch->count && m->alpha_mode != E3D_ALPHA_BLEND; i++)
        batch->alpha[i] = m->alpha_mode == E3D_ALPHA_OPAQUE || batch->alpha[i] >= m->alpha_cutoff ? 1.0f : 0.0f;
}

void e3d_find_alphas(const e3d_steps *s)
{
    const e3d_bucket *bucket = s->bucket;
    const e3d_material *m = bucket->material;
    e3d_shade_memory *memory = s->out->memory;
    const e3d_varying base = bucket->mapped ? e3d_mapped_alpha(bucket, &memory->textures) : (e3d_varying){NULL, m->alpha};
    const e3d_texture_view *texture = bucket->textured && !bucket->mapped ? e3d_texture_get_view(m->texture.texture) : NULL;
    s->pass->kernels->alpha(&memory->batch, &memory->surfaces, texture, &base, bucket->by_vertex, bucket->by_instance);
    if (bucket->transmits)
        round_alphas(m, &memory->batch);
}

void e3d_keep_layers(const e3d_steps *s)
{
    keep(s->out->memory, s->bucket, s->bucket->hidden ? -1.0f : 1.0f, s->out->list);
}

void e3d_keep_solid(const e3d_steps *s)
{
    e3d_batch *batch = &s->out->memory->batch;
    for (int i = 0; i < batch->count; i++)
        batch->alpha[i] = 1.0f;
    keep(s->out->memory, NULL, 1.0f, s->out->list);
}

void e3d_lay_batch(const e3d_steps *s)
{
    e3d_shade_memory *memory = s->out->memory;
    if (s->bucket->transmits)
        s->pass->kernels->lay_through(&memory->batch, &memory->textures.batch, &s->out->pixels->samples);
    else
        s->pass->kernels->lay(&memory->batch, &s->out->pixels->samples);
}
