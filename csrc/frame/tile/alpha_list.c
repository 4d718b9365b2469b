/* raster, records with alpha: lists the samples that they cover, and has them shaded. With multisampling an entry is a pixel, with
 * all samples that the record covers there (R108), or a sample of one (R195). */
#include "base/grow.h"
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
#include "frame/shade/shade.h"
#include "frame/tile/alpha_list.h"
#include "frame/tile/piece.h"

static void empty(const e3d_tile_job *job)
{
    e3d_shown_begin(&job->memory->shade.shown, 0);
    job->memory->shade.shown.pattern = job->in->pass->pattern;
    job->memory->shade.shown.at_samples = job->in->pass->pattern && job->memory->multisample->alpha.alone;
}

/* Begins a list of pixels in planes; 0 when memory is out. */
static int begin_planes(const e3d_tile_job *job, int depths, int alone)
{
    const e3d_sample_pattern *pattern = job->in->pass->pattern;
    e3d_multisample_memory *memory = job->memory->multisample;
    if (!e3d_array_reserve(&memory->covers, E3D_SHOWN_ROOM + 2 * E3D_PAD, sizeof(int32_t)))
        return 0;
    memory->alpha = (e3d_msaa_list){.shown = &job->memory->shade.shown, .cover = memory->covers.data, .alone = alone, .pattern = pattern};
    empty(job);
    for (int s = 0; s < pattern->count; s++) {
        memory->alpha.limit[s] = depths ? job->visible[s].z : job->memory->marks.bound;
        memory->alpha.kept[s] = job->visible[s].id;
    }
    return 1;
}

/* Begins a list. If the last record in order shows, depths hide nothing. Masks have one alpha in a pixel, even where samples are
 * shaded each (R195); these list `all`. */
int e3d_alpha_begin(const e3d_tile_job *job, int all)
{
    e3d_alpha_memory *memory = &job->memory->alpha;
    int depths = !all && !e3d_plans(job->in->pass, E3D_PLAN_SORTS);
    if (job->in->pass->pattern)
        return begin_planes(job, depths, !all && job->in->pass->frame->sample_shading);
    empty(job);
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

void e3d_alpha_planes(const e3d_tile_job *job, uint32_t id, e3d_plane_pieces *out)
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
    e3d_plane_pieces planes;
    planes.live = 0;
    if (pass->pattern)
        e3d_alpha_planes(job, piece->slot, &planes);
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
    to.alpha = to.alpha ? to.alpha : job->memory->alpha.alpha;
    to.primitive = -1;
    out.sink = sink;
    out.list = &to;
    return e3d_shade_shown(job->in->shade, &job->tile, &out);
}
