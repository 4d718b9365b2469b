/* geometry: cluster by cluster, transform, clip, setup and bin.
 *
 * Items are groups of clusters, the near ones first. Threads take some of them at a time; each keeps its
 * records and bins to itself.
 */
#include <stdatomic.h>
#include <string.h>

#include "core/always_inline.h"
#include "core/limits.h"
#include "core/mesh.h"
#include "core/pool.h"
#include "e3d.h"
#include "kernels/coverage.h"
#include "kernels/kernels.h"
#include "kernels/types/records.h"
#include "kernels/types/vertices.h"
#include "kernels/types/visible.h"
#include "pipeline/cull/cull.h"
#include "pipeline/cull/depths.h"
#include "pipeline/cull/history.h"
#include "pipeline/geometry/alpha.h"
#include "pipeline/geometry/bin.h"
#include "pipeline/geometry/clip.h"
#include "pipeline/geometry/fragments.h"
#include "pipeline/geometry/geometry.h"
#include "pipeline/geometry/lines.h"
#include "pipeline/geometry/records.h"
#include "pipeline/geometry/setup.h"
#include "pipeline/pass/boxes.h"
#include "pipeline/pass/draws.h"
#include "pipeline/pass/plan.h"
#include "pipeline/pass/prepared.h"
#include "pipeline/pass/view.h"

enum { TASKS_A_THREAD = 64, MOST_CANDIDATES_A_TASK = 32, UNITS_A_TASK = 8 };
enum { LEAST_WORK = 4 }; /* candidates or tasks of units, that are worth a second thread */

/* What all threads do with the candidates and the units. */
typedef struct geometry_job {
    const e3d_geometry_in *in;
    const e3d_geometry_out *out;
    atomic_llong next, next_unit;
} geometry_job;

/* Where a thread stands: one instance of one draw. */
typedef struct walker {
    const e3d_geometry_in *in;
    const e3d_geometry_out *out;
    const e3d_prepared *pass;
    e3d_geometry_state *state;
    const e3d_draw_state *draw;
    uint32_t number; /* of the instance */
    const e3d_view_instance *instance;
    uint32_t order; /* of the instance's first primitive */
    int open;       /* the cluster may reach into a window, where backs are not culled */
    const e3d_cluster *next;      /* of the next candidate, */
    unsigned next_left;           /* and those of them that are to be fetched: a bit each */
} walker;

/* ---- triangles ---- */

static e3d_cull cull_of(const walker *w, int32_t face)
{
    const e3d_frame *frame = w->pass->frame;
    if (!w->draw->any_two_sided || w->draw->all_two_sided)
        return w->draw->all_two_sided ? E3D_CULL_NONE : frame->cull;
    const e3d_mesh_desc *desc = &w->draw->mesh->desc;
    int32_t material = w->draw->draw->material_base + (desc->material_ids ? desc->material_ids[face] : 0);
    return frame->materials[material].two_sided ? E3D_CULL_NONE : frame->cull;
}

/* The sign of the area (screen, Y down) of what one-sided materials don't show: front faces have a negative one. */
static int culled_sign(const walker *w)
{
    e3d_cull cull = w->pass->frame->cull;
    int sign = cull == E3D_CULL_NONE ? 0 : cull == E3D_CULL_BACK ? 1 : -1;
    return w->instance->mirrored ? -sign : sign;
}

/* The one that setup may drop, whatever the material. */
static int drop_sign(const walker *w) { return w->draw->any_two_sided || w->open ? 0 : culled_sign(w); }

static e3d_primitive face_primitive(const walker *w, int32_t face)
{
    return (e3d_primitive){.order = w->order + (uint32_t)face,
                           .set = E3D_SET_SCENE,
                           .face = 1,
                           .alpha = e3d_alpha_kind_of(w->pass, w->draw, face),
                           .cull = cull_of(w, face),
                           .mirrored = w->instance->mirrored};
}

/* Emits one triangle, with the key that painter's algorithm sorts by. */
static void draw_triangle(walker *w, const e3d_cluster *cluster, const uint8_t *indices, int triangle)
{
    const e3d_vertices *v = &w->state->vertices;
    e3d_corner corner[3];
    for (int k = 0; k < 3; k++) {
        int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k] = (e3d_corner){v->sx[i], v->sy[i], v->zn[i], v->iw[i], {0, 0, 0}};
    }
    e3d_primitive primitive = face_primitive(w, w->draw->mesh->faces[cluster->first + triangle]);
    int64_t before = w->state->counters.records;
    e3d_emit(w->pass, w->state, corner, &primitive);
    w->state->counters.triangles_drawn += w->state->counters.records > before;
}

static void draw_clipped(walker *w, const e3d_cluster *cluster, const uint8_t *indices, int triangle)
{
    const e3d_vertices *v = &w->state->vertices;
    const e3d_viewport *viewport = &w->pass->view->viewport;
    float corner[3][4];
    e3d_clip_vertex polygon[E3D_CLIP_MAX];
    e3d_corner projected[E3D_CLIP_MAX];
    int good[E3D_CLIP_MAX];
    for (int k = 0; k < 3; k++) {
        int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        corner[k][0] = v->x[i];
        corner[k][1] = v->y[i];
        corner[k][2] = v->z[i];
        corner[k][3] = v->w[i];
    }
    int count = e3d_clip_triangle(corner, viewport, polygon);
    w->state->counters.triangles_clipped++;
    int64_t before = w->state->counters.records;
    for (int i = 0; i < count; i++) {
        good[i] = e3d_project(polygon[i].v, 1, viewport, &projected[i]);
        for (int k = 0; k < 3; k++)
            projected[i].c[k] = polygon[i].c[k];
    }
    e3d_primitive primitive = face_primitive(w, w->draw->mesh->faces[cluster->first + triangle]);
    primitive.cut = 1;
    for (int i = 1; i + 1 < count; i++)
        if (good[0] && good[i] && good[i + 1]) {
            const e3d_corner piece[3] = {projected[0], projected[i], projected[i + 1]};
            e3d_emit(w->pass, w->state, piece, &primitive);
        }
    w->state->counters.triangles_drawn += w->state->counters.records > before;
}

static void draw_records(walker *w, const e3d_record_request *request, int alpha)
{
    e3d_record_set *set = &w->state->sets[E3D_SET_SCENE];
    e3d_tile_span spans[E3D_CLUSTER_TRIANGLES];
    if (!e3d_records_fit(set, w->state->id_bits, E3D_CLUSTER_TRIANGLES)) {
        w->state->failed = 1;
        return;
    }
    e3d_record *records = (e3d_record *)set->records.data + set->records.count;
    int made = w->pass->kernels->record(request, records, spans);
    uint32_t number = (uint32_t)set->records.count;
    set->records.count += (size_t)made;
    w->state->counters.records += made;
    w->state->counters.triangles_drawn += made;
    if (!e3d_bin_records(w->pass->view, w->state, set, e3d_chains_of(set, alpha), number, spans, made))
        w->state->failed = 1;
}

/* Triangles of a cluster, a bit each, a vector at a time; tiny ones may be among them. */
static void draw_triangles(walker *w, const e3d_cluster *cluster, const uint8_t *indices, uint64_t triangles, int tiny, int alpha)
{
    uint8_t list[E3D_CLUSTER_TRIANGLES + E3D_PAD];
    int count = 0;
    if (!triangles)
        return;
    tiny = tiny && !w->pass->view->viewport.reach; /* with several samples in a pixel, a cover isn't found ahead */
    for (uint64_t left = triangles; left; left &= left - 1)
        list[count++] = (uint8_t)__builtin_ctzll(left);
    memset(list + count, 0, E3D_PAD);
    const e3d_record_request request = {.vertices = &w->state->vertices, .indices = indices, .triangles = list,
                                        .count = count, .tiny = tiny, .cull = drop_sign(w), .mirrored = w->instance->mirrored, .order = w->order,
                                        .faces = w->draw->mesh->faces + cluster->first, .viewport = &w->pass->view->viewport};
    draw_records(w, &request, alpha);
}

/* Whether a triangle that setup kept, because both sides of others of its cluster show, is culled. */
static int is_culled(const walker *w, const e3d_cluster *cluster, const uint8_t *indices, int triangle)
{
    const e3d_vertices *v = &w->state->vertices;
    int32_t x[3], y[3];
    for (int k = 0; k < 3; k++) {
        int i = indices[k * E3D_CLUSTER_TRIANGLES + triangle];
        x[k] = v->sx[i];
        y[k] = v->sy[i];
    }
    if ((e3d_doubled_area(x, y) < 0 ? -1 : 1) != culled_sign(w))
        return 0;
    const e3d_box box = e3d_sample_box(x, y, &w->pass->view->viewport);
    return !(w->open && e3d_meets_window(w->pass->view, &box)) &&
           cull_of(w, w->draw->mesh->faces[cluster->first + triangle]) != E3D_CULL_NONE;
}

/* Takes the triangles that are culled from the survivors. */
static void drop_culled(walker *w, const e3d_cluster *cluster, const uint8_t *indices)
{
    e3d_survivors *s = &w->state->survivors;
    uint64_t culled = 0;
    if (drop_sign(w) || !culled_sign(w) || w->draw->all_two_sided)
        return; /* setup did, or none are */
    for (uint64_t left = s->draw | s->small; left; left &= left - 1)
        if (is_culled(w, cluster, indices, __builtin_ctzll(left)))
            culled |= left & -left;
    s->draw &= ~culled;
    s->small &= ~culled;
}

/* Takes the triangles that have alpha from the survivors, small or not. They become records of their own lists: a fragment of a
 * micro-triangle would hide what is behind it at once. */
static void draw_alpha(walker *w, const e3d_cluster *cluster, const uint8_t *indices)
{
    e3d_survivors *s = &w->state->survivors;
    uint64_t of[E3D_ALPHA_UNSEEN + 1] = {0};
    for (uint64_t left = s->draw | s->small; left; left &= left - 1)
        of[e3d_alpha_kind_of(w->pass, w->draw, w->draw->mesh->faces[cluster->first + __builtin_ctzll(left)])] |= left & -left;
    s->draw &= of[E3D_ALPHA_NONE];
    s->small &= of[E3D_ALPHA_NONE];
    for (int kind = 0; kind < E3D_ALPHA_KINDS; kind++)
        draw_triangles(w, cluster, indices, of[kind], 1, kind);
}

static void draw_small(walker *w, const e3d_cluster *cluster, const uint8_t *indices)
{
    uint64_t small = w->state->survivors.small;
    e3d_drawn_cluster *drawn = e3d_fragments_cluster(&w->state->fragments);
    if (!drawn) {
        w->state->failed = 1;
        return;
    }
    /* Written in place: a copy of the struct would load wider words than were just stored, which stores cannot forward. */
    *drawn = (e3d_drawn_cluster){w->draw->mesh->faces + cluster->first, w->order, (int32_t)w->number,
                                 (int32_t)(w->draw - w->pass->draws->states), w->instance->mirrored};
    e3d_fragments_add(w->pass, w->state, indices, small);
}

static void transform_cluster(const walker *w, const e3d_candidate *candidate, const e3d_cluster *cluster)
{
    const e3d_kernels *kernels = w->pass->kernels;
    const e3d_view *view = w->pass->view;
    e3d_vertices *out = &w->state->vertices;
    if (w->draw->mesh->desc.components == 4)
        kernels->take_clip(cluster->positions, cluster->stride, cluster->vertices, &view->viewport, out);
    else
        kernels->transform(cluster->positions, cluster->stride, cluster->vertices, w->instance->clip, &view->viewport,
                           candidate->view.state == E3D_BOX_INSIDE && w->pass->frustum == view, out);
}

/* Prefetches for writing the cache lines of the next records: other threads read the last frame's records there. */
static void fetch_records(const walker *w, int count)
{
    e3d_record_set *set = &w->state->sets[E3D_SET_SCENE];
    if (!count || !e3d_records_fit(set, w->state->id_bits, E3D_CLUSTER_TRIANGLES))
        return; /* whoever makes them asks again */
    const e3d_record *next = (const e3d_record *)set->records.data + set->records.count;
    _Static_assert(sizeof *next == 64, "a record is a line of the cache");
    for (int i = 0; i < count; i++)
        __builtin_prefetch(next + i, 1);
}

/* A cluster that is transformed. */
static void draw_cluster(walker *w, const e3d_cluster *cluster)
{
    const e3d_mesh *mesh = w->draw->mesh;
    const e3d_kernels *kernels = w->pass->kernels;
    const e3d_viewport *viewport = &w->pass->view->viewport;
    e3d_geometry_state *state = w->state;
    int fragments = e3d_plans(w->pass, E3D_PLAN_FRAGMENTS) && mesh->desc.components == 3 && e3d_fragments_fit(state);
    const uint8_t *indices = e3d_cluster_indices(cluster, mesh->desc.components);
    e3d_survivors *s = &state->survivors;
    int count = kernels->setup(&state->vertices, indices, cluster->triangles, drop_sign(w), fragments, viewport, s);
    state->counters.triangles_rejected += cluster->triangles - count;
    drop_culled(w, cluster, indices);
    fetch_records(w, __builtin_popcountll(s->draw));
    int sorts = e3d_plans(w->pass, E3D_PLAN_SORTS);
    if (w->draw->any_alpha && !sorts)
        draw_alpha(w, cluster, indices);
    if (s->small)
        draw_small(w, cluster, indices);
    if (!sorts)
        draw_triangles(w, cluster, indices, s->draw, !fragments, E3D_ALPHA_NONE);
    for (uint64_t left = sorts ? s->draw : 0; left; left &= left - 1)
        draw_triangle(w, cluster, indices, __builtin_ctzll(left));
    for (uint64_t left = s->clip; left; left &= left - 1)
        draw_clipped(w, cluster, indices, __builtin_ctzll(left));
}

/* ---- candidates ---- */

/* Whether what is in a box may reach into a window. */
static int reaches_window(const walker *w, const float lo[3], const float hi[3])
{
    e3d_box_view box;
    e3d_view_box(&w->pass->view->viewport, w->instance->clip, lo, hi, &box);
    return box.state != E3D_BOX_OUTSIDE && e3d_meets_window(w->pass->view, &box.samples);
}

/* Whether what the cluster's vertices enclose may: less than its box does. */
static int vertices_reach_window(const walker *w)
{
    e3d_box_view view;
    return !e3d_view_vertices(&w->pass->view->viewport, &w->state->vertices, &view) || e3d_meets_window(w->pass->view, &view.samples);
}

/* The group's clusters that may reach into a window: a bit each. */
static unsigned find_open(const walker *w, const e3d_group_box *group)
{
    const e3d_cluster *clusters = &w->draw->mesh->clusters[group->first_cluster];
    unsigned open = 0;
    if (!w->pass->view->window_count || w->draw->all_two_sided || !reaches_window(w, group->lo, group->hi))
        return 0;
    for (int k = 0; k < group->clusters; k++)
        open |= (unsigned)reaches_window(w, clusters[k].lo, clusters[k].hi) << k;
    return open;
}

/* A bit for each cluster. */
static unsigned find_away(const walker *w, const e3d_group_box *group)
{
    if (!e3d_plans(w->pass, E3D_PLAN_FACES)) /* edges are drawn whichever way faces face */
        return 0;
    return w->pass->kernels->face_away(&w->draw->mesh->clusters[group->first_cluster], group->clusters, &w->instance->facing,
                                       drop_sign(w), w->instance->clip, &w->pass->view->viewport);
}

/* Whether what earlier rounds drew hides a box. */
static int is_hidden(const walker *w, const e3d_box_view *view)
{
    return w->in->round.tested && e3d_is_hidden(w->in->depths, w->pass->view->tiles_x, view);
}

/* What becomes of a cluster, before it is tested against what is drawn. Where it may show, *view is what that test needs. */
static e3d_cull_result result_of(const walker *w, const e3d_candidate *candidate, const e3d_cluster *cluster, int away, e3d_box_view *view)
{
    const float *clip = w->pass->frustum->instances[w->number].clip;
    if (!cluster->any_finite)
        return E3D_RESULT_OUTSIDE;
    if (away)
        return candidate->view.state == E3D_BOX_INSIDE || e3d_box_state(clip, cluster->lo, cluster->hi) != E3D_BOX_OUTSIDE
                   ? E3D_RESULT_BACKFACING
                   : E3D_RESULT_OUTSIDE;
    if (!w->in->round.tested && candidate->view.state == E3D_BOX_INSIDE)
        return E3D_RESULT_DRAWN;
    e3d_view_box(&w->pass->view->viewport, clip, cluster->lo, cluster->hi, view);
    return view->state == E3D_BOX_OUTSIDE ? E3D_RESULT_OUTSIDE : E3D_RESULT_DRAWN;
}

/* Whether a cluster is drawn, and if not, why. A box may be hidden by what earlier rounds drew. */
static e3d_cull_result tested_result_of(const walker *w, const e3d_candidate *candidate, const e3d_cluster *cluster, int away)
{
    e3d_box_view view;
    e3d_cull_result result = result_of(w, candidate, cluster, away, &view);
    return result == E3D_RESULT_DRAWN && is_hidden(w, &view) ? E3D_RESULT_OCCLUDED : result;
}

/* The results of those of a group's clusters whose bits are set; a bit for each that is drawn. What was seen faced the viewer, and is
 * tested again in turn. */
static unsigned find_results(const walker *w, const e3d_candidate *candidate, const e3d_group_box *group, unsigned asked, unsigned open,
                             e3d_cull_result results[E3D_GROUP_CLUSTERS])
{
    unsigned shown = 0, away = w->in->round.choice == E3D_SEEN_CANDIDATES ? 0 : find_away(w, group) & ~open;
    for (unsigned left = asked; left; left &= left - 1) {
        int k = __builtin_ctz(left);
        results[k] = tested_result_of(w, candidate, &w->draw->mesh->clusters[group->first_cluster + k], away >> k & 1);
        shown |= (unsigned)(results[k] == E3D_RESULT_DRAWN) << k;
    }
    return shown;
}

/* Whether what is drawn hides all that the cluster's vertices enclose on the screen: less than its box does. */
static int vertices_are_hidden(const walker *w)
{
    e3d_box_view view;
    return e3d_view_vertices(&w->pass->view->viewport, &w->state->vertices, &view) && is_hidden(w, &view);
}

/* Whether the vertices of a group's clusters are worth testing: those of a smaller one are drawn in the same time. */
static int is_wide(const e3d_box *samples)
{
    enum { WIDE = 48 };
    return (samples->x1 - samples->x0) + (samples->y1 - samples->y0) > WIDE;
}

/* Threads may mark the same instance. */
static void mark(walker *w, const e3d_candidate *candidate, e3d_cull_result result)
{
    uint8_t *marks = &w->out->marks[candidate->instance];
    uint8_t bits = result == E3D_RESULT_DRAWN        ? E3D_MARK_UNOCCLUDED | E3D_MARK_DRAWN
                   : result == E3D_RESULT_BACKFACING ? E3D_MARK_UNOCCLUDED
                                            : 0;
    if (bits & ~__atomic_load_n(marks, __ATOMIC_RELAXED))
        __atomic_fetch_or(marks, bits, __ATOMIC_RELAXED);
}

/* Prefetches a cluster's positions and indices, which lie one after the other. */
static ALWAYS_INLINE void fetch_cluster(const e3d_cluster *c, int32_t components)
{
    enum { LINE = 64 };
    const char *from = (const char *)c->positions, *end = (const char *)e3d_cluster_indices(c, components) + 3 * E3D_CLUSTER_TRIANGLES;
    for (; from < end; from += LINE)
        __builtin_prefetch(from);
}

/* The next one of a group, or behind its last ones those of the next candidate: all at once would wait for each other. */
static void fetch_next(walker *w, const e3d_cluster *clusters, unsigned left)
{
    const e3d_mesh *mesh = w->draw->mesh;
    if (left) {
        fetch_cluster(&clusters[__builtin_ctz(left)], mesh->desc.components);
    } else if (w->next_left) {
        fetch_cluster(&w->next[__builtin_ctz(w->next_left)], 3);
        w->next_left &= w->next_left - 1;
    }
}

static void count_cluster(walker *w, const e3d_candidate *candidate, const e3d_cluster *cluster, e3d_cull_result result)
{
    w->state->counters.culled.clusters[result]++;
    w->state->counters.culled.triangles[result] += cluster->triangles;
    if (result == E3D_RESULT_DRAWN && !e3d_plans(w->pass, E3D_PLAN_FACES))
        w->state->counters.triangles_drawn += cluster->triangles;
    mark(w, candidate, result);
}

/* Counts the clusters of a hidden group; it looks at each only where not all count, or not all are in the frustum. */
static void count_hidden(walker *w, const e3d_candidate *candidate, const e3d_group_box *group, unsigned counted)
{
    e3d_cull_counters *counters = &w->state->counters.culled;
    const e3d_cluster *clusters = &w->draw->mesh->clusters[group->first_cluster];
    const float *clip = w->pass->frustum->instances[w->number].clip;
    int inside = candidate->view.state == E3D_BOX_INSIDE;
    if (inside && counted == (1u << group->clusters) - 1) {
        counters->clusters[E3D_RESULT_OCCLUDED] += group->clusters;
        counters->triangles[E3D_RESULT_OCCLUDED] += group->triangles;
        return;
    }
    for (unsigned left = counted; left; left &= left - 1) {
        const e3d_cluster *cluster = &clusters[__builtin_ctz(left)];
        int outside = !inside && e3d_box_state(clip, cluster->lo, cluster->hi) == E3D_BOX_OUTSIDE;
        counters->clusters[outside ? E3D_RESULT_OUTSIDE : E3D_RESULT_OCCLUDED]++;
        counters->triangles[outside ? E3D_RESULT_OUTSIDE : E3D_RESULT_OCCLUDED] += cluster->triangles;
    }
}

/* Draws the group's clusters that are in `wanted` and may show; returns all that may, of those that are in `asked`. Bit k is
 * cluster k. */
static unsigned draw_group(walker *w, const e3d_candidate *candidate, const e3d_group_box *group, unsigned asked, unsigned wanted)
{
    const e3d_mesh *mesh = w->draw->mesh;
    const e3d_cluster *clusters = &mesh->clusters[group->first_cluster];
    unsigned shown = asked, open;
    e3d_cull_result results[E3D_GROUP_CLUSTERS] = {E3D_RESULT_DRAWN};
    if (is_hidden(w, &candidate->view)) {
        count_hidden(w, candidate, group, asked & wanted);
        return 0;
    }
    w->order = w->pass->draws->instances[w->number].order;
    if (!w->instance->ready)
        e3d_view_finish_instance(w->out->view, w->out->draws, w->number);
    w->open = 0; /* of none yet */
    open = find_open(w, group);
    if (mesh->desc.components == 3 && e3d_culls_parts(w->pass->frame))
        shown = find_results(w, candidate, group, asked, open, results);
    int closely = w->in->round.tested && is_wide(&candidate->view.samples);
    unsigned left = !e3d_plans(w->pass, E3D_PLAN_FACES) ? 0 : closely ? shown : shown & wanted;
    for (; left; left &= left - 1) {
        int k = __builtin_ctz(left);
        fetch_next(w, clusters, left & (left - 1));
        transform_cluster(w, candidate, &clusters[k]);
        w->open = open >> k & 1 && vertices_reach_window(w);
        if (closely && vertices_are_hidden(w)) {
            results[k] = E3D_RESULT_OCCLUDED;
            shown &= ~(1u << k);
        } else if (wanted >> k & 1) {
            draw_cluster(w, &clusters[k]);
        }
    }
    for (unsigned left = asked & wanted; left; left &= left - 1)
        count_cluster(w, candidate, &clusters[__builtin_ctz(left)], results[__builtin_ctz(left)]);
    return shown;
}

/* Clusters that the last frame saw are drawn without a test. A quarter of them is tested again in each frame, so that those that
 * are hidden now drop out. */
enum { FRAMES_A_TRIAL = 4 };

/* Stores what showed; other threads may read it at the same time, to see what to prefetch. */
static void set_seen(const walker *w, const e3d_candidate *candidate, unsigned seen)
{
    __atomic_store_n(&w->out->seen[candidate->number], (uint8_t)seen, __ATOMIC_RELAXED);
}

static void visit_candidate(walker *w, const e3d_candidate *candidate)
{
    w->number = candidate->instance;
    w->instance = &w->pass->view->instances[candidate->instance];
    w->draw = &w->pass->draws->states[candidate->draw];
    const e3d_group_box *group = &w->draw->mesh->groups[candidate->group];
    unsigned all = (1u << group->clusters) - 1;
    if (w->in->round.choice == E3D_ALL_CANDIDATES) {
        unsigned shown = draw_group(w, candidate, group, all, all);
        if (w->out->seen)
            set_seen(w, candidate, shown);
        return;
    }
    unsigned seen = w->out->seen[candidate->number];
    if (w->in->round.choice == E3D_SEEN_CANDIDATES) {
        if (seen)
            draw_group(w, candidate, group, seen, seen);
        return;
    }
    const e3d_history *history = w->in->history;
    int tried = history->doubts || (candidate->number + history->trials) % FRAMES_A_TRIAL == 0;
    unsigned trusted = tried ? 0 : seen;
    if (trusted != all)
        set_seen(w, candidate, trusted | draw_group(w, candidate, group, all & ~trusted, all & ~seen));
}

/* ---- the walk ---- */

/* Prefetches what a candidate will read of its instance; few of those that did not show last time read it. */
static void fetch_candidate(const walker *w, const e3d_candidate *candidate)
{
    enum { LINE = 64 };
    const char *seen = (const char *)&w->pass->view->instances[candidate->instance];
    if (w->in->round.choice == E3D_ALL_CANDIDATES || __atomic_load_n(&w->out->seen[candidate->number], __ATOMIC_RELAXED))
        for (size_t at = 0; at < sizeof(e3d_view_instance); at += LINE)
            __builtin_prefetch(seen + at);
}

/* Prefetches what fetch_candidate reads. */
static void fetch_seen(const walker *w, const e3d_candidate *candidate)
{
    if (w->in->round.choice != E3D_ALL_CANDIDATES)
        __builtin_prefetch(&w->out->seen[candidate->number]);
}

/* The first two clusters of the next candidate that may be drawn, as far as one can tell yet: a bit each. What tells of all of them is
 * fetched. */
static unsigned find_next(walker *w, const e3d_candidate *candidate)
{
    const e3d_mesh *mesh = w->pass->draws->states[candidate->draw].mesh;
    size_t first = (size_t)candidate->group * E3D_GROUP_CLUSTERS, count = (size_t)mesh->cluster_count;
    unsigned may = w->in->round.choice == E3D_ALL_CANDIDATES    ? ~0u
                   : w->in->round.choice == E3D_SEEN_CANDIDATES ? __atomic_load_n(&w->out->seen[candidate->number], __ATOMIC_RELAXED)
                                                          : 0;
    unsigned found = 0;
    if (mesh->desc.components != 3 || count <= E3D_GROUP_CLUSTERS)
        return 0;
    w->next = &mesh->clusters[first];
    for (size_t k = 0; k < E3D_GROUP_CLUSTERS && first + k < count; k++) {
        __builtin_prefetch(&w->next[k]);
        if (may >> k & 1 && !(found & (found - 1)))
            found |= 1u << k;
    }
    return found;
}

/* How many candidates a thread takes at once: many, so that it seldom asks; few, so that none waits long for another's last. */
static int64_t candidates_a_task(const e3d_geometry_in *in)
{
    int64_t candidates = (in->round.end - in->round.first) / (TASKS_A_THREAD * in->pass->threads);
    return candidates < 1 ? 1 : candidates > MOST_CANDIDATES_A_TASK ? MOST_CANDIDATES_A_TASK : candidates;
}

static void walk_candidates(walker *w, atomic_llong *next)
{
    enum { AHEAD = 6 };
    const e3d_candidate *candidates = w->in->candidates;
    int64_t end = w->in->round.end, task = candidates_a_task(w->in);
    while (!w->state->failed) {
        int64_t first = w->in->round.first + atomic_fetch_add(next, task);
        if (first >= end)
            return;
        for (int64_t i = first; i < first + task && i < end; i++) {
            if (i + 2 * AHEAD < end)
                fetch_seen(w, &candidates[i + 2 * AHEAD]);
            if (i + AHEAD < end)
                fetch_candidate(w, &candidates[i + AHEAD]);
            w->next_left = i + 1 < end ? find_next(w, &candidates[i + 1]) : 0;
            visit_candidate(w, &candidates[i]);
        }
    }
}

static void walk_units(const e3d_prepared *pass, e3d_geometry_state *state, atomic_llong *next)
{
    while (!state->failed) {
        int64_t first = atomic_fetch_add(next, UNITS_A_TASK);
        if (first >= pass->draws->units)
            return;
        for (int64_t unit = first; unit < first + UNITS_A_TASK && unit < pass->draws->units; unit++) {
            const e3d_draw_state *draw = e3d_draw_of_unit(pass->draws, unit);
            int32_t instance = (int32_t)((unit - draw->unit_base) / draw->units);
            e3d_draw_unit(pass, state, draw, instance, (int32_t)((unit - draw->unit_base) % draw->units));
        }
    }
}

static void geometry_work(void *argument, int number)
{
    geometry_job *job = argument;
    walker w = {.in = job->in, .out = job->out, .pass = job->in->pass, .state = job->out->bins->of[number]};
    walk_candidates(&w, &job->next);
    e3d_fragments_flush(w.pass, w.state);
    if (job->in->round.last)
        walk_units(w.pass, w.state, &job->next_unit);
}

int e3d_geometry(const e3d_geometry_in *in, const e3d_geometry_out *out)
{
    geometry_job job = {.in = in, .out = out};
    int64_t work = in->round.end - in->round.first + in->pass->draws->units / UNITS_A_TASK;
    int failed = 0;
    e3d_pool_run(work > LEAST_WORK ? in->pass->threads : 1, geometry_work, &job);
    for (int32_t t = 0; t < in->pass->threads; t++)
        failed |= out->bins->of[t]->failed;
    e3d_bins_index(out->bins);
    return !failed;
}
