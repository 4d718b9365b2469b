/* raster with multisampling: draws a tile's records into the planes of its samples. A pixel whose samples all show the same is
 * shaded as with one sample; other pixels are mixed (msaa_mixed.c). If all samples of a pixel have one colour, their average is
 * that colour to the bit (R106), so that it is encoded at once. If samples are shaded alone (R195), so is each plane. */
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "base/large_pages.h"
#include "base/limits.h"
#include "data/sample_patterns.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/visible.h"
#include "frame/cull/depths.h"
#include "frame/geometry/bin.h"
#include "frame/geometry/records.h"
#include "frame/pass/plan.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"
#include "frame/shade/shade.h"
#include "frame/store/resolve.h"
#include "frame/store/tile_state.h"
#include "frame/tile/alpha_test.h"
#include "frame/tile/blend.h"
#include "frame/tile/msaa_mixed.h"
#include "frame/tile/multisample.h"
#include "frame/tile/piece.h"
#include "frame/tile/slots.h"
#include "frame/tile/visible.h"

/* ---- memory ---- */

void e3d_multisample_free(e3d_multisample_memory *memory)
{
    if (!memory)
        return;
    free(memory->planes);
    free(memory->samples);
    e3d_array_free(&memory->covers);
    free(memory);
}

int e3d_multisample_reserve(e3d_multisample_memory **memory, int32_t samples)
{
    if (!*memory)
        *memory = calloc(1, sizeof **memory);
    e3d_multisample_memory *m = *memory;
    if (!m || samples <= m->samples_room)
        return m != NULL;
    free(m->planes);
    free(m->samples);
    m->samples_room = 0;
    m->planes = e3d_large_memory((size_t)samples * sizeof *m->planes);
    m->samples = e3d_large_memory((size_t)samples * sizeof *m->samples);
    if (!m->planes || !m->samples)
        return 0;
    memset(m->planes, 0, (size_t)samples * sizeof *m->planes); /* padding is read, but never used */
    memset(m->samples, 0, (size_t)samples * sizeof *m->samples);
    m->samples_room = samples;
    return 1;
}

/* ---- the planes ---- */

/* Draws record after record, if the last one in order shows; each keeps its ID. */
static void overwrite_link(const e3d_tile_job *job, const e3d_bin_link *link)
{
    const e3d_prepared *pass = job->in->pass;
    for (uint32_t i = 0; i < link->count; i++) {
        const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], link->id[i]);
        for (int s = 0; s < pass->pattern->count; s++) {
            e3d_tile_buffers buffers = {job->visible[s].z, job->visible[s].id, NULL};
            e3d_piece piece;
            if (e3d_piece_in_plane(pass, s, record, &job->tile, link->id[i], &piece))
                pass->kernels->raster_overwrite(&piece, &buffers);
        }
    }
}

static void overwrite_planes(const e3d_tile_job *job)
{
    const e3d_bins *bins = job->in->bins;
    for (int s = 0; s < job->in->pass->pattern->count; s++)
        e3d_visible_empty(&job->visible[s]);
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        const e3d_bin_link *link = e3d_first_records(set, 0, job->number);
        for (; link; link = e3d_bin_link_at(set, link->next))
            overwrite_link(job, link);
    }
}

static void draw_planes(const e3d_tile_job *job, int settle)
{
    const e3d_prepared *pass = job->in->pass;
    if (e3d_plans(pass, E3D_PLAN_SORTS)) {
        overwrite_planes(job);
        return;
    }
    if (job->state != E3D_TILE_KEPT)
        e3d_visible_clear(job->visible, &job->tile);
    e3d_visible_draw(pass, job->in->bins, job->number, job->state == E3D_TILE_DRAWN, job->visible);
    if (job->in->finishes)
        e3d_note_depths(pass->kernels, pass->pattern->count, job->visible, &job->out->depths[job->number]);
    if (settle)
        pass->kernels->msaa_settle(job->visible, pass->pattern, &job->in->bins->tables[E3D_SET_SCENE]);
}

/* ---- pixels ---- */

static uint64_t columns_inside(const e3d_tile *tile) { return ~(uint64_t)0 >> (E3D_TILE - tile->width); }

/* Splits the pixels into mixed ones and others. The others' IDs go to the thread's own plane; returns whether some of them show
 * nothing. */
static int split(const e3d_tile_job *job)
{
    uint64_t *mixed = job->memory->multisample->mixed;
    const e3d_prepared *pass = job->in->pass;
    int gaps = pass->kernels->msaa_split(job->visible, pass->pattern->count, job->tile.width, job->tile.height, mixed,
                                         &job->memory->visible);
    for (int y = 0; y < E3D_TILE; y++)
        mixed[y] = y < job->tile.height ? mixed[y] & columns_inside(&job->tile) : 0;
    return gaps;
}

static void mix_all(const e3d_tile_job *job)
{
    for (int y = 0; y < E3D_TILE; y++)
        job->memory->multisample->mixed[y] = y < job->tile.height ? columns_inside(&job->tile) : 0;
}

/* Shades the pixels that aren't mixed, as with one sample. */
static int shade_shared(const e3d_tile_job *job, int gaps)
{
    e3d_tile_memory *memory = job->memory;
    int with_mixed;
    int32_t count = job->in->pass->kernels->find_runs(&memory->visible, job->tile.width, job->tile.height, memory->shade.runs.rows, &with_mixed);
    if (gaps)
        e3d_resolve_begin(job->in->shade->store, &memory->pixels);
    return !count || e3d_shade_runs(job->in->shade, &job->tile, count, &job->shades);
}

/* Shades plane after plane, as pictures of one sample a pixel. */
static int shade_planes(const e3d_tile_job *job)
{
    const e3d_prepared *pass = job->in->pass;
    e3d_tile_memory *memory = job->memory;
    int done = 1, gaps;
    memory->pixels.sampled = 1;
    for (int s = 0; s < pass->pattern->count && done; s++) {
        job->visible[s].noted = 0; /* all IDs are written */
        int32_t count = pass->kernels->find_runs(&job->visible[s], job->tile.width, job->tile.height, memory->shade.runs.rows, &gaps);
        if (gaps)
            e3d_resolve_begin(job->in->shade->store, &memory->pixels);
        done = !count || e3d_shade_plane(job->in->shade, &job->tile, count, s, &job->shades);
        memcpy(&memory->multisample->samples[s], &memory->pixels.samples, sizeof memory->pixels.samples);
    }
    memory->pixels.sampled = 0;
    return done;
}

/* Shades each surface in each pixel once (R105); `layered`: its colours stay in the samples. */
static int shade_pixels(const e3d_tile_job *job, int layered)
{
    if (layered)
        mix_all(job);
    else if (!shade_shared(job, split(job)))
        return 0;
    return e3d_mixed_shade(job, layered);
}

int e3d_multisample_draw(const e3d_tile_job *job)
{
    e3d_tile_memory *memory = job->memory;
    int edges = e3d_plans(job->in->pass, E3D_PLAN_EDGES), alone = job->in->pass->frame->sample_shading;
    int layered = job->blended || edges || alone;
    draw_planes(job, layered || job->masked);
    if (!e3d_alpha_cut(job))
        return 0;
    e3d_lap(memory, &memory->ns_raster);
    if (!(alone ? shade_planes(job) : shade_pixels(job, layered)) || !e3d_alpha_blend(job))
        return 0;
    e3d_lap(memory, &memory->ns_shade);
    if (edges && !e3d_slots_mark_planes(job))
        return 0;
    if (layered)
        e3d_mixed_average_samples(job);
    e3d_lap(memory, &memory->ns_shade);
    return 1;
}
