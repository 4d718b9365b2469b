/* raster and shade, blended records: the layers of samples are kept, sorted sample by sample, and blended over the colours there
 * (R83, R84). */
#include <string.h>

#include "base/always_inline.h"
#include "base/grow.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/bending.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/shade/job.h"
#include "frame/shade/shade.h"
#include "frame/store/outputs.h"
#include "frame/tile/a_buffer.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/behind.h"
#include "frame/tile/piece.h"

void e3d_a_buffer_free(e3d_a_buffer *f)
{
    e3d_array *const arrays[] = {&f->z, &f->cover, &f->sample, &f->of, &f->ids, &f->color, &f->through, &f->light, &f->bend, &f->depth, &f->which};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        e3d_array_free(arrays[k]);
}

void e3d_a_buffer_clear(e3d_a_buffer *f) { f->z.count = f->ids.count = 0; }

void *e3d_radiance_of(const e3d_tile_job *job)
{
    return e3d_outputs_gathered(job->in->shade->store, &job->memory->pixels, E3D_OUTPUT_RADIANCE);
}

/* ---- what is kept ---- */

/* Makes room for layers and their IDs; *to is where shading puts the colours of the layers from `first` on. Returns 0 when
 * memory is out. */
static int reserve(const e3d_tile_job *job, size_t first, size_t count, size_t ids, e3d_shaded_list *to)
{
    e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    int transmits = job->in->pass->draws->any_transmits, lights = e3d_radiance_of(job) != NULL;
    int bends = e3d_plans(job->in->pass, E3D_PLAN_BENDS);
    if (!e3d_array_reserve(&f->z, count, sizeof(float)) || !e3d_array_reserve(&f->sample, count, sizeof(int32_t)) ||
        !e3d_array_reserve(&f->of, count, sizeof(int32_t)) || !e3d_array_reserve(&f->ids, ids, sizeof(int32_t)) ||
        !e3d_array_reserve(&f->color, count, sizeof(float[4])) ||
        (job->in->pass->pattern && !e3d_array_reserve(&f->cover, count, sizeof(uint32_t))) ||
        (transmits && !e3d_array_reserve(&f->through, count, sizeof(float[4]))) ||
        (lights && !e3d_array_reserve(&f->light, count, sizeof(float[4]))) || (bends && !e3d_array_reserve(&f->bend, count, sizeof(e3d_bend))))
        return 0;
    to->color = (float (*)[4])f->color.data + first;
    to->through = transmits ? (float (*)[4])f->through.data + first : NULL;
    to->light = lights ? (float (*)[4])f->light.data + first : NULL;
    to->bend = bends ? (e3d_bend *)f->bend.data + first : NULL;
    return 1;
}

int e3d_a_buffer_keep(const e3d_tile_job *job)
{
    const e3d_shown *shown = &job->memory->shade.shown;
    e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    size_t first = f->z.count, count = (size_t)shown->count, ids = f->ids.count;
    e3d_shaded_list to = {0};
    if (!count)
        return 1;
    if (!reserve(job, first, first + count, ids + (size_t)shown->primitives, &to) || !e3d_alpha_shade(job, E3D_SINK_A_BUFFER, to))
        return 0;
    if (job->in->pass->pattern)
        memcpy((uint32_t *)f->cover.data + first, job->memory->multisample->alpha.cover, count * sizeof(uint32_t));
    else
        memcpy((float *)f->z.data + first, job->memory->alpha.z, count * sizeof(float));
    for (size_t n = 0; n < count; n++) {
        ((int32_t *)f->sample.data)[first + n] = shown->sample[n] & (E3D_TILE_SAMPLES - 1);
        ((int32_t *)f->of.data)[first + n] = shown->of[n] + (int32_t)ids;
    }
    for (int32_t p = 0; p < shown->primitives; p++)
        ((int32_t *)f->ids.data)[ids + (size_t)p] = (int32_t)shown->primitive[p].id;
    f->z.count = first + count;
    f->ids.count = ids + (size_t)shown->primitives;
    return 1;
}

/* ---- their order ---- */

/* The bits of a depth as an integer that grows with the depth; -0 becomes 0. */
static int32_t depth_key(float z)
{
    float positive = z + 0.0f;
    int32_t bits;
    memcpy(&bits, &positive, sizeof bits);
    return bits < 0 ? bits ^ 0x7FFFFFFF : bits;
}

/* Lists the layers by sample, the last ones first, since they come roughly from near to far. With `cover`, only layers that
 * cover `plane` are listed. */
static ALWAYS_INLINE void list_covering(e3d_a_buffer *f, const uint32_t *cover, int plane)
{
    size_t count = f->z.count;
    uint32_t *first = f->first, at = 0, *which = f->which.data;
    const int32_t *sample = f->sample.data;
    const float *z = f->z.data;
    int32_t *depth = f->depth.data;
    memset(first, 0, sizeof f->first);
    for (size_t n = 0; n < count; n++)
        if (!cover || cover[n] >> plane & 1)
            first[sample[n]]++;
    for (int s = 0; s < E3D_TILE_SAMPLES; s++)
        first[s] = at += first[s]; /* here: the end of sample s, where the next one begins */
    for (size_t n = 0; n < count; n++) {
        if (cover && !(cover[n] >> plane & 1))
            continue;
        uint32_t place = --first[sample[n]];
        depth[place] = depth_key(z[n]);
        which[place] = (uint32_t)n;
    }
    first[E3D_TILE_SAMPLES] = at;
    memset(depth + at, 0, E3D_PAD * sizeof *depth);
}

static int list_by_sample(e3d_a_buffer *f, const uint32_t *cover, int plane)
{
    size_t count = f->z.count;
    if (!e3d_array_reserve(&f->depth, count + E3D_PAD, sizeof(int32_t)) || !e3d_array_reserve(&f->which, count, sizeof(uint32_t)))
        return 0;
    if (cover)
        list_covering(f, cover, plane);
    else
        list_covering(f, NULL, 0);
    return 1;
}

/* Whether layer a is blended before layer b: it is farther, or later in order (R83). */
static int is_before(const e3d_record_table *table, const e3d_a_buffer *f, uint32_t a, uint32_t b)
{
    const float *z = f->z.data;
    const int32_t *of = f->of.data, *ids = f->ids.data;
    if (z[a] != z[b])
        return z[a] > z[b];
    return e3d_id_comes_first(table, ids[of[b]], ids[of[a]]);
}

/* Lets an element sink to its place in a heap; the heap's top is blended last. */
static void sink(const e3d_record_table *table, const e3d_a_buffer *f, uint32_t *heap, uint32_t at, uint32_t count)
{
    uint32_t sinking = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && is_before(table, f, heap[child], heap[child + 1]))
            child++;
        if (!is_before(table, f, sinking, heap[child]))
            break;
        heap[at] = heap[child];
    }
    heap[at] = sinking;
}

/* Sorts a sample's layers in the order in which they are blended. It is a heap sort, since a sample may have any number of
 * layers. */
static void sort_sample(const e3d_record_table *table, const e3d_a_buffer *f, uint32_t *which, uint32_t count)
{
    for (uint32_t at = count / 2; at-- > 0;)
        sink(table, f, which, at, count);
    for (uint32_t end = count; end-- > 1;) {
        uint32_t last = which[0];
        which[0] = which[end];
        which[end] = last;
        sink(table, f, which, 0, end);
    }
}

/* Blends the sorted layers of one sample over its colour (R84). */
static void blend_sample(const e3d_alpha_layers *layers, int32_t sample, const uint32_t *which, uint32_t count, e3d_samples *samples)
{
    float over[4] = {samples->color[0][sample], samples->color[1][sample], samples->color[2][sample], samples->counts[sample]};
    for (uint32_t i = 0; i < count; i++)
        e3d_lay_any(layers->color[which[i]], layers->through ? layers->through[which[i]] : NULL, over);
    for (int k = 0; k < 3; k++)
        samples->color[k][sample] = over[k];
    samples->counts[sample] = over[3];
    if (layers->light)
        e3d_lay_light(layers, which, (int)count, sample);
}

/* Finds the nearest of a sample's sorted layers that shows; a face that a wireframe leaves out counts. */
static void find_front(e3d_a_buffer *f, int32_t sample, const uint32_t *which, uint32_t count)
{
    const float (*colors)[4] = (const float (*)[4])f->color.data;
    for (uint32_t i = count; i-- > 0;) {
        float alpha = colors[which[i]][3];
        if (alpha >= E3D_LEAST_ALPHA || -alpha >= E3D_LEAST_ALPHA) {
            f->front_z[sample] = ((const float *)f->z.data)[which[i]];
            f->front_id[sample] = ((const int32_t *)f->ids.data)[((const int32_t *)f->of.data)[which[i]]];
            return;
        }
    }
}

/* Blends one sample: one that the kernel left, or any if the nearest layers are asked for. */
static void blend_slowly(const e3d_tile_job *job, const e3d_alpha_layers *layers, int32_t sample, e3d_samples *samples)
{
    e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    uint32_t *which = (uint32_t *)f->which.data + f->first[sample], count = f->first[sample + 1] - f->first[sample];
    if (!count)
        return;
    sort_sample(&job->in->bins->tables[E3D_SET_SCENE], f, which, count);
    blend_sample(layers, sample, which, count, samples);
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT))
        find_front(f, sample, which, count);
}

static e3d_alpha_layers layers_of(const e3d_tile_job *job)
{
    const e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    float (*lit)[3] = e3d_radiance_of(job);
    return (e3d_alpha_layers){.first = f->first,
                              .depth = f->depth.data,
                              .which = f->which.data,
                              .color = (const float (*)[4])f->color.data,
                              .through = job->in->pass->draws->any_transmits ? (const float (*)[4])f->through.data : NULL,
                              .light = lit ? (const float (*)[4])f->light.data : NULL,
                              .lit = lit,
                              .axis = job->in->pass->frame->samples_axis};
}

/* Blends the layers that cover a plane (list_covering) into its samples. */
static int blend_plane(const e3d_tile_job *job, const uint32_t *cover, int plane, e3d_samples *samples)
{
    e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    if (!list_by_sample(f, cover, plane))
        return 0;
    const e3d_alpha_layers layers = layers_of(job);
    if (e3d_plans(job->in->pass, E3D_PLAN_BENDS)) {
        const e3d_bent_layers bent = {f->first, f->which.data, layers.color, f->bend.data};
        if (!e3d_begin_behind(job, &bent, plane, layers.lit, samples))
            return 0;
    }
    if (e3d_plans(job->in->pass, E3D_PLAN_FRONT)) {
        for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++)
            blend_slowly(job, &layers, s, samples);
        return 1;
    }
    int left = job->in->pass->kernels->blend(&layers, samples, f->left);
    for (int i = 0; i < left; i++)
        blend_slowly(job, &layers, f->left[i], samples);
    return 1;
}

/* Finds the depths that layers have in a plane. */
static void find_depths(const e3d_tile_job *job, int plane)
{
    e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    const uint32_t *cover = f->cover.data;
    const int32_t *sample = f->sample.data, *of = f->of.data, *ids = f->ids.data;
    int32_t last = -1;
    e3d_piece piece = {0};
    for (size_t n = 0; n < f->z.count; n++) {
        if (!(cover[n] >> plane & 1))
            continue;
        uint32_t id = (uint32_t)ids[of[n]];
        if (of[n] != last)
            e3d_piece_in_plane(job->in->pass, plane, e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id), &job->tile, id, &piece);
        last = of[n];
        ((float *)f->z.data)[n] = e3d_piece_depth(&piece, sample[n] % E3D_TILE, sample[n] / E3D_TILE);
    }
}

int e3d_a_buffer_blend(const e3d_tile_job *job)
{
    const e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    const e3d_sample_pattern *pattern = job->in->pass->pattern;
    if (!f->z.count)
        return 1;
    if (!pattern)
        return blend_plane(job, NULL, 0, &job->memory->pixels.samples);
    for (int s = 0; s < pattern->count; s++) {
        find_depths(job, s);
        if (!blend_plane(job, f->cover.data, s, &job->memory->multisample->samples[s]))
            return 0;
    }
    return 1;
}

void e3d_a_buffer_lay(const e3d_tile_job *job)
{
    const e3d_a_buffer *f = &job->memory->alpha.a_buffer;
    const e3d_alpha_layers layers = layers_of(job);
    for (uint32_t n = 0; n < f->z.count; n++)
        for (uint32_t left = ((const uint32_t *)f->cover.data)[n]; left; left &= left - 1)
            blend_sample(&layers, ((const int32_t *)f->sample.data)[n], &n, 1, &job->memory->multisample->samples[__builtin_ctz(left)]);
}
