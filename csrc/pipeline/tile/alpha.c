/* raster, records with alpha: their samples are listed, their alphas found, and what shows of masked ones joins the visible surface.
 *
 * Which samples they show is known late, so that they hide no block and no cluster.
 */
#include "core/grow.h"
#include "core/limits.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/records.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/records.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/alpha.h"
#include "pipeline/shade/job.h"
#include "pipeline/shade/shade.h"
#include "pipeline/tile/alpha.h"
#include "pipeline/tile/job.h"
#include "pipeline/tile/memory.h"
#include "pipeline/tile/piece.h"

static void free_fragments(e3d_alpha_fragments *f)
{
    e3d_array *const arrays[] = {&f->z, &f->sample, &f->of, &f->ids, &f->color, &f->through, &f->light, &f->depth, &f->which};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        e3d_array_free(arrays[k]);
}

void e3d_alpha_free(e3d_alpha_memory *memory)
{
    e3d_array_free(&memory->pieces);
    e3d_array_free(&memory->sorted);
    e3d_array_free(&memory->ranges);
    e3d_array_free(&memory->groups);
    free_fragments(&memory->fragments);
}

/* ---- lists ---- */

static void empty(const e3d_tile_job *job) { e3d_shown_begin(&job->memory->shade.shown, 0); }

/* Where the last record in order shows, depths hide nothing. */
void e3d_alpha_begin(const e3d_tile_job *job, int all)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    int depths = !all && !e3d_plans(job->in->pass, E3D_PLAN_SORTS);
    memory->list = (e3d_alpha_list){.limit = depths ? job->visible->z : job->memory->marks.bound,
                                    .kept = job->visible->id,
                                    .shown = &job->memory->shade.shown,
                                    .z = memory->z};
    empty(job);
}

int e3d_alpha_add(const e3d_tile_job *job, const e3d_piece *piece, e3d_alpha_action action)
{
    e3d_piece rest = *piece;
    for (;;) {
        rest.y0 = job->in->pass->kernels->raster_alpha(&rest, &job->in->bins->tables[E3D_SET_SCENE], &job->memory->alpha.list);
        if (rest.y0 > rest.y1)
            return 1;
        if (!action(job))
            return 0;
        empty(job);
    }
}

int e3d_alpha_shade(const e3d_tile_job *job, e3d_alpha_use use, float (*color)[4], float (*through)[4], float (*light)[4])
{
    e3d_alpha_shading shading = {.use = use, .alpha = job->memory->alpha.alpha, .color = color, .through = through, .light = light, .piece = -1};
    e3d_shade_out out = job->shades;
    out.alpha = &shading;
    return e3d_shade_shown(job->in->shade, &job->tile, &out);
}

/* ---- what a list's samples do where their alpha is enough ---- */

typedef void (*sample_action)(const e3d_tile_job *job, int32_t id, int32_t sample, float z);

static int act_on(const e3d_tile_job *job, sample_action act)
{
    const e3d_shade_memory *shade = &job->memory->shade;
    const e3d_alpha_memory *memory = &job->memory->alpha;
    if (!e3d_alpha_shade(job, E3D_ALPHA_TEST, NULL, NULL, NULL))
        return 0;
    const e3d_visible_primitive *pieces = shade->pieces.data;
    const e3d_bucket *buckets = shade->buckets.data;
    for (int32_t p = 0; p < shade->shown.pieces; p++) {
        float cutoff = e3d_alpha_cutoff(buckets[pieces[p].bucket].material);
        for (int32_t n = pieces[p].first; n < pieces[p].end; n++)
            if (memory->alpha[n] >= cutoff)
                act(job, (int32_t)shade->shown.piece[p].id, shade->shown.sample[n], memory->z[n]);
    }
    return 1;
}

/* The list was made when less was kept. Sorted records are numbered as they are drawn. */
static void show(const e3d_tile_job *job, int32_t id, int32_t sample, float z)
{
    e3d_visible_tile *visible = job->visible;
    int32_t kept = visible->id[sample];
    int wins = z < visible->z[sample] || (z == visible->z[sample] && kept >= 0 && e3d_id_comes_first(&job->in->bins->tables[E3D_SET_SCENE], id, kept));
    if (e3d_plans(job->in->pass, E3D_PLAN_SORTS))
        wins = z < E3D_BEYOND_FAR && id > kept;
    if (!wins)
        return;
    visible->z[sample] = z;
    visible->id[sample] = id;
}

static int show_list(const e3d_tile_job *job) { return act_on(job, show); }

static void count(const e3d_tile_job *job, int32_t id, int32_t sample, float z)
{
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], (uint32_t)id);
    job->memory->marks.count[sample] += z < E3D_BEYOND_FAR && record->meta & E3D_RECORD_FACE;
}

static int count_list(const e3d_tile_job *job) { return act_on(job, count); }

/* ---- masked records ---- */

static int add_block(const e3d_tile_job *job, const e3d_bin_block *block, e3d_alpha_action action)
{
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    for (uint32_t i = 0; i < block->count; i++) {
        e3d_piece piece;
        if (e3d_piece_in_tile(&job->in->pass->view->viewport, e3d_record_at(table, block->id[i]), &job->tile, block->id[i], &piece) &&
            !e3d_alpha_add(job, &piece, action))
            return 0;
    }
    return 1;
}

static int visit_masked(const e3d_tile_job *job, int all, e3d_alpha_action action)
{
    const e3d_bins *bins = job->in->bins;
    e3d_alpha_begin(job, all);
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_block *block = e3d_first_alpha(set, E3D_ALPHA_MASKED, job->number);
        for (; block; block = e3d_next_alpha(set, E3D_ALPHA_MASKED, block))
            if (!add_block(job, block, action))
                return 0;
    }
    return !job->memory->shade.shown.count || action(job);
}

int e3d_alpha_cut(const e3d_tile_job *job) { return !job->masked || visit_masked(job, 0, show_list); }

int e3d_alpha_count(const e3d_tile_job *job) { return !job->masked || visit_masked(job, 1, count_list); }
