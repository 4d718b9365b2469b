/* raster, records with alpha: lists their samples, finds the alphas, and adds what masked records show to the visible surface.
 * Which samples they cover is known late, so they hide no block and no cluster. With multisampling an alpha is found once for a
 * pixel, for all samples that the record covers there (R108). */
#include "base/grow.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "kernels/types/vertices.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/alpha_batch.h"
#include "frame/shade/shade.h"
#include "frame/shade/surface.h"
#include "frame/tile/alpha_test.h"
#include "frame/tile/piece.h"

/* ---- lists ---- */

static void empty(const e3d_tile_job *job)
{
    e3d_shown_begin(&job->memory->shade.shown, 0);
    job->memory->shade.shown.pattern = job->in->pass->pattern;
}

/* Begins a list of pixels in planes; 0 when memory is out. */
static int begin_planes(const e3d_tile_job *job, int depths)
{
    const e3d_sample_pattern *pattern = job->in->pass->pattern;
    e3d_multisample_memory *memory = job->memory->multisample;
    if (!e3d_array_reserve(&memory->covers, E3D_SHOWN_ROOM + 2 * E3D_PAD, sizeof(int32_t)))
        return 0;
    memory->alpha = (e3d_msaa_list){.shown = &job->memory->shade.shown, .cover = memory->covers.data, .pattern = pattern};
    for (int s = 0; s < pattern->count; s++) {
        memory->alpha.limit[s] = depths ? job->visible[s].z : job->memory->marks.bound;
        memory->alpha.kept[s] = job->visible[s].id;
    }
    return 1;
}

/* Begins a list. If the last record in order shows, depths hide nothing. */
int e3d_alpha_begin(const e3d_tile_job *job, int all)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    int depths = !all && !e3d_plans(job->in->pass, E3D_PLAN_SORTS);
    empty(job);
    if (job->in->pass->pattern)
        return begin_planes(job, depths);
    memory->list = (e3d_alpha_list){.limit = depths ? job->visible->z : job->memory->marks.bound,
                                    .kept = job->visible->id,
                                    .shown = &job->memory->shade.shown,
                                    .z = memory->z};
    return 1;
}

int e3d_alpha_piece(const e3d_tile_job *job, uint32_t id, e3d_piece *piece)
{
    const e3d_viewport *viewport = &job->in->pass->view->viewport;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id);
    if (!job->in->pass->pattern)
        return e3d_piece_in_tile(viewport, record, &job->tile, id, piece);
    e3d_piece_box(viewport, record, &job->tile, piece);
    e3d_piece_rest(record, id, piece);
    return 1;
}

/* A record in the planes of a tile. */
typedef struct plane_pieces {
    e3d_piece of[E3D_MOST_MSAA_SAMPLES];
    uint32_t live; /* the planes in which it may show: a bit each */
} plane_pieces;

static void find_planes(const e3d_tile_job *job, uint32_t id, plane_pieces *out)
{
    const e3d_prepared *pass = job->in->pass;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id);
    out->live = 0;
    for (int s = 0; s < pass->pattern->count; s++)
        out->live |= (uint32_t)e3d_piece_in_plane(pass, s, record, &job->tile, id, &out->of[s]) << s;
}

int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action)
{
    const e3d_prepared *pass = job->in->pass;
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    e3d_piece rest = *piece;
    plane_pieces planes;
    planes.live = 0;
    if (pass->pattern)
        find_planes(job, piece->slot, &planes);
    if (pass->pattern && !planes.live)
        return 1;
    for (;;) {
        rest.y0 = pass->pattern ? pass->kernels->cover_msaa(planes.of, planes.live, rest.y0, rest.y1, table,
                                                            &job->memory->multisample->alpha)
                                : pass->kernels->raster_alpha(&rest, table, &job->memory->alpha.list);
        if (rest.y0 > rest.y1)
            return 1;
        if (!action(job))
            return 0;
        empty(job);
    }
}

int e3d_alpha_shade(const e3d_tile_job *job, e3d_sink sink, e3d_shaded_list to)
{
    e3d_shade_out out = job->shades;
    to.alpha = job->memory->alpha.alpha;
    to.primitive = -1;
    out.sink = sink;
    out.list = &to;
    return e3d_shade_shown(job->in->shade, &job->tile, &out);
}

/* ---- what a list's samples do where their alpha is enough ---- */

typedef void (*sample_action)(const e3d_tile_job *job, e3d_visible_tile *plane, int32_t id, int32_t sample, float z);

static void act_on_samples(const e3d_tile_job *job, const e3d_visible_primitive *primitive, uint32_t id, float cutoff, sample_action act)
{
    const e3d_alpha_memory *memory = &job->memory->alpha;
    for (int32_t n = primitive->first; n < primitive->end; n++)
        if (memory->alpha[n] >= cutoff)
            act(job, job->visible, (int32_t)id, job->memory->shade.shown.sample[n], memory->z[n]);
}

/* R108: the samples that an alpha covers, a bit each. */
static uint32_t coverage_of(float alpha, float cutoff, int32_t samples)
{
    uint32_t covered = 0;
    float share = alpha < cutoff ? (0.5f * alpha) / cutoff : 1.0f;
    if (alpha >= cutoff && cutoff < 1.0f)
        share = 0.5f + (0.5f * (alpha - cutoff)) / (1.0f - cutoff);
    for (int32_t n = 0; n < samples; n++)
        if (share * (float)samples >= (float)n + 0.5f)
            covered |= (uint32_t)1 << n;
    return covered;
}

static uint32_t samples_left(const e3d_prepared *pass, const e3d_material *material, float alpha)
{
    float cutoff = e3d_alpha_cutoff(material);
    if (pass->frame->alpha_to_coverage && material->alpha_mode == E3D_ALPHA_MASK)
        return coverage_of(alpha, cutoff, pass->pattern->count);
    return alpha >= cutoff ? ~(uint32_t)0 : 0;
}

static void act_on_planes(const e3d_tile_job *job, const e3d_visible_primitive *primitive, uint32_t id, const e3d_material *material, sample_action act)
{
    plane_pieces planes;
    find_planes(job, id, &planes);
    for (int32_t n = primitive->first; n < primitive->end; n++) {
        int32_t pixel = job->memory->shade.shown.sample[n] & (E3D_TILE_SAMPLES - 1);
        uint32_t left = (uint32_t)job->memory->multisample->alpha.cover[n] & samples_left(job->in->pass, material, job->memory->alpha.alpha[n]);
        for (; left; left &= left - 1) {
            int s = __builtin_ctz(left);
            act(job, &job->visible[s], (int32_t)id, pixel, e3d_piece_depth(&planes.of[s], pixel % E3D_TILE, pixel / E3D_TILE));
        }
    }
}

static int act_on(const e3d_tile_job *job, sample_action act)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    if (!e3d_alpha_shade(job, E3D_SINK_ALPHA_TEST, (e3d_shaded_list){0}))
        return 0;
    const e3d_visible_primitive *primitives = shade->primitives.data;
    for (int32_t p = 0; p < shade->shown.primitives; p++) {
        const e3d_material *material = ((const e3d_bucket *)shade->buckets.data)[primitives[p].bucket].material;
        if (job->in->pass->pattern)
            act_on_planes(job, &primitives[p], shade->shown.primitive[p].id, material, act);
        else
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
