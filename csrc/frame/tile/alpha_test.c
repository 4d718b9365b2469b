/* raster, records with alpha: adds what masked records show to the visible surface, once their alphas are known.
 * Which samples they cover is known late, so they hide no block and no cluster. With multisampling an alpha is found once for a
 * pixel, for all samples that the record covers there (R108). */
#include "base/limits.h"
#include "e3d.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/shade/alpha_batch.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/alpha_test.h"
#include "frame/tile/coverage.h"
#include "frame/tile/piece.h"

/* ---- what a list's samples do where their alpha is enough ---- */

typedef void (*sample_action)(const e3d_tile_job *job, e3d_visible_tile *plane, int32_t id, int32_t sample, float z);

static void act_on_samples(const e3d_tile_job *job, const e3d_visible_primitive *primitive, uint32_t id, float cutoff, sample_action act)
{
    const e3d_alpha_memory *memory = &job->memory->alpha;
    for (int32_t n = primitive->first; n < primitive->end; n++)
        if (memory->alpha[n] >= cutoff)
            act(job, job->visible, (int32_t)id, job->memory->shade.shown.sample[n], memory->z[n]);
}

/* Acts on the samples of a record's pixels that their covers name. */
static void act_on_planes(const e3d_tile_job *job, const e3d_visible_primitive *primitive, uint32_t id, sample_action act)
{
    e3d_plane_pieces planes;
    e3d_alpha_planes(job, id, &planes);
    for (int32_t n = primitive->first; n < primitive->end; n++) {
        int32_t pixel = job->memory->shade.shown.sample[n] & (E3D_TILE_SAMPLES - 1);
        for (uint32_t left = (uint32_t)job->memory->multisample->alpha.cover[n]; left; left &= left - 1) {
            int s = __builtin_ctz(left);
            act(job, &job->visible[s], (int32_t)id, pixel, e3d_piece_depth(&planes.of[s], pixel % E3D_TILE, pixel / E3D_TILE));
        }
    }
}

static void act_on_pixels(const e3d_tile_job *job, sample_action act)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    for (int32_t p = 0; p < shade->shown.primitives; p++)
        act_on_planes(job, &primitives[p], shade->shown.primitive[p].id, act);
}

/* First on the pixels whose alphas cover all or nothing of them, then on those that lie on an edge. */
static int act_on_coverage(const e3d_tile_job *job, sample_action act)
{
    int32_t edges;
    if (!e3d_cover_pixels(job, &edges))
        return 0;
    act_on_pixels(job, act);
    if (!edges)
        return 1;
    if (!e3d_cover_edges(job))
        return 0;
    act_on_pixels(job, act);
    return 1;
}

static int act_on(const e3d_tile_job *job, sample_action act)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    if (job->in->pass->pattern)
        return act_on_coverage(job, act);
    if (!e3d_alpha_shade(job, E3D_SINK_ALPHA_TEST, (e3d_shaded_list){0}))
        return 0;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    for (int32_t p = 0; p < shade->shown.primitives; p++) {
        const e3d_material *material = ((const e3d_bucket *)shade->buckets.data)[primitives[p].bucket].material;
        act_on_samples(job, &primitives[p], shade->shown.primitive[p].id, e3d_alpha_cutoff(material), act);
    }
    return 1;
}

/* Lets a sample show a record if that wins there (R16): other records may have been drawn since the list was made. Sorted
 * records have IDs in the order of drawing. */
static void show(const e3d_tile_job *job, e3d_visible_tile *plane, int32_t id, int32_t sample, float z)
{
    int32_t kept = plane->id[sample];
    int wins = z < plane->z[sample] || (z == plane->z[sample] && kept >= 0 && e3d_id_comes_first(&job->in->bins->tables[E3D_SET_SCENE], id, kept));
    if (e3d_plans(job->in->pass, E3D_PLAN_SORTS))
        wins = z < E3D_BEYOND_FAR && id > kept;
    if (!wins)
        return;
    plane->z[sample] = z;
    plane->id[sample] = id;
}

static int show_list(const e3d_tile_job *job) { return act_on(job, show); }

static void count(const e3d_tile_job *job, e3d_visible_tile *plane, int32_t id, int32_t sample, float z)
{
    (void)plane;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], (uint32_t)id);
    job->memory->marks.count[sample] += z < E3D_BEYOND_FAR && record->meta & E3D_RECORD_FACE;
}

static int count_list(const e3d_tile_job *job) { return act_on(job, count); }

/* ---- masked records ---- */

static int add_link(const e3d_tile_job *job, const e3d_bin_link *link, e3d_alpha_action action)
{
    e3d_piece piece;
    for (uint32_t i = 0; i < link->count; i++)
        if (e3d_alpha_piece(job, link->id[i], &piece) && !e3d_alpha_add(job, &piece, action))
            return 0;
    return 1;
}

static int visit_masked(const e3d_tile_job *job, int all, e3d_alpha_action action)
{
    const e3d_bins *bins = job->in->bins;
    if (!e3d_alpha_begin(job, all))
        return 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_link *link = e3d_first_alpha(set, E3D_ALPHA_MASKED, job->number);
        for (; link; link = e3d_next_alpha(set, E3D_ALPHA_MASKED, link))
            if (!add_link(job, link, action))
                return 0;
    }
    return !job->memory->shade.shown.count || action(job);
}

/* With multisampling all samples that a record covers are listed, hidden or not: they decide where in a pixel the alpha is found
 * (R105). */
int e3d_alpha_cut(const e3d_tile_job *job) { return !job->masked || visit_masked(job, job->in->pass->pattern != NULL, show_list); }

int e3d_alpha_count(const e3d_tile_job *job) { return !job->masked || visit_masked(job, 1, count_list); }
