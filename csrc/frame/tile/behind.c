/* raster and shade, blended records: adds up how far the layers of each sample shift what is behind them, and begins with the
 * picture behind there (R166, R167). The sums are integers, so that the order of the layers doesn't matter. */
#include <math.h>
#include <string.h>

#include "base/grow.h"
#include "base/limits.h"
#include "data/views/whole_picture.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/tile/behind.h"
#include "frame/tile/memory.h"

static int is_nothing(const e3d_bend *b)
{
    return !(b->shift[0][0] | b->shift[0][1] | b->shift[1][0] | b->shift[1][1] | b->shift[2][0] | b->shift[2][1] | b->blur);
}

static int32_t wrapped(int32_t a, int32_t b) { return (int32_t)((uint32_t)a + (uint32_t)b); }

static void add(const e3d_bend *bend, e3d_bend *sum)
{
    if (is_nothing(bend))
        return;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 2; k++)
            sum->shift[c][k] = wrapped(sum->shift[c][k], bend->shift[c][k]);
    sum->blur = wrapped(sum->blur, bend->blur);
    sum->depth = bend->depth < sum->depth ? bend->depth : sum->depth;
}

static float within(float v, float most)
{
    v = v > 0.0f ? v : 0.0f;
    return v < most ? v : most;
}

/* Whether something that is nearer than `depth` shows at a place. */
static int is_before(const e3d_prepared *pass, float x, float y, float depth)
{
    const e3d_frame *frame = pass->frame;
    int32_t column = (int32_t)lrintf(within(x, (float)(frame->width - 1))), row = (int32_t)lrintf(within(y, (float)(frame->height - 1)));
    float d = pass->behind.depth[(size_t)row * (size_t)frame->width + (size_t)column];
    return d > 0.0f && d < depth;
}

/* The place of a sample in the picture; pixels have their middles at whole numbers. */
static float place_of(const e3d_frame *frame, int32_t sample)
{
    return ((float)sample + 0.5f) * (1.0f / (float)frame->samples_axis) - 0.5f;
}

/* Adds a sample to the batch, unless nothing is bent or blurred in it after all; returns whether it did. */
static int list(const e3d_tile_job *job, int32_t sample, const e3d_bend *sum, e3d_behind_batch *batch)
{
    const e3d_prepared *pass = job->in->pass;
    float x = place_of(pass->frame, job->tile.x + sample % E3D_TILE), y = place_of(pass->frame, job->tile.y + sample / E3D_TILE);
    int n = batch->count, some = sum->blur != 0, differ = 0;
    for (int c = 0; c < 3; c++) {
        float to_x = x + (float)sum->shift[c][0] * 0x1p-8f, to_y = y + (float)sum->shift[c][1] * 0x1p-8f;
        int before = is_before(pass, to_x, to_y, sum->depth);
        batch->x[c][n] = before ? x : to_x;
        batch->y[c][n] = before ? y : to_y;
        some |= batch->x[c][n] != x || batch->y[c][n] != y;
        differ |= batch->x[c][n] != batch->x[0][n] || batch->y[c][n] != batch->y[0][n];
    }
    batch->sample[n] = sample;
    batch->blur[n] = sum->blur;
    batch->is_dispersive |= some && differ;
    batch->count += some;
    return some;
}

/* ---- beyond the picture (R167) ---- */

static float beyond(const e3d_frame *frame, float x, float y)
{
    float left = 0.0f - x, right = x - (float)(frame->width - 1), up = 0.0f - y, down = y - (float)(frame->height - 1);
    float across = left > right ? left : right, along = up > down ? up : down;
    return across > along ? across : along;
}

static void find_rays(const e3d_frame *frame, const e3d_behind_batch *batch, int channel, e3d_behind_lanes ray[3])
{
    const e3d_backdrop *b = &frame->backdrop;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < batch->count; i++)
            ray[k][i] = (b->ray[k] + (batch->x[channel][i] + 0.5f) * b->across[k]) + (batch->y[channel][i] + 0.5f) * b->down[k];
}

/* Mixes the environment into a channel, or into the share (3), which is green's. */
static void fade(const e3d_frame *frame, const e3d_behind_lanes light, int channel, e3d_behind_batch *batch)
{
    int at = channel < 3 ? channel : 1;
    const e3d_whole whole = e3d_whole_of(frame);
    float scale = 16.0f / ((float)whole.height * whole.fineness), *shown = batch->light[channel];
    for (int i = 0; i < batch->count; i++) {
        float o = beyond(frame, batch->x[at][i], batch->y[at][i]), f = o * scale < 1.0f ? o * scale : 1.0f;
        if (o > 0.0f)
            shown[i] = shown[i] + (light[i] - shown[i]) * f;
    }
}

static int any_beyond(const e3d_frame *frame, const e3d_behind_batch *batch)
{
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < batch->count; i++)
            if (beyond(frame, batch->x[c][i], batch->y[c][i]) > 0.0f)
                return 1;
    return 0;
}

static void fade_all(const e3d_prepared *pass, e3d_behind_batch *batch)
{
    const e3d_frame *frame = pass->frame;
    const e3d_backdrop *backdrop = &frame->backdrop;
    e3d_behind_lanes ray[3], level, light[3], all;
    if (!backdrop->light.environment || !any_beyond(frame, batch))
        return;
    float last = (float)(pass->behind.whole_count - 1), a_level = 8.0f / (last > 1.0f ? last : 1.0f);
    for (int i = 0; i < batch->count; i++) {
        float wanted = batch->whole_level[i] * a_level;
        level[i] = backdrop->level > wanted ? backdrop->level : wanted;
        all[i] = 1.0f;
    }
    for (int c = 0; c < 3; c++) {
        if (c == 0 || batch->is_dispersive) {
            find_rays(frame, batch, c, ray);
            pass->kernels->environment(&backdrop->light, (const float *const[3]){ray[0], ray[1], ray[2]}, level, batch->count,
                                       (float *const[3]){light[0], light[1], light[2]});
        }
        fade(frame, light[c], c, batch);
    }
    fade(frame, all, 3, batch);
}

/* ---- colours ---- */

static float unit(float v) { return within(v, 1.0f); }

/* The light to be tone mapped: in front of a transparent background, that of what shows. */
static void find_lit(int opaque, const e3d_behind_batch *batch, float *const lit[3])
{
    for (int i = 0; i < batch->count; i++) {
        float share = batch->light[3][i], inverse = 1.0f / (share > 0.0f ? share : 1.0f);
        for (int k = 0; k < 3; k++) {
            float light = batch->light[k][i];
            if (!opaque)
                light = share > 0.0f ? light * inverse : 0.0f;
            lit[k][i] = light;
        }
    }
}

static void put_colors(int opaque, float *const mapped[3], const e3d_behind_batch *batch, e3d_samples *samples)
{
    for (int i = 0; i < batch->count; i++) {
        int32_t at = batch->sample[i];
        float share = batch->light[3][i];
        for (int k = 0; k < 3; k++) {
            float plain = unit(batch->light[k][i]), shown = mapped[k][i];
            samples->color[k][at] = opaque ? plain + (shown - plain) * share : shown * share;
        }
        samples->counts[at] = opaque ? 1.0f : share;
    }
}

static void put_radiance(const e3d_frame *frame, const e3d_behind_batch *batch, float (*lit)[3])
{
    int32_t axis = frame->samples_axis;
    for (int i = 0; i < batch->count; i++) {
        int32_t x = batch->sample[i] % E3D_TILE, y = batch->sample[i] / E3D_TILE;
        for (int k = 0; k < 3 && x % axis == axis / 2 && y % axis == axis / 2; k++)
            lit[y / axis * E3D_TILE + x / axis][k] = batch->light[k][i];
    }
}

/* Keeps what pixels begin with, for other planes. */
static void note(const e3d_behind_batch *batch, const e3d_samples *samples, e3d_begun *begun)
{
    for (int i = 0; i < batch->count; i++) {
        int32_t at = batch->sample[i];
        for (int k = 0; k < 3; k++)
            begun[at].color[k] = samples->color[k][at];
        begun[at].color[3] = samples->counts[at];
    }
}

/* Begins with what an earlier plane began with, if its bends were the same. */
static int begins_alike(const e3d_begun *begun, const e3d_bend *sum, int32_t at, e3d_samples *samples)
{
    if (!begun || memcmp(&begun[at].sum, sum, sizeof *sum) != 0)
        return 0;
    for (int k = 0; k < 3; k++)
        samples->color[k][at] = begun[at].color[k];
    samples->counts[at] = begun[at].color[3];
    return 1;
}

static void show(const e3d_tile_job *job, e3d_behind_batch *batch, e3d_begun *begun, float (*lit)[3], e3d_samples *samples)
{
    const e3d_prepared *pass = job->in->pass;
    int opaque = e3d_shows_environment(pass->frame) || pass->frame->background[3] > 0.5f;
    e3d_behind_lanes room[3];
    float *const mapped[3] = {room[0], room[1], room[2]};
    if (!batch->count)
        return;
    pass->kernels->behind(&pass->behind, batch);
    fade_all(pass, batch);
    find_lit(opaque, batch, mapped);
    pass->kernels->tone(pass->frame->tone_mapping, mapped, batch->count);
    put_colors(opaque, mapped, batch, samples);
    if (lit)
        put_radiance(pass->frame, batch, lit);
    if (begun)
        note(batch, samples, begun);
    batch->count = batch->is_dispersive = 0;
}

/* The sum of a sample's bends. */
static e3d_bend sum_of(const e3d_bent_layers *layers, int32_t sample)
{
    e3d_bend sum = {.depth = INFINITY};
    for (uint32_t i = layers->first[sample]; i < layers->first[sample + 1]; i++)
        if (layers->color[layers->which[i]][3] >= E3D_LEAST_ALPHA)
            add(&layers->bend[layers->which[i]], &sum);
    return sum;
}

/* With multisampling: what pixels began with in earlier planes; NULL when memory is out. */
static e3d_begun *begun_in(e3d_alpha_memory *memory, int plane)
{
    if (!e3d_array_reserve(&memory->begun, E3D_TILE_SAMPLES, sizeof(e3d_begun)))
        return NULL;
    return plane ? memory->begun.data : memset(memory->begun.data, 0, E3D_TILE_SAMPLES * sizeof(e3d_begun));
}

int e3d_begin_behind(const e3d_tile_job *job, const e3d_bent_layers *layers, int plane, float (*lit)[3], e3d_samples *samples)
{
    e3d_behind_batch *batch = &job->memory->alpha.behind;
    int several = job->in->pass->pattern != NULL;
    e3d_begun *begun = several ? begun_in(&job->memory->alpha, plane) : NULL;
    batch->count = batch->is_dispersive = 0;
    if (several && !begun)
        return 0;
    for (int32_t s = 0; s < E3D_TILE_SAMPLES; s++) {
        const e3d_bend sum = sum_of(layers, s);
        if (is_nothing(&sum) || begins_alike(begun, &sum, s, samples))
            continue;
        if (list(job, s, &sum, batch) && begun)
            begun[s].sum = sum;
        if (batch->count == E3D_BEHIND_BATCH)
            show(job, batch, begun, lit, samples);
    }
    show(job, batch, begun, lit, samples);
    return 1;
}
