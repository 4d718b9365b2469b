/* raster and shade with multisampling, records with alpha: each is found once in a pixel, for all samples that it covers there (R108).
 *
 * In:  the planes of a tile; the records of its masked or blended bins.
 * Out: of masked ones what they show, in the planes; blended ones laid over the colours of the samples.
 */
#include <string.h>

#include "core/grow.h"
#include "core/limits.h"
#include "core/sample_patterns.h"
#include "e3d.h"
#include "kernels/kernels.h"
#include "kernels/types/alpha.h"
#include "kernels/types/records.h"
#include "kernels/types/samples.h"
#include "kernels/types/shown.h"
#include "kernels/types/visible.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/records.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/shade/alpha.h"
#include "pipeline/shade/job.h"
#include "pipeline/tile/alpha.h"
#include "pipeline/tile/blend.h"
#include "pipeline/tile/job.h"
#include "pipeline/tile/memory.h"
#include "pipeline/tile/multisample_alpha.h"
#include "pipeline/tile/piece.h"

enum { MOST_FRAGMENTS = 1 << 17 }; /* of rows that are done together, as far as can be foreseen */

/* ---- lists of what records cover ---- */

/* A record in the planes of a tile. */
typedef struct plane_pieces {
    e3d_piece of[E3D_MOST_MSAA_SAMPLES];
    uint32_t live; /* those that it may show in: a bit each */
} plane_pieces;

static void find_pieces(const e3d_tile_job *job, uint32_t id, plane_pieces *out)
{
    const e3d_prepared *pass = job->in->pass;
    const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], id);
    out->live = 0;
    for (int s = 0; s < pass->pattern->count; s++)
        out->live |= (uint32_t)e3d_piece_in_plane(pass, s, record, &job->tile, id, &out->of[s]) << s;
}

/* R104 */
static float depth_at(const e3d_piece *p, int32_t pixel) { return e3d_piece_depth(p, pixel % E3D_TILE, pixel / E3D_TILE); }

/* Begins a list of what is in front of the planes; `all`: of everything that is no farther than the far plane. */
static int begin(const e3d_tile_job *job, int all, e3d_planes_list *list)
{
    e3d_array *covers = &job->memory->multisample->covers;
    int depths = !all && !e3d_plans(job->in->pass, E3D_PLAN_SORTS);
    if (!e3d_array_reserve(covers, E3D_SHOWN_ROOM + 2 * E3D_PAD, sizeof(int32_t)))
        return 0;
    *list = (e3d_planes_list){.shown = &job->memory->shade.shown, .cover = covers->data, .pattern = job->in->pass->pattern};
    for (int s = 0; s < job->in->pass->pattern->count; s++) {
        list->limit[s] = depths ? job->visible[s].z : job->memory->marks.bound;
        list->kept[s] = job->visible[s].id;
    }
    e3d_shown_begin(list->shown, 0);
    list->shown->pattern = list->pattern;
    return 1;
}

typedef int (*list_action)(const e3d_tile_job *job, const e3d_planes_list *list);

static int act(const e3d_tile_job *job, e3d_planes_list *list, list_action action)
{
    int done = !list->shown->count || action(job, list);
    e3d_shown_begin(list->shown, 0);
    list->shown->pattern = list->pattern;
    return done;
}

/* Lists what a record covers in rows y .. end - 1; whenever the list is full, it is acted on. */
static int add_record(const e3d_tile_job *job, uint32_t id, int32_t y, int32_t end, e3d_planes_list *list, list_action action)
{
    plane_pieces pieces;
    find_pieces(job, id, &pieces);
    if (!pieces.live)
        return 1;
    int32_t first = pieces.of[0].y0 > y ? pieces.of[0].y0 : y, last = pieces.of[0].y1 < end - 1 ? pieces.of[0].y1 : end - 1;
    while (first <= last) {
        first = job->in->pass->kernels->cover_planes(pieces.of, pieces.live, first, last, &job->in->bins->tables[E3D_SET_SCENE], list);
        if (first <= last && !act(job, list, action))
            return 0;
    }
    return 1;
}

/* The IDs of the tile's records of a kind; 0 when memory is out. */
static int find_ids(const e3d_tile_job *job, int kind)
{
    const e3d_bins *bins = job->in->bins;
    e3d_array *ids = &job->memory->multisample->ids;
    ids->count = 0;
    for (int32_t t = 0; t < bins->threads; t++) {
        const e3d_record_set *set = &bins->of[t]->sets[E3D_SET_SCENE];
        for (const e3d_bin_block *block = e3d_first_alpha(set, kind, job->number); block; block = e3d_next_alpha(set, kind, block)) {
            if (!e3d_array_reserve(ids, ids->count + block->count, sizeof(uint32_t)))
                return 0;
            for (uint32_t i = 0; i < block->count; i++)
                ((uint32_t *)ids->data)[ids->count++] = block->id[i];
        }
    }
    return 1;
}

/* ---- masked records ---- */

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

/* A sample shows a record if that wins there (R16). */
static void show(const e3d_tile_job *job, int32_t id, int32_t pixel, float z, e3d_visible_tile *plane)
{
    const e3d_record_table *table = &job->in->bins->tables[E3D_SET_SCENE];
    int32_t kept = plane->id[pixel];
    int wins = z < plane->z[pixel] || (z == plane->z[pixel] && kept >= 0 && e3d_id_comes_first(table, id, kept));
    if (e3d_plans(job->in->pass, E3D_PLAN_SORTS))
        wins = id > kept;
    if (!wins)
        return;
    plane->z[pixel] = z;
    plane->id[pixel] = id;
}

static int show_list(const e3d_tile_job *job, const e3d_planes_list *list)
{
    const e3d_prepared *pass = job->in->pass;
    const e3d_shade_memory *shade = &job->memory->shade;
    const float *alpha = job->memory->alpha.alpha;
    if (!e3d_alpha_shade(job, E3D_ALPHA_TEST, NULL, NULL, NULL))
        return 0;
    const e3d_visible_primitive *primitives = shade->pieces.data;
    const e3d_bucket *buckets = shade->buckets.data;
    for (int32_t p = 0; p < list->shown->pieces; p++) {
        const e3d_material *material = buckets[primitives[p].bucket].material;
        uint32_t id = list->shown->piece[p].id;
        plane_pieces pieces;
        find_pieces(job, id, &pieces);
        for (int32_t n = primitives[p].first; n < primitives[p].end; n++) {
            int32_t pixel = list->shown->sample[n] & (E3D_TILE_SAMPLES - 1);
            uint32_t left = (uint32_t)list->cover[n] & samples_left(pass, material, alpha[n]);
            for (; left; left &= left - 1) {
                int s = __builtin_ctz(left);
                show(job, (int32_t)id, pixel, depth_at(&pieces.of[s], pixel), &job->visible[s]);
            }
        }
    }
    return 1;
}

int e3d_multisample_cut(const e3d_tile_job *job)
{
    e3d_planes_list list;
    if (!begin(job, 1, &list) || !find_ids(job, E3D_ALPHA_MASKED))
        return 0;
    const e3d_array *ids = &job->memory->multisample->ids;
    for (size_t i = 0; i < ids->count; i++)
        if (!add_record(job, ((const uint32_t *)ids->data)[i], 0, E3D_TILE, &list, show_list))
            return 0;
    return act(job, &list, show_list);
}

/* ---- blended records ---- */

/* What is laid over the samples of a pixel, in front of what they keep. */
typedef struct layer_entry {
    int32_t pixel, id;
    uint32_t cover;
    float color[4];   /* clamped, with alpha */
    float through[4]; /* where light passes through some material: its shares that pass (e3d_alpha_layers) */
} layer_entry;

static int append_entries(const e3d_tile_job *job, const e3d_planes_list *list, const float (*color)[4], const float (*through)[4])
{
    e3d_array *kept = &job->memory->multisample->kept;
    const e3d_shown *shown = list->shown;
    if (!e3d_array_reserve(kept, kept->count + (size_t)shown->count, sizeof(layer_entry)))
        return 0;
    for (int32_t n = 0; n < shown->count; n++) {
        layer_entry *entry = (layer_entry *)kept->data + kept->count++;
        entry->pixel = shown->sample[n] & (E3D_TILE_SAMPLES - 1);
        entry->id = (int32_t)shown->piece[shown->of[n]].id;
        entry->cover = (uint32_t)list->cover[n];
        memcpy(entry->color, color[n], sizeof entry->color);
        if (through)
            memcpy(entry->through, through[n], sizeof entry->through);
    }
    return 1;
}

/* Shades what is listed, and keeps it. */
static int keep_list(const e3d_tile_job *job, const e3d_planes_list *list)
{
    e3d_alpha_fragments *f = &job->memory->alpha.fragments;
    int transmits = job->in->pass->draws->any_transmits;
    if (!e3d_alpha_reserve_fragments(f, (size_t)list->shown->count, 0, transmits))
        return 0;
    float (*through)[4] = transmits ? f->through.data : NULL;
    return e3d_alpha_shade(job, E3D_ALPHA_KEEP, f->color.data, through, NULL) && append_entries(job, list, f->color.data, through);
}

/* The kept entries that cover a sample become its plane's fragments. */
static int find_fragments(const e3d_tile_job *job, int s)
{
    const e3d_array *kept = &job->memory->multisample->kept;
    const layer_entry *entries = kept->data;
    e3d_alpha_fragments *f = &job->memory->alpha.fragments;
    plane_pieces pieces;
    int32_t id = E3D_NO_SLOT;
    e3d_alpha_clear_fragments(f);
    int transmits = job->in->pass->draws->any_transmits;
    if (!e3d_alpha_reserve_fragments(f, kept->count, kept->count, transmits))
        return 0;
    for (size_t i = 0; i < kept->count; i++) {
        if (!(entries[i].cover >> s & 1))
            continue;
        if (entries[i].id != id) {
            id = entries[i].id;
            find_pieces(job, (uint32_t)id, &pieces);
            ((int32_t *)f->ids.data)[f->ids.count++] = id;
        }
        size_t n = f->z.count++;
        ((float *)f->z.data)[n] = depth_at(&pieces.of[s], entries[i].pixel);
        ((int32_t *)f->sample.data)[n] = entries[i].pixel;
        ((int32_t *)f->of.data)[n] = (int32_t)f->ids.count - 1;
        memcpy((float (*)[4])f->color.data + n, entries[i].color, sizeof entries[i].color);
        if (transmits)
            memcpy((float (*)[4])f->through.data + n, entries[i].through, sizeof entries[i].through);
    }
    return 1;
}

static int blend_rows(const e3d_tile_job *job, int32_t y, int32_t end)
{
    const e3d_array *ids = &job->memory->multisample->ids;
    e3d_planes_list list;
    job->memory->multisample->kept.count = 0;
    if (!begin(job, 0, &list))
        return 0;
    for (size_t i = 0; i < ids->count; i++)
        if (!add_record(job, ((const uint32_t *)ids->data)[i], y, end, &list, keep_list))
            return 0;
    if (!act(job, &list, keep_list))
        return 0;
    for (int s = 0; s < job->in->pass->pattern->count; s++)
        if (!find_fragments(job, s) || !e3d_alpha_blend_fragments(job, &job->memory->multisample->samples[s]))
            return 0;
    return 1;
}

/* How many rows are done together, so that their fragments are not too many. */
static int32_t rows_of(const e3d_tile_job *job)
{
    const e3d_array *ids = &job->memory->multisample->ids;
    int64_t most = 0;
    for (size_t i = 0; i < ids->count; i++) {
        const e3d_record *record = e3d_record_at(&job->in->bins->tables[E3D_SET_SCENE], ((const uint32_t *)ids->data)[i]);
        e3d_piece piece;
        e3d_piece_box(&job->in->pass->view->viewport, record, &job->tile, &piece);
        most += (int64_t)(piece.x1 - piece.x0 + 1) * (piece.y1 - piece.y0 + 1);
    }
    int64_t rows = most <= MOST_FRAGMENTS ? E3D_TILE : (int64_t)E3D_TILE * MOST_FRAGMENTS / most;
    return rows < 1 ? 1 : (int32_t)rows;
}

/* ---- records that are sorted already ---- */

/* Leaves of a list of one record what comes after the records that are kept. */
static void leave_later(const e3d_tile_job *job, const e3d_planes_list *list)
{
    e3d_shown *shown = list->shown;
    int32_t left = 0, id = (int32_t)shown->piece[0].id;
    for (int32_t n = 0; n < shown->count; n++) {
        int32_t pixel = shown->sample[n] & (E3D_TILE_SAMPLES - 1);
        uint32_t cover = 0;
        for (uint32_t some = (uint32_t)list->cover[n]; some; some &= some - 1)
            cover |= id > job->visible[__builtin_ctz(some)].id[pixel] ? some & -some : 0;
        if (!cover)
            continue;
        list->cover[left] = (int32_t)cover;
        shown->sample[left++] = pixel | __builtin_ctz(cover) << E3D_SHOWN_NUMBER;
    }
    shown->count = left;
}

/* R84 at one sample. */
static void lay(const layer_entry *entry, int transmits, e3d_samples *samples)
{
    int32_t at = entry->pixel;
    float over[4] = {samples->color[0][at], samples->color[1][at], samples->color[2][at], samples->counts[at]};
    e3d_lay_any(entry->color, transmits ? entry->through : NULL, over);
    for (int k = 0; k < 3; k++)
        samples->color[k][at] = over[k];
    samples->counts[at] = over[3];
}

static int lay_list(const e3d_tile_job *job, const e3d_planes_list *list)
{
    e3d_multisample_memory *memory = job->memory->multisample;
    leave_later(job, list);
    memory->kept.count = 0;
    if (list->shown->count && !keep_list(job, list))
        return 0;
    const layer_entry *entries = memory->kept.data;
    for (size_t i = 0; i < memory->kept.count; i++)
        for (uint32_t left = entries[i].cover; left; left &= left - 1)
            lay(&entries[i], job->in->pass->draws->any_transmits, &memory->samples[__builtin_ctz(left)]);
    return 1;
}

static int blend_sequence(const e3d_tile_job *job)
{
    const e3d_array *ids = &job->memory->multisample->ids;
    e3d_planes_list list;
    if (!begin(job, 0, &list))
        return 0;
    for (size_t i = 0; i < ids->count; i++)
        if (!add_record(job, ((const uint32_t *)ids->data)[i], 0, E3D_TILE, &list, lay_list) || !act(job, &list, lay_list))
            return 0;
    return 1;
}

int e3d_multisample_blend(const e3d_tile_job *job)
{
    if (!find_ids(job, E3D_ALPHA_BLENDED))
        return 0;
    if (e3d_plans(job->in->pass, E3D_PLAN_SORTS))
        return blend_sequence(job);
    int32_t rows = rows_of(job);
    for (int32_t y = 0; y < E3D_TILE; y += rows)
        if (!blend_rows(job, y, y + rows < E3D_TILE ? y + rows : E3D_TILE))
            return 0;
    return 1;
}
